"""Commands and references as velocities over time. Not for: the controller's checks, stops and rows."""

from __future__ import annotations

import math

import numpy as np

from swayless.design.shaper import FloatArray, Impulses
from swayless.errors import DesignError
from swayless.plant.response import VelocityProfile
from swayless.report.plotted import PlottedCommand, PlottedShaper
from swayless.report.sampling import MOST_POINTS

_ROUNDING = 1e-9  # of a tick: what was meant to be a whole number of ticks is one


def command_profile(command: PlottedCommand, shaper: PlottedShaper) -> VelocityProfile:
    """Make the command as the shaper meets it: after the ramps, and in ticks if the design has a tick.

    The press lasts for `accepted_hold_s`.

    Raises
    ------
    DesignError
        If a ramp has more ticks than a figure can show.

    Examples
    --------
    A press of 1 s at 0.5 m/s2 gets to 0.5 m/s of the 2 m/s asked for:

    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> zv = design_shaper("zv", Mode(0.5))
    >>> short = PlottedCommand(2.0, hold_s=1.0, acceleration_m_s2=0.5)
    >>> command_profile(short, PlottedShaper("ZV", zv, zv.guarantee)).vertices()
    (array([0., 0., 1., 1., 1., 1.]), array([0. , 0. , 0.5, 0.5, 0.5, 0. ]))
    """
    hold_s = accepted_hold_s(command, shaper)
    if shaper.tick_s is not None and math.isfinite(hold_s):
        hold_s = math.ceil(hold_s / shaper.tick_s - _ROUNDING) * shaper.tick_s
    peak_m_s = min(command.speed_m_s, command.acceleration_m_s2 * hold_s)
    ramps = [_ramp(0.0, peak_m_s, command.acceleration_m_s2, shaper.tick_s)]
    if math.isfinite(hold_s):
        ramps.append(_ramp(hold_s, -peak_m_s, command.deceleration_m_s2, shaper.tick_s))
    times_s, jumps_m_s, acceleration_steps_m_s2 = np.concatenate(ramps, axis=1)
    return VelocityProfile(times_s, jumps_m_s, acceleration_steps_m_s2)


def accepted_hold_s(command: PlottedCommand, shaper: PlottedShaper) -> float:
    """Tell how long the press counts, in seconds.

    A design with negative amplitudes takes the release only when it is settled: when the ramp is over and
    the last impulse has acted. Otherwise the reference would leave the range of the command.
    """
    if not np.any(shaper.impulses.amplitudes < 0.0):
        return command.hold_s
    return max(command.hold_s, command.speed_m_s / command.acceleration_m_s2 + shaper.duration_s)


def shaped_profile(command: VelocityProfile, impulses: Impulses) -> VelocityProfile:
    """Convolve a velocity with impulses: the reference."""
    return VelocityProfile(
        np.add.outer(command.times_s, impulses.times_s).ravel(),
        np.multiply.outer(command.jumps_m_s, impulses.amplitudes).ravel(),
        np.multiply.outer(command.acceleration_steps_m_s2, impulses.amplitudes).ravel(),
    )


def _ramp(start_s: float, change_m_s: float, limit_m_s2: float, tick_s: float | None) -> FloatArray:
    """Make one ramp: its times, jumps and acceleration steps, shape (3, n)."""
    if math.isinf(limit_m_s2):
        return np.array([[start_s], [change_m_s], [0.0]])
    duration_s = abs(change_m_s) / limit_m_s2
    if tick_s is None:
        slope_m_s2 = math.copysign(limit_m_s2, change_m_s)
        return np.array([[start_s, start_s + duration_s], [0.0, 0.0], [slope_m_s2, -slope_m_s2]])
    ticks = duration_s / tick_s
    if ticks > MOST_POINTS:
        raise DesignError(f"a ramp of {ticks:.6g} ticks: a figure shows at most {MOST_POINTS}")
    number = np.arange(math.ceil(ticks - _ROUNDING))
    reached = np.append(number[1:] / ticks, 1.0)  # the last tick takes what is left
    jumps_m_s = change_m_s * np.diff(reached, prepend=0.0)
    return np.stack([start_s + tick_s * number, jumps_m_s, np.zeros(number.size)])
