"""Families whose impulses are exact formulas at any damping.

Not for: families that need their equations solved (`insensitive`, `unity_magnitude`).
"""

from __future__ import annotations

import math

from swayless.design.families.family import TimesAndAmplitudes
from swayless.errors import DesignError
from swayless.plant import Mode

LARGEST_ORDER = 18
"""Undamped, the outer impulses of order m are 2^-(m+1): beyond this they no longer count (below 1e-6)."""

SMALLEST_DELAY_DIVISOR = 1e-3
"""Smallest sum of coefficients by which a delay filter is normalised: its peak factor stays below 4000."""


def decay_per_period(mode: Mode) -> float:
    """Natural logarithm of the decay of the free vibration over a damped period, >= 0.

    Examples
    --------
    >>> decay_per_period(Mode(1.0, 0.0))
    0.0
    """
    return 2.0 * math.pi * mode.damping_ratio / math.sqrt(1.0 - mode.damping_ratio**2)


def derivative_shaper(mode: Mode, *, order: int) -> TimesAndAmplitudes:
    """Make vibration and its first `order` derivatives vanish: the convolution of order + 1 ZV shapers.

    A_k = C(order + 1, k) K^k / (1 + K)^(order + 1) at k damped half periods, K = exp(-pi z / sqrt(1 - z^2)).

    Parameters
    ----------
    mode : Mode
        The vibration to cancel.
    order : int
        0 (ZV) to `LARGEST_ORDER`.

    Raises
    ------
    DesignError
        If the order is out of range.

    References
    ----------
    Magee and Book, eqs 13-16.

    Examples
    --------
    >>> derivative_shaper(Mode(1.0), order=1)
    ([0.0, 0.5, 1.0], [0.25, 0.5, 0.25])
    """
    if isinstance(order, bool) or not isinstance(order, int) or not 0 <= order <= LARGEST_ORDER:
        raise DesignError(f"order = {order!r}: must be a whole number from 0 to {LARGEST_ORDER}")
    count = order + 1
    half_decay = math.exp(-0.5 * decay_per_period(mode))
    half_period_s = 0.5 * mode.damped_period_s
    scale = (1.0 + half_decay) ** -count
    amplitudes = [math.comb(count, k) * half_decay**k * scale for k in range(count + 1)]
    return [k * half_period_s for k in range(count + 1)], amplitudes


def modified_zero_vibration(mode: Mode) -> TimesAndAmplitudes:
    """Cancel a mode with three impulses 3/8 of a damped period apart, as printer firmwares do.

    Phases 0, 135 and 270 degrees cancel with 1 : sqrt(2) : 1; damping scales the impulses by the decay
    between them, which keeps the cancellation exact.

    Examples
    --------
    >>> times_s, amplitudes = modified_zero_vibration(Mode(1.0))
    >>> times_s, [round(amplitude, 6) for amplitude in amplitudes]
    ([0.0, 0.375, 0.75], [0.292893, 0.414214, 0.292893])
    """
    spacing_decay = math.exp(-0.375 * decay_per_period(mode))
    weights = [1.0, math.sqrt(2.0) * spacing_decay, spacing_decay**2]
    total = sum(weights)
    spacing_s = 0.375 * mode.damped_period_s
    return [0.0, spacing_s, 2.0 * spacing_s], [weight / total for weight in weights]


def delay_filter(mode: Mode, *, delay_s: float) -> TimesAndAmplitudes:
    """Cancel a mode with three impulses an arbitrary delay T apart: the optimal arbitrary time-delay filter.

    1, -2 cos(w_d T) exp(-z w T), exp(-2 z w T), divided by their sum. Amplitudes may be negative.

    Parameters
    ----------
    mode : Mode
        The vibration to cancel.
    delay_s : float
        Spacing of the impulses, > 0 and finite.

    Raises
    ------
    DesignError
        If the delay is out of range, or so near a whole number of damped periods (or 0) that the coefficients
        almost cancel: their sum must be at least `SMALLEST_DELAY_DIVISOR`.

    References
    ----------
    Rhim and Book, eq 4.

    Examples
    --------
    >>> delay_filter(Mode(1.0), delay_s=0.5)  # half a period: ZVD
    ([0.0, 0.5, 1.0], [0.25, 0.5, 0.25])
    """
    if not (math.isfinite(delay_s) and delay_s > 0.0):
        raise DesignError(f"delay_s = {delay_s!r}: must be finite and > 0")
    periods = delay_s / mode.damped_period_s
    decay = math.exp(-decay_per_period(mode) * periods)
    middle = -2.0 * math.cos(2.0 * math.pi * periods) * decay
    divisor = 1.0 + middle + decay**2
    if divisor < SMALLEST_DELAY_DIVISOR:
        raise DesignError(
            f"delay_s = {delay_s!r}: {periods:.6g} damped periods are too near a whole number of them; the "
            f"coefficients sum to {divisor:.3g}, must be at least {SMALLEST_DELAY_DIVISOR:g}"
        )
    first, last = 1.0 / divisor, decay**2 / divisor
    return [0.0, delay_s, 2.0 * delay_s], [first, 1.0 - first - last, last]
