"""Follows the solution of constraint equations from no damping to the damping asked for.

Not for: the equations (`constraints`), nor for undamped designs: their formulas are the start.
"""

from __future__ import annotations

import math

import numpy as np

from swayless.design.families.constraints import Constraints
from swayless.design.families.family import TimesAndAmplitudes
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import Mode

SMALLEST_TOLERANCE = 1e-6
"""Below it the zeros beside a hump lie within 1e-3 of each other: the equations lose half their digits."""

_FIRST_STEP = 0.25  # of the decay: damping 0.2 in one step where the branch is straight enough
_SMALLEST_STEP = 1e-9  # the branch has ended when no longer step succeeds
_NUDGE = 1e-5  # of the decay, back along the branch, over which its bend is measured
_OFF_PREDICTION = 0.2  # of the predicted change: corrections beyond might cross a fold to another root
_OFF_ROUNDING = 1e-6  # allowed besides: what the last point was still off by
_CONTRACTION = 0.5  # each correction must be smaller than the last by this
_NEAR = 1e-5  # correction after which a point is good enough to go on from: the next would be its square
_CONVERGED = 1e-9  # likewise for the last point, whose error is then that of rounding
_CORRECTIONS = 8


def check_hump_tolerance(tolerance: float) -> None:
    """Refuse a tolerance at which no hump can stand, or none that double precision can resolve.

    Raises
    ------
    DesignError
        If the tolerance is not at least `SMALLEST_TOLERANCE` and below 1.
    """
    if not SMALLEST_TOLERANCE <= tolerance < 1.0:
        raise DesignError(f"tolerance = {tolerance!r}: must be at least {SMALLEST_TOLERANCE:g} and below 1")


def solve(
    family: str, constraints: Constraints, start: FloatArray, mode: Mode, *, tolerance: float = 0.0
) -> TimesAndAmplitudes:
    """Solve constraint equations for a damped mode, from their undamped solution.

    Parameters
    ----------
    family : str
        Name, for the message.
    constraints : Constraints
        The equations.
    start : ndarray, shape (m,)
        Unknown vector that solves them without damping.
    mode : Mode
        The mode; its damping ratio is where the solution is continued to.
    tolerance : float
        V of the humps, if there are any.

    Returns
    -------
    times_s, amplitudes : sequence of float

    Raises
    ------
    DesignError
        If the branch of solutions ends before the mode's damping: the message names the end.
    """
    decay = mode.damping_ratio / math.sqrt(1.0 - mode.damping_ratio**2)
    with np.errstate(
        all="ignore"
    ):  # near the end of a branch trial steps may overflow: they fail, and shrink
        unknowns, reached = _follow(constraints, start, decay, tolerance)
    if reached < decay:
        limit = math.floor(1e4 * reached / math.hypot(1.0, reached)) / 1e4
        which = f"{family} at tolerance {tolerance:g}" if tolerance else family
        raise DesignError(f"{which} exists up to damping_ratio {limit:.4f}, got {mode.damping_ratio:.6g}")
    times_s = constraints.times(unknowns) * mode.damped_period_s
    return times_s.tolist(), constraints.amplitudes(unknowns).tolist()


def _follow(
    constraints: Constraints, start: FloatArray, decay: float, tolerance: float
) -> tuple[FloatArray, float]:
    """Continue in the decay, predicting and correcting: the solution, and the decay reached."""
    unknowns, reached, step, growth = start, 0.0, _FIRST_STEP, 1.0
    course: tuple[FloatArray, FloatArray, FloatArray] | None = None
    while reached < decay and step > _SMALLEST_STEP:
        course = course or _course(constraints, unknowns, reached, tolerance)
        refined, tangent, bend = course
        ahead = min(reached + step, decay)
        change = (ahead - reached) * (tangent + 0.5 * (ahead - reached) * bend)
        allowed = _OFF_PREDICTION * float(np.abs(change).max()) + _OFF_ROUNDING
        needed = _CONVERGED if ahead == decay else _NEAR
        corrected = _correct(constraints, refined + change, ahead, tolerance, allowed=allowed, needed=needed)
        if corrected is None:
            step, growth = 0.5 * (ahead - reached), 1.0
        else:
            unknowns, reached, course = corrected, ahead, None
            step, growth = growth * step, 2.0
    return unknowns, reached


def _course(
    constraints: Constraints, unknowns: FloatArray, decay: float, tolerance: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Correct a point on the branch once more; find the branch's first and second derivative there."""
    residuals, jacobian, decay_slope = constraints.linearise(unknowns, decay, tolerance)
    correction, tangent = _newton(jacobian, np.array((residuals, decay_slope)).T).T
    refined = unknowns + correction
    _, jacobian, decay_slope = constraints.linearise(refined - _NUDGE * tangent, decay - _NUDGE, tolerance)
    earlier_tangent = _newton(jacobian, decay_slope)
    return refined, tangent, (tangent - earlier_tangent) / _NUDGE


def _correct(
    constraints: Constraints,
    predicted: FloatArray,
    decay: float,
    tolerance: float,
    *,
    allowed: float,
    needed: float,
) -> FloatArray | None:
    """Correct a prediction by Newton's method; None if it does not home in on a root near by."""
    unknowns = predicted
    for _ in range(_CORRECTIONS):
        if not constraints.holds_order(unknowns):
            return None
        residuals, jacobian, _ = constraints.linearise(unknowns, decay, tolerance)
        correction = _newton(jacobian, residuals)
        size = float(np.abs(correction).max())
        if not size <= allowed:  # larger, or not a number
            return None
        unknowns = unknowns + correction
        if size < needed:
            return unknowns
        allowed = _CONTRACTION * size
    return None


def _newton(jacobian: FloatArray, residuals: FloatArray) -> FloatArray:
    """Solve for what brings the residuals to 0; not a number where the equations are singular."""
    try:
        return np.linalg.solve(jacobian, -residuals).astype(np.float64, copy=False)
    except np.linalg.LinAlgError:
        return np.full_like(residuals, np.nan)
