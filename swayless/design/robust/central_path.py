"""The least worst size of a few complex numbers that are affine in bounded variables, by the central path.

A cone |G| <= v is treated as it is, not as a polygon of half-planes, so the program is small and smooth:
about thirty steps of Newton's method solve it, whatever its size. Not for: exact optima, which `stationary`
finds from here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

RealOrComplexArray: TypeAlias = NDArray[np.float64] | NDArray[np.complex128]

_TIGHTENED = 20.0  # how much nearer to the optimum each centre is than the last
_CENTRED = 1.0  # Newton decrement (squared) at which a centre is near enough for the next
_AT_CENTRE = 1e-6  # the same for the last one, whose weights are to be dual values
_TO_BOUNDARY = 0.95  # share of the way to the nearest limit that one step may go
_STEPS = 400  # thirty to fifty are usual


@dataclass(frozen=True, eq=False)
class Centre:
    """A point near the optimum.

    Parameters
    ----------
    variables : ndarray, shape (n,)
        Each between 0 and 1.
    worst : float
        A bound of all sizes, within the gap asked for of the least possible.
    weights : ndarray, shape (k,)
        Dual values of the sizes, >= 0, in sum nearly 1: those that hold the optimum up are large.
    """

    variables: FloatArray
    worst: float
    weights: FloatArray


def least_worst(
    rows: RealOrComplexArray,
    offset: RealOrComplexArray,
    *,
    sum_to_one: bool,
    resolved: float = 1e-3,
    gap: float = 1e-4,
) -> Centre:
    """Minimise the largest |offset + rows @ x| over 0 <= x <= 1, with sum 1 if asked for.

    Parameters
    ----------
    rows : ndarray, shape (k, n)
        Real or complex.
    offset : ndarray, shape (k,)
        Of the same kind.
    sum_to_one : bool
        Whether the variables must sum to 1.
    resolved : float
        Size below which the optimum need not be told from 0.
    gap : float
        Relative distance to the optimum that may be left.

    Raises
    ------
    DesignError
        If the central path is lost, which rounding alone can do.

    References
    ----------
    Boyd and Vandenberghe (2004), Convex Optimization, section 11.3: the barrier method.

    Examples
    --------
    >>> centre = least_worst(np.eye(2), np.zeros(2), sum_to_one=True)
    >>> centre.variables.round(3)
    array([0.5, 0.5])
    """
    path = _Path(rows, offset, sum_to_one)
    n = rows.shape[1]
    variables = np.full(n, 1.0 / n if sum_to_one else 0.5)
    worst = 1.5 * float(np.abs(offset + rows @ variables).max()) + 1e-3
    point, limits = np.append(variables, worst), 2 * (n + offset.size)
    tightness = 2.0 * limits / worst
    for _ in range(_STEPS):
        point, decrement = path.step(point, tightness)
        enough = limits / (gap * max(float(point[-1]), resolved))
        last = tightness >= enough
        if decrement > (_AT_CENTRE if last else _CENTRED):
            continue
        if last:
            size = np.abs(offset + rows @ point[:-1])
            weights = 2.0 * size / ((point[-1] ** 2 - size**2) * tightness)
            return Centre(point[:-1], float(point[-1]), weights)
        tightness = min(_TIGHTENED * tightness, 1.1 * enough)
    raise DesignError(f"central path of {n} variables and {offset.size} sizes: not done in {_STEPS} steps")


@dataclass(frozen=True, eq=False)
class _Path:
    """The function that is least on the central path: tightness v - log of every distance to a limit."""

    rows: RealOrComplexArray
    offset: RealOrComplexArray
    sum_to_one: bool

    def value(self, point: FloatArray, tightness: float) -> float:
        """Evaluate it; infinite outside the limits."""
        variables, worst = point[:-1], float(point[-1])
        room = worst**2 - np.abs(self.offset + self.rows @ variables) ** 2
        distances = np.concatenate([room, variables, 1.0 - variables])
        if worst <= 0.0 or distances.min() <= 0.0:
            return np.inf
        return tightness * worst - float(np.log(distances).sum())

    def step(self, point: FloatArray, tightness: float) -> tuple[FloatArray, float]:
        """One damped step of Newton's method: the new point, and the squared decrement at the old one."""
        slope, curvature = self._derivatives(point, tightness)
        # Distances to limits differ by ten orders of magnitude: scaled by them, equations are solved well.
        scale = 1.0 / np.sqrt(np.append(curvature.diagonal()[: point.size], np.ones(slope.size - point.size)))
        try:
            scaled = np.linalg.solve(curvature * np.multiply.outer(scale, scale), -slope * scale)
        except np.linalg.LinAlgError:
            return point, 0.0  # as centred as double precision allows
        direction = (scaled * scale)[: point.size]
        decrement = -float(slope[: point.size] @ direction)
        variables, change = point[:-1], direction[:-1]
        distance = np.where(change < 0.0, variables, 1.0 - variables)
        share = min(1.0, _TO_BOUNDARY / float((np.abs(change) / distance).max(initial=1e-300)))
        start = self.value(point, tightness)
        noise = 1e-12 * abs(start)
        while self.value(point + share * direction, tightness) > start - 0.01 * share * decrement + noise:
            share *= 0.5
            if share < 1e-12:
                return point, 0.0  # no further progress in double precision: as centred as can be
        return point + share * direction, decrement

    def _derivatives(self, point: FloatArray, tightness: float) -> tuple[FloatArray, FloatArray]:
        """First and second derivatives, with the equality as a last row where there is one."""
        variables, worst = point[:-1], point[-1]
        value = self.offset + self.rows @ variables
        room = worst**2 - np.abs(value) ** 2
        towards = (value.conj()[:, np.newaxis] * self.rows).real
        parts = [self.rows.real, self.rows.imag] if np.iscomplexobj(self.rows) else [self.rows]
        root = np.sqrt(2.0 / room)[:, np.newaxis]
        factor = np.concatenate([*(part * root for part in parts), towards * (2.0 / room)[:, np.newaxis]])
        n = variables.size
        size = n + 1 + self.sum_to_one
        curvature, slope = np.zeros((size, size)), np.zeros(size)
        curvature[:n, :n] = factor.T @ factor
        curvature[range(n), range(n)] += variables**-2 + (1.0 - variables) ** -2
        curvature[:n, n] = curvature[n, :n] = -4.0 * worst * (room**-2 @ towards)
        curvature[n, n] = (4.0 * worst**2 / room**2 - 2.0 / room).sum()
        slope[:n] = 2.0 * (1.0 / room @ towards) - 1.0 / variables + 1.0 / (1.0 - variables)
        slope[n] = tightness - 2.0 * worst * (1.0 / room).sum()
        if self.sum_to_one:
            curvature[n + 1, :n] = curvature[:n, n + 1] = 1.0
            slope[n + 1] = variables.sum() - 1.0
        return slope, curvature
