"""Limits of the command in the controller's own units and number type. Not for: reading machine files."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from swayless.controller.number import NumberType, as_written
from swayless.controller.ramp_grid import RampGrid
from swayless.errors import ControllerError

MAX_COUNTS = 1 << 28
"""Largest command in int32: 64-bit sums of products have room for amplitudes whose sizes add up to 16."""

FLOAT_STEP_ERROR = 0.001
"""A ramp may be at most this much faster than asked because a step is a whole number of grid units."""

INTEGER_STEP_ERROR = 0.05
"""A ramp may be at most this much slower than asked because a step is a whole number of counts."""

MAX_RAMP_TICKS = 1 << 20
"""Longest ramp, in ticks: keeps the closed form of the stop distance exact in 64-bit counts."""

REAL_RANGE = (1e-30, 1e30)
"""Speeds in command units that float and double allow: stop distances stay within the range of float."""


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
        A command must change by at least this much to count as a new one, and one below half of it counts
        as 0: noise of less than half of it, from peak to peak, comes to rest at any level. 0 takes every
        command.
    units : str
        What commands are in.
    units_per_m_s : float
        How many of them make 1 m/s, > 0.

    Raises
    ------
    ControllerError
        If a limit is not finite, not above 0, or one of the three small speeds not below the largest.
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

    def __post_init__(self) -> None:
        for name in (
            "max_speed_m_s",
            "acceleration_m_s2",
            "deceleration_m_s2",
            "quick_stop_m_s2",
            "units_per_m_s",
        ):
            value = getattr(self, name)
            if value is not None and not 0.0 < value < math.inf:
                raise ControllerError(f"{name} = {value!r}: must be finite and > 0")
        for name in ("minimum_speed_m_s", "inching_speed_m_s", "command_resolution_m_s"):
            value = getattr(self, name)
            if not 0.0 <= value < self.max_speed_m_s:
                raise ControllerError(
                    f"{name} = {value!r}: must be at least 0 and below max_speed_m_s = {self.max_speed_m_s!r}"
                )


@dataclass(frozen=True)
class CommandLimits:
    """Limits in command units per tick; every number is exact in the number type.

    Parameters
    ----------
    max_command : float or int
        Largest command.
    acceleration_step, deceleration_step, quick_stop_step : float or int
        Largest change of the ramped command in one tick: a multiple of the grid unit, which is 1 in int32 and
        elsewhere the distance from `ramp_anchor` to the next larger number.
    ramp_anchor : float or int
        Power of two above the largest command; added and taken away again, it rounds a command to the grid.
        0 in int32, where commands are on the grid.
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
    ramp_anchor: Any
    minimum_command: Any
    inching_command: Any
    command_resolution: Any
    units: str
    units_per_m_s: float


def command_limits(
    speeds: SpeedLimits, *, tick_s: float, number: NumberType, on_grid: bool = False
) -> CommandLimits:
    """Bring the limits of a machine into a number type.

    Parameters
    ----------
    speeds : SpeedLimits
        Limits in SI units.
    tick_s : float
        Length of a tick.
    number : NumberType
        Target type. In int32 everything is rounded towards the safe side: down.
    on_grid : bool
        Bring the largest commands down to the grid of the ramp steps, on which the phase clock computes.

    Raises
    ------
    ControllerError
        If the type cannot resolve a limit; the message says what would do.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> command_limits(SpeedLimits(0.5, 0.5), tick_s=0.125, number=number_type("double")).acceleration_step
    0.0625
    >>> command_limits(SpeedLimits(0.5, 0.5), tick_s=0.01, number=number_type("float")).acceleration_step
    np.float32(0.0050001144)
    """

    def in_units(name: str, value_m_s: float) -> Any:
        return command_units(name, value_m_s, speeds.units_per_m_s, number)

    max_command = in_units("max_speed", speeds.max_speed_m_s)
    grid = RampGrid(max_command, number)
    inching = in_units("inching_speed", speeds.inching_speed_m_s)
    if on_grid:
        max_command = grid.floor(max_command)
    steps = [
        grid.unramped_step if value is None else _step(name, value, speeds, tick_s, grid)
        for name, value in (
            ("acceleration", speeds.acceleration_m_s2),
            ("deceleration", speeds.deceleration_m_s2),
            ("quick_stop", speeds.quick_stop_m_s2),
        )
    ]
    return CommandLimits(
        max_command=max_command,
        acceleration_step=steps[0],
        deceleration_step=steps[1],
        quick_stop_step=steps[2],
        ramp_anchor=grid.anchor,
        minimum_command=in_units("minimum_speed", speeds.minimum_speed_m_s),
        inching_command=grid.floor(inching) if on_grid else inching,
        command_resolution=in_units("command_resolution", speeds.command_resolution_m_s),
        units=speeds.units,
        units_per_m_s=speeds.units_per_m_s,
    )


