"""The exchange: times and half-planes in use grow until the linear program's optimum is the true one.

Not for: callers outside this package, who use `minimax_amplitudes`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from swayless.design.minimax.held import Held, HeldPeaks
from swayless.design.minimax.polish import Deciding, independent, meet, polish
from swayless.design.minimax.program import AmplitudeRule, Vertex, solve_program
from swayless.design.minimax.response import IndexArray
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

DROPPED_AMPLITUDE = 1e-9
"""Amplitudes below this are rounding of the linear program: their times are dropped."""

MISSED_EQUALITY = 1e-9
"""Equalities that settled amplitudes miss by more cannot be met."""

_SHORTFALL = 3e-9  # the same for the linear program: HiGHS leaves 1e-9
_GAP = 1e-8  # broken half-planes and prices below this, in units of the target, end the exchange
_AT_LIMIT = 1e-8  # amplitudes and partial sums this near their limit are at it: HiGHS leaves 1e-9
_SMALLEST_UNIT = 1e-3  # residual vibration that the program counts as 1 when the target is smaller
_HIGH = 0.9  # of the optimum so far: lower peaks do not decide
_FIRST_FREQUENCIES = 9  # of the first half-planes, four phases each: a frame that the exchange fills in
_ROUNDS = 500  # far above the 30 or so of the slowest designs: a bound against cycling


@dataclass(frozen=True, eq=False)
class Minimax:
    """Amplitudes found, and what is proved about them.

    Parameters
    ----------
    taps : ndarray of int, shape (k,)
        Indices of the times in use, rising.
    amplitudes : ndarray, shape (k,)
        Their amplitudes, none 0, in sum 1.
    worst_residual_ratio : float
        Largest residual vibration of these amplitudes over the bands; infinite if they miss an equality.
    lower_bound_ratio : float
        No amplitudes at the times offered do better; infinite if none meet the equalities, 0 if the target
        was reached before anything was proved.
    """

    taps: IndexArray
    amplitudes: FloatArray
    worst_residual_ratio: float
    lower_bound_ratio: float


@dataclass(eq=False)
class Exchange:
    """A search in progress.

    Parameters
    ----------
    held : Held
        The bands, and what unit impulses at all n times offered leave on them.
    rule : AmplitudeRule
        Sign rule of the amplitudes.
    equalities : ndarray, shape (p, n)
        Rows whose product with the amplitudes must be 0.
    target_ratio : float
        Residual vibration that is enough.
    least_last : float
        Smallest amplitude at the last time.
    taps : ndarray of int
        Indices of the times in use; grows.
    line, frequency, phase : ndarray, shape (m,)
        Half-planes in use: the index of a line, a frequency in cycles per duration and a phase in radians
        each; they grow.
    """

    held: Held
    rule: AmplitudeRule
    equalities: FloatArray
    target_ratio: float
    least_last: float
    taps: IndexArray
    line: IndexArray = field(init=False)
    frequency: FloatArray = field(init=False)
    phase: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        line, frequency = self.held.spread(_FIRST_FREQUENCIES)
        self.line, self.frequency = np.repeat(line, 4), np.repeat(frequency, 4)
        self.phase = np.tile(np.arange(4) * (math.pi / 2.0), line.size)

    @property
    def unit(self) -> float:
        """Residual vibration that the linear program counts as 1."""
        return max(self.target_ratio, _SMALLEST_UNIT)

    def run(self) -> Minimax:
        """Exchange until nothing is broken and no time helps, or the target is proved out of reach."""
        for _ in range(_ROUNDS):
            vertex = solve_program(
                self._cuts(self.taps), self.equalities[:, self.taps], self.rule, self.least_last
            )
            missed = vertex.shortfall > _SHORTFALL
            short = missed or vertex.level * self.unit > self.target_ratio * (1.0 + _GAP)
            further = self._further_times(vertex) if short else self.taps[:0]
            peaks = self.held.of(self.taps).peaks(vertex.amplitudes)
            bound = 0.0 if not short else math.inf if missed else vertex.level * self.unit
            if short and not further.size and (missed or self.target_ratio > 0.0):
                return Minimax(self.taps, vertex.amplitudes, math.inf if missed else peaks.worst, bound)
            broken = np.abs(peaks.value) > (vertex.level + _GAP) * self.unit
            if not further.size:
                taps, amplitudes = self._settled(vertex, peaks)
                worst = self._worst(taps, amplitudes)
                if not broken.any() or worst <= (vertex.level + _GAP) * self.unit:
                    return Minimax(taps, amplitudes, worst, bound)
                # Half-planes where the settled amplitudes peak end the search many rounds earlier.
                ahead = self.held.of(taps).peaks(amplitudes)
                self._admit(ahead, np.abs(ahead.value) > _HIGH * vertex.level * self.unit)
            self._admit(peaks, broken)
            self.taps = np.union1d(self.taps, further)
        raise DesignError(f"{self.taps.size} amplitudes did not settle in {_ROUNDS} rounds of exchange")

    def _admit(self, peaks: HeldPeaks, chosen: NDArray[np.bool_]) -> None:
        """Add the half-planes of some peaks to those in use."""
        self.line = np.append(self.line, peaks.line[chosen])
        self.frequency = np.append(self.frequency, peaks.frequency[chosen])
        self.phase = np.append(self.phase, np.angle(peaks.value[chosen]))

    def _cuts(self, taps: IndexArray | slice, chosen: NDArray[np.bool_] | slice = slice(None)) -> FloatArray:
        """Half-planes as rows over the times `taps`: the part of the residual vibration in their phase."""
        exponents = self.held.exponents[:, taps][self.line[chosen]]
        columns = np.exp(self.frequency[chosen, np.newaxis] * exponents)
        rows: FloatArray = (columns * np.exp(-1j * self.phase[chosen])[:, np.newaxis]).real / self.unit
        return rows

    def _further_times(self, vertex: Vertex) -> IndexArray:
        """Find times not in use at which amplitude would lower the optimum, where locally it does so most."""
        active = vertex.cut_weights > 0.0
        cost = vertex.cut_weights[active] @ self._cuts(slice(None), active)
        cost -= vertex.equality_prices @ np.vstack([np.ones((1, cost.size)), self.equalities])
        following = np.searchsorted(self.taps, np.arange(cost.size))  # first tap in use at or after each time
        cost -= np.append(np.cumsum(vertex.level_prices[::-1])[::-1], 0.0)[following]
        gain = -cost
        if self.rule is AmplitudeRule.BOUNDED:
            level = np.append(0.0, np.cumsum(vertex.amplitudes))[following]
            gain = np.maximum(
                np.where(level < 1.0 - _AT_LIMIT, -cost, 0.0), np.where(level > _AT_LIMIT, cost, 0.0)
            )
        gain[self.taps] = 0.0
        highest = (gain >= np.append(0.0, gain[:-1])) & (gain >= np.append(gain[1:], 0.0))
        return np.flatnonzero(highest & (gain > _GAP))

    def _deciding(self, vertex: Vertex, peaks: HeldPeaks) -> Deciding:
        """Peaks that hold the optimum up, with the weights of the half-planes nearest to them."""
        away = np.abs(np.subtract.outer(self.frequency, peaks.frequency))
        away[np.not_equal.outer(self.line, peaks.line)] = np.inf
        nearest = away.argmin(axis=1)
        weights = np.zeros(peaks.frequency.size)
        np.add.at(weights, nearest, vertex.cut_weights)
        heavy = weights > _GAP
        moving = self.held.inside(peaks)
        return Deciding(peaks.line[heavy], peaks.frequency[heavy], weights[heavy], moving[heavy])

    def _settled(self, vertex: Vertex, peaks: HeldPeaks) -> tuple[IndexArray, FloatArray]:
        """Reduce to the times that the optimum uses, with amplitudes to machine precision."""
        taps, amplitudes, deciding = self.taps, vertex.amplitudes, self._deciding(vertex, peaks)
        used = self._used(amplitudes)
        while True:  # each further pass has dropped a time
            taps, amplitudes = taps[used], amplitudes[used]
            rows, targets = self._active(taps, amplitudes)
            amplitudes = meet(rows, targets, amplitudes)
            polished = polish(self.held.exponents[:, taps], rows, targets, amplitudes, deciding)
            if polished is not None and self._keeps_limits(polished):
                amplitudes = polished
            if self.rule is AmplitudeRule.BOUNDED:  # equalities that repeat each other leave rounding here
                amplitudes = np.diff(np.clip(np.cumsum(amplitudes), 0.0, 1.0), prepend=0.0)
            used = self._used(amplitudes)
            if used.all():
                return taps, amplitudes

    def _used(self, amplitudes: FloatArray) -> NDArray[np.bool_]:
        """Tell the amplitudes that count from rounding, and from those that have the wrong sign."""
        sizes = amplitudes if self.rule is AmplitudeRule.POSITIVE else np.abs(amplitudes)
        return np.asarray(sizes > DROPPED_AMPLITUDE)

    def _active(self, taps: IndexArray, amplitudes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Every equality that the amplitudes must keep: the sum, the design's own, and levels at a limit."""
        levels, highest = np.cumsum(amplitudes)[:-1], np.ones(taps.size - 1)
        highest[-1:] = 1.0 - self.least_last
        bounded = self.rule is AmplitudeRule.BOUNDED
        low, high = bounded & (levels < _AT_LIMIT), levels > highest - _AT_LIMIT
        high[:-1] &= bounded
        steps = np.tri(taps.size)[:-1]
        rows = [np.ones((1, taps.size)), self.equalities[:, taps], steps[low], steps[high]]
        targets = [np.ones(1), np.zeros(len(self.equalities) + low.sum()), highest[high]]
        return independent(np.concatenate(rows), np.concatenate(targets))

    def _keeps_limits(self, amplitudes: FloatArray) -> bool:
        """Whether the last amplitude is large enough, and partial sums keep to 0 .. 1 where they must."""
        levels = np.cumsum(amplitudes)
        bounded = self.rule is AmplitudeRule.BOUNDED
        within = not bounded or bool(levels.min() > -_AT_LIMIT and levels.max() < 1.0 + _AT_LIMIT)
        return within and bool(amplitudes[-1] > self.least_last - _AT_LIMIT)

    def _worst(self, taps: IndexArray, amplitudes: FloatArray) -> float:
        """Largest residual vibration over the bands; infinite if an equality or a limit is missed."""
        missed = np.abs(self.equalities[:, taps] @ amplitudes).max(initial=0.0) > MISSED_EQUALITY
        wrong = missed or not self._keeps_limits(amplitudes)
        return math.inf if wrong else self.held.of(taps).peaks(amplitudes).worst
