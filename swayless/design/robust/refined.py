"""The least worst residual vibration for given lines and a duration, and its proof: by exchange.

A small convex program over a few times and frequencies is solved. Times are added where its dual polynomial
dips, frequencies where its residual vibration peaks, both in continuous time, until worst and bound are as
near as asked for. Nothing is assumed of how many impulses or peaks the optimum has, or that there is only
one. Not for: the exact optimum (`search`), which starts from here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import ComplexArray
from swayless.design.robust.central_path import RealOrComplexArray, least_worst
from swayless.design.robust.certificate import Certificate
from swayless.design.robust.lines import Line
from swayless.design.robust.search import peaks_of
from swayless.design.shaper import FloatArray

_TIMES_PER_CYCLE = 8  # of the highest frequency, to begin with
_FREQUENCIES_PER_RIPPLE = 6  # |G|^2 ripples once per 1 / duration
_FEWEST = 8  # of each
_ROUNDS = 40  # three to eight are usual
_APART = 5e-5  # in cycles of the highest frequency: a dip nearer to a time in use is deeper by 5e-8 at most
_IDLE = 0.01  # of the gap: smaller weights and amplitudes are dropped; what is missed comes back
_CENTRED = 0.1  # share of the gap that the convex program may leave


@dataclass(frozen=True, eq=False)
class Refined:
    """Amplitudes at many times, near the optimum, and a proof of how near.

    Parameters
    ----------
    times, amplitudes : ndarray, shape (n,)
        All times tried, the first 0 and the last the duration; most amplitudes are next to nothing.
    frequency, turn, weights, phase : ndarray, shape (m,)
        All frequencies tried, on their lines, with the dual values that make the certificate.
    worst : float
        Largest residual vibration that the amplitudes leave, as a ratio.
    bound : float
        No amplitudes of the rule, at whatever times up to the duration, leave less.
    """

    times: FloatArray
    amplitudes: FloatArray
    frequency: FloatArray
    turn: ComplexArray
    weights: FloatArray
    phase: FloatArray
    worst: float
    bound: float

    @property
    def certificate(self) -> Certificate:
        """The dual polynomial behind the bound."""
        coefficients = self.weights / max(1.0, float(self.weights.sum())) * np.exp(-1j * self.phase)
        return Certificate(coefficients, self.frequency * self.turn, float(self.times[-1]))


def refined(
    lines: Sequence[Line],
    duration: float,
    rule: AmplitudeRule,
    *,
    gap: float,
    resolved: float,
    decided: float = math.nan,
) -> Refined:
    """Find amplitudes whose worst residual on all lines is within a gap of the least there is.

    Parameters
    ----------
    lines : sequence of Line
        What is to be held.
    duration : float
        In periods of the frequency 1, > 0.
    rule : AmplitudeRule
        Sign rule.
    gap : float
        Relative distance of worst and bound, 1e-5 to 0.1.
    resolved : float
        Residual vibration below which the gap counts relative to this.
    decided : float
        End as soon as the least worst residual is known to be above this, or to be at most this.

    Returns
    -------
    Refined
        The gap may be larger where rounding does not let it close; the bound holds all the same.

    Raises
    ------
    DesignError
        If the central path is lost.
    """
    exchange, best = _Exchange.start(lines, duration, rule), -math.inf
    for _ in range(_ROUNDS):
        level, found = exchange.solved(gap=_CENTRED * gap, resolved=resolved)
        known = found.bound > decided or found.worst <= decided
        if known or found.bound >= found.worst - gap * max(found.worst, resolved):
            break
        # Where dual values are not unique, idle times may be what keeps them up: dropped each time, they
        # would come back for ever.
        kept = exchange.thinned(found, _IDLE * gap) if found.bound > best else exchange
        exchange, best = kept.grown(level, found), max(best, found.bound)
    return found


@dataclass(frozen=True, eq=False)
class _Exchange:
    """Times and frequencies in use.

    Without damping a shaper and its mirror image in time leave the same, so that the best one is symmetric:
    half the variables do, and the vibration seen from the middle is real. The times then are their own mirror
    image, and the middle is one of them.
    """

    lines: Sequence[Line]
    rule: AmplitudeRule
    times: FloatArray
    frequency: FloatArray
    turn: ComplexArray

    @classmethod
    def start(cls, lines: Sequence[Line], duration: float, rule: AmplitudeRule) -> _Exchange:
        """Spread times and frequencies evenly."""
        half = math.ceil(_TIMES_PER_CYCLE / 2.0 * _highest(lines) * duration)
        spread = [_frequencies(line, duration) for line in lines]
        turn = np.repeat([line.turn for line in lines], [part.size for part in spread])
        times = np.linspace(0.0, duration, 2 * max(_FEWEST, half) + 1)
        return cls(lines, rule, times, np.concatenate(spread), turn)

    @property
    def symmetric(self) -> bool:
        """Whether nothing is damped."""
        return not np.any(self.turn.real)

    def solved(self, *, gap: float, resolved: float) -> tuple[float, Refined]:
        """Solve the program: its value, and what its amplitudes and weights are worth everywhere."""
        duration = float(self.times[-1])
        from_end = np.exp(np.multiply.outer(self.frequency * self.turn, self.times - duration))
        columns: RealOrComplexArray = from_end
        if self.symmetric:
            columns = np.cos(np.multiply.outer(self.frequency * self.turn.imag, self.times - duration / 2.0))
        start, table = _variables(self.times.size, self.rule, symmetric=self.symmetric)
        positive = self.rule is AmplitudeRule.POSITIVE
        centre = least_worst(
            columns @ table, columns @ start, sum_to_one=positive, resolved=resolved, gap=gap
        )
        amplitudes = start + table @ centre.variables
        worst = float(np.abs(peaks_of(self.times, amplitudes, self.lines).value).max())
        phase = np.angle(from_end @ amplitudes)
        found = Refined(
            self.times, amplitudes, self.frequency, self.turn, centre.weights, phase, worst, -math.inf
        )
        return centre.worst, replace(found, bound=found.certificate.bound(self.rule))

    def thinned(self, found: Refined, idle: float) -> _Exchange:
        """Drop the frequencies and the times that do next to nothing."""
        used = np.abs(found.amplitudes) > idle
        used[[0, self.times.size // 2, -1]] = True
        active = found.weights > idle * found.weights.max()
        times = self.times[used | used[::-1] if self.symmetric else used]
        return replace(self, times=times, frequency=self.frequency[active], turn=self.turn[active])

    def grown(self, level: float, found: Refined) -> _Exchange:
        """Add the frequencies at which the residual is above the program's value, and the times that help."""
        peaks = peaks_of(found.times, found.amplitudes, self.lines)
        over = np.abs(peaks.value) > level
        return replace(
            self,
            times=self._with_times(level, found.certificate),
            frequency=np.append(self.frequency, peaks.frequency[over]),
            turn=np.append(self.turn, peaks.turn[over]),
        )

    def _with_times(self, level: float, certificate: Certificate) -> FloatArray:
        """Add times at which the dual polynomial dips below the level, or at which bounded levels switch."""
        if self.rule is AmplitudeRule.POSITIVE:
            dips = certificate.dips()
            new = dips[certificate(dips)[0] < level]
        else:
            new = certificate.extremes()
        duration = float(self.times[-1])
        if self.symmetric:
            new = np.sort(np.minimum(new, duration - new))
        apart = _APART / _highest(self.lines)
        far = np.abs(np.subtract.outer(new, self.times)).min(axis=1, initial=math.inf) > apart
        new = new[far & (np.diff(new, prepend=-1.0) > apart)]
        mirrored = duration - new if self.symmetric else new[:0]
        return np.sort(np.concatenate([self.times, new, mirrored]))


