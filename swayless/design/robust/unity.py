"""The best shapers of exactly so many impulses +1, -1, ..., +1, free of units.

Bounded optima are of this kind, with as many impulses as they need; fewer impulses are easier on a drive.
With their number given the problem is not convex: switch times descend from many starts, and the best local
optimum found is polished. No dual polynomial proves that it is the best; the bound of the bounded set is
quoted beside it.
Not for: units (`specified`), nor for ticks (`whole_ticks`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust import exact
from swayless.design.robust.demand import FewerDoError, NotHeldError, check_impulses
from swayless.design.robust.descent import Trials, alternating, descended
from swayless.design.robust.lines import Line
from swayless.design.robust.search import candidates, is_near, peaks_of
from swayless.design.robust.stationary import Goal, Optimum, polish
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

_SIZES = 24  # durations or edges that are scanned
_DRAWN = 256  # starts for each size, of which the best descend
_DESCENDING = 8
_PURSUED = 40  # trials nearest to the tolerance, which are led to where they meet it
_LONGEST_MOVES = 0.15 * 0.8 ** np.arange(
    14
)  # of a size in one round: less and less, so that all come to rest
_POLISHED = 12  # of the trials that meet the tolerance, the best first
_CORRECTIONS = 10  # of what is active; one to three are usual
_SAMPLES_PER_RIPPLE = 12  # |G|^2 ripples once per 1 / duration
_FEWEST_SAMPLES = 9
_NEAR = 0.2  # log of the worst over the tolerance, within which a trial meets it: the norm is not the worst
_ACTIVE = 0.8  # of the worst: peaks lower than that are not active
_ADMITTED = 1e-2  # weight with which a newcomer starts
_TOUCH = 1e-8  # relative: peaks beyond the worst by more are not yet covered
_APART = 1e-3  # relative: nearer frequencies are one peak
_MEETING = 1e-3  # gap between impulses, in durations, below which they cancel each other
_SAME = 1e-4  # trials nearer to each other than that, in durations and logs, are one
_FLAT = 1e-9  # slope of the worst over the size, below which it shows no way
_BETTER = 1e-2  # log of the size: by that much fewer impulses must be better
_LEAST_TOLD = 0.01  # residual vibration below which the bounded optimum need not be told from 0
_SHORTEST = 0.1  # periods of the lowest frequency
_LONGEST = 0.36  # periods of the lowest frequency per impulse
_LARGEST_RATIO = 8.0


def shortest(lines: Sequence[Line], tolerance: float, count: int) -> Optimum:
    """Find the shortest impulses +1, -1, ..., +1 of a number that leave at most the tolerance on every line.

    Parameters
    ----------
    lines : sequence of Line
        What is to be held; the lowest frequency is 1.
    tolerance : float
        Residual vibration as a ratio.
    count : int
        Number of impulses, odd, at least 3.

    Raises
    ------
    NotHeldError
        If so many impulses cannot hold the lines whatever their duration.
    FewerDoError
        If fewer impulses are as good.

    Examples
    --------
    >>> round(shortest([Line(1.0, 1.2, 0.0)], 0.05, 5).duration, 4)
    0.598
    """
    check_impulses(count)
    return _Search(Goal.DURATION, tuple(lines), 1.0, tolerance, count).best()


def widest(duration: float, damping_ratio: float, tolerance: float, count: int) -> Optimum:
    """Find the impulses of a number and duration that hold the tolerance from 1 to the highest edge.

    Parameters
    ----------
    duration : float
        In periods of the lowest frequency.
    damping_ratio : float
        Over the whole band.
    tolerance, count
        As for `shortest`.

    Returns
    -------
    Optimum
        Its last peak is at the upper edge.

    Raises
    ------
    DesignError
        If so many impulses of the duration do not even hold frequency 1, hold all up to 8, or fewer are as
        good.

    Examples
    --------
    >>> round(float(widest(0.5, 0.0, 0.05, 5).frequency[-1]), 3)
    1.084
    """
    check_impulses(count)
    return _Search(Goal.REACH, (Line(1.0, 1.0, damping_ratio),), duration, tolerance, count).best()


def least(lines: Sequence[Line], duration: float, count: int) -> Optimum:
    """Find the impulses of a number and duration that leave the least on all lines.

    Parameters
    ----------
    lines, count
        As for `shortest`.
    duration : float
        In periods of the lowest frequency.

    Raises
    ------
    FewerDoError
        If fewer impulses are as good.

    Examples
    --------
    >>> round(least([Line(1.0, 1.1, 0.0)], 0.5, 5).worst, 4)
    0.0585
    """
    check_impulses(count)
    return _Search(Goal.WORST, tuple(lines), duration, 1.0, count).best()


@dataclass(frozen=True, eq=False)
class _Search:
    """One problem; its size (log of the duration, or less the log of the edge) is to be small."""

    goal: Goal
    lines: tuple[Line, ...]
    duration: float
    tolerance: float
    count: int

    def best(self) -> Optimum:
        """Find the best optimum that any start leads to, or say why there is none.

        Where the bounded optimum has the number of impulses asked for, it is the answer, and proved.
        """
        bounded = self._bounded()
        if bounded is not None and bounded.times.size <= self.count:
            return self._with_count(bounded)
        optimum, meeting, worst = self._found()
        if optimum is not None and meeting > self._badness(optimum) - _BETTER:
            return optimum
        others = (replace(self, count=count)._found()[0] for count in range(self.count - 2, 1, -2))
        fewer = next((other for other in others if other is not None), None)
        if fewer is not None and (optimum is None or self._badness(fewer) <= self._badness(optimum)):
            return self._with_count(fewer)
        if optimum is None:
            raise self._refusal(worst)
        return optimum

    def _bounded(self) -> Optimum | None:
        """Find the bounded optimum, if one is found."""
        rule = AmplitudeRule.BOUNDED
        try:
            if self.goal is Goal.DURATION:
                return exact.shortest(self.lines, self.tolerance, rule)
            if self.goal is Goal.REACH:
                return exact.widest(self.duration, self.lines[0].damping_ratio, self.tolerance, rule)
            return exact.least(self.lines, self.duration, _LEAST_TOLD, rule)
        except DesignError:
            return None

    def _with_count(self, optimum: Optimum) -> Optimum:
        """Refuse an optimum of fewer impulses than asked for."""
        if optimum.times.size == self.count:
            return optimum
        raise FewerDoError(
            f"impulses = {self.count}: no better than {optimum.times.size}, because two of them would cancel "
            f"each other; ask for {optimum.times.size}",
            optimum.worst,
        )

    def _refusal(self, worst: float) -> DesignError:
        """Say what is missing, and what would do."""
        what = f"{self.count} impulses +1, -1, ..., +1"
        if self.goal is Goal.REACH and worst < self.tolerance:
            return DesignError(
                f"{what} hold all up to {_LARGEST_RATIO:g} times the lowest frequency; ask for fewer impulses"
            )
        if worst < self.tolerance:
            return DesignError(
                f"{what}: no optimum is found; another number of impulses or another tolerance may do"
            )
        span = f"{self.duration:.4g}"
        if self.goal is Goal.DURATION:
            span = f"{_SHORTEST:g} to {_LONGEST * self.count:.3g}"
        where = "the lowest frequency" if self.goal is Goal.REACH else "the band"
        return NotHeldError(
            f"{what} of {span} periods of the lowest frequency leave {100.0 * worst:.3g} % on {where} "
            "at best; more impulses, another duration or a larger tolerance may do"
        )

    def _sizes(self) -> FloatArray:
        """Sizes that are scanned, rising; all that come into question lie between them."""
        if self.goal is Goal.DURATION:
            return np.linspace(math.log(_SHORTEST), math.log(_LONGEST * self.count), _SIZES)
        return np.linspace(-math.log(_LARGEST_RATIO), 0.0, _SIZES) if self.goal is Goal.REACH else np.zeros(1)

    def _found(self) -> tuple[Optimum | None, float, float]:
        """Find the best optimum, the least size at which impulses meet, and the least residual."""
        trials, size, least_worst = self._met()
        worst = trials.worst()
        met = np.abs(np.log(worst / self.tolerance)) < _NEAR
        if self.goal is Goal.WORST:
            met, size = worst < 1.0, np.log(worst)
        trials, size = _distinct(trials.chosen(met), size[met])
        meeting = np.diff(trials.times).min(axis=1) < _MEETING
        shapes = list(zip(trials.times[~meeting], size[~meeting].tolist(), strict=True))[:_POLISHED]
        optima = [optimum for times, each in shapes for optimum in self._polished(times, each)]
        apart = [each for each in optima if np.diff(each.times).min() > _MEETING * each.duration]
        fewer = min((self._badness(each) for each in optima if each not in apart), default=np.inf)
        best = min(apart, key=self._badness, default=None)
        return best, min(fewer, float(size[meeting].min(initial=np.inf))), least_worst

    def _met(self) -> tuple[Trials, FloatArray, float]:
        """Descend from the best starts of every size, then move the sizes to where the tolerance is met."""
        sizes = self._sizes()
        size = np.repeat(sizes, _DRAWN)
        trials = self._trials(np.tile(_starts(_DRAWN, self.count), (sizes.size, 1)), size)
        order = trials.worst().reshape(sizes.size, _DRAWN).argsort(axis=1)[:, :_DESCENDING]
        chosen = (order + _DRAWN * np.arange(sizes.size)[:, np.newaxis]).ravel()
        trials, size = _distinct(descended(trials.chosen(chosen)), size[chosen])
        worst = trials.worst()
        least_worst = self._left(trials, size, worst)
        near = np.abs(np.log(worst / self.tolerance)).argsort(kind="stable")[:_PURSUED]
        trials, size = trials.chosen(near), size[near]
        for longest in () if self.goal is Goal.WORST else _LONGEST_MOVES:
            move = np.clip(self._move(trials, size), -longest, longest)
            size = np.clip(size + move, sizes[0], sizes[-1])
            trials = descended(self._trials(trials.times, size), again=True)
            least_worst = min(least_worst, self._left(trials, size, trials.worst()))
        return trials, size, least_worst

    def _left(self, trials: Trials, size: FloatArray, worst: FloatArray) -> float:
        """Measure what the best trial leaves at its peaks, which lie between the samples."""
        best = int(worst.argmin())
        lines, duration, _ = self._of_size(float(size[best]))
        times = trials.times[best] * duration
        return float(np.abs(peaks_of(times, alternating(self.count), lines).value).max())

    def _of_size(self, size: float) -> tuple[tuple[Line, ...], float, float]:
        """Lines, duration and worst that a size stands for."""
        if self.goal is Goal.DURATION:
            return self.lines, math.exp(size), self.tolerance
        if self.goal is Goal.REACH:
            return (replace(self.lines[0], high=math.exp(-size)),), self.duration, self.tolerance
        return self.lines, self.duration, math.exp(size)

    def _move(self, trials: Trials, size: FloatArray) -> FloatArray:
        """Newton's step towards the tolerance, from above it; from below it, towards smaller sizes."""
        slope = trials.sensitivity(self._spread(size)[1])
        over = 1.0 - self.tolerance / trials.worst()
        rate = np.where(over > 0.0, slope, -np.abs(slope))
        rate = np.where(np.abs(rate) < _FLAT, -_FLAT, rate)
        move: FloatArray = -over / rate
        return move

    def _trials(self, times: FloatArray, size: FloatArray) -> Trials:
        """Judge times at the frequencies of their sizes."""
        frequency = self._spread(size)[0]
        if self.goal is Goal.REACH:
            return Trials(times, frequency, np.full(frequency.shape[1], self.lines[0].turn))
        turn = np.concatenate([np.full(_shares(line, self.duration).size, line.turn) for line in self.lines])
        return Trials(times, frequency, turn)

    def _spread(self, size: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Sample frequencies for each size, in cycles per duration, and their derivative by the size."""
        grown = np.exp(size)[:, np.newaxis]
        if self.goal is Goal.REACH:
            share = _shares(Line(1.0, _LARGEST_RATIO, 0.0), self.duration)
            return self.duration * (1.0 + share * (1.0 / grown - 1.0)), -self.duration * share / grown
        spread = [line.low + _shares(line, self.duration) * (line.high - line.low) for line in self.lines]
        frequency = self.duration * grown * np.concatenate(spread)
        return frequency, frequency if self.goal is Goal.DURATION else np.zeros_like(frequency)

    def _badness(self, optimum: Optimum) -> float:
        """Return what is to be least, as a logarithm."""
        if self.goal is Goal.WORST:
            return math.log(optimum.worst)
        return math.log(optimum.duration if self.goal is Goal.DURATION else 1.0 / optimum.frequency[-1])

    def _polished(self, times: FloatArray, size: float) -> Iterator[Optimum]:
        """Polish one trial; nothing comes of one that belongs to no optimum."""
        lines, duration, worst = self._of_size(size)
        start = _guess(times * duration, lines, worst)
        for candidate in candidates(start, self.goal) if start.weights.size else ():
            optimum = self._settled(candidate, lines)
            if optimum is not None:
                yield optimum
                return

    def _settled(self, start: Optimum, lines: Sequence[Line]) -> Optimum | None:
        """Polish and correct what is active until the worst is kept to on every line."""
        for _ in range(_CORRECTIONS):
            optimum = polish(start, self.goal, AmplitudeRule.BOUNDED)
            if optimum is None or not is_near(optimum, start) or np.diff(optimum.times).min() <= 0.0:
                return None
            if self.goal is Goal.REACH:
                lines = [replace(line, high=float(optimum.frequency[-1])) for line in lines]
            corrected = _corrected(optimum, lines)
            if corrected is None or corrected.weights.size == 0:
                return optimum if corrected is None else None
            start = corrected
        return None


def _starts(number: int, count: int) -> FloatArray:
    """Spread switch times evenly over 0 to 1, every second ones symmetric: shape (number, count)."""
    inner = count - 2
    base = 2.0
    for _ in range(60):
        base = (1.0 + base) ** (1.0 / (inner + 1))
    drawn = np.sort(np.outer(np.arange(1, number + 1), base ** -np.arange(1.0, inner + 1.0)) % 1.0, axis=1)
    drawn[::2] = (drawn[::2] + 1.0 - drawn[::2, ::-1]) / 2.0
    return np.pad(drawn, ((0, 0), (1, 1)), constant_values=(0.0, 1.0))


def _shares(line: Line, duration: float) -> FloatArray:
    """Places of samples over a line, from 0 to 1, denser towards the ends."""
    if line.high == line.low:
        return np.zeros(1)
    number = _FEWEST_SAMPLES + math.ceil(_SAMPLES_PER_RIPPLE * duration * (line.high - line.low))
    shares: FloatArray = (1.0 - np.cos(np.linspace(0.0, np.pi, number))) / 2.0
    return shares


def _distinct(trials: Trials, size: FloatArray) -> tuple[Trials, FloatArray]:
    """Sort trials by size and leave out those that came to the same as one before."""
    keys = np.rint(np.column_stack([size, trials.times]) / _SAME)
    first = np.unique(keys, axis=0, return_index=True)[1]
    order = first[np.argsort(size[first], kind="stable")]
    return trials.chosen(order), size[order]


def _guess(times: FloatArray, lines: Sequence[Line], worst: float) -> Optimum:
    """Take the high peaks for the active ones."""
    peaks = peaks_of(times, alternating(times.size), lines)
    size = np.abs(peaks.value)
    kept = size > _ACTIVE * size.max()
    weights = (size[kept] / size.max()) ** (1.0 / (1.0 - _ACTIVE)) ** 2
    return Optimum(
        times,
        alternating(times.size),
        peaks.frequency[kept],
        peaks.turn[kept],
        peaks.moving[kept],
        weights / weights.sum(),
        np.angle(peaks.value[kept]),
        worst,
    )


def _corrected(optimum: Optimum, lines: Sequence[Line]) -> Optimum | None:
    """Drop the peaks of negative weight and add those above the worst; None if there are neither."""
    peaks = peaks_of(optimum.times, optimum.amplitudes, lines)
    over = np.abs(peaks.value) > optimum.worst * (1.0 + _TOUCH)
    if not over.any() and optimum.weights.min() >= 0.0:
        return None
    away = np.abs(np.subtract.outer(peaks.frequency, optimum.frequency))
    away[np.not_equal.outer(peaks.turn, optimum.turn)] = np.inf
    weights = np.where(away.min(axis=1) < _APART, optimum.weights[away.argmin(axis=1)], 0.0)
    kept = over | (weights > 0.0)
    return replace(
        optimum,
        frequency=peaks.frequency[kept],
        turn=peaks.turn[kept],
        moving=peaks.moving[kept],
        weights=np.maximum(weights[kept], _ADMITTED),
        phase=np.angle(peaks.value[kept]),
    )
