"""Taps whose delays are phases of the pendulum: the filter of the phase clock (`law = "phase"`).

A change of the command is a *cell* of a ring: the parts that each later tap will release, and the quanta of
phase until the next cell. Each tap is one pointer into the ring, which lags by the tap's phase and moves by
the quanta of every tick; a cell that it passes inside a tick is split between this tick and the next, in
proportion. Everything is a sum of whole quanta and of numbers on one grid, so nothing is lost or drifts.

What a hoist that starts or stops does to the swing, the taps answer: `hoist` says how large a step of the
trolley's speed that wants, `hoist_answers` how the taps make it. Not for: ramps, stops or rows.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from swayless.controller.hoist import FloatHoist
from swayless.controller.hoist_answers import leaning_from
from swayless.controller.hoist_int32 import IntegerHoist
from swayless.controller.ramp import on_grid
from swayless.controller.settings import ShaperSettings


class PhaseFilter(ABC):
    """The ring and the pointers that both filters share.

    Parameters
    ----------
    settings : ShaperSettings
        Constants in the number type of the filter.
    hoist : FloatHoist or IntegerHoist
        What hoisting does.
    """

    def __init__(self, settings: ShaperSettings, hoist: FloatHoist | IntegerHoist) -> None:
        assert settings.clock is not None  # noqa: S101 - only a phase law is given this filter
        self._clock, self._tables, self._hoist = settings.clock, settings.row_tables, hoist
        self._zero = settings.number.scalar(0)
        self._last = last_cell(settings)
        taps = max(len(table.lags) for table in self._tables)
        self._parts = [[self._zero] * (self._last + 1) for _ in range(taps)]
        self._foreseen = [[self._zero] * (self._last + 1) for _ in range(taps)]
        self._gaps = [0] * (self._last + 1)
        self._cells, self._ahead = [0] * taps, [0] * taps
        self._head = self._last
        self._leaning_from = leaning_from(settings)
        self._base = self._command = self._level = self._late = self._mass = self._zero
        self.is_running = self.has_pushed = False
        self.elapsed = self._quanta = self._clock.fewest_quanta

    def turn(self, length: Any, speed: Any) -> None:
        """Take the rope of a tick: the tick before had the quanta that have elapsed."""
        self.elapsed = self._quanta
        self._quanta = self._clock.quanta(length)
        self._hoist.turn(self._quanta, speed)

    def ticks_of(self, lag: int) -> int:
        """Ticks in which a lag passes while the rope is still."""
        return -(-lag // self._quanta)

    def rest(self, command: Any) -> None:
        """Enter rest at `command`, or stay there. The reference equals the command."""
        self._base = command
        self.is_running = self.has_pushed = False

    def run(self, command: Any, row: int) -> Any:
        """Shape one new command; returns the reference."""
        if not self.is_running:
            self._leave_rest(row)
        self._head = 0 if self._head >= self._last else self._head + 1
        release, lack = self._pass(row)
        change = self._arrived(command)
        kick = self._hoist.kick()
        wanted = self._within(kick + lack)
        release = release + self._push(change, (wanted, self._lean(change, wanted)), row)
        # The oscillator knows nothing of the kick, so it is not shown what undoes it.
        self._hoist.swing(release - kick)
        self._level = self._level + release
        return self._reference()

    def _leave_rest(self, row: int) -> None:
        """Every pointer lags by its phase behind the first cell, and nothing is under way."""
        self.is_running = True
        self._head = self._last
        for tap, lag in enumerate(self._tables[row].lags):
            self._cells[tap], self._ahead[tap] = 0, lag
        self._late = self._mass = self._zero
        self._start()
        self._hoist.start()

    def _pass(self, row: int) -> tuple[Any, Any]:
        """Move every pointer by a tick: what is released now, and what it lacks after a change of hoist."""
        release, lack = self._late, self._zero
        self._late = self._zero
        for tap in range(1, len(self._tables[row].lags)):
            ahead, cell = self._ahead[tap], self._cells[tap]
            while ahead < self._quanta:
                part = self._parts[tap][cell]
                if part != 0:
                    late = self._later(part, ahead)
                    release = release + (part - late)
                    self._late = self._late + late
                    lack = lack + self._hoist.lack(part, self._foreseen[tap][cell])
                    self._leave(part, ahead, in_lap=cell <= self._head)
                ahead += self._gaps[cell]
                cell = 0 if cell >= self._last else cell + 1
            self._ahead[tap], self._cells[tap] = ahead - self._quanta, cell
        return release, lack

    def _lean(self, change: Any, wanted: Any) -> Any:
        """Lean away from the largest command where the command is next to it and does not shrink."""
        if self._command > self._leaning_from and change >= 0:
            return -abs(wanted)
        if self._command < -self._leaning_from and change <= 0:
            return abs(wanted)
        return self._zero

    def _push(self, change: Any, wanted: tuple[Any, Any], row: int) -> Any:
        """Write a cell; returns the part of the first tap, which is what the others leave."""
        lags = self._tables[row].lags
        self._gaps[self._head] = self._quanta
        self.has_pushed = bool(change != 0 or wanted[0] != 0)
        if not self.has_pushed:
            for tap in range(1, len(lags)):
                self._parts[tap][self._head] = self._zero
            self._enter(self._zero, self._zero)
            return self._zero
        first, moment = change, self._zero
        foreseen = self._hoist.foreseen(row)
        for tap in range(1, len(lags)):
            weight, inverse = foreseen[tap]
            part = self._hoist.part(change, weight, wanted, row, tap)
            self._parts[tap][self._head], self._foreseen[tap][self._head] = part, inverse
            first = first - part
            moment = moment + (part * self._lag(lags[tap]))
        self._enter(change - first, moment)
        return first

    @abstractmethod
    def rest_sum(self, command: Any, row: int) -> Any:
        """Sum of the references still to come at rest at `command`."""

    @abstractmethod
    def pending(self, row: int) -> Any:
        """Sum of the references still to come if every later command is 0 and the rope is still."""

    @abstractmethod
    def _start(self) -> None: ...

    @abstractmethod
    def _arrived(self, command: Any) -> Any: ...

    @abstractmethod
    def _within(self, wanted: Any) -> Any: ...

    @abstractmethod
    def _later(self, part: Any, ahead: int) -> Any: ...

    @abstractmethod
    def _lag(self, lag: int) -> Any: ...

    @abstractmethod
    def _leave(self, part: Any, ahead: int, *, in_lap: bool) -> None: ...

    @abstractmethod
    def _enter(self, later: Any, moment: Any) -> None: ...

    @abstractmethod
    def _reference(self) -> Any: ...


class FloatPhaseFilter(PhaseFilter):
    """Taps at phases in double or float; every part lies on the grid of the ramp steps, and adds exactly.

    `_moment` sums, over the parts under way, part times phase still to go: with it the references to come on
    a still rope are known at once. Rounding would let it wander for ever under a command that never rests, so
    a second sum, `_fresh`, is taken over each lap of the ring from the cells of that lap alone; when a lap is
    full it has forgotten everything older and replaces the first.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._floats = FloatHoist(settings)
        super().__init__(settings, self._floats)
        self._scalar, self._limits = settings.number.scalar, settings.limits
        self._moments = tuple(self._scalar(float(table.moment)) for table in self._tables)
        self._moment = self._passed = self._zero
        self._fresh = self._fresh_mass = self._fresh_passed = self._zero

    def rest_sum(self, command: Any, row: int) -> Any:
        """Sum of the references still to come at rest at `command`."""
        return (command * self._moments[row]) * self._floats.inverse

    def pending(self, row: int) -> Any:
        """Sum of the references still to come if every later command is 0 and the rope is still."""
        if not self.is_running:
            return self.rest_sum(self._base, row)
        return ((self._command * self._moments[row]) - self._moment) * self._floats.inverse

    def _start(self) -> None:
        self._command = self._level = self._base
        self._moment = self._fresh = self._fresh_mass = self._zero
        self._passed = self._fresh_passed = self._zero

    def _arrived(self, command: Any) -> Any:
        change = command - self._command
        self._command = command
        return change

    def _within(self, wanted: Any) -> Any:
        return wanted

    def _later(self, part: Any, ahead: int) -> Any:
        return on_grid(part * (self._scalar(ahead) * self._floats.inverse), self._limits)

    def _lag(self, lag: int) -> Any:
        return self._scalar(lag)

    def _leave(self, part: Any, ahead: int, *, in_lap: bool) -> None:
        moment = part * self._scalar(ahead)
        self._mass = self._mass - part
        self._passed = self._passed + moment
        if in_lap:
            self._fresh_mass = self._fresh_mass - part
            self._fresh_passed = self._fresh_passed + moment

    def _enter(self, later: Any, moment: Any) -> None:
        quanta = self._scalar(self._quanta)
        self._mass = self._mass + later
        self._fresh_mass = self._fresh_mass + later
        self._moment = (self._moment + (moment - self._passed)) - (self._mass * quanta)
        self._fresh = (self._fresh + (moment - self._fresh_passed)) - (self._fresh_mass * quanta)
        self._passed = self._fresh_passed = self._zero
        if self._head >= self._last:
            self._moment = self._fresh
            self._fresh = self._fresh_mass = self._zero

    def _reference(self) -> Any:
        limit = self._limits.max_command
        return min(max(self._level, -limit), limit)


def last_cell(settings: ShaperSettings) -> int:
    """Last cell of the ring: what the longest lag takes on the longest rope, and two cells more."""
    return settings.longest_delay_ticks + 1
