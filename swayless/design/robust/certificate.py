"""The proof that no shaper does better: a dual polynomial, bounded over continuous time.

Not for: finding it (`search`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import ComplexArray
from swayless.design.shaper import FloatArray

_CELLS_PER_CYCLE = 16
_SAMPLES_PER_CYCLE = 256
_REFINEMENTS = 4  # Newton doubles the digits each time, from a start within 1/256 of a cycle
_MOST_CELLS = 100_000  # at once: a polynomial that needs more is no proof worth having
_SLACK = 1e-9  # of sizes of order 1: what the bound may lose against the true one


@dataclass(frozen=True, eq=False)
class Certificate:
    """p(t) = Re sum c_k exp(f_k turn_k (t - T)), sum |c_k| <= 1, whose values prove a worst residual.

    Take any shaper of duration t_n <= T. At f_k it leaves V_k = exp(-z w t_n) |sum A_i exp(f_k turn_k t_i)|,
    and exp(-z w t_n) >= exp(-z w T). So max V_k >= sum |c_k| V_k >= sum A_i p(t_i): whatever the amplitudes
    are, their worst residual vibration is at least the least value of that sum that the sign rule allows.
    Damping makes no difference: p counts the decay up to T, the most that a shorter design may have.

    Parameters
    ----------
    coefficients : ndarray of complex, shape (m,)
        c_k; their sizes sum to at most 1.
    rates : ndarray of complex, shape (m,)
        f_k turn_k.
    duration : float
        T.
    """

    coefficients: ComplexArray
    rates: ComplexArray
    duration: float

    def dips(self) -> FloatArray:
        """Find the local minima of p, the ends included."""
        left, _ = self._cells(_SAMPLES_PER_CYCLE)
        times = np.append(left, self.duration)
        value = self(times)[0]
        low = (value <= np.append(np.inf, value[:-1])) & (value <= np.append(value[1:], np.inf))
        return self._flat(times[low])

    def extremes(self) -> FloatArray:
        """Find the places inside 0 .. T where the slope of p changes sign."""
        left, width = self._cells(_SAMPLES_PER_CYCLE)
        slope = self(np.append(left, self.duration))[1]
        return self._flat(left[slope[:-1] * slope[1:] < 0.0] + width / 2.0)

    def _flat(self, times: FloatArray) -> FloatArray:
        """Move times to where p is flat, by Newton's method, at most a cell away."""
        _, width = self._cells(_SAMPLES_PER_CYCLE)
        low, high = np.maximum(times - width, 0.0), np.minimum(times + width, self.duration)
        for _ in range(_REFINEMENTS):
            terms = np.exp(np.multiply.outer(times - self.duration, self.rates)) * self.coefficients
            slope, bend = (terms @ self.rates).real, (terms @ self.rates**2).real
            times = np.clip(times - slope / np.where(bend == 0.0, 1.0, bend), low, high)
        return times

    def _derivative_bound(self, order: int) -> float:
        """Bound the size of a derivative of p at all times up to T: |exp(rate (t - T))| <= 1 there."""
        return float(np.abs(self.coefficients) @ np.abs(self.rates) ** order)

    def __call__(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Values and slopes at times."""
        terms = np.exp(np.multiply.outer(times - self.duration, self.rates)) * self.coefficients
        return terms.sum(axis=-1).real, (terms @ self.rates).real

    def bound(self, rule: AmplitudeRule) -> float:
        """Least worst residual vibration that any shaper of the rule and of duration <= T can leave.

        Positive amplitudes sum to 1, so sum A_i p(t_i) >= min p. Bounded ones give, by parts, p(T) - the
        integral of p'(t) times the partial sum up to t, which is at least p(T) - the sum of all rises of p.
        """
        return self._least() if rule is AmplitudeRule.POSITIVE else self._end_less_rises()

    def _cells(self, per_cycle: int = _CELLS_PER_CYCLE) -> tuple[FloatArray, float]:
        """Left ends of equal cells that cover 0 .. T, and their width."""
        cycles = float(np.abs(self.rates).max()) / (2.0 * np.pi) * self.duration
        edges, width = np.linspace(0.0, self.duration, 9 + int(per_cycle * cycles), retstep=True)
        return edges[:-1], float(width)

    def _least(self) -> float:
        """Minimum of p over 0 .. T from below: a cell falls at most |p''| width^2 / 8 below both ends."""
        left, width = self._cells()
        proven = sampled = np.inf
        while left.size:
            ends = np.minimum(self(left)[0], self(left + width)[0])
            sampled = min(sampled, float(ends.min()))
            lowest = ends - self._derivative_bound(2) * width**2 / 8.0
            unsure = lowest < sampled - _SLACK
            proven = min(proven, float(lowest[~unsure].min(initial=np.inf)))
            if np.count_nonzero(unsure) > _MOST_CELLS:
                return float(lowest.min())
            left, width = np.concatenate([left[unsure], left[unsure] + width / 2.0]), width / 2.0
        return proven

    def _end_less_rises(self) -> float:
        """p(T) less its rises, from below: slopes stray at most the third derivative times width^2 / 8."""
        left, width = self._cells()
        proven = float(self(np.array([self.duration]))[0][0])
        while True:
            (value, slope), (after, slope_after) = self(left), self(left + width)
            stray = self._derivative_bound(3) * width**2 / 8.0
            steepest = np.maximum(slope, slope_after) + stray
            unsure = (steepest > 0.0) & (np.minimum(slope, slope_after) < stray)
            proven -= float(np.maximum(after - value, 0.0)[~unsure].sum())
            largest_rises = float(steepest[unsure].sum()) * width
            if largest_rises < _SLACK or left.size > _MOST_CELLS:
                return proven - largest_rises
            left, width = np.concatenate([left[unsure], left[unsure] + width / 2.0]), width / 2.0
