"""Unity-magnitude shapers: impulses +1, -1, ..., +1, which an on-off drive can follow.

Not for: amplitudes that may take any size (`insensitive`, `closed_form`).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from swayless.design.families.constraints import AtMode, Constraints
from swayless.design.families.continuation import check_hump_tolerance, solve
from swayless.design.families.family import TimesAndAmplitudes
from swayless.design.shaper import FloatArray
from swayless.plant import Mode

_THREE = (1.0, -1.0, 1.0)
_FIVE = (1.0, -1.0, 1.0, -1.0, 1.0)
_NEAR_OUTER_ANGLE = 2.35  # the root lies between 2.30 (tolerance 0) and 2.57 (tolerance 1)
_NEWTON_STEPS = 20
_SMALL_VALUE = 1e-9  # the step after it leaves rounding
ZERO = Constraints(impulses=3, at_mode=AtMode.ZERO, fixed_amplitudes=_THREE)
DOUBLE_ZERO = Constraints(impulses=5, at_mode=AtMode.DOUBLE_ZERO, fixed_amplitudes=_FIVE)
HUMP = Constraints(impulses=5, at_mode=AtMode.HUMP, zeros=2, fixed_amplitudes=_FIVE)


def zero_vibration(mode: Mode) -> TimesAndAmplitudes:
    """Cancel a mode with impulses +1, -1, +1: UM-ZV, undamped at 0, T/6 and T/3.

    Raises
    ------
    DesignError
        If the shaper does not exist at the mode's damping.

    References
    ----------
    Kriikku, Singer and Singhose (1997), table 1; Singhose, Singer and Seering (1997).

    Examples
    --------
    >>> times_s, amplitudes = zero_vibration(Mode(1.0))
    >>> [round(time_s, 12) for time_s in times_s], amplitudes
    ([0.0, 0.166666666667, 0.333333333333], [1.0, -1.0, 1.0])
    """
    start = np.array([1.0, 2.0]) / 6.0
    return solve("um-zv", ZERO, start, mode)


def zero_slope(mode: Mode) -> TimesAndAmplitudes:
    """Make vibration and its slope over frequency vanish with impulses +1, -1, +1, -1, +1: UM-ZVD.

    Raises
    ------
    DesignError
        If the shaper does not exist at the mode's damping.

    References
    ----------
    Singhose, Singer and Seering (1997), time-optimal negative input shapers.

    Examples
    --------
    >>> times_s, _ = zero_slope(Mode(1.0))
    >>> [round(time_s, 4) for time_s in times_s]
    [0.0, 0.0895, 0.3662, 0.643, 0.7325]
    """
    start = _five_times(*_five_angles(0.0))
    return solve("um-zvd", DOUBLE_ZERO, start, mode)


def one_hump(mode: Mode, *, tolerance: float) -> TimesAndAmplitudes:
    """Raise the vibration at the mode to the tolerance with impulses +1, -1, +1, -1, +1: UM-EI.

    Parameters
    ----------
    mode : Mode
        The vibration to hold.
    tolerance : float
        Residual vibration of the hump at the mode, as a ratio, `SMALLEST_TOLERANCE` to 1.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or the shaper does not exist at the mode's damping.

    References
    ----------
    Singhose, Singer and Seering (1997), time-optimal negative input shapers.

    Examples
    --------
    >>> times_s, _ = one_hump(Mode(1.0), tolerance=0.05)
    >>> [round(time_s, 4) for time_s in times_s]
    [0.0, 0.0941, 0.3684, 0.6427, 0.7367]
    """
    check_hump_tolerance(tolerance)
    inner, outer = _five_angles(tolerance)

    def vibration(ratio: float) -> tuple[float, float]:
        value = 1.0 - 2.0 * math.cos(inner * ratio) + 2.0 * math.cos(outer * ratio)
        return value, 2.0 * inner * math.sin(inner * ratio) - 2.0 * outer * math.sin(outer * ratio)

    # The zeros, searched from where the parabola at the mode has them.
    reach = math.sqrt(tolerance / (inner**2 * math.cos(inner) - outer**2 * math.cos(outer)))
    zeros = [_root(vibration, 1.0 - reach), _root(vibration, 1.0 + reach)]
    start = np.concatenate([_five_times(inner, outer), np.reciprocal(zeros)])
    return solve("um-ei", HUMP, start, mode, tolerance=tolerance)


def _five_angles(tolerance: float) -> tuple[float, float]:
    """Find the undamped phases a < b from the middle impulse: 1 - 2 cos a + 2 cos b = -V, and flat."""

    def slope(outer: float) -> tuple[float, float]:
        inner = math.acos(0.5 * (1.0 + tolerance) + math.cos(outer))
        inner_slope = math.sin(outer) / math.sin(inner)
        value = inner * math.sin(inner) - outer * math.sin(outer)
        bend = (math.sin(inner) + inner * math.cos(inner)) * inner_slope
        return value, bend - math.sin(outer) - outer * math.cos(outer)

    outer = _root(slope, _NEAR_OUTER_ANGLE)
    return math.acos(0.5 * (1.0 + tolerance) + math.cos(outer)), outer


def _five_times(inner: float, outer: float) -> FloatArray:
    """Give the times in periods after the first impulse, from the phases of `_five_angles`."""
    return np.array([outer - inner, outer, outer + inner, 2.0 * outer]) / (2.0 * math.pi)


def _root(function: Callable[[float], tuple[float, float]], start: float) -> float:
    """Find where the first of a pair (value, slope) is 0, by Newton's method from near by."""
    place = start
    for _ in range(_NEWTON_STEPS):
        value, slope = function(place)
        place -= value / slope
        if abs(value) < _SMALL_VALUE:
            break
    return place
