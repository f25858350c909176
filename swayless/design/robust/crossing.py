"""Where a falling function passes 0, if every evaluation is a design of its own.

Not for: smooth equations, which have derivatives (`stationary`).
"""

from __future__ import annotations

import math
from collections.abc import Callable

_TRIALS = 80
_JUMP = 1e3  # a function steeper than this jumps
_RESOLVED = 1e-12  # width of a bracket that rounding allows
_FIRST_STEPS = 1.2  # times what the usual steepness says: beyond the crossing is as good as before it
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

    def aimed(argument: float) -> float:
        return function(argument) + near / 2.0  # the middle of the values that end the search

    left, above, right, below = math.nan, math.nan, start, aimed(start)
    while below > near / 2.0:
        if right >= limit:
            return None
        left, above = right, below
        right = min(limit, right + _FIRST_STEPS * below / steepness)
        below, steepness = aimed(right), steepness / 2.0
    if math.isnan(left):
        return right
    return _narrowed(aimed, (left, above), (right, below), near / 2.0, apart)


def _narrowed(
    aimed: Callable[[float], float],
    over: tuple[float, float],
    under: tuple[float, float],
    near: float,
    apart: float,
) -> float:
    """Narrow a bracket, given as arguments and values, until a value is this near to 0."""
    (left, above), (right, below) = over, under
    least, value, before, width_before = right, below, math.nan, math.inf
    for trial in range(_TRIALS):
        width, jump = right - left, above - below > _JUMP * (right - left)
        if width <= (apart if jump else _RESOLVED) or abs(value) <= near:
            break
        # Across a jump no secant comes near: where three steps did not halve the bracket, the next one does.
        drawn = math.isfinite(above) and math.isfinite(below)
        if trial % 3 == 2:
            drawn, width_before = drawn and width < 0.5 * width_before, width
        share = above / (above - below) if drawn else 0.5
        middle = left + width * min(max(share, _LEAST_SHARE), 1.0 - _LEAST_SHARE)
        value = aimed(middle)
        if value > near:
            left, above, below = middle, value, below / 2.0 if before > near else below
        else:
            least, right, below, above = middle, middle, value, above / 2.0 if before <= near else above
        before = value
    return least
