"""What hoisting does, in int32: the law of `hoist` in whole numbers. Not for: why; that is there.

Speeds are in mm/s; ratios are in Q30; commands are scaled counts (`phase_filter_int32`). Every shift and
division cuts towards 0, so that both directions of travel are alike. What is divided by the quanta of a tick
is multiplied by their reciprocal, which is found once, when they change.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from swayless.controller.hoist import (
    LEAST_ANSWER,
    LEAST_LACK,
    LEAST_MISMATCH,
    LONGEST_STRETCH,
    SERIES,
    kick_per_quantum,
    loss_ratio,
    stretches,
)
from swayless.controller.hoist_answers import answers
from swayless.controller.phase_clock import PhaseClock
from swayless.controller.rope import MM_PER_M
from swayless.controller.settings import ShaperSettings

ONE = 1 << 30
"""1 in Q30."""

LARGEST_SWING = 1 << 31
"""Keeps products of the oscillator in 64 bits: twice the largest command, a full reversal."""

LARGEST_WANTED = 1 << 29
"""Keeps answers in 64 bits: half of the largest command, more than any hoist wants."""


def shifted(value: int, bits: int) -> int:
    """Divide by a power of two, towards 0."""
    return value >> bits if value >= 0 else -(-value >> bits)


def within(value: int, limit: int) -> int:
    """Value, but no farther from 0 than the limit."""
    return min(max(value, -limit), limit)


def inverse_shift(clock: PhaseClock) -> int:
    """Power of two over which reciprocals of quanta fill 32 bits, with half as much again to spare."""
    return 30 + clock.fewest_quanta.bit_length()


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
    """Weights and wanted steps in int32.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    max_scaled : int
        Largest command, scaled.
    """

    STRETCH_BITS = 22
    KICK_BITS = 22

    def __init__(self, settings: ShaperSettings, max_scaled: int) -> None:
        clock = settings.clock
        assert clock is not None  # noqa: S101 - only a phase law has a hoist
        self._tables = settings.row_tables
        widest = max(max(row) for row in stretches(settings)) / MM_PER_M
        self.stretch_shift = Scale.of(widest, bits=self.STRETCH_BITS).shift
        self.stretch = tuple(
            tuple(round(s / MM_PER_M * ONE * 2.0**self.stretch_shift) for s in row)
            for row in stretches(settings)
        )
        self.answers = tuple(
            tuple((round(e * ONE), round(n * ONE)) for e, n in zip(*each, strict=True))
            for each in answers(settings)
        )
        self.kick_scale = Scale.of(kick_per_quantum(settings) / MM_PER_M, bits=self.KICK_BITS)
        self.per_most = round(2.0**52 / clock.most_quanta)
        self.per_fewest = round(2.0**52 / clock.fewest_quanta)
        self.inverse_shift = inverse_shift(clock)
        self.angle_shift = 30 + round(math.log2(clock.quantum_rad))
        self.loss = round(2.0 * loss_ratio(settings) * ONE)
        self.longest, self.series = round(LONGEST_STRETCH * ONE), tuple(round(s * ONE) for s in SERIES)
        self.mismatch = round(LEAST_MISMATCH * ONE)
        self.least_answer = max(round(max_scaled * LEAST_ANSWER), 1)
        self.least_lack = max(round(max_scaled * LEAST_LACK), 1)
        self._quanta = clock.fewest_quanta
        self.inverse = (1 << self.inverse_shift) // self._quanta
        self._speed = self._answered = self._rate = self._place = self._pace = 0

    def turn(self, quanta: int, speed: int) -> None:
        """Take the quanta and the hoist speed of a tick."""
        if quanta != self._quanta:
            grown = self.ratio(quanta, self.inverse)
            self._place = within(shifted(self._place * grown, 30), LARGEST_SWING)
            self._quanta = quanta
            self.inverse = (1 << self.inverse_shift) // quanta
        self._speed = speed
        self._rate = speed * quanta

    def ratio(self, quanta: int, inverse: int) -> int:
        """Quanta times a reciprocal of quanta, in Q30."""
        return (quanta * inverse) >> (self.inverse_shift - 30)

    def ticks(self, moment: int) -> int:
        """Divide part times phase by the quanta of a tick, in two halves of 31 bits each."""
        size = abs(moment)
        low = ((size & (ONE + ONE - 1)) * self.inverse) >> 31
        found = ((size >> 31) * self.inverse + low) >> (self.inverse_shift - 31)
        return found if moment >= 0 else -found

    def start(self) -> None:
        """Leave rest: the load hangs still."""
        self._place = self._pace = 0
        self._answered = self._speed

    def kick(self) -> int:
        """Step that undoes the kick of a change of hoist speed; small ones are collected."""
        change = (self._speed - self._answered) * self._quanta
        step = shifted(shifted(change * self.kick_scale.factor, self.kick_scale.shift) * self._place, 30)
        if abs(step) < self.least_answer:
            return 0
        self._answered = self._speed
        return step

    def swing(self, step: int) -> None:
        """Let the oscillator swing for a tick, after a step of the trolley's speed."""
        shift = self.angle_shift
        angle = self._quanta << shift if shift >= 0 else self._quanta >> -shift
        half = angle >> 1
        pace = within(self._pace - step, LARGEST_SWING)
        place = self._place + shifted(half * pace, 30)
        pace = pace - shifted(angle * place, 30)
        self._pace = within(shifted(pace * (ONE - shifted(angle * self.loss, 30)), 30), LARGEST_SWING)
        self._place = within(place + shifted(half * self._pace, 30), LARGEST_SWING)

    def foreseen(self, row: int) -> list[tuple[int, int]]:
        """Weight of each tap for a change now, in sum 1 but for rounding; and 1 / quanta when it releases."""
        low = max(shifted(self._quanta * self.per_most, 22) - ONE, -self.longest)
        high = min(shifted(self._quanta * self.per_fewest, 22) - ONE, self.longest)
        found = []
        for amplitude, per_rate in zip(self._tables[row].amplitudes, self.stretch[row], strict=True):
            stretch = min(max(shifted(self._rate * per_rate, self.stretch_shift), low), high)
            level = 0
            for term in reversed(self.series):
                level = shifted(stretch * (term + level), 30)
            found.append((shifted(amplitude * (ONE + level), 30), (self.inverse * (ONE + stretch)) >> 30))
        share = (ONE * ONE) // sum(weight for weight, _ in found)
        return [(shifted(weight * share, 30), inverse) for weight, inverse in found]

    def part(self, change: int, weight: int, wanted: tuple[int, int], row: int, tap: int) -> int:
        """Part of a change, and of the answer to a wanted step, that a tap releases later."""
        step, lean = wanted
        even, leaning = self.answers[row][tap]
        return shifted((change * weight) + ((step * even) + (lean * leaning)), 30)

    def lack(self, part: int, inverse: int) -> int:
        """Step that a part lacks on the rope as it is: this is shorter than foreseen."""
        excess = shifted(self.ratio(self._quanta, inverse) - ONE, 1)
        if abs(excess) < self.mismatch:
            return 0
        more = shifted(part * within(excess, ONE >> 1), 30)
        return more if abs(more) >= self.least_lack else 0
