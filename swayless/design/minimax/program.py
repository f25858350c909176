"""One linear program: amplitudes at fixed times under cuts, solved by HiGHS with its dual values.

Not for: choosing cuts and times, which is `minimax`.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

_SHORTFALL_COST = 1e4
"""Price of missing an equality, in objective units: far above any dual value of a design that exists."""

_HIGHS_TOLERANCE = 1e-9  # ten times the finest that HiGHS accepts, on which it gives up on very fine ticks


class AmplitudeRule(enum.Enum):
    """Which amplitudes a design may use."""

    POSITIVE = "positive"
    """None below 0: whatever the command does, the reference stays inside its recent range."""

    BOUNDED = "bounded"
    """Every partial sum in [0, 1]: after one step of the command the reference stays between its ends."""


@dataclass(frozen=True, eq=False)
class Vertex:
    """Optimum of one linear program.

    Parameters
    ----------
    amplitudes : ndarray, shape (n,)
        Optimal amplitudes.
    level : float
        Largest cut value.
    shortfall : float
        By how much the equalities are missed in sum; 0 when they can be met.
    cut_weights : ndarray, shape (m,)
        Dual values of the cuts, >= 0, summing to 1.
    equality_prices : ndarray, shape (p,)
        Dual values of the equalities.
    level_prices : ndarray, shape (n,)
        Dual values of the limits on the partial sum up to each amplitude; 0 under the positive rule.
    """

    amplitudes: FloatArray
    level: float
    shortfall: float
    cut_weights: FloatArray
    equality_prices: FloatArray
    level_prices: FloatArray


def solve_program(cuts: FloatArray, equalities: FloatArray, rule: AmplitudeRule, least_last: float) -> Vertex:
    """Minimise the largest of `cuts @ amplitudes`, with sum 1 and `equalities @ amplitudes` = 0.

    The equalities are elastic: an amount missed costs far more than any vibration. So the program always has
    an optimum, and its dual values say which further times would help even while the equalities cannot be
    met.

    Parameters
    ----------
    cuts : ndarray, shape (m, n)
        One half-plane each, scaled so that values of interest are near 1.
    equalities : ndarray, shape (p, n)
        Rows of order 1.
    rule : AmplitudeRule
        Sign rule of the amplitudes.
    least_last : float
        Smallest last amplitude, >= 0.

    Raises
    ------
    DesignError
        If HiGHS does not find the optimum.
    """
    from scipy.optimize import linprog  # here, because it is heavy and only a design needs it

    (m, n), p = cuts.shape, equalities.shape[0]
    elastic = np.vstack([np.zeros((1, 2 * p)), np.hstack([np.eye(p), -np.eye(p)])])
    sums = np.vstack([np.ones((1, n)), equalities])
    levels = np.tri(n)[: n - 1] if rule is AmplitudeRule.BOUNDED else np.empty((0, n))
    limits = np.vstack([cuts, levels, -levels])
    lowest = np.full(n, 0.0 if rule is AmplitudeRule.POSITIVE else -np.inf)
    lowest[-1] = least_last
    slopes = np.append(np.full(m, -1.0), np.zeros(2 * len(levels)))[:, np.newaxis]
    result = linprog(
        np.concatenate([np.zeros(n), np.full(2 * p, _SHORTFALL_COST), [1.0]]),
        A_ub=np.hstack([limits, np.zeros((len(limits), 2 * p)), slopes]),
        b_ub=np.concatenate([np.zeros(m), np.ones(len(levels)), np.zeros(len(levels))]),
        A_eq=np.hstack([sums, elastic, np.zeros((p + 1, 1))]),
        b_eq=np.append(1.0, np.zeros(p)),
        bounds=[(bound, np.inf) for bound in (*lowest, *np.zeros(2 * p + 1))],
        method="highs-ds",
        options={
            "primal_feasibility_tolerance": _HIGHS_TOLERANCE,
            "dual_feasibility_tolerance": _HIGHS_TOLERANCE,
        },
    )
    if result.status != 0 or result.x is None:
        raise DesignError(f"linear program of {n} amplitudes and {m} cuts: {result.message}")
    upper, lower = np.split(result.ineqlin.marginals[m:], 2)
    return Vertex(
        amplitudes=result.x[:n],
        level=float(result.x[-1]),
        shortfall=float(result.x[n : n + 2 * p].sum()),
        cut_weights=-result.ineqlin.marginals[:m],
        equality_prices=result.eqlin.marginals,
        level_prices=np.append(upper - lower, np.zeros(n - len(levels))),
    )
