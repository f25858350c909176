"""Where a falling function passes 0, if every evaluation is a design of its own.

Not for: smooth equations, which have derivatives (`stationary`).
"""

from __future__ import annotations

import math
from collections.abc import Callable

_TRIALS = 80
_JUMP = 1e3  # a function steeper than this jumps
_RESOLVED = 1e-12  # width of a bracket that rounding allows
_LEAST_SHARE = 1e-4  # of a bracket, that a step leaves on either side


def crossing(
    function: Callable[[float], float],
    start: float,
    limit: float,
    *,
    steepness: float,
    near: float,
    apart: float,
) -> float | None:
    """Find the smallest argument at which a falling function is not above 0.

    Parameters
    ----------
    function : callable
        May be infinite, of either sign, and may jump.
    start, limit : float
        Where to look, start < limit.
    steepness : float
        A usual -slope, > 0, for the first steps; too large a one costs a few more.
    near : float
        Value below 0 by no more than this, at which the search ends.
    apart : float
        Width of the bracket at which it ends too, where the function jumps.

    Returns
    -------
    float or None
        An argument at which the function was evaluated and not above 0; None if it is still above at the
        limit.

    References
    ----------
    Dowell and Jarratt (1971): the Illinois method, regula falsi in which an end that stays counts half.

    Examples
    --------
    >>> root = crossing(lambda x: 2.0 - x**2, 0.0, 9.0, steepness=1.0, near=1e-12, apart=1e-12)
    >>> round(root, 9)
    1.414213562
    """
    left, above, right, below = math.nan, math.nan, start, function(start)
    while below > 0.0:
        if right >= limit:
            return None
        left, above = right, below
        right = min(limit, right + 2.0 * below / steepness)
        below, steepness = function(right), steepness / 2.0
    least, value, before = right, below, math.nan
    for trial in range(_TRIALS):
        width, jump = right - left, above - below > _JUMP * (right - left)
        if math.isnan(left) or width <= (apart if jump else _RESOLVED) or -near <= value <= 0.0:
            break
        # A jump draws no secant near: then every third step halves the bracket.
        drawn = math.isfinite(above) and math.isfinite(below) and trial % 3 < 2
        share = above / (above - below) if drawn else 0.5
        middle = left + (right - left) * min(max(share, _LEAST_SHARE), 1.0 - _LEAST_SHARE)
        value = function(middle)
        if value > 0.0:
            left, above, below = middle, value, below / 2.0 if before > 0.0 else below
        else:
            least, right, below, above = middle, middle, value, above / 2.0 if before <= 0.0 else above
        before = value
    return least
