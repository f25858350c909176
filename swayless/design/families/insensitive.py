"""Extra-insensitive shapers: one, two or three humps of the residual vibration touch the tolerance.

The undamped solutions are formulas; damped ones continue them (`continuation`).
Not for: amplitudes of fixed size (`unity_magnitude`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from swayless.design.families.constraints import AtMode, Constraints
from swayless.design.families.continuation import check_hump_tolerance, solve
from swayless.design.families.family import TimesAndAmplitudes
from swayless.design.shaper import FloatArray
from swayless.plant import Mode

ONE_HUMP = Constraints(impulses=3, at_mode=AtMode.HUMP, zeros=2)
TWO_HUMP = Constraints(impulses=4, at_mode=AtMode.ZERO, zeros=2, humps=2)
THREE_HUMP = Constraints(impulses=5, at_mode=AtMode.HUMP, zeros=4, humps=2)


def one_hump(mode: Mode, *, tolerance: float) -> TimesAndAmplitudes:
    """Raise the vibration at the mode to the tolerance, so that zeros on both sides widen the band: EI.

    Undamped (1 + V)/4, (1 - V)/2, (1 + V)/4 half a period apart, with zeros at 1 -+ (2/pi) atan(sqrt(V)).

    Parameters
    ----------
    mode : Mode
        The vibration to hold.
    tolerance : float
        V, the residual vibration of the hump at the mode, as a ratio, `SMALLEST_TOLERANCE` to 1.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or the shaper does not exist at the mode's damping.

    References
    ----------
    Singhose, Seering and Singer (1994), residual vibration reduction with vector diagrams.

    Examples
    --------
    >>> times_s, amplitudes = one_hump(Mode(1.0), tolerance=0.05)
    >>> times_s, [round(amplitude, 12) for amplitude in amplitudes]
    ([0.0, 0.5, 1.0], [0.2625, 0.475, 0.2625])
    """
    check_hump_tolerance(tolerance)
    outer = 0.25 * (1.0 + tolerance)
    offset = 2.0 / math.pi * math.atan(math.sqrt(tolerance))
    start = _start([outer, 1.0 - 2.0 * outer, outer], zeros=[1.0 - offset], humps=[])
    return solve("ei", ONE_HUMP, start, mode, tolerance=tolerance)


def two_hump(mode: Mode, *, tolerance: float) -> TimesAndAmplitudes:
    """Put a zero on the mode, a hump on each side of it, and a zero beyond each hump: 2-hump EI.

    Undamped, with X = cbrt(V^2 (sqrt(1 - V^2) + 1)): A_1 = (3 X^2 + 2 X + 3 V^2) / (16 X), A_2 = 1/2 - A_1.

    Parameters
    ----------
    mode, tolerance
        As for `one_hump`; the tolerance is that of both humps.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or the shaper does not exist at the mode's damping.

    References
    ----------
    Singhose, Porter, Tuttle and Singer (1997), vibration reduction using multi-hump input shapers.

    Examples
    --------
    >>> _, amplitudes = two_hump(Mode(1.0), tolerance=0.05)
    >>> [round(amplitude, 6) for amplitude in amplitudes]
    [0.159797, 0.340203, 0.340203, 0.159797]
    """
    check_hump_tolerance(tolerance)
    x = math.cbrt(tolerance**2 * (math.sqrt(1.0 - tolerance**2) + 1.0))
    outer = (3.0 * x**2 + 2.0 * x + 3.0 * tolerance**2) / (16.0 * x)
    inner = 0.5 - outer
    # With c = cos(pi r / 2), the vibration is c (8 A_1 c^2 - 6 A_1 + 2 A_2).
    cosine = math.sqrt(0.25 * (3.0 - inner / outer))
    zero, hump = (2.0 / math.pi * math.acos(c) for c in (cosine, cosine / math.sqrt(3.0)))
    start = _start([outer, inner, inner, outer], zeros=[zero], humps=[hump])
    return solve("ei2", TWO_HUMP, start, mode, tolerance=tolerance)


def three_hump(mode: Mode, *, tolerance: float) -> TimesAndAmplitudes:
    """Put a hump on the mode and one on each side, with four zeros around them: 3-hump EI.

    Undamped, A_1 = (1 + 3 V + 2 sqrt(2 (V^2 + V))) / 16, A_2 = (1 - V) / 4, A_3 = 1 - 2 (A_1 + A_2).

    Parameters
    ----------
    mode, tolerance
        As for `one_hump`; the tolerance is that of all humps.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or the shaper does not exist at the mode's damping: at 5 % it ends
        at 0.2756, at 10 % at 0.2063.

    References
    ----------
    Singhose, Porter, Tuttle and Singer (1997), vibration reduction using multi-hump input shapers.

    Examples
    --------
    >>> _, amplitudes = three_hump(Mode(1.0), tolerance=0.05)
    >>> [round(amplitude, 6) for amplitude in amplitudes]
    [0.11238, 0.2375, 0.300241, 0.2375, 0.11238]
    """
    check_hump_tolerance(tolerance)
    outer = (1.0 + 3.0 * tolerance + 2.0 * math.sqrt(2.0 * (tolerance**2 + tolerance))) / 16.0
    inner = 0.25 * (1.0 - tolerance)
    centre = 1.0 - 2.0 * (outer + inner)
    # With u = cos(pi r), the vibration is 4 A_1 u^2 + 2 A_2 u + A_3 - 2 A_1.
    hump = -0.25 * inner / outer
    spread = math.sqrt(hump**2 - 0.25 * (centre - 2.0 * outer) / outer)
    low, high, crest = (math.acos(u) / math.pi for u in (hump + spread, hump - spread, hump))
    start = _start([outer, inner, centre, inner, outer], zeros=[low, high], humps=[crest])
    return solve("ei3", THREE_HUMP, start, mode, tolerance=tolerance)


def _start(amplitudes: Sequence[float], *, zeros: Sequence[float], humps: Sequence[float]) -> FloatArray:
    """Make the unknown vector of an undamped design; ratios below 1 stand for their mirror images too."""
    times = 0.5 * np.arange(1, len(amplitudes))
    mirrored = [np.reciprocal([*ratios, *(2.0 - r for r in ratios)]) for ratios in (zeros, humps)]
    return np.concatenate([np.log(amplitudes), times, *mirrored])
