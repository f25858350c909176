"""A flexible arm whose frequency depends on how far it reaches, like the one of Magee and Book.

Not for: several vibrations at once, nor for how links and joints make up the reach.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import ModuleType
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from swayless.errors import PlantError
from swayless.plant.simulation.crane_ticks import Hold, check_tick, finite, reference_ends
from swayless.plant.simulation.hoisting_crane import check_damping
from swayless.plant.simulation.integration import State, Value, integrate, steps_per_tick
from swayless.plant.simulation.trajectory import FloatArray


class ArmTick(NamedTuple):
    """Inputs of one tick of an arm; in a simulation of many cases each is an array, one element a case."""

    command_m: Value
    slope_m_s: Value
    reach_m: Value
    reach_slope_m_s: Value


@dataclass(frozen=True, eq=False)
class ArmTrajectory:
    """A simulated move of a flexible arm, given at rest and at the end of every tick.

    Shapes are (ticks + 1,), or (cases, ticks + 1) when many cases were simulated.

    Parameters
    ----------
    time_s : ndarray, shape (ticks + 1,)
    tip_m, tip_m_s, tip_m_s2 : ndarray
        Position, speed and acceleration of the tip across the arm.
    frequency_hz : ndarray
        Of the arm at its present reach.
    """

    time_s: FloatArray
    tip_m: FloatArray
    tip_m_s: FloatArray
    tip_m_s2: FloatArray
    frequency_hz: FloatArray


@dataclass(frozen=True)
class FlexibleArm:
    """A tip that is commanded across the arm, y'' = w^2 (r - y) - 2 d w y', with w = 2 pi f(reach).

    r is the commanded position and y the tip's: what an impulse in r does is Magee's eq 1. The frequency is
    that of a light beam with a heavy tip, w^2 = 3 E I / (m reach^3): frequency_hz (reach / reach_m)^(-3/2).

    This is an assumption. Magee and Book give the range of the frequency over their circle (3.7 to 5.5 Hz),
    but neither where the circle lies nor how the frequency depends on it; the second resonance of their arm,
    near 10 Hz, is left out. Reach and motion across it are two straight axes, not the arm's own joints.

    Parameters
    ----------
    frequency_hz : float
        At the reach `reach_m`, > 0.
    reach_m : float
        > 0.
    damping_ratio : float
        0 <= damping_ratio < 1.

    Raises
    ------
    PlantError
        If a value is out of range.

    References
    ----------
    D. P. Magee, W. J. Book, The application of input shaping to a system with varying parameters (1992), eq 1
    and the section on experimental verification. The beam: S. Timoshenko, Vibration Problems in Engineering.

    Examples
    --------
    Where a circle of 3 ft must lie for the frequencies to be 3.7 to 5.5 Hz:

    >>> arm = FlexibleArm.over_circle(3.7, 5.5, 0.9144)
    >>> round(arm.reach_m, 3), arm.frequency_at([arm.reach_m - 0.4572, arm.reach_m + 0.4572]).round(6)
    (3.48, array([5.5, 3.7]))
    """

    frequency_hz: float
    reach_m: float
    damping_ratio: float = 0.0

    def __post_init__(self) -> None:
        for name in ("frequency_hz", "reach_m"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise PlantError(f"{name} = {value!r}: must be finite and > 0")
        check_damping(self.damping_ratio)

    @classmethod
    def over_circle(
        cls, lowest_hz: float, highest_hz: float, diameter_m: float, damping_ratio: float = 0.0
    ) -> FlexibleArm:
        """Make the arm whose frequency spans just this range over a circle about the end of its reach."""
        if not 0.0 < lowest_hz < highest_hz < math.inf:
            raise PlantError(f"{lowest_hz!r} to {highest_hz!r} Hz: must be finite, > 0 and rising")
        if not (math.isfinite(diameter_m) and diameter_m > 0.0):
            raise PlantError(f"diameter_m = {diameter_m!r}: must be finite and > 0")
        far_over_near = (highest_hz / lowest_hz) ** (2.0 / 3.0)
        reach_m = 0.5 * diameter_m * (far_over_near + 1.0) / (far_over_near - 1.0)
        far_m = reach_m + 0.5 * diameter_m
        return cls(lowest_hz * (far_m / reach_m) ** 1.5, reach_m, damping_ratio)

    def frequency_at(self, reach_m: ArrayLike) -> FloatArray:
        """Frequency in Hz of the arm that reaches so far, in m."""
        return np.asarray(self.frequency_hz * (np.asarray(reach_m) / self.reach_m) ** -1.5)

    def simulate(
        self, command_m: ArrayLike, reach_m: ArrayLike, *, tick_s: float, hold: Hold = "step"
    ) -> ArmTrajectory:
        """Run the arm from rest at position 0 through every tick of the command.

        Parameters
        ----------
        command_m : array_like, shape (ticks,) or (cases, ticks)
            Commanded position across the arm, a value a tick.
        reach_m : array_like, shape (ticks + 1,) or (cases, ticks + 1)
            At the beginning of each tick and the end of the last one, > 0; straight between.
        tick_s : float
            Duration of a tick, > 0.
        hold : "step" or "line"
            Whether the command steps as a tick begins and holds, or runs straight to it within the tick.

        Raises
        ------
        PlantError
            If an input is out of range.
        """
        check_tick(tick_s)
        command, reach = finite("command_m", command_m), finite("reach_m", reach_m)
        if not (reach > 0.0).all():
            raise PlantError(f"reach_m = {float(reach.min())!r}: must be > 0 at every tick")
        if command.ndim not in {1, 2} or reach.shape != (*command.shape[:-1], command.shape[-1] + 1):
            raise PlantError(
                f"command_m of shape {command.shape} and reach_m of {reach.shape}: must be one longer"
            )
        begins_m, ends_m = reference_ends(command, hold)
        ticks = ArmTick(begins_m, (ends_m - begins_m) / tick_s, reach[..., :-1], np.diff(reach) / tick_s)
        frequency_hz = self.frequency_at(reach)
        steps = steps_per_tick(tick_s, 2.0 * math.pi * float(frequency_hz.max()))
        tip_m, tip_m_s = integrate(self, (0.0, 0.0), ticks, tick_s, steps)
        w_rad_s = 2.0 * math.pi * frequency_hz
        told_m = np.concatenate([np.zeros_like(ends_m[..., :1]), ends_m], axis=-1)
        tip_m_s2 = w_rad_s**2 * (told_m - tip_m) - 2.0 * self.damping_ratio * w_rad_s * tip_m_s
        return ArmTrajectory(
            time_s=tick_s * np.arange(reach.shape[-1], dtype=np.float64),
            tip_m=tip_m,
            tip_m_s=tip_m_s,
            tip_m_s2=np.asarray(tip_m_s2),
            frequency_hz=frequency_hz,
        )

    def kick(self, xp: ModuleType, tick: ArmTick, state: State) -> State:  # noqa: ARG002 - nothing kicks a spring
        """State unchanged: a step of the command pulls at the spring, it does not hit."""
        return state

    def rates(self, xp: ModuleType, tick: ArmTick, time_s: float, state: State) -> State:
        """Speed and acceleration of the tip."""
        tip_m, tip_m_s = state
        reaches = (tick.reach_m + tick.reach_slope_m_s * time_s) / self.reach_m
        w_rad_s = 2.0 * math.pi * self.frequency_hz / (reaches * xp.sqrt(reaches))
        stretch_m = tick.command_m + tick.slope_m_s * time_s - tip_m
        return tip_m_s, w_rad_s * (w_rad_s * stretch_m - 2.0 * self.damping_ratio * tip_m_s)
