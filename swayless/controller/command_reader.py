"""Reading the command: as far as it is finite, within the maximum, above the minimum, new and not locked.

Not for: what the block makes of it.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.contactor import quantised
from swayless.controller.finite import is_finite
from swayless.controller.ramp import on_grid
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

# Plain integers: the flag type is an order of magnitude slower, and this runs millions of times.
_CLAMPED, _INVALID = int(Status.COMMAND_CLAMPED), int(Status.COMMAND_INVALID)
_BELOW_MINIMUM, _LOCKED = int(Status.BELOW_MINIMUM), int(Status.COMMAND_LOCKED)


class CommandReader:
    """The command as it counts, and whether it is 0 as it was given.

    Parameters
    ----------
    settings : ShaperSettings
        Limits, number type, and what a contactor drive knows.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._limits, self._number = settings.limits, settings.number
        self._contactor = settings.operator.contactor_commands
        self._on_grid = settings.clock is not None
        self._zero = self._held = settings.number.scalar(0)
        self._is_invalid = False
        self._is_locked = settings.operator.starts_from_zero
        self.is_zero = False
        self.status = 0

    def read(self, command: Any, *, locks: bool) -> Any:
        """Read the command of a tick; `status` and `is_zero` tell the rest.

        Parameters
        ----------
        command : float or int
            As it is given.
        locks : bool
            A command other than 0 does nothing from now on, until it has been 0.
        """
        self.status = 0
        command, valid = self._finite(command)
        command = self._resolved(self._above_minimum(command))
        self.is_zero = bool(valid and command == 0)
        self._latch(locks=locks, valid=valid)
        if self._is_invalid:
            self.status |= _INVALID
        if self._is_locked:
            self.status |= _LOCKED
        if self._is_invalid or self._is_locked or self.is_zero:
            return self._zero
        return on_grid(command, self._limits) if self._on_grid else command

    def _latch(self, *, locks: bool, valid: bool) -> None:
        """Keep a command that was not finite, or is locked, from doing anything until it has been 0."""
        if self.is_zero:
            self._is_invalid = self._is_locked = False
        else:
            self._is_invalid = self._is_invalid or not valid
            self._is_locked = self._is_locked or locks

    def _finite(self, command: Any) -> tuple[Any, bool]:
        """Clamp the command to the maximum; a command that is not finite becomes 0 and is not valid."""
        limit = self._limits.max_command
        if -limit <= command <= limit:
            return command, True
        if is_finite(command, self._number):
            self.status |= _CLAMPED
            return (limit if command > 0 else -limit), True
        return self._zero, False

    def _above_minimum(self, command: Any) -> Any:
        """Count a command below the minimum as 0; a contactor drive's as one that it knows."""
        counted = command
        if self._contactor:
            magnitude = quantised(abs(command), self._contactor, self._zero)
            counted = magnitude if command > 0 else -magnitude
        if abs(command) < self._limits.minimum_command:
            counted = self._zero
        if counted == 0 and command != 0:
            self.status |= _BELOW_MINIMUM
        return counted

    def _resolved(self, command: Any) -> Any:
        """Hold the last command until it changes by the resolution; the maximum and 0 always arrive."""
        resolution, magnitude = self._limits.command_resolution, abs(command)
        if magnitude + magnitude < resolution:
            self._held = self._zero
        elif magnitude >= self._limits.max_command or abs(command - self._held) >= resolution:
            self._held = command
        return self._held
