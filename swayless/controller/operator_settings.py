"""What an operator touches besides the command, as constants in the number type of the block.

Each function is optional, and a block without it is the block without it, to the bit. Sums of commands over
ticks measure ways here: one command unit for one tick is `units_per_m_s` and `tick_s` in metres.
Not for: SI units (`operator_options`), nor for what the functions do.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from swayless.controller.number import NumberType
from swayless.controller.status import Status


@dataclass(frozen=True)
class StepSettings:
    """Step Mode: fixed ways at the press of a button.

    Parameters
    ----------
    sizes : tuple
        Ways of the three sizes, in command units times ticks, > 0.
    command : float or int
        Largest command of a step, on the grid of the ramp.
    capacity : float or int
        Most that may be pressed and not yet travelled, in command units times ticks.
    """

    sizes: tuple[Any, Any, Any]
    command: Any
    capacity: Any


@dataclass(frozen=True)
class WaySettings:
    """Distance inputs: the way that is left to each end of the travel.

    Parameters
    ----------
    margin : float or int
        Way that is kept free before each end: m, in int32 mm.
    farthest : float or int
        A way beyond the margin that is longer than every stop, and counts for all that are longer still.
    scale : float or int
        Command units times ticks in a metre; in int32 in a mm, over 2**shift.
    shift : int
        0 in float types.
    least : float or int
        Smallest way that is worth leaving rest for, in command units times ticks: below it a distance that
        trembles would move the crane for ever.
    number : NumberType
        Number type.
    """

    margin: Any
    farthest: Any
    scale: Any
    shift: int
    least: Any
    number: NumberType

    def budget(self, distance: Any) -> Any:
        """Sum of the references that may still come before an end that is so far away.

        Examples
        --------
        >>> from swayless.controller.number import number_type
        >>> WaySettings(0.5, 20.0, 100.0, 0, 1.0, number_type("double")).budget(1.5)
        100.0
        >>> WaySettings(500, 20_000, 3 << 16, 16, 30, number_type("int32")).budget(1500)
        3000
        """
        way = min(max(distance - self.margin, self.number.scalar(0)), self.farthest)
        return (way * self.scale) >> self.shift if self.number.is_integer else way * self.scale

    @property
    def most(self) -> Any:
        """Budget of the farthest way."""
        return self.budget(self.farthest + self.margin)


@dataclass(frozen=True)
class OperatorSettings:
    """The functions of a block that are not there unless asked for.

    Parameters
    ----------
    steps : StepSettings or None
        Step Mode.
    has_stop_switches : bool
        Inputs of the stop switches at the ends.
    slow_command : float or int or None
        Largest command towards a slow-down switch that is made; None without such inputs.
    way : WaySettings or None
        Distance inputs.
    contactor_commands : tuple
        The one or two commands that the drive knows besides 0, rising; empty for a drive that takes all.
    has_drive_feedback : bool
        Inputs that say whether the drive is ready, and its speed.
    has_speed_limit : bool
        Input of a speed limit.
    rope_offset : tuple or None
        Smallest and largest offset of the rope length, m, in int32 mm; None without the input.
    starts_from_zero : bool
        After power-on a command counts only after it has been 0.
    """

    steps: StepSettings | None = None
    has_stop_switches: bool = False
    slow_command: Any | None = None
    way: WaySettings | None = None
    contactor_commands: tuple[Any, ...] = ()
    has_drive_feedback: bool = False
    has_speed_limit: bool = False
    rope_offset: tuple[Any, Any] | None = None
    starts_from_zero: bool = False

    @property
    def has_switches(self) -> bool:
        """Whether there are stop or slow-down switches."""
        return self.has_stop_switches or self.slow_command is not None

    @property
    def is_tuned(self) -> bool:
        """Whether there is something to set on site."""
        return self.has_speed_limit or self.rope_offset is not None

    @property
    def locks(self) -> bool:
        """Whether there are commands that do nothing until they have been 0."""
        return self.steps is not None or self.has_stop_switches or self.starts_from_zero

    @property
    def status_bits(self) -> Status:
        """Bits of the status word that these functions add."""
        steps = Status.STEPPING | Status.STEP_REFUSED | Status.STEP_SIZE_INVALID
        way = Status.WAY_LIMITS | Status.WAY_TOO_SHORT | Status.DISTANCE_INVALID
        found = (
            (self.steps is not None, steps),
            (self.locks, Status.COMMAND_LOCKED),
            (self.has_stop_switches, Status.STOP_SWITCH),
            (self.slow_command is not None, Status.SLOW_SWITCH),
            (self.way is not None, way),
            (self.has_drive_feedback, Status.DRIVE_NOT_READY),
            (self.has_speed_limit, Status.SPEED_LIMIT_INVALID),
            (self.rope_offset is not None, Status.ROPE_OFFSET_INVALID),
        )
        bits = Status(0)
        for is_there, each in found:
            bits |= each if is_there else Status(0)
        return bits


NO_OPTIONS = OperatorSettings()
"""A block with a command, a knob and its stops, and nothing else."""
