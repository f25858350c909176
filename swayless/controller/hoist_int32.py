"""The answer to hoisting in int32: the law of `hoist` in whole numbers. Not for: why; that is there.

Speeds are in mm/s; ratios are in Q30; commands are scaled counts (`phase_filter_int32`). Every shift and
division cuts towards 0, so that both directions of travel are alike.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from swayless.controller.hoist import (
    LEAST_ANSWER,
    LEAST_MISMATCH,
    LEAST_OWED,
    LONGEST_STRETCH,
    SERIES,
    kick_per_quantum,
    loss_ratio,
    stretches,
)
from swayless.controller.rope import MM_PER_M
from swayless.controller.settings import ShaperSettings

ONE = 1 << 30
"""1 in Q30."""

_LARGEST_SWING = 1 << 31


def shifted(value: int, bits: int) -> int:
    """Divide by a power of two, towards 0."""
    return value >> bits if value >= 0 else -(-value >> bits)


def quotient(value: int, divisor: int) -> int:
    """Divide by a positive number, towards 0."""
    return value // divisor if value >= 0 else -(-value // divisor)


def _within(swing: int) -> int:
    """Keep the oscillator where products fit in 64 bits: twice the largest command, a full reversal."""
    return min(max(swing, -_LARGEST_SWING), _LARGEST_SWING)


class Scale(NamedTuple):
    """A small real factor as `factor` over 2 to the power of `shift`, in Q30 once applied."""

    factor: int
    shift: int

    @classmethod
    def of(cls, value: float, *, bits: int) -> Scale:
        """Keep so many bits of a positive value; 0 stays 0."""
        if value == 0.0:
            return cls(0, 0)
        shift = bits - math.frexp(value * ONE)[1]
        return cls(round(value * ONE * 2.0**shift), shift)


class IntegerHoist:
    """The answer to hoisting in int32.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    cells : int
        Cells of the ring.
    max_scaled : int
        Largest command, scaled.
    """

    STRETCH_BITS = 22
    KICK_BITS = 22

    def __init__(self, settings: ShaperSettings, cells: int, max_scaled: int) -> None:
        clock = settings.clock
        assert clock is not None  # noqa: S101 - only a phase law has a hoist
        self._tables = settings.row_tables
        widest = max(max(row) for row in stretches(settings)) / MM_PER_M
        self.stretch_shift = Scale.of(widest, bits=self.STRETCH_BITS).shift
        self.stretch = tuple(
            tuple(round(s / MM_PER_M * ONE * 2.0**self.stretch_shift) for s in row)
            for row in stretches(settings)
        )
        self.kick = Scale.of(kick_per_quantum(settings) / MM_PER_M, bits=self.KICK_BITS)
        self.per_most = round(2.0**52 / clock.most_quanta)
        self.per_fewest = round(2.0**52 / clock.fewest_quanta)
        self.angle_shift = 30 + round(math.log2(clock.quantum_rad))
        self.loss = round(loss_ratio(settings) * ONE)
        self.sixth, self.twelfth = round(ONE / 6), round(ONE / 12)
        self.longest, self.series = round(LONGEST_STRETCH * ONE), tuple(round(s * ONE) for s in SERIES)
        self.mismatch = round(LEAST_MISMATCH * ONE)
        self.least_answer = max(round(max_scaled * LEAST_ANSWER), 1)
        self.least_owed = max(round(max_scaled * LEAST_OWED), 1)
        self._rates = [0] * cells
        self._quanta = clock.fewest_quanta
        self._speed = self._answered = self._rate = self._place = self._pace = 0

    def turn(self, quanta: int, speed: int) -> None:
        """Take the quanta and the hoist speed of a tick."""
        if quanta != self._quanta:
            self._place = _within(shifted(self._place * quotient(quanta * ONE, self._quanta), 30))
            self._quanta = quanta
        self._speed = speed
        self._rate = speed * quanta

    def start(self) -> None:
        """Leave rest: the load hangs still."""
        self._place = self._pace = 0
        self._answered = self._speed

    def answer(self) -> int:
        """Step of the reference that undoes the kick of a change of hoist speed."""
        change = (self._speed - self._answered) * self._quanta
        step = shifted(shifted(change * self.kick.factor, self.kick.shift) * self._place, 30)
        if abs(step) < self.least_answer:
            return 0
        self._answered = self._speed
        return step

    def swing(self, release: int) -> None:
        """Let the oscillator swing for a tick, after a step of the trolley's speed."""
        shift = self.angle_shift
        angle = self._quanta << shift if shift >= 0 else self._quanta >> -shift
        square = shifted(angle * angle, 30)
        sine = shifted(angle * (ONE - shifted(square * self.sixth, 30)), 30)
        cosine = ONE - shifted((square >> 1) * (ONE - shifted(square * self.twelfth, 30)), 30)
        keep = ONE - shifted(angle * self.loss, 30)
        pace = _within(self._pace - release)
        self._pace = _within(shifted(shifted((pace * cosine) - (self._place * sine), 30) * keep, 30))
        self._place = _within(shifted(shifted((self._place * cosine) + (pace * sine), 30) * keep, 30))

    def remember(self, cell: int) -> None:
        """Keep what the weights of a new cell are made for."""
        self._rates[cell] = self._rate

    def weights(self, row: int) -> list[int]:
        """Weights of the taps for a change now, in sum 1 but for rounding."""
        weights = []
        for tap, amplitude in enumerate(self._tables[row].amplitudes):
            stretch = self._stretched(self._rate, self._quanta, row, tap)
            level = 0
            for term in reversed(self.series):
                level = shifted(stretch * (term + level), 30)
            weights.append(shifted(amplitude * (ONE + level), 30))
        total = sum(weights)
        return [quotient(weight * ONE, total) for weight in weights]

    def part(self, change: int, weight: int) -> int:
        """Part of a change that a tap releases later."""
        return shifted(change * weight, 30)

    def due(self, part: int, cell: int, gap: int, row: int, tap: int) -> int:
        """Give what of a part is released on the rope as it is: more on a longer one than it was made for."""
        made_for = self._stretched(self._rates[cell], gap, row, tap)
        longer = shifted(quotient(self._quanta * ONE, gap) * (ONE + made_for), 30)
        excess = shifted(longer - ONE, 1)
        if abs(excess) < self.mismatch:
            return part
        more = shifted(part * min(max(excess, -(ONE >> 1)), ONE >> 1), 30)
        return part + more if abs(more) >= self.least_owed else part

    def _stretched(self, rate: int, quanta: int, row: int, tap: int) -> int:
        """Relative change of sqrt(L) until a tap releases, within the range of the rope."""
        low = max(shifted(quanta * self.per_most, 22) - ONE, -self.longest)
        high = min(shifted(quanta * self.per_fewest, 22) - ONE, self.longest)
        return min(max(shifted(rate * self.stretch[row][tap], self.stretch_shift), low), high)
