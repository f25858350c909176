"""Taps applied to a command, tick by tick, with the references still to come. Not for: ramps, stops or rows.

A filter is either *at rest*, when all commands within reach of the taps are equal, or running. At rest
nothing is written: the equal commands are one number, and the next change starts a new lap of the ring.
Until that first lap is full, what lies further back is the command of the rest.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from swayless.controller.settings import ShaperSettings


class TapFilter(ABC):
    """The ring of commands that both filters share.

    Parameters
    ----------
    settings : ShaperSettings
        Constants in the number type of the filter.
    """

    elapsed = 1
    """What passes in a tick, in the unit of the lags: a tick."""

    has_pushed = False
    """Whether the last tick changed more than its command did: never."""

    def __init__(self, settings: ShaperSettings) -> None:
        self._zero = settings.number.scalar(0)
        self._tables = settings.row_tables
        self._last = settings.longest_delay_ticks
        self._ring = [self._zero] * (self._last + 1)
        self._base = self._zero
        self._head = self._last
        self._lapped = False

    @property
    def is_running(self) -> bool:
        """Whether commands within reach of the taps may differ."""
        return self._lapped or self._head < self._last

    def turn(self, length: Any, speed: Any) -> None:
        """Take the rope of a tick, which moves no tap."""
        del length, speed

    def ticks_of(self, lag: int) -> int:
        """Ticks in which a lag passes."""
        return lag

    def rest(self, command: Any) -> None:
        """Enter rest at `command`, or stay there. The reference equals the command."""
        self._base = command
        self._head = self._last
        self._lapped = False

    def pending(self, row: int) -> Any:
        """Sum of the references still to come if every later command is 0, in command units times ticks.

        At rest any row may take over, and `row` says which; while running it is the row that runs.
        """
        return self._running_sum() if self.is_running else self.rest_sum(self._base, row)

    def run(self, command: Any, row: int) -> Any:
        """Shape one new command; returns the reference."""
        if not self.is_running:
            self._start(row)
        self._head = 0 if self._head >= self._last else self._head + 1
        self._ring[self._head] = command
        reference = self._shape(command, row)
        if self._head >= self._last:
            self._lap()
            self._lapped = True
        return reference

    def _reach(self, row: int) -> Iterator[tuple[Any, Any, bool]]:
        """Amplitude and command of each tap, and whether the command belongs to the present lap."""
        table, head = self._tables[row], self._head
        for delay, amplitude in zip(table.lags, table.amplitudes, strict=True):
            if delay <= head:
                yield amplitude, self._ring[head - delay], True
            elif self._lapped:
                yield amplitude, self._ring[head + (self._last + 1 - delay)], False
            else:
                yield amplitude, self._base, False

    @abstractmethod
    def rest_sum(self, command: Any, row: int) -> Any:
        """Sum of the references still to come at rest at `command`."""

    @abstractmethod
    def _running_sum(self) -> Any: ...

    @abstractmethod
    def _start(self, row: int) -> None: ...

    @abstractmethod
    def _shape(self, command: Any, row: int) -> Any: ...

    @abstractmethod
    def _lap(self) -> None: ...


class FloatTapFilter(TapFilter):
    """Taps in double or float.

    `_pending` sums command minus reference. Rounding would let it wander for ever under a command that never
    rests, so a second sum, `_fresh`, is taken over each lap of the ring from the commands of that lap alone;
    when a lap is full it has forgotten everything older and replaces the first.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        super().__init__(settings)
        self._moments = tuple(settings.number.scalar(float(t.moment)) for t in self._tables)
        self._max = settings.limits.max_command
        self._pending = self._fresh = self._zero

    def rest_sum(self, command: Any, row: int) -> Any:
        """Sum of the references still to come at rest at `command`."""
        return command * self._moments[row]

    def _running_sum(self) -> Any:
        return self._pending

    def _start(self, row: int) -> None:
        self._pending = self.rest_sum(self._base, row)
        self._fresh = self._zero

    def _shape(self, command: Any, row: int) -> Any:
        reference = lap = self._zero
        for amplitude, past, in_lap in self._reach(row):
            reference = reference + (amplitude * past)
            if in_lap:
                lap = reference
        low, high = self._bounds(command, row)
        reference = min(max(reference, low), high)
        self._pending = self._pending + (command - reference)
        self._fresh = self._fresh + (command - lap)
        return reference

    def _bounds(self, command: Any, row: int) -> tuple[Any, Any]:
        """Give the bounds that a reference could pass by rounding alone, by an ulp.

        Where amplitudes are negative, a command moves one way from the last rest, and so does the reference.
        """
        if not self._tables[row].waits:
            return -self._max, self._max
        return (self._base, command) if self._base < command else (command, self._base)

    def _lap(self) -> None:
        self._pending = self._fresh
        self._fresh = self._zero


class IntegerTapFilter(TapFilter):
    """Taps in int32: counts in, counts out, amplitudes in Q30.

    What rounding takes from one reference, `_carry` gives to the next, so that the references of a whole move
    sum to exactly its commands, and the pending sum is exact for ever.
    """

    _BITS = 30
    _HALF = 1 << (_BITS - 1)

    def __init__(self, settings: ShaperSettings) -> None:
        super().__init__(settings)
        self._moments = tuple(_whole_and_q30(table.moment) for table in self._tables)
        self._pending = self._carry = 0

    def rest(self, command: int) -> None:
        """Enter rest at `command`, or stay there."""
        super().rest(command)
        if command == 0:
            self._carry = 0

    def rest_sum(self, command: int, row: int) -> int:
        """Sum of the references still to come at rest at `command`."""
        whole, fraction = self._moments[row]
        return command * whole + ((command * fraction + self._carry + self._HALF) >> self._BITS)

    def _running_sum(self) -> int:
        return self._pending

    def _start(self, row: int) -> None:
        self._pending = self.rest_sum(self._base, row)

    def _shape(self, command: int, row: int) -> int:
        total = self._carry
        for amplitude, past, _ in self._reach(row):
            total += amplitude * past
        reference = (total + self._HALF) >> self._BITS
        self._carry = total - (reference << self._BITS)
        self._pending += command - reference
        return reference

    def _lap(self) -> None:
        """Do nothing: integer sums do not drift."""


def _whole_and_q30(moment_ticks: Fraction) -> tuple[int, int]:
    """Split a moment into whole ticks and a numerator over 2**30; exact, since amplitudes are in Q30."""
    return divmod(int(moment_ticks * (1 << 30)), 1 << 30)


def tap_filter(settings: ShaperSettings) -> TapFilter:
    """Make the filter for the settings' number type, at rest at 0.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    """
    return IntegerTapFilter(settings) if settings.number.is_integer else FloatTapFilter(settings)
