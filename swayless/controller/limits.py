"""Limits of the command in the controller's own units and number type. Not for: reading machine files."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from swayless.controller.number import NumberType
from swayless.errors import ControllerError

MAX_COUNTS = 1 << 28
"""Largest command in int32: leaves the 64-bit sums of products room for amplitudes that add up to 32."""

LANDING_SHARE = 0.125
"""Largest landing margin as a share of a ramp step: the last step of a ramp may be longer by so much."""

INTEGER_STEP_ERROR = 0.05
"""A ramp may be at most this much slower than asked because a step is a whole number of counts."""

MAX_RAMP_TICKS = 1 << 20
"""Longest ramp, in ticks: keeps the closed form of the stop distance exact in 64-bit counts."""


@dataclass(frozen=True)
class SpeedLimits:
    """Limits as the machine states them, in SI units.

    Parameters
    ----------
    max_speed_m_s : float
        Largest command, > 0.
    acceleration_m_s2, deceleration_m_s2, quick_stop_m_s2 : float or None
        Ramps, > 0. None means that the command is not ramped.
    minimum_speed_m_s : float
        Commands below it count as 0.
    inching_speed_m_s : float
        Up to this speed, a command from rest passes unshaped. 0 switches inching off.
    command_resolution_m_s : float
        A command must change by at least this much to count as a new one. 0 takes every command.
    units : str
        What commands are in.
    units_per_m_s : float
        How many of them make 1 m/s.
    """

    max_speed_m_s: float
    acceleration_m_s2: float | None = None
    deceleration_m_s2: float | None = None
    quick_stop_m_s2: float | None = None
    minimum_speed_m_s: float = 0.0
    inching_speed_m_s: float = 0.0
    command_resolution_m_s: float = 0.0
    units: str = "m/s"
    units_per_m_s: float = 1.0


@dataclass(frozen=True)
class CommandLimits:
    """Limits in command units per tick; every number is exact in the number type.

    Parameters
    ----------
    max_command : float or int
        Largest command.
    acceleration_step, deceleration_step, quick_stop_step : float or int
        Largest change of the ramped command in one tick.
    landing_margin : float or int
        A ramp this close to its target lands on it: the rounding that a whole ramp may collect. 0 in int32.
    minimum_command, inching_command, command_resolution : float or int
        As in `SpeedLimits`; 0 switches each off.
    units : str
        What commands are in.
    units_per_m_s : float
        How many of them make 1 m/s.
    """

    max_command: Any
    acceleration_step: Any
    deceleration_step: Any
    quick_stop_step: Any
    landing_margin: Any
    minimum_command: Any
    inching_command: Any
    command_resolution: Any
    units: str
    units_per_m_s: float


def command_limits(speeds: SpeedLimits, *, tick_s: float, number: NumberType) -> CommandLimits:
    """Bring the limits of a machine into a number type.

    Parameters
    ----------
    speeds : SpeedLimits
        Limits in SI units.
    tick_s : float
        Length of a tick.
    number : NumberType
        Target type. In int32 everything is rounded towards the safe side: down.

    Raises
    ------
    ControllerError
        If the type cannot resolve a limit; the message says what would do.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> command_limits(SpeedLimits(0.5, 0.5), tick_s=0.01, number=number_type("double")).acceleration_step
    0.005
    """
    convert = _counts if number.is_integer else _real
    max_command = convert("max_speed", speeds.max_speed_m_s, speeds, number)
    steps = {
        name: _step(name, value, max_command, speeds, tick_s, number)
        for name, value in (
            ("acceleration", speeds.acceleration_m_s2),
            ("deceleration", speeds.deceleration_m_s2),
            ("quick_stop", speeds.quick_stop_m_s2),
        )
    }
    smallest = min(steps.values())
    if max_command / smallest > MAX_RAMP_TICKS:
        raise ControllerError(f"a ramp of more than {MAX_RAMP_TICKS} ticks: raise the accelerations or the tick")
    return CommandLimits(
        max_command=max_command,
        acceleration_step=steps["acceleration"],
        deceleration_step=steps["deceleration"],
        quick_stop_step=steps["quick_stop"],
        landing_margin=_landing_margin(max_command, smallest, number),
        minimum_command=convert("minimum_speed", speeds.minimum_speed_m_s, speeds, number),
        inching_command=convert("inching_speed", speeds.inching_speed_m_s, speeds, number),
        command_resolution=convert("command_resolution", speeds.command_resolution_m_s, speeds, number),
        units=speeds.units,
        units_per_m_s=speeds.units_per_m_s,
    )


def _real(name: str, value_m_s: float, speeds: SpeedLimits, number: NumberType) -> Any:
    value = number.scalar(value_m_s * speeds.units_per_m_s)
    largest = 1e37 if number.name == "double" else 1e30
    if not 0.0 <= value <= largest or (name == "max_speed" and value < 1.0 / largest):
        raise ControllerError(f"{name} = {value_m_s!r} m/s is {value!r} {speeds.units}: outside the range of {number.name}")
    return value


def _counts(name: str, value_m_s: float, speeds: SpeedLimits, number: NumberType) -> int:
    counts = math.floor(Fraction(repr(value_m_s)) * Fraction(repr(speeds.units_per_m_s)))
    if counts > MAX_COUNTS:
        raise ControllerError(
            f"{name} = {value_m_s!r} m/s is {counts} counts: int32 allows {MAX_COUNTS}; lower counts_per_m_s"
        )
    if counts == 0 and value_m_s > 0.0:
        raise ControllerError(f"{name} = {value_m_s!r} m/s is less than one count: raise counts_per_m_s")
    return counts


def _step(
    name: str, value_m_s2: float | None, max_command: Any, speeds: SpeedLimits, tick_s: float, number: NumberType
) -> Any:
    """Largest change in one tick. Without a ramp, twice the maximum: enough for every change."""
    if value_m_s2 is None:
        return 2 * max_command
    if number.is_integer:
        exact = Fraction(repr(value_m_s2)) * Fraction(repr(tick_s)) * Fraction(repr(speeds.units_per_m_s))
        step = min(math.floor(exact), 2 * max_command)
        if step < min(exact, 2 * max_command) * (1 - Fraction(repr(INTEGER_STEP_ERROR))):
            raise ControllerError(
                f"{name} = {value_m_s2!r} m/s2 is {float(exact):.6g} counts per tick, and int32 takes whole counts: "
                f"raise counts_per_m_s to at least {math.ceil(speeds.units_per_m_s * 20 / float(exact))}"
            )
        return step
    return min(number.scalar(value_m_s2 * tick_s * speeds.units_per_m_s), 2 * max_command)


def _landing_margin(max_command: Any, step: Any, number: NumberType) -> Any:
    """Bound the rounding that a whole ramp collects.

    Each step rounds by at most half a unit in the last place of the command; half of the steps run in the
    upper binade, a quarter in the next, and so on: ulp / 2 (1/2 + 1/8 + 1/32 + ...) = ulp / 3 on average.
    """
    if number.is_integer:
        return 0
    ticks = math.ceil(float(max_command) / float(step))
    margin = (ticks + 1) * float(np.spacing(max_command)) / 3.0
    if margin > LANDING_SHARE * float(step):
        raise ControllerError(
            f"a ramp of {ticks} ticks to {float(max_command):.6g} collects too much rounding in {number.name}: "
            "use double, a longer tick or higher accelerations"
        )
    return number.scalar(margin)
