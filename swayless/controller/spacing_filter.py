"""Taps at multiples of a spacing that is looked up each tick: Magee and Book's two laws.

Both keep the commands of the longest delay, and sums of them, from which the references still to come on a
still position are known at once; the sums start anew with each lap of the ring, so that they do not drift.
Not for: ramps, stops or rows, nor for what a change of the spacing does (`original_filter`,
`modified_filter`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.controller.spacing import Spacing
from swayless.errors import ControllerError

AMPLITUDE_BITS = 30
"""In int32 amplitudes are numerators over 2 to this power."""


def spacing_of(settings: ShaperSettings) -> Spacing:
    """Spacing that the rows of a block share.

    Raises
    ------
    ControllerError
        If rows differ in their law or their spacing, or have none.
    """
    found = [row.taps for row in settings.bank.rows if isinstance(row.taps, SpacedTaps)]
    if len(found) != len(settings.bank.rows) or len({(taps.law, taps.spacing) for taps in found}) != 1:
        raise ControllerError("all rows of a bank must follow one law and one spacing")
    return found[0].spacing


def check_products(settings: ShaperSettings) -> None:
    """Refuse commands so large that sums of products could leave 64 bits (int32 only).

    Raises
    ------
    ControllerError
        If they could.
    """
    most = ((1 << 62) >> AMPLITUDE_BITS) // (settings.longest_delay_ticks + 2)
    if settings.number.is_integer and settings.limits.max_command >= most:
        raise ControllerError(
            f"a largest command of {settings.limits.max_command} counts times {settings.longest_delay_ticks} "
            f"ticks exceeds 64 bits: below {most} counts are allowed; lower counts_per_m_s"
        )


class SpacedFilter(ABC):
    """The ring that both laws share.

    Parameters
    ----------
    settings : ShaperSettings
        Constants in the number type of the filter; their lags are those of the widest spacing.
    """

    has_pushed = False
    """Whether the last tick changed more than its command did: never."""

    def __init__(self, settings: ShaperSettings) -> None:
        check_products(settings)
        self._table, self._tables = spacing_of(settings), settings.row_tables
        self._zero, self._scalar = settings.number.scalar(0), settings.number.scalar
        self._output = CountOutput(settings) if settings.number.is_integer else RealOutput(settings)
        self._last = settings.longest_delay_ticks
        self._commands = [self._zero] * (self._last + 1)
        self._sums = [self._zero] * (self._last + 1)
        self._spacing = self._start_spacing = self._table.most
        self._base = self._lap_sum = self._zero
        self._head = -1
        self.is_running = self._lapped = False
        self._taps = self.elapsed = 1

    def turn(self, position: Any, speed: Any) -> None:
        """Take the position of a tick; its speed does not matter."""
        del speed
        self._spacing = self._table.at(position)

    def ticks_of(self, lag: int) -> int:
        """Ticks in which what is left of a row's longest lag passes while the position is still."""
        spacings = self._taps - 1 if self.is_running else lag // self._table.most
        return max(lag - spacings * (self._table.most - self._spacing), 0)

    def rest(self, command: Any) -> None:
        """Enter rest at `command`, or stay there. The reference equals the command."""
        self._base = command
        self.is_running = False
        self._output.rest(command)

    def run(self, command: Any, row: int) -> Any:
        """Shape one new command; returns the reference."""
        if not self.is_running:
            self._leave_rest(row)
        self._head += 1
        if self._head > self._last:
            self._head, self._lapped, self._lap_sum = 0, True, self._sums[self._last]
        before = self._sums[self._head - 1] if self._head > 0 else self._zero
        self._commands[self._head] = command
        self._sums[self._head] = before + command
        return self._output.reference(self._shape(command, row))

    def rest_sum(self, command: Any, row: int) -> Any:
        """Sum of the references still to come at rest at `command`."""
        total = self._zero
        for tap, amplitude in enumerate(self._tables[row].amplitudes):
            total = total + (amplitude * (self._scalar(tap * self._spacing) * command))
        return self._output.total(total)

    def pending(self, row: int) -> Any:
        """Sum of the references still to come if every later command is 0 and the position is still."""
        if not self.is_running:
            return self.rest_sum(self._base, row)
        total = self._zero
        for tap, amplitude in enumerate(self._tables[row].amplitudes):
            total = total + (amplitude * self._latest(self._delay(tap)))
        return self._output.total(total)

    def _leave_rest(self, row: int) -> None:
        self._head, self._lapped, self.is_running = -1, False, True
        self._start_spacing, self._taps = self._spacing, len(self._tables[row].lags)
        self._start()

    def _latest(self, delay: int) -> Any:
        """Sum of so many latest commands."""
        head = self._head
        if delay <= head:
            return self._sums[head] - self._sums[head - delay]
        if self._lapped:
            return self._sums[head] + (self._lap_sum - self._sums[head + (self._last + 1 - delay)])
        return self._sums[head] + (self._scalar(delay - head - 1) * self._base)

    @abstractmethod
    def _start(self) -> None: ...

    @abstractmethod
    def _shape(self, command: Any, row: int) -> Any: ...

    @abstractmethod
    def _delay(self, tap: int) -> int:
        """Ticks that a tap lags while the position is still."""


class RealOutput:
    """References in double or float.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._max = settings.limits.max_command

    def rest(self, command: Any) -> None:
        """Nothing is carried."""

    def reference(self, total: Any) -> Any:
        """Keep a reference within the maximum."""
        return min(max(total, -self._max), self._max)

    def total(self, total: Any) -> Any:
        """Sum of references, from a sum of amplitudes times commands."""
        return total


class CountOutput:
    """References in int32; what rounding takes from one, the carry gives to the next.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    """

    _HALF = 1 << (AMPLITUDE_BITS - 1)

    def __init__(self, settings: ShaperSettings) -> None:
        self._max = int(settings.limits.max_command)
        self._carry = 0

    def rest(self, command: int) -> None:
        """At rest at 0 nothing is carried."""
        if command == 0:
            self._carry = 0

    def reference(self, total: int) -> int:
        """Round to counts, within the maximum."""
        total += self._carry
        reference = (total + self._HALF) >> AMPLITUDE_BITS
        self._carry = total - (reference << AMPLITUDE_BITS)
        return min(max(reference, -self._max), self._max)

    def total(self, total: int) -> int:
        """Sum of references in counts, from a sum of amplitudes times commands."""
        return (total + self._carry + self._HALF) >> AMPLITUDE_BITS
