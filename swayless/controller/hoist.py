"""What hoisting does to the swing: weights of the taps, and the steps that a start or stop of it wants.

A change dv of the trolley's speed excites the swing in proportion to dv L^(1/4), because E / w of a slowly
hoisted pendulum stays (adiabatic invariant). So the part of a later tap is weighted by L^(-1/4) of the rope
on which it will be released: with a steady hoist sqrt(L) grows by speed lag / (2 sqrt(g)).
A hoist that starts or stops does two things more, and both are known:
- It kicks the swing. In u = L angle the pendulum is u'' = -(g / L - L'' / L) u - x'', so a change of the
  hoist speed changes u' by that change times u / L. The block runs this oscillator beside its reference: a
  step of the trolley's speed by the same undoes the kick.
- Parts under way were weighted for another length. Where that matters, a part that is released lacks a step.
How a row answers such a step is a matter of its taps (`hoist_answers`).
Everything else is of second order in L' / (L w). Not for: the ring and its pointers (`phase_filter`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.hoist_answers import answers
from swayless.controller.ramp import on_grid
from swayless.controller.settings import ShaperSettings
from swayless.plant import STANDARD_GRAVITY_M_S2

LONGEST_STRETCH = 0.5
"""Relative change of sqrt(L) until a tap that is weighted for at most; faster hoists count as this fast."""

LEAST_MISMATCH = 2.0**-9
"""Relative error of a weight from which on it is corrected: noise of a hoist speed stays below."""

LEAST_ANSWER = 2.0**-12
"""Part of the largest command: smaller kicks are collected before they are answered."""

LEAST_LACK = 2.0**-20
"""Part of the largest command: what a part lacks is not worth the time until rest below."""

LEAST_LOSS = 1e-3
"""Damping ratio of the oscillator that the block runs, at least: it forgets what rounding adds."""

SERIES = (-1.0 / 2.0, 3.0 / 8.0, -5.0 / 16.0, 35.0 / 128.0)
"""(1 + z)^(-1/2) = 1 + z (s_0 + z (s_1 + z (s_2 + z s_3))), right to 1.2 % at z = -0.5, to 3e-6 at 0.1."""


def stretches(settings: ShaperSettings) -> tuple[tuple[float, ...], ...]:
    """Change of sqrt(L) until each tap, relative, per m/s of hoist and quantum of the tick; by row."""
    clock = settings.clock
    assert clock is not None  # noqa: S101 - only a phase law asks
    per_lag = clock.quantum_rad**2 / (2.0 * STANDARD_GRAVITY_M_S2 * settings.tick_s)
    return tuple(tuple(lag * per_lag for lag in table.lags) for table in settings.row_tables)


def kick_per_quantum(settings: ShaperSettings) -> float:
    """Kick, relative to the swing's speed amplitude, per m/s of hoist and quantum of the tick: 1 / (w L)."""
    clock = settings.clock
    assert clock is not None  # noqa: S101 - only a phase law asks
    return clock.quantum_rad / (STANDARD_GRAVITY_M_S2 * settings.tick_s)


def loss_ratio(settings: ShaperSettings) -> float:
    """Damping ratio of the oscillator that the block runs beside its reference."""
    damping = max(row.taps.guarantee.mode.damping_ratio for row in settings.bank.rows)
    return max(damping, LEAST_LOSS)


class FloatHoist:
    """Weights and wanted steps in double or float.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        clock, scalar = settings.clock, settings.number.scalar
        assert clock is not None  # noqa: S101 - only a phase law has a hoist
        self._limits, self._scalar = settings.limits, scalar
        self._tables = settings.row_tables
        self._answers = tuple(
            tuple((scalar(e), scalar(n)) for e, n in zip(*each, strict=True)) for each in answers(settings)
        )
        self._stretch = tuple(tuple(scalar(s) for s in row) for row in stretches(settings))
        self._kick = scalar(kick_per_quantum(settings))
        self._per_most = scalar(1.0 / clock.most_quanta)
        self._per_fewest = scalar(1.0 / clock.fewest_quanta)
        self._quantum, self._loss = scalar(clock.quantum_rad), scalar(2.0 * loss_ratio(settings))
        self._zero, self._half, self._one = scalar(0.0), scalar(0.5), scalar(1.0)
        self._longest, self._series = scalar(LONGEST_STRETCH), tuple(scalar(s) for s in SERIES)
        self._mismatch = scalar(LEAST_MISMATCH)
        max_command = settings.limits.max_command
        self._least_answer = max_command * scalar(LEAST_ANSWER)
        self._least_lack = max_command * scalar(LEAST_LACK)
        self._quanta = scalar(clock.fewest_quanta)
        self.inverse = self._one / self._quanta
        self._speed = self._answered = self._rate = self._place = self._pace = self._zero

    def turn(self, quanta: int, speed: Any) -> None:
        """Take the quanta and the hoist speed of a tick."""
        count = self._scalar(quanta)
        if count != self._quanta:
            self._place = self._place * (count * self.inverse)
            self._quanta = count
            self.inverse = self._one / count
        self._speed = speed
        self._rate = speed * count

    def start(self) -> None:
        """Leave rest: the load hangs still."""
        self._place = self._pace = self._zero
        self._answered = self._speed

    def kick(self) -> Any:
        """Step that undoes the kick of a change of hoist speed; small ones are collected."""
        kick = ((self._speed - self._answered) * (self._quanta * self._kick)) * self._place
        step = on_grid(kick, self._limits)
        if abs(step) < self._least_answer:
            return self._zero
        self._answered = self._speed
        return step

    def swing(self, step: Any) -> None:
        """Let the oscillator swing for a tick, after a step of the trolley's speed."""
        angle = self._quanta * self._quantum
        half = angle * self._half
        pace = self._pace - step
        place = self._place + (half * pace)
        self._pace = (pace - (angle * place)) * (self._one - (angle * self._loss))
        self._place = place + (half * self._pace)

    def foreseen(self, row: int) -> list[tuple[Any, Any]]:
        """Weight of each tap for a change now, in sum 1 but for rounding; and 1 / quanta when it releases."""
        first, second, third, fourth = self._series
        low = max((self._quanta * self._per_most) - self._one, -self._longest)
        high = min((self._quanta * self._per_fewest) - self._one, self._longest)
        found, total = [], self._zero
        for amplitude, per_rate in zip(self._tables[row].amplitudes, self._stretch[row], strict=True):
            stretch = min(max(self._rate * per_rate, low), high)
            tail = second + (stretch * (third + (stretch * fourth)))
            weight = amplitude * (self._one + (stretch * (first + (stretch * tail))))
            found.append((weight, self.inverse * (self._one + stretch)))
            total = total + weight
        share = self._one / total
        return [(weight * share, inverse) for weight, inverse in found]

    def part(self, change: Any, weight: Any, wanted: tuple[Any, Any], row: int, tap: int) -> Any:
        """Part of a change, and of the answer to a wanted step, that a tap releases later."""
        step, lean = wanted
        even, leaning = self._answers[row][tap]
        return on_grid((change * weight) + ((step * even) + (lean * leaning)), self._limits)

    def lack(self, part: Any, inverse: Any) -> Any:
        """Step that a part lacks on the rope as it is: this is shorter than foreseen."""
        excess = ((self._quanta * inverse) - self._one) * self._half
        if abs(excess) < self._mismatch:
            return self._zero
        more = on_grid(part * min(max(excess, -self._half), self._half), self._limits)
        return more if abs(more) >= self._least_lack else self._zero