def _highest(lines: Sequence[Line]) -> float:
    """Highest frequency of all lines."""
    return max(line.high for line in lines)


def _frequencies(line: Line, duration: float) -> FloatArray:
    """Spread frequencies over a line, its ends included."""
    count = max(_FEWEST, math.ceil(_FREQUENCIES_PER_RIPPLE * duration * (line.high - line.low)))
    return np.linspace(line.low, line.high, count) if line.high > line.low else np.array([line.low])


def _variables(count: int, rule: AmplitudeRule, *, symmetric: bool) -> tuple[FloatArray, FloatArray]:
    """Amplitudes at a number of times as start + table @ variables, every variable between 0 and 1.

    The variables are amplitudes (positive; of a pair of mirror images, if symmetric), or the levels that the
    reference takes between two times (bounded; if symmetric, a level and its mirror image sum to 1).
    """
    half = count // 2
    if rule is AmplitudeRule.POSITIVE:
        table = np.eye(count)
        return np.zeros(count), (table + table[::-1])[:, : half + 1] / 2.0 if symmetric else table
    levels, first = np.eye(count - 1), np.zeros(count - 1)
    if symmetric:
        levels, first = (levels - levels[::-1])[:, :half], np.repeat([0.0, 1.0], half)
    edges = np.zeros((1, levels.shape[1]))
    return np.diff(first, prepend=0.0, append=1.0), np.diff(np.vstack([edges, levels, edges]), axis=0)
