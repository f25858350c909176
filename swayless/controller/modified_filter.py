"""Modified command shaping: every tick gets just one sample of each tap (`law = "modified"`).

The paper fills the gaps that a wider spacing leaves with samples shaped by the old spacing too, and drops the
surplus of a narrower one. Tap by tap that is one rule: a tap reads the command of some ticks ago, and goes
over to another delay as soon as the samples that it would read, by the old delay and by the new one, both
want it. So it holds for a change by any number of ticks; a tap does not follow a spacing that changes back
before that moment has come. Not for: exact ways of moves; samples are read twice or never.

References
----------
Magee and Book, figs 13 and 14.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import SpacedFilter


class ModifiedFilter(SpacedFilter):
    """Taps that each read one past command a tick.

    Parameters
    ----------
    settings : ShaperSettings
        Constants in the number type of the filter.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        super().__init__(settings)
        self._spacings = [self._spacing] * (self._last + 1)
        self._delays = [0] * max(len(table.lags) for table in self._tables)

    def _start(self) -> None:
        self._delays[: self._taps] = [tap * self._spacing for tap in range(self._taps)]

    def _shape(self, command: Any, row: int) -> Any:
        del command  # it is in the ring
        self._spacings[self._head] = self._spacing
        total = self._zero
        for tap, amplitude in enumerate(self._tables[row].amplitudes):
            delay = self._followed(tap)
            self._delays[tap] = delay
            total = total + (amplitude * self._past(delay))
        return total

    def _followed(self, tap: int) -> int:
        """Delay of a tap for this tick: the median of what it was, and what the two samples want."""
        delay = self._delays[tap]
        wanted = tap * self._spacing_then(delay)
        agreed = tap * self._spacing_then(wanted)
        return max(min(wanted, agreed), min(max(wanted, agreed), delay))

    def _past(self, delay: int) -> Any:
        """Command of so many ticks ago."""
        if delay <= self._head:
            return self._commands[self._head - delay]
        return self._commands[self._head + (self._last + 1 - delay)] if self._lapped else self._base

    def _spacing_then(self, delay: int) -> int:
        """Spacing of so many ticks ago."""
        if delay <= self._head:
            return self._spacings[self._head - delay]
        return self._spacings[self._head + (self._last + 1 - delay)] if self._lapped else self._start_spacing

    def _delay(self, tap: int) -> int:
        return self._delays[tap]
