"""What hoisting does to the swing, and the answer of the phase clock: weights, and what is owed.

A change dv of the trolley's speed excites the swing in proportion to dv L^(1/4), because E / w of a slowly
hoisted pendulum stays (adiabatic invariant). So the part of a later tap is weighted by L^(-1/4) of the rope
on which it will be released: with a steady hoist sqrt(L) grows by speed lag / (2 sqrt(g)).
A hoist that starts or stops does two things more, and both are known:
- It kicks the swing. In u = L angle the pendulum is u'' = -(g / L - L'' / L) u - x'', so a change of the
  hoist speed changes u' by that change times u / L. The block runs this oscillator beside its reference,
  moves the reference by the same at once, and gives it back through its taps.
- Parts under way were weighted for another length. Where that matters they are corrected when they are
  released, and the difference is owed: it goes through the taps again.
Everything else is of second order in L' / (L w). Not for: the ring and its pointers (`phase_filter`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.ramp import on_grid
from swayless.controller.settings import ShaperSettings
from swayless.plant import STANDARD_GRAVITY_M_S2

LONGEST_STRETCH = 0.5
"""Relative change of sqrt(L) until a tap that is weighted for at most; faster hoists count as this fast."""

LEAST_MISMATCH = 2.0**-9
"""Relative error of a weight from which on it is corrected: noise of a hoist speed stays below."""

LEAST_ANSWER = 2.0**-12
"""Part of the largest command: smaller kicks are collected before they are answered."""

LEAST_OWED = 2.0**-20
"""Part of the largest command: differences below are not worth the time until rest."""

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
    """The answer to hoisting in double or float.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    cells : int
        Cells of the ring.
    """

    def __init__(self, settings: ShaperSettings, cells: int) -> None:
        clock, scalar = settings.clock, settings.number.scalar
        assert clock is not None  # noqa: S101 - only a phase law has a hoist
        self._limits, self._scalar = settings.limits, scalar
        self._tables = settings.row_tables
        self._stretch = tuple(tuple(scalar(s) for s in row) for row in stretches(settings))
        self._kick = scalar(kick_per_quantum(settings))
        self._per_most = scalar(1.0 / clock.most_quanta)
        self._per_fewest = scalar(1.0 / clock.fewest_quanta)
        self._quantum, self._loss = scalar(clock.quantum_rad), scalar(loss_ratio(settings))
        self._zero, self._half, self._one = scalar(0.0), scalar(0.5), scalar(1.0)
        self._sixth, self._twelfth = scalar(1.0 / 6.0), scalar(1.0 / 12.0)
        self._longest, self._series = scalar(LONGEST_STRETCH), tuple(scalar(s) for s in SERIES)
        self._mismatch = scalar(LEAST_MISMATCH)
        max_command = settings.limits.max_command
        self._least_answer = max_command * scalar(LEAST_ANSWER)
        self._least_owed = max_command * scalar(LEAST_OWED)
        self._inverses, self._rates = [self._one] * cells, [self._zero] * cells
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

    def answer(self) -> Any:
        """Step of the reference that undoes the kick of a change of hoist speed."""
        kick = ((self._speed - self._answered) * (self._quanta * self._kick)) * self._place
        step = on_grid(kick, self._limits)
        if abs(step) < self._least_answer:
            return self._zero
        self._answered = self._speed
        return step

    def swing(self, release: Any) -> None:
        """Let the oscillator swing for a tick, after a step of the trolley's speed."""
        angle = self._quanta * self._quantum
        square = angle * angle
        sine = angle * (self._one - (square * self._sixth))
        cosine = self._one - ((square * self._half) * (self._one - (square * self._twelfth)))
        keep = self._one - (angle * self._loss)
        pace = self._pace - release
        self._pace = ((pace * cosine) - (self._place * sine)) * keep
        self._place = ((self._place * cosine) + (pace * sine)) * keep

    def remember(self, cell: int) -> None:
        """Keep what the weights of a new cell are made for."""
        self._inverses[cell], self._rates[cell] = self.inverse, self._rate

    def weights(self, row: int) -> list[Any]:
        """Weights of the taps for a change now, in sum 1 but for rounding."""
        amplitudes = self._tables[row].amplitudes
        weights = []
        total = self._zero
        for tap, amplitude in enumerate(amplitudes):
            stretch = self._stretched(self._rate, self._quanta, row, tap)
            first, second, third, fourth = self._series
            tail = second + (stretch * (third + (stretch * fourth)))
            weight = amplitude * (self._one + (stretch * (first + (stretch * tail))))
            weights.append(weight)
            total = total + weight
        share = self._one / total
        return [weight * share for weight in weights]

    def part(self, change: Any, weight: Any) -> Any:
        """Part of a change that a tap releases later."""
        return on_grid(change * weight, self._limits)

    def due(self, part: Any, cell: int, gap: int, row: int, tap: int) -> Any:
        """Give what of a part is released on the rope as it is: more on a longer one than it was made for."""
        made_for = self._stretched(self._rates[cell], self._scalar(gap), row, tap)
        longer = (self._quanta * self._inverses[cell]) * (self._one + made_for)
        excess = (longer - self._one) * self._half
        if abs(excess) < self._mismatch:
            return part
        more = on_grid(part * min(max(excess, -self._half), self._half), self._limits)
        return part + more if abs(more) >= self._least_owed else part

    def _stretched(self, rate: Any, quanta: Any, row: int, tap: int) -> Any:
        """Relative change of sqrt(L) until a tap releases, within the range of the rope."""
        low = max((quanta * self._per_most) - self._one, -self._longest)
        high = min((quanta * self._per_fewest) - self._one, self._longest)
        return min(max(rate * self._stretch[row][tap], low), high)
