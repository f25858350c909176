"""Original command shaping: each sample is scattered by the spacing of its tick (`law = "original"`).

When the spacing grows, ticks are left for which a tap has no sample; when it shrinks, ticks get two. Every
sample is released in full, so that the way of a move is kept, but a change of the spacing shakes the load: it
is the law that Magee and Book improve on, here to compare with. Not for: cranes that hoist while they travel.

References
----------
Magee and Book, figs 10 to 12.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import SpacedFilter

MOST_RUNS = 1 << 30
"""Runs are numbered up to here. Every tick of a run passes a cell and a run has a tick, so a cell is passed
before as many runs as the ring has cells are over: numbers may be used again."""


class OriginalFilter(SpacedFilter):
    """Taps that scatter each command over the ticks to come.

    A cell holds what is released at its tick, and the number of the run that put it there: what an earlier
    run has left counts as 0, and needs no clearing.

    Parameters
    ----------
    settings : ShaperSettings
        Constants in the number type of the filter.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        super().__init__(settings)
        self._cells = [self._zero] * (self._last + 1)
        self._runs = [0] * (self._last + 1)
        self._run = self._cell = self._age = 0
        self._before = self._spacing

    def turn(self, position: Any, speed: Any) -> None:
        """Take the position of a tick: a new spacing disturbs a steady command, and takes back all rest."""
        self._before = self._spacing
        super().turn(position, speed)
        command = self._commands[self._head] if self.is_running else self._base
        self.elapsed = -self._last if self._spacing != self._before and command != 0 else 1

    def _start(self) -> None:
        self._start_spacing = self._before
        self._run = 1 if self._run >= MOST_RUNS else self._run + 1
        self._age = 0

    def _shape(self, command: Any, row: int) -> Any:
        self._cell = 0 if self._cell >= self._last else self._cell + 1
        amplitudes = self._tables[row].amplitudes
        for tap, amplitude in enumerate(amplitudes):
            self._scatter(tap * self._spacing, amplitude * command)
        total = self._cells[self._cell]
        self._runs[self._cell] = 0
        for tap, amplitude in enumerate(amplitudes):
            if tap * self._start_spacing > self._age:
                total = total + (amplitude * self._base)
        self._age = min(self._age + 1, self._last)
        return total

    def _scatter(self, delay: int, part: Any) -> None:
        """Add a part to what is released after a delay."""
        cell = self._cell + delay
        if cell > self._last:
            cell -= self._last + 1
        is_new = self._runs[cell] != self._run
        self._cells[cell] = part if is_new else self._cells[cell] + part
        self._runs[cell] = self._run

    def _delay(self, tap: int) -> int:
        return tap * self._spacing
