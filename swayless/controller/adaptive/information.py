"""What has been learned: six sums, and the coefficients that leave least of the vibration they sum up.

Eqs 13-16 keep P, the inverse of a matrix that is all but singular once the vibration is understood. Here the
constraint is solved for the middle coefficient first: c1 = 1 - c0 - c2, so that coefficients leave
e = v1 + c0 u + c2 w of a sample, with u = v0 - v1, w = v2 - v1. What is summed up is e, and what is found is
a correction of the coefficients that made it: right to rounding of the correction, not of the vibration. The
matrix of the two unknowns is well conditioned, and the coefficients are those of eq 16 (decision 27).

Not for: when to learn.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

Coefficients: TypeAlias = tuple[Any, Any, Any]
"""Amplitudes after 0, 1 and 2 delays, in the number type; they sum to 1."""

LEAST_DETERMINANT = 2.0**-14
"""Relative: below it the samples do not tell the coefficients apart, in double or in float."""

NEWTON_STEPS = 8
"""After them the noise is right to rounding where a window teaches, and to 4 % where all is noise."""


class Information(NamedTuple):
    """Sums of products of e, u and w over samples; with coefficients 0, 1, 0, e is v1 itself."""

    ee: Any
    eu: Any
    ew: Any
    uu: Any
    uw: Any
    ww: Any

    @property
    def energy(self) -> Any:
        """Sum of v0 v0 + v1 v1 + v2 v2 of sums that are around 0, 1, 0."""
        return (((3.0 * self.ee) + (2.0 * (self.eu + self.ew))) + self.uu) + self.ww

    def with_sample(self, e: Any, u: Any, w: Any) -> Information:
        """Add the products of one sample, as `sample` gives it."""
        return Information(
            self.ee + (e * e),
            self.eu + (e * u),
            self.ew + (e * w),
            self.uu + (u * u),
            self.uw + (u * w),
            self.ww + (w * w),
        )

    def with_white(self, coefficients: Coefficients, power: Any) -> Information:
        """Add white noise of this power to each of the three samples; a negative power takes it away.

        With 1e-7 and no samples this is P(0) = 1e7 I: what coefficients of 1/3 come from.

        Examples
        --------
        >>> nothing = Information(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        >>> c0, c2 = nothing.with_white((0.0, 1.0, 0.0), 1e-7).correction()
        >>> round(c0, 12), round(c2, 12)
        (0.333333333333, 0.333333333333)
        """
        c0, c1, c2 = coefficients
        twice = power + power
        return Information(
            self.ee + (squared_size(coefficients) * power),
            self.eu + ((c0 - c1) * power),
            self.ew + ((c2 - c1) * power),
            self.uu + twice,
            self.uw + power,
            self.ww + twice,
        )

    def after(self, weight: Any, past: Information) -> Information:
        """Add what was known before, by a weight."""
        return Information(*((weight * old) + new for old, new in zip(past, self, strict=True)))

    def moved(self, d0: Any, d2: Any) -> Information:
        """Give the sums around other coefficients: d0 more of the first, d2 more of the last.

        Examples
        --------
        >>> nothing = Information(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        >>> here = nothing.with_sample(*sample((0.25, 0.5, 0.25), 3.0, 1.0, 2.0))
        >>> here.moved(0.5, -0.25) == nothing.with_sample(*sample((0.75, 0.25, 0.0), 3.0, 1.0, 2.0))
        True
        """
        eu = (self.eu + (d0 * self.uu)) + (d2 * self.uw)
        ew = (self.ew + (d0 * self.uw)) + (d2 * self.ww)
        ee = ((self.ee + (d0 * self.eu)) + (d2 * self.ew)) + ((d0 * eu) + (d2 * ew))
        return Information(ee, eu, ew, self.uu, self.uw, self.ww)

    def correction(self) -> tuple[Any, Any] | None:
        """Find what to add to the first and last coefficient to leave least; None if the samples do not tell.

        References
        ----------
        S. Rhim, W. J. Book, Adaptive command shaping using adaptive filter approach in time domain,
        eqs 12-16.
        """
        product = self.uu * self.ww
        determinant = product - (self.uw * self.uw)
        if not (self.uu > 0.0 and self.ww > 0.0 and determinant > LEAST_DETERMINANT * product):
            return None
        d0 = ((self.uw * self.ew) - (self.ww * self.eu)) / determinant
        d2 = ((self.uw * self.eu) - (self.uu * self.ew)) / determinant
        return d0, d2


class Window(NamedTuple):
    """Sums over the samples of a window: of products, and of e, u and w themselves.

    The differences u and w know of no offset of the measurement; all of it is in e, of every sample alike.
    """

    products: Information
    e: Any
    u: Any
    w: Any

    def with_sample(self, e: Any, u: Any, w: Any) -> Window:
        """Add one sample, as `sample` gives it."""
        return Window(self.products.with_sample(e, u, w), self.e + e, self.u + u, self.w + w)

    def around_means(self, samples: Any) -> Information:
        """Give the sums of products of what differs from the means: a constant offset leaves nothing.

        Parameters
        ----------
        samples : float or numpy.float32
            How many there are.

        Examples
        --------
        >>> nothing, middle = Information(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0)
        >>> plain = shifted = Window(nothing, 0.0, 0.0, 0.0)
        >>> for v0, v1, v2 in (1.0, 2.0, 0.0), (0.0, 1.0, 2.0):
        ...     plain = plain.with_sample(*sample(middle, v0, v1, v2))
        ...     shifted = shifted.with_sample(*sample(middle, 7.0 + v0, 7.0 + v1, 7.0 + v2))
        >>> shifted.around_means(2.0) == plain.around_means(2.0)
        True
        """
        ee, eu, ew, uu, uw, ww = self.products
        e, u, w = self.e / samples, self.u / samples, self.w / samples
        return Information(
            ee - (e * self.e),
            eu - (e * self.u),
            ew - (e * self.w),
            uu - (u * self.u),
            uw - (u * self.w),
            ww - (w * self.w),
        )


def sample(coefficients: Coefficients, v0: Any, v1: Any, v2: Any) -> tuple[Any, Any, Any]:
    """Give e, u and w of one sample and those of one and two delays ago."""
    c0, _, c2 = coefficients
    u, w = v0 - v1, v2 - v1
    return v1 + ((c0 * u) + (c2 * w)), u, w


def squared_size(coefficients: Coefficients) -> Any:
    """Sum of squares: what white noise of power 1 is made by these coefficients; at least 1/3."""
    c0, c1, c2 = coefficients
    return ((c0 * c0) + (c1 * c1)) + (c2 * c2)


def noise_power(around: Information, plain: Information) -> Any:
    """Sum of squares of the white noise in each of the three samples of a window.

    A vibration of one mode fills two dimensions of three: what is in the third is noise, the least eigenvalue
    of the samples' matrix. Newton's method on the characteristic polynomial comes to it from below. The
    determinant is the same around any coefficients, and the more exact the better they fit.

    Parameters
    ----------
    around, plain : Information
        The window, around the coefficients learned and around 0, 1, 0.

    Examples
    --------
    >>> nothing, middle = Information(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    >>> window = nothing.with_sample(*sample(middle, 1.0, 0.0, -1.0))
    >>> window = window.with_sample(*sample(middle, 0.0, 2.0, 0.0))
    >>> noisy = window.with_white(middle, 0.5)
    >>> noise_power(window, window), round(noise_power(noisy, noisy), 12)
    (0.0, 0.5)
    """
    trace, minors, determinant = plain.energy, _principal_minors(plain), _determinant(around)
    noise = trace - trace
    for _ in range(NEWTON_STEPS):
        value = (((noise - trace) * noise) + minors) * noise - determinant
        slope = (((3.0 * noise) - (trace + trace)) * noise) + minors
        if slope > 0.0 and value < 0.0:
            noise = noise - (value / slope)
    return noise


def _principal_minors(plain: Information) -> Any:
    """Sum of the principal minors of the sums of v v'."""
    vv, vu, vw, uu, uw, ww = plain
    first, last = (vv + (vu + vu)) + uu, (vv + (vw + vw)) + ww
    across = ((vv + vu) + vw) + uw
    middle = ((uu * vv) - (vu * vu)) + ((ww * vv) - (vw * vw))
    return middle + ((first * last) - (across * across))


def _determinant(sums: Information) -> Any:
    """Give the determinant of the sums: the same around any coefficients, which only shear v0, v1 and v2."""
    ee, eu, ew, uu, uw, ww = sums
    return ((ee * ((uu * ww) - (uw * uw))) - (eu * ((eu * ww) - (uw * ew)))) + (ew * ((eu * uw) - (uu * ew)))
