"""The filter of the phase clock in int32: counts in, counts out, everything between exact.

Commands are scaled by a power of two, as far as 30 bits allow, so that small changes can be shared out; what
rounding to counts takes from one reference, the carry gives to the next. Not for: why; see `phase_filter`.
"""

from __future__ import annotations

from swayless.controller.hoist_int32 import LARGEST_WANTED, ONE, IntegerHoist, shifted, within
from swayless.controller.phase_filter import PhaseFilter
from swayless.controller.settings import ShaperSettings


def command_shift(settings: ShaperSettings) -> int:
    """Bits by which commands are scaled."""
    return 30 - int(settings.limits.max_command).bit_length()


class IntegerPhaseFilter(PhaseFilter):
    """Taps at phases in int32.

    `_moment` sums, over the parts under way, part times phase still to go, exactly: it never drifts.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._shift = command_shift(settings)
        self._limit = int(settings.limits.max_command)
        self._whole = IntegerHoist(settings, self._limit << self._shift)
        super().__init__(settings, self._whole)
        self._moments = tuple(divmod(int(table.moment * ONE), ONE) for table in self._tables)
        self._moment = self._passed = self._carry = 0

    def rest(self, command: int) -> None:
        """Enter rest at `command`, or stay there."""
        super().rest(command)
        if command == 0:
            self._carry = 0

    def rest_sum(self, command: int, row: int) -> int:
        """Sum of the references still to come at rest at `command`."""
        return self._in_counts(self._reach(command, row))

    def pending(self, row: int) -> int:
        """Sum of the references still to come if every later command is 0 and the rope is still."""
        if not self.is_running:
            return self.rest_sum(self._base, row)
        return self._in_counts(self._reach(self._command, row) - self._moment)

    def _reach(self, command: int, row: int) -> int:
        """Command times the moment of a row, scaled."""
        whole, fraction = self._moments[row]
        return (command * whole + shifted(command * fraction, 30)) << self._shift

    def _in_counts(self, moment: int) -> int:
        """Turn a scaled sum of part times phase into references to come, in counts times ticks."""
        half = (1 << self._shift) >> 1
        return (self._whole.ticks(moment) + self._carry + half) >> self._shift

    def _start(self) -> None:
        self._command = self._base
        self._level = self._base << self._shift
        self._moment = self._passed = 0

    def _arrived(self, command: int) -> int:
        change: int = (command - self._command) << self._shift
        self._command = command
        return change

    def _within(self, wanted: int) -> int:
        return within(wanted, LARGEST_WANTED)

    def _later(self, part: int, ahead: int) -> int:
        return shifted(part * self._whole.ratio(ahead, self._whole.inverse), 30)

    def _lag(self, lag: int) -> int:
        return lag

    def _leave(self, part: int, ahead: int, *, in_lap: bool) -> None:
        del in_lap  # exact sums need no second one
        self._mass -= part
        self._passed += part * ahead

    def _enter(self, later: int, moment: int) -> None:
        self._mass += later
        self._moment += moment - self._passed - self._mass * self._quanta
        self._passed = 0

    def _reference(self) -> int:
        total = self._level + self._carry
        reference = (total + ((1 << self._shift) >> 1)) >> self._shift
        self._carry = total - (reference << self._shift)
        return int(min(max(reference, -self._limit), self._limit))
