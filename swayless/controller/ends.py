"""The ends of the travel as the block is told of them: distances that are left, and switches.

Not for: what the reference does then (`motion`), nor for the quick stop that a made stop switch asks for.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.finite import is_finite
from swayless.controller.motion import Motion
from swayless.controller.pins import ShaperInput
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

_STOP_SWITCH, _SLOW_SWITCH = int(Status.STOP_SWITCH), int(Status.SLOW_SWITCH)
_LOCKED, _DISTANCE_INVALID = int(Status.COMMAND_LOCKED), int(Status.DISTANCE_INVALID)


class Switches:
    """Stop and slow-down switches of both ends.

    A command towards a made stop switch does nothing until it has been 0 or pointed away, even if the switch
    opens again: nothing starts by itself.

    Parameters
    ----------
    settings : ShaperSettings
        Which switches there are.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        operator, limits = settings.operator, settings.limits
        self._has_stops, self._zero = operator.has_stop_switches, settings.number.scalar(0)
        self._has_slow = operator.slow_command is not None
        self._slow = operator.slow_command if self._has_slow else limits.max_command
        self._shuts_forward = self._shuts_reverse = False
        self.is_shut_forward = self.is_shut_reverse = False
        self._max = self._most_forward = self._most_reverse = limits.max_command
        self.status = 0

    def _read(self, inputs: ShaperInput) -> None:
        self.status = 0
        if self._has_stops:
            self.is_shut_forward, self.is_shut_reverse = inputs.stop_forward, inputs.stop_reverse
            if inputs.stop_forward or inputs.stop_reverse:
                self.status |= _STOP_SWITCH
        if self._has_slow:
            self._most_forward = self._slow if inputs.slow_forward else self._max
            self._most_reverse = self._slow if inputs.slow_reverse else self._max

    def shut(self, reference: Any) -> bool:
        """Whether a reference leads towards a made stop switch."""
        return bool((self.is_shut_forward and reference > 0) or (self.is_shut_reverse and reference < 0))

    def most(self, *, forward: bool) -> Any:
        """Largest command in a direction."""
        return self._most_forward if forward else self._most_reverse

    def hit(self, motion: Motion) -> bool:
        """Whether the motion, or what is pending at a reference of 0, leads towards a made stop switch."""
        if not (self.is_shut_forward or self.is_shut_reverse):
            return False
        return self.shut(motion.reference if motion.reference != 0 else motion.pending)

    def limited(self, command: Any, inputs: ShaperInput) -> Any:
        """Take the switches of a tick, and limit a command to what they leave of it."""
        self._read(inputs)
        self._shuts_forward = bool(command > 0 and (self._shuts_forward or self.is_shut_forward))
        self._shuts_reverse = bool(command < 0 and (self._shuts_reverse or self.is_shut_reverse))
        if self._shuts_forward or self._shuts_reverse:
            self.status |= _LOCKED
            return self._zero
        if command > self._most_forward:
            self.status |= _SLOW_SWITCH
            return self._most_forward
        if command < -self._most_reverse:
            self.status |= _SLOW_SWITCH
            return -self._most_reverse
        return command


class Distances:
    """Ways left to both ends, in command units times ticks; without a valid distance, none.

    Parameters
    ----------
    settings : ShaperSettings
        With distance inputs.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        way = settings.operator.way
        assert way is not None  # noqa: S101 - only a block with distance inputs asks
        self._settings, self._number = way, settings.number
        self._most, self._zero = way.most, settings.number.scalar(0)
        self._forward = self._reverse = self._zero

    def read(self, inputs: ShaperInput, reference: Any) -> int:
        """Take the distances of a tick, or what is left of the last ones after the last reference.

        Parameters
        ----------
        inputs : ShaperInput
            Inputs of the tick.
        reference : float or int
            The last one, which has been travelled since.

        Returns
        -------
        int
            Status bits.
        """
        forward, reverse = inputs.distance_forward, inputs.distance_reverse
        is_valid = inputs.distance_valid
        takes_forward = is_valid and is_finite(forward, self._number)
        takes_reverse = is_valid and is_finite(reverse, self._number)
        self._forward = (
            self._settings.budget(forward) if takes_forward else self._held(self._forward - reference)
        )
        self._reverse = (
            self._settings.budget(reverse) if takes_reverse else self._held(self._reverse + reference)
        )
        return 0 if takes_forward and takes_reverse else _DISTANCE_INVALID

    def exceeds(self, total: Any, slack: Any) -> bool:
        """Whether a sum of references to come, with its sign, exceeds the way by more than `slack`."""
        return bool(total > self._forward + slack or self._zero - total > self._reverse + slack)

    def will_exceed(self, total: Any, reference: Any) -> bool:
        """Whether a sum of references to come exceeds the way that the reference of this tick leaves."""
        return bool(total > self._forward - reference or self._zero - total > self._reverse + reference)

    def left(self, motion: Motion, *, forward: bool) -> Any:
        """Sum of the commands that may still come towards an end; from rest none where it is not worth it."""
        left = self._forward - motion.pending if forward else self._reverse + motion.pending
        return self._zero if motion.command == 0 and left < self._settings.least else left

    def _held(self, way: Any) -> Any:
        return min(max(way, self._zero), self._most)
