"""What a machine wants of its operator's functions, in SI units, and the way to the constants of a block.

Not for: reading machine files, nor for what the functions do.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from swayless.controller.contactor import quantised
from swayless.controller.limits import CommandLimits, command_units
from swayless.controller.number import NumberType, as_written
from swayless.controller.operator_settings import OperatorSettings, StepSettings, WaySettings
from swayless.controller.ramp_grid import RampGrid
from swayless.controller.taps import Bank
from swayless.errors import ControllerError

MOST_PRESSES = 16
"""So many of the largest steps may be pressed and not yet travelled."""

STEP_ERROR = 0.001
"""A step may be off by this part of it at most because it is a whole number of counts times ticks."""

LEAST_WAY_M = 0.01
"""From rest, nothing moves towards an end that is nearer than this: sensors tremble by some millimetres."""

MM_PER_M = 1000
"""In int32 ways are in mm."""


@dataclass(frozen=True)
class OperatorOptions:
    """Functions of a block that are not there unless asked for; None or False leaves each out.

    Parameters
    ----------
    step_sizes_m : tuple of float or None
        Step Mode: ways of the three sizes, > 0.
    step_speed_m_s : float or None
        Largest speed of a step, up to the maximum; None: the maximum.
    stop_switches : bool
        Inputs of the stop switches at the ends.
    slow_speed_m_s : float or None
        Largest speed towards a slow-down switch that is made, > 0, up to the maximum.
    limit_margin_m : float or None
        Distance inputs: way that is kept free before each end, >= 0.
    contactor_speeds_m_s : tuple of float or None
        The one or two speeds that the drive knows besides 0, rising, up to the maximum, which is the last.
        All rows then need amplitudes +1, -1, ..., +1 on whole ticks, and no command may be ramped.
    drive_feedback : bool
        Inputs that say whether the drive is ready, and its speed.
    speed_limit : bool
        Input of a speed limit.
    rope_offset_m : tuple of float or None
        Smallest and largest offset of the measured rope length.
    start_from_zero : bool
        After power-on a command counts only after it has been 0.

    Raises
    ------
    ControllerError
        If a value is out of range.
    """

    step_sizes_m: tuple[float, ...] | None = None
    step_speed_m_s: float | None = None
    stop_switches: bool = False
    slow_speed_m_s: float | None = None
    limit_margin_m: float | None = None
    contactor_speeds_m_s: tuple[float, ...] | None = None
    drive_feedback: bool = False
    speed_limit: bool = False
    rope_offset_m: tuple[float, float] | None = None
    start_from_zero: bool = False

    def __post_init__(self) -> None:
        sizes, speeds = self.step_sizes_m, self.contactor_speeds_m_s
        if sizes is not None and (len(sizes) != 3 or not all(0.0 < size < math.inf for size in sizes)):
            raise ControllerError(f"step_sizes_m = {sizes!r}: must be three ways, finite and > 0")
        if self.step_speed_m_s is not None and sizes is None:
            raise ControllerError(f"step_speed_m_s = {self.step_speed_m_s!r}: needs step_sizes_m")
        if self.limit_margin_m is not None and not 0.0 <= self.limit_margin_m < math.inf:
            raise ControllerError(f"limit_margin_m = {self.limit_margin_m!r}: must be finite and >= 0")
        if speeds is not None and not (1 <= len(speeds) <= 2 and 0.0 < speeds[0] <= speeds[-1] < math.inf):
            raise ControllerError(f"contactor_speeds_m_s = {speeds!r}: must be one or two, rising, > 0")
        for name, asked in (
            ("step_sizes_m", sizes is not None),
            ("drive_feedback", self.drive_feedback),
            ("speed_limit", self.speed_limit),
        ):
            if speeds is not None and asked:
                raise ControllerError(f"{name}: a drive with contactor_speeds_m_s has no speeds between")
        offset = self.rope_offset_m
        if offset is not None and not -math.inf < offset[0] <= 0.0 <= offset[1] < math.inf:
            raise ControllerError(f"rope_offset_m = {offset!r}: must be a range around 0, finite")


def operator_settings(options: OperatorOptions, bank: Bank, limits: CommandLimits) -> OperatorSettings:
    """Bring the functions of a machine into the number type of its block.

    Parameters
    ----------
    options : OperatorOptions
        What is asked for.
    bank : Bank
        The rows: in int32, steps of a bank with negative amplitudes are whole multiples of its longest delay.
    limits : CommandLimits
        Ramps and maxima.

    Raises
    ------
    ControllerError
        If a value is out of range, or the type cannot hold it closely enough.
    """
    made = _Maker(bank, limits)
    steps = None
    if options.step_sizes_m is not None:
        steps = made.steps(options.step_sizes_m, options.step_speed_m_s)
    contactor = made.contactor(options.contactor_speeds_m_s or ())
    slow_m_s, margin_m, offset_m = options.slow_speed_m_s, options.limit_margin_m, options.rope_offset_m
    return OperatorSettings(
        steps=steps,
        has_stop_switches=options.stop_switches,
        slow_command=None if slow_m_s is None else made.slow(slow_m_s, contactor),
        way=None if margin_m is None else made.way(margin_m, steps),
        contactor_commands=contactor,
        has_drive_feedback=options.drive_feedback,
        has_speed_limit=options.speed_limit,
        rope_offset=None if offset_m is None else made.offset(offset_m),
        starts_from_zero=options.start_from_zero,
    )


class _Maker:
    """Makes constants for one bank and its limits."""

    def __init__(self, bank: Bank, limits: CommandLimits) -> None:
        self._bank, self._limits = bank, limits
        self._number: NumberType = bank.number
        self._grid = RampGrid(limits.max_command, self._number)
        self._sums_per_m = as_written(limits.units_per_m_s) / as_written(bank.tick_s)

    def command(self, name: str, speed_m_s: float) -> Any:
        """Bring a speed to the grid of the ramp."""
        return self._grid.floor(self._within_maximum(name, speed_m_s))

    def slow(self, speed_m_s: float, contactor: tuple[Any, ...]) -> Any:
        """Bring the slow speed to the grid of the ramp, or to what a contactor drive knows."""
        if not contactor:
            return self.command("slow_speed_m_s", speed_m_s)
        return quantised(self._within_maximum("slow_speed_m_s", speed_m_s), contactor, self._number.scalar(0))

    def steps(self, sizes_m: tuple[float, ...], speed_m_s: float | None) -> StepSettings:
        """Make the constants of Step Mode."""
        exact = [as_written(size_m) * self._sums_per_m for size_m in sizes_m]
        unit = self._step_unit(max(exact) * MOST_PRESSES)
        sizes = [round(size / unit) * unit for size in exact]
        for size_m, asked, made in zip(sizes_m, exact, sizes, strict=True):
            if abs(made - asked) > asked * Fraction(STEP_ERROR):
                raise ControllerError(
                    f"step_sizes_m: {size_m!r} m is not within {STEP_ERROR:.1%} of a multiple of "
                    f"{float(unit / self._sums_per_m):.3g} m: raise counts_per_m_s or the size"
                )
        first, second, third = (self._scalar(size) for size in sizes)
        top = self._grid.floor(self._limits.max_command)
        command = top if speed_m_s is None else self.command("step_speed_m_s", speed_m_s)
        return StepSettings((first, second, third), command, self._scalar(max(sizes) * MOST_PRESSES))

    def way(self, margin_m: float, steps: StepSettings | None) -> WaySettings:
        """Make the constants of the distance inputs."""
        limits = self._limits
        slowest = Fraction(float(min(limits.acceleration_step, limits.deceleration_step)))
        ramp_ticks = math.ceil(Fraction(float(limits.max_command)) / slowest)
        ticks = 2 * ramp_ticks + 4 * self._bank.longest_delay_ticks + 4
        longest = Fraction(float(limits.max_command)) * ticks
        longest += 0 if steps is None else Fraction(float(steps.capacity))
        farthest_m = math.ceil(longest / self._sums_per_m) + 1
        if not self._number.is_integer:
            scalar = self._number.scalar
            scale = scalar(float(self._sums_per_m))
            least = scalar(float(as_written(LEAST_WAY_M) * self._sums_per_m))
            return WaySettings(scalar(margin_m), scalar(farthest_m), scale, 0, least, self._number)
        per_mm, most_mm = self._sums_per_m / MM_PER_M, farthest_m * MM_PER_M
        shift = 30
        while shift > 0 and per_mm * most_mm * (1 << shift) >= 1 << 62:
            shift -= 1
        margin_mm = math.ceil(as_written(margin_m) * MM_PER_M)
        if margin_mm + most_mm >= 1 << 31:
            raise ControllerError("limit_margin_m and the longest stop exceed 2^31 mm")
        scale = math.floor(per_mm * (1 << shift))
        least = math.ceil(as_written(LEAST_WAY_M) * self._sums_per_m)
        return WaySettings(margin_mm, most_mm, scale, shift, least, self._number)

    def contactor(self, speeds_m_s: tuple[float, ...]) -> tuple[Any, ...]:
        """Make the commands that the drive knows."""
        commands = tuple(self._within_maximum("contactor_speeds_m_s", speed) for speed in speeds_m_s)
        if commands and commands[-1] != self._limits.max_command:
            raise ControllerError("contactor_speeds_m_s: the last one must be max_speed")
        return commands

    def offset(self, offset_m: tuple[float, float]) -> tuple[Any, Any]:
        """Make the range of the rope offset."""
        low_m, high_m = offset_m
        if self._number.is_integer:
            return math.ceil(as_written(low_m) * MM_PER_M), math.floor(as_written(high_m) * MM_PER_M)
        return self._number.scalar(low_m), self._number.scalar(high_m)

    def _within_maximum(self, name: str, speed_m_s: float) -> Any:
        limits = self._limits
        max_m_s = float(limits.max_command) / limits.units_per_m_s
        if not 0.0 < speed_m_s < math.inf:
            raise ControllerError(f"{name} = {speed_m_s!r}: must be finite and > 0")
        command = command_units(name, speed_m_s, limits.units_per_m_s, self._number)
        if command > limits.max_command:
            raise ControllerError(f"{name} = {speed_m_s!r}: must be at most max_speed_m_s = {max_m_s!r}")
        return command

    def _step_unit(self, capacity: Fraction) -> Fraction:
        """Give the way of which steps are whole multiples, so that presses add exactly.

        A bank with negative amplitudes holds the speed of a step for its longest delay at least: in int32 a
        count for each of these ticks, and of the first.
        """
        if self._number.is_integer:
            waits = any(row.taps.has_negative for row in self._bank.rows)
            return Fraction(self._bank.longest_delay_ticks + 2 if waits else 1)
        power = math.frexp(float(capacity))[1] - (self._number.significand_bits - 2)
        return max(Fraction(2) ** power, self._grid.unit)

    def _scalar(self, exact: Fraction) -> Any:
        return self._number.scalar(int(exact) if self._number.is_integer else float(exact))
