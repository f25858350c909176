"""The response figure: command, reference and the swing of the load over time.

Not for: large angles, hoisting and drives (simulation).
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from swayless.design.shaper import FloatArray
from swayless.plant import Mode
from swayless.plant.response import VelocityProfile, swing_state
from swayless.report.motion import accepted_hold_s, command_profile, shaped_profile
from swayless.report.plotted import PlottedCommand, PlottedShaper
from swayless.report.sampling import point_count
from swayless.report.style import GREY, LineStyle, figure_style, legend_above, line_style, new_figure, settle

_PERIODS_AFTER = 2.5  # shown after the last change
_LEAD_RATIO = 0.04  # of the figure, shown before the command

_UNSHAPED: LineStyle = {"color": GREY, "linestyle": (0, (5, 2))}
_SHAPED = line_style(0)


def response_figure(
    shaper: PlottedShaper, *, command: PlottedCommand | None = None, mode: Mode | None = None
) -> Figure:
    """Draw a command, the reference it becomes, and how the load swings with and without the shaper.

    The swing is in % of the swing that a jump to the command's speed leaves unshaped, so that the residual
    of a step without ramps is the residual vibration of the shaper.

    Parameters
    ----------
    shaper : PlottedShaper
        The design. With a tick the command moves in ticks.
    command : PlottedCommand, optional
        A step to 1 m/s unless given.
    mode : Mode, optional
        What swings: the design's own mode unless given.

    Returns
    -------
    Figure
        For `save_figure`.

    Raises
    ------
    DesignError
        If the move is too long to be drawn.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> zv = design_shaper("zv", Mode(0.2))
    >>> figure = response_figure(PlottedShaper("ZV", zv, zv.guarantee), mode=Mode(0.21))
    >>> [line.get_label() for line in figure.axes[1].lines]
    ['without shaper: residual 100.00 %', 'with shaper: residual 7.85 %']
    """
    command = PlottedCommand() if command is None else command
    mode = shaper.guarantee.mode if mode is None else mode
    with figure_style():
        return settle(_drawn(shaper, command, mode))


def _drawn(shaper: PlottedShaper, command: PlottedCommand, mode: Mode) -> Figure:
    """Draw the panel with the speeds and the one with the swings."""
    given = command_profile(command, shaper)
    reference = shaped_profile(given, shaper.impulses)
    time_s = _times_s(reference, mode)
    waits = ", release waits for rest" if accepted_hold_s(command, shaper) > command.hold_s else ""
    figure, (speeds, swings) = new_figure(f"{shaper.label}: {command.title}", (2.1, 2.9), sharex=True)
    _draw_velocity(speeds, given, time_s, label="command" + waits, look=_UNSHAPED)
    _draw_velocity(speeds, reference, time_s, label="reference", look=_SHAPED)
    for velocity, label, look in ((given, "without", _UNSHAPED), (reference, "with", _SHAPED)):
        percent = 100.0 / command.speed_m_s * swing_state(mode, velocity, time_s)
        last_change_s = velocity.times_s[-1]
        _draw_swing(swings, time_s, percent, last_change_s=last_change_s, label=f"{label} shaper", look=look)
    speeds.set_title(f"{mode.frequency_hz:.4g} Hz, damping ratio {mode.damping_ratio:.3g}", loc="right")
    speeds.set_ylabel("Speed (m/s)")
    swings.set_ylabel("Swing (% of an unshaped jump's)")
    swings.set_xlabel("Time (s)")
    swings.set_xlim(time_s[0], time_s[-1])
    for axes in (speeds, swings):
        legend_above(axes)
    return figure


def _times_s(reference: VelocityProfile, mode: Mode) -> FloatArray:
    """Choose times to draw at: even ones, and each change of the reference, where the swing has a corner."""
    end_s = float(reference.times_s[-1]) + _PERIODS_AFTER * mode.damped_period_s
    count = point_count(mode.frequency_hz * end_s, f"a move of {end_s:g} s")
    return np.union1d(np.linspace(-_LEAD_RATIO * end_s, end_s, count), reference.times_s)


def _draw_velocity(
    axes: Axes, velocity: VelocityProfile, time_s: FloatArray, *, label: str, look: LineStyle
) -> None:
    """Draw a velocity corner by corner, from rest before it to steady after it."""
    corners_s, velocity_m_s = velocity.vertices()
    corners_s = np.concatenate([time_s[:1], corners_s, time_s[-1:]])
    velocity_m_s = np.concatenate([[0.0], velocity_m_s, velocity_m_s[-1:]])
    axes.plot(corners_s, velocity_m_s, label=label, **look)


def _draw_swing(
    axes: Axes,
    time_s: FloatArray,
    percent: NDArray[np.complex128],
    *,
    last_change_s: float,
    label: str,
    look: LineStyle,
) -> None:
    """Draw a swing, shade its envelope from the last change on, and name what is left there."""
    after = time_s >= last_change_s
    envelope = np.abs(percent[after])
    axes.plot(time_s, percent.imag, label=f"{label}: residual {envelope[0]:.2f} %", **look)
    axes.fill_between(time_s[after], -envelope, envelope, color=look["color"], alpha=0.12, linewidth=0.0)
