"""The stops and how long they last: emergency stop, quick stop, a drive that is not ready.

Not for: what the reference does then (`motion`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.finite import clamped
from swayless.controller.pins import ShaperInput
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

_QUICK_STOP, _EMERGENCY_STOP = int(Status.QUICK_STOP), int(Status.EMERGENCY_STOP)
_DRIVE_NOT_READY = int(Status.DRIVE_NOT_READY)


class Stops:
    """Which stops are latched; after power-on none, but a drive that has to be ready first.

    Parameters
    ----------
    settings : ShaperSettings
        Limits, number type, and whether the drive reports.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._limit, self._number = settings.limits.max_command, settings.number
        self._has_feedback = settings.operator.has_drive_feedback
        self.is_emergency = self.is_quick = False
        self.is_drive_off = self._has_feedback

    @property
    def is_latched(self) -> bool:
        """Whether the reference is stopped or being stopped."""
        return self.is_emergency or self.is_quick or self.is_drive_off

    @property
    def is_halted(self) -> bool:
        """Whether the reference is 0 at once."""
        return self.is_emergency or self.is_drive_off

    @property
    def status(self) -> int:
        """Bits of the stops that are latched."""
        status = _QUICK_STOP if self.is_quick else 0
        if self.is_emergency:
            status |= _EMERGENCY_STOP
        return status | _DRIVE_NOT_READY if self.is_drive_off else status

    def watch_drive(self, inputs: ShaperInput, reference: Any) -> Any:
        """Give the reference to go on from: of a drive that is ready again its speed, for a quick stop.

        Parameters
        ----------
        inputs : ShaperInput
            Inputs of the tick.
        reference : float or int
            The last one.
        """
        if not self._has_feedback:
            return reference
        returns = self.is_drive_off and inputs.drive_ready
        self.is_drive_off = not inputs.drive_ready
        self.is_quick = self.is_quick or returns
        if not returns:
            return reference
        return clamped(inputs.actual_speed, -self._limit, self._limit, self._number)

    def latch(self, inputs: ShaperInput, *, hits: bool, is_zero: bool, reference: Any) -> None:
        """Latch what is asked for, and release what is not where the command is 0.

        Parameters
        ----------
        inputs : ShaperInput
            Inputs of the tick.
        hits : bool
            A stop switch is made in the direction of motion.
        is_zero : bool
            The command is 0 as it was given.
        reference : float or int
            The last one: a quick stop lasts until it is 0.
        """
        if inputs.emergency_stop:
            self.is_emergency = True
        elif is_zero:
            self.is_emergency = False
        if inputs.quick_stop or hits:
            self.is_quick = True
        elif is_zero and reference == 0:
            self.is_quick = False