def command_units(name: str, value_m_s: float, units_per_m_s: float, number: NumberType) -> Any:
    """Bring a speed into command units; in int32 rounded down.

    Parameters
    ----------
    name : str
        What a message calls it.
    value_m_s : float
        Finite, >= 0.
    units_per_m_s : float
        How many command units make 1 m/s.
    number : NumberType
        Target type.

    Raises
    ------
    ControllerError
        If the type cannot hold it.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> command_units("max_speed", 0.35, 1000.0, number_type("int32"))
    350
    """
    exact = as_written(value_m_s) * as_written(units_per_m_s)
    return _counts(name, value_m_s, exact) if number.is_integer else _real(name, value_m_s, exact, number)


def _counts(name: str, value_m_s: float, exact: Fraction) -> int:
    counts = math.floor(exact)
    if counts > MAX_COUNTS:
        raise ControllerError(
            f"{name} = {value_m_s!r} m/s is {counts} counts: int32 allows {MAX_COUNTS}; lower counts_per_m_s"
        )
    if counts == 0 and value_m_s > 0.0:
        raise ControllerError(f"{name} = {value_m_s!r} m/s is less than one count: raise counts_per_m_s")
    return counts


def _real(name: str, value_m_s: float, exact: Fraction, number: NumberType) -> Any:
    smallest, largest = REAL_RANGE
    if exact != 0 and not smallest <= exact <= largest:
        raise ControllerError(
            f"{name} = {value_m_s!r} m/s is {float(exact):.6g} command units: "
            f"{number.name} allows {smallest:.6g} to {largest:.6g}"
        )
    return number.scalar(float(exact))


def _step(name: str, value_m_s2: float, speeds: SpeedLimits, tick_s: float, grid: RampGrid) -> Any:
    """Bring an acceleration into command units per tick; refuse it where the grid is too coarse."""
    per_tick_m_s = as_written(value_m_s2) * as_written(tick_s)
    change = per_tick_m_s * as_written(speeds.units_per_m_s)
    ticks = math.ceil(as_written(speeds.max_speed_m_s) / per_tick_m_s)
    if ticks > MAX_RAMP_TICKS:
        raise ControllerError(
            f"{name} = {value_m_s2!r} m/s2 takes {ticks} ticks to full speed: allowed are {MAX_RAMP_TICKS}"
        )
    step = grid.step(change)
    error = float(abs(Fraction(float(step)) / change - 1))
    if step == grid.unramped_step or error <= (INTEGER_STEP_ERROR if grid.is_whole else FLOAT_STEP_ERROR):
        return step
    if grid.is_whole:
        enough = math.ceil(speeds.units_per_m_s / (INTEGER_STEP_ERROR * float(change)))
        raise ControllerError(
            f"{name} = {value_m_s2!r} m/s2 is {float(change):.6g} counts per tick, "
            f"and int32 takes whole counts: raise counts_per_m_s to at least {enough}"
        )
    raise ControllerError(
        f"{name} = {value_m_s2!r} m/s2 takes {ticks} ticks to full speed, too many for float: "
        "use double, a longer tick or a higher acceleration"
    )
