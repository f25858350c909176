"""Newton's method on the conditions of an optimal shaper: impulses, peaks and weights together.

Not for: finding what is active, which is `search`.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import ComplexArray
from swayless.design.shaper import FloatArray

_STEPS = 20  # four to eight are usual
_CONVERGED = (
    1e-10  # largest last step, in periods and ratios: Newton squares what is left, which is then rounding
)
_LARGEST_STEP = 0.05  # in periods of the highest frequency, and in ripples of the response


class Goal(enum.Enum):
    """Which quantity is best, while the others are given."""

    DURATION = "shortest"
    WORST = "least residual vibration"
    REACH = "highest upper edge of the band"


@dataclass(frozen=True, eq=False)
class Optimum:
    """Impulses, and the peaks of the residual vibration that hold them where they are.

    Parameters
    ----------
    times, amplitudes : ndarray, shape (n,)
        The impulses, the first time 0.
    frequency : ndarray, shape (m,)
        Where the peaks lie.
    turn : ndarray of complex, shape (m,)
        `Line.turn` of their lines.
    moving : ndarray of bool, shape (m,)
        Whether a peak is flat; one at an end of its line is not.
    weights : ndarray, shape (m,)
        Dual values of the peaks, in sum 1.
    phase : ndarray, shape (m,)
        Angle of the residual vibration at the peaks, in radians.
    worst : float
        Residual vibration at all of them, as a ratio.
    """

    times: FloatArray
    amplitudes: FloatArray
    frequency: FloatArray
    turn: ComplexArray
    moving: NDArray[np.bool_]
    weights: FloatArray
    phase: FloatArray
    worst: float

    @property
    def duration(self) -> float:
        """Time of the last impulse."""
        return float(self.times[-1])


def polish(start: Optimum, goal: Goal, rule: AmplitudeRule) -> Optimum | None:
    """Solve the conditions from a start.

    All of them say that one function is stationary: the goal plus sum q_k (Re G(f_k) exp(-j phase_k) - v) +
    price (sum A_i - 1), with G(f) = sum A_i exp(f turn (t_i - t_n)); in weights q, phases, frequencies that
    move, times, amplitudes (where the rule leaves them free: bounded optima switch between 0 and 1) and the
    goal itself.

    Parameters
    ----------
    start : Optimum
        Near a solution. Where the goal is the reach, the last peak is at the upper edge.
    goal : Goal
        What is best; the worst, the duration and the edges of the band keep their values otherwise.
    rule : AmplitudeRule
        Sign rule of the amplitudes.

    Returns
    -------
    Optimum or None
        None if Newton's method does not converge.
    """
    layout = _Layout(start, goal, rule)
    point = layout.start()
    for _ in range(_STEPS):
        slope, curvature = layout.derivatives(point)
        if not np.isfinite(curvature).all():
            return None
        step = np.linalg.lstsq(curvature, -slope, rcond=1e-14)[0]
        size = float(np.abs(step[layout.geometric]).max(initial=0.0))
        point[layout.free] += step * min(1.0, layout.longest / max(size, 1e-300))
        if size < _CONVERGED and np.abs(slope).max() < 1e-8:
            return layout.optimum(point)
    return None


class _Layout:
    """Where things stand in the vector of unknowns, and which of them are free."""

    def __init__(self, start: Optimum, goal: Goal, rule: AmplitudeRule) -> None:
        self.optimum_start, self.goal = start, goal
        n, m = start.times.size, start.weights.size
        sizes = np.array([n, n - 1, m, m, m, 1, 1])
        ends = np.cumsum(sizes)
        self.parts = [slice(end - size, end) for end, size in zip(ends, sizes, strict=True)]
        free_parts = [np.full(size, True) for size in sizes]
        positive = rule is AmplitudeRule.POSITIVE
        free_parts[0][:] = free_parts[5][:] = positive
        free_parts[1][0] = goal is Goal.DURATION
        free_parts[4][:] = start.moving
        free_parts[4][-1] |= goal is Goal.REACH
        free_parts[6][:] = goal is Goal.WORST
        self.free = np.flatnonzero(np.concatenate(free_parts))
        self.geometric = (self.free < ends[1]) | ((self.free >= ends[3]) & (self.free < ends[4]))
        self.longest = _LARGEST_STEP / max(float(start.frequency.max()), start.duration)
        self.pull = np.zeros(int(ends[-1]))
        place, sign = {
            Goal.DURATION: (ends[0], -1.0),
            Goal.WORST: (ends[-1] - 1, 1.0),
            Goal.REACH: (ends[4] - 1, -1.0),
        }[goal]
        self.pull[place] = sign
        self.place = int(place)

    def start(self) -> FloatArray:
        """Unknowns at the start; weights are scaled to balance the goal, and the price to balance them."""
        start = self.optimum_start
        lags = start.times[:-1] - start.times[-1]
        point = np.concatenate(
            [start.amplitudes, lags, start.weights, start.phase, start.frequency, [0.0, start.worst]]
        )
        whole = self._gradient(point)[0] - self.pull
        point[self.parts[2]] *= abs(1.0 / whole[self.place]) if whole[self.place] else 1.0
        point[self.parts[5]] = -(self._gradient(point)[0])[self.parts[0]].mean()
        return point

    def optimum(self, point: FloatArray) -> Optimum:
        """Read the unknowns back."""
        start = self.optimum_start
        amplitudes, lags, weights, phase, frequency, _, worst = (point[part] for part in self.parts)
        times = np.append(lags, 0.0) - lags[0]
        scaled = weights / np.abs(weights).sum()
        return Optimum(times, amplitudes, frequency, start.turn, start.moving, scaled, phase, float(worst[0]))

    def derivatives(self, point: FloatArray) -> tuple[FloatArray, FloatArray]:
        """First derivatives, which must vanish, and second ones, in the free unknowns."""
        slope, terms = self._gradient(point)
        return slope[self.free], self._curvature(point, *terms)[np.ix_(self.free, self.free)]

    def _gradient(
        self, point: FloatArray
    ) -> tuple[FloatArray, tuple[ComplexArray, ComplexArray, ComplexArray]]:
        amplitudes, lags, weights, phase, frequency, price, worst = (point[part] for part in self.parts)
        lag = np.append(lags, 0.0)
        rate = (frequency * self.optimum_start.turn)[:, np.newaxis]
        unit = np.exp(rate * lag - 1j * phase[:, np.newaxis])
        bent = self.optimum_start.turn[:, np.newaxis] * lag  # d log unit / d frequency
        terms = unit * amplitudes
        value, climb = terms.sum(axis=1), (bent * terms).sum(axis=1)
        slope = self.pull.copy()
        slope += np.concatenate(
            [
                weights @ unit.real + price,
                (weights @ (rate * terms).real)[:-1],
                value.real - worst,
                weights * value.imag,
                weights * climb.real,
                [amplitudes.sum() - 1.0],
                -weights.sum(keepdims=True),
            ]
        )
        return slope, (unit, rate, bent)

    def _curvature(
        self, point: FloatArray, unit: ComplexArray, rate: ComplexArray, bent: ComplexArray
    ) -> FloatArray:
        amplitudes, _, weights, _, _, _, _ = (point[part] for part in self.parts)
        amp, lag, wgt, pha, fre, pri, wor = self.parts
        terms, turn = unit * amplitudes, self.optimum_start.turn[:, np.newaxis]
        value, climb = terms.sum(axis=1), (bent * terms).sum(axis=1)
        q = weights[:, np.newaxis]
        table = np.zeros((point.size, point.size))
        n = amplitudes.size
        diagonal = np.diag
        table[amp, lag] = diagonal(weights @ (rate * unit).real)[:, : n - 1]
        table[lag, lag] = diagonal((weights @ (rate**2 * terms).real)[:-1]) / 2.0
        table[wgt, amp] = unit.real
        table[wgt, lag] = (rate * terms).real[:, :-1]
        table[wgt, pha] = diagonal(value.imag)
        table[wgt, fre] = diagonal(climb.real)
        table[wgt, wor] = -1.0
        table[pha, amp] = q * unit.imag
        table[pha, lag] = (q * (rate * terms).imag)[:, :-1]
        table[pha, pha] = diagonal(-weights * value.real) / 2.0
        table[pha, fre] = diagonal(weights * climb.imag)
        table[fre, amp] = q * (bent * unit).real
        table[fre, lag] = (q * (turn * terms * (1.0 + rate * bent / turn)).real)[:, :-1]
        table[fre, fre] = diagonal(weights * (bent**2 * terms).sum(axis=1).real) / 2.0
        table[pri, amp] = 1.0
        return table + table.T
