"""What has been learned: six sums, and the coefficients that leave least of the vibration they sum up.

Eqs 13-16 keep P, the inverse of a matrix that is all but singular once the vibration is understood. Here the
constraint is solved for the middle coefficient first: c1 = 1 - c0 - c2, so that what is left of a sample is
v1 + c0 u + c2 w with u = v0 - v1, w = v2 - v1. The matrix of these two unknowns is well conditioned, and the
coefficients are those of eq 16 (decision 27). Not for: when to learn.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

Coefficients: TypeAlias = tuple[Any, Any, Any]
"""Amplitudes after 0, 1 and 2 delays, in the number type; they sum to 1."""

LEAST_DETERMINANT = 2.0**-14
"""Relative: below it the samples do not tell the coefficients apart, in double or in float."""

NEWTON_STEPS = 8
"""After them the noise is right to rounding where a window teaches, and to 4 % where all is noise."""

ANCHOR = 24.0
"""Added and taken away again, it leaves whole multiples of 2**-48 in double, of 2**-19 in float."""


class Information(NamedTuple):
    """Sums over samples: of u u, u w, w w, v1 u, v1 w and v1 v1."""

    uu: Any
    uw: Any
    ww: Any
    vu: Any
    vw: Any
    vv: Any

    @property
    def energy(self) -> Any:
        """Sum of v0 v0 + v1 v1 + v2 v2."""
        return (((3.0 * self.vv) + (2.0 * (self.vu + self.vw))) + self.uu) + self.ww

    def with_sample(self, v0: Any, v1: Any, v2: Any) -> Information:
        """Add one sample and those of one and two delays ago."""
        u, w = v0 - v1, v2 - v1
        return Information(
            self.uu + (u * u),
            self.uw + (u * w),
            self.ww + (w * w),
            self.vu + (v1 * u),
            self.vw + (v1 * w),
            self.vv + (v1 * v1),
        )

    def with_white(self, power: Any) -> Information:
        """Add white noise of this power to each of the three samples; a negative power takes it away.

        With 1e-7 and no samples this is P(0) = 1e7 I: what coefficients of 1/3 come from.

        Examples
        --------
        >>> nothing = Information(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        >>> [round(c, 12) for c in nothing.with_white(1e-7).fit()]
        [0.333333333333, 0.333333333333, 0.333333333333]
        """
        twice = power + power
        return Information(
            self.uu + twice,
            self.uw + power,
            self.ww + twice,
            self.vu - power,
            self.vw - power,
            self.vv + power,
        )

    def after(self, weight: Any, past: Information) -> Information:
        """Add what was known before, by a weight."""
        return Information(*((weight * old) + new for old, new in zip(past, self, strict=True)))

    def left_by(self, coefficients: Coefficients) -> Any:
        """Sum of squares that coefficients leave, eq 12; at least 0."""
        c0, _, c2 = coefficients
        squares = ((c0 * c0) * self.uu) + ((c2 * c2) * self.ww)
        mixed = (((c0 * c2) * self.uw) + (c0 * self.vu)) + (c2 * self.vw)
        left = (squares + (2.0 * mixed)) + self.vv
        return left if left > 0.0 else 0.0 * self.vv

    def fit(self) -> Coefficients | None:
        """Find the coefficients of unit sum that leave least, eq 16; None if the samples do not tell.

        References
        ----------
        S. Rhim, W. J. Book, Adaptive command shaping using adaptive filter approach in time domain,
        eqs 12-16.
        """
        product = self.uu * self.ww
        determinant = product - (self.uw * self.uw)
        if not (self.uu > 0.0 and self.ww > 0.0 and determinant > LEAST_DETERMINANT * product):
            return None
        c0 = ((self.uw * self.vw) - (self.ww * self.vu)) / determinant
        c2 = ((self.uw * self.vu) - (self.uu * self.vw)) / determinant
        return c0, 1.0 - (c0 + c2), c2


def squared_size(coefficients: Coefficients) -> Any:
    """Sum of squares: what white noise of power 1 is made by these coefficients; at least 1/3."""
    c0, c1, c2 = coefficients
    return ((c0 * c0) + (c1 * c1)) + (c2 * c2)


def absolute_sum(coefficients: Coefficients) -> Any:
    """Sum of absolute amplitudes: the peak factor."""
    c0, c1, c2 = coefficients
    return (abs(c0) + abs(c1)) + abs(c2)


def on_lattice(coefficients: Coefficients) -> Coefficients:
    """Round amplitudes to a lattice on which every sum is exact; the last takes the rest to exactly 1.

    Parameters
    ----------
    coefficients : tuple of three float
        Absolute sum at most 8 or thereabouts.

    Examples
    --------
    >>> c0, c1, c2 = on_lattice((0.1, 0.7, 0.2))
    >>> c0 + c1 + c2 == c2 + c1 + c0 == 1.0
    True
    """
    c0, c1, _ = coefficients
    c0, c1 = (c0 + ANCHOR) - ANCHOR, (c1 + ANCHOR) - ANCHOR
    return c0, c1, 1.0 - (c0 + c1)


def noise_power(window: Information) -> Any:
    """Sum of squares of the white noise in each of the three samples of a window.

    A vibration of one mode fills two dimensions of three: what is in the third is noise, the least eigenvalue
    of the samples' matrix. Newton's method on the characteristic polynomial comes to it from below.

    Examples
    --------
    >>> nothing = Information(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    >>> window = nothing.with_sample(1.0, 0.0, -1.0).with_sample(0.0, 2.0, 0.0)
    >>> noise_power(window), round(noise_power(window.with_white(0.5)), 12)
    (0.0, 0.5)
    """
    trace, minors, determinant = _invariants(window)
    noise = trace - trace
    for _ in range(NEWTON_STEPS):
        value = (((noise - trace) * noise) + minors) * noise - determinant
        slope = (((3.0 * noise) - (trace + trace)) * noise) + minors
        if slope > 0.0 and value < 0.0:
            noise = noise - (value / slope)
    return noise


def _invariants(window: Information) -> tuple[Any, Any, Any]:
    """Trace, sum of the principal minors and determinant of the sums of v v'."""
    uu, uw, ww, vu, vw, vv = window
    trace = window.energy
    first, last = (vv + (vu + vu)) + uu, (vv + (vw + vw)) + ww
    across = ((vv + vu) + vw) + uw
    middle = ((uu * vv) - (vu * vu)) + ((ww * vv) - (vw * vw))
    minors = middle + ((first * last) - (across * across))
    determinant = ((vv * ((uu * ww) - (uw * uw))) - (vu * ((vu * ww) - (uw * vw)))) + (
        vw * ((vu * uw) - (uu * vw))
    )
    return trace, minors, determinant
