"""The motion that a load shall make: a polynomial from rest to rest. Not for: what makes it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

LARGEST_ORDER = 15
"""Highest order of the polynomial: enough for relative degree 7."""


@dataclass(frozen=True)
class PolynomialMotion:
    """From one position to another; as many derivatives as the order allows are 0 at both ends.

    Parameters
    ----------
    duration_s : float
        > 0.
    target, start : float
        Positions after and before, different ones.
    order : int
        Of the polynomial, odd, 3 to 15: of order 2 q + 1, derivatives 1 to q are 0 at both ends.

    Raises
    ------
    DesignError
        If a value is out of range.

    References
    ----------
    Visioli and Piazzi (2008), eq 20; Piazzi and Visioli (2001), "Optimal noncausal set-point regulation of
    scalar systems", for any order.

    Examples
    --------
    >>> motion = PolynomialMotion(2.0, 1.0)
    >>> motion.at([0.0, 0.5, 1.0, 2.0]).tolist()
    [0.0, 0.070556640625, 0.5, 1.0]
    >>> [str(each) for each in motion.coefficients]
    ['0', '0', '0', '0', '35', '-84', '70', '-20']
    """

    duration_s: float
    target: float
    start: float = 0.0
    order: int = 7

    def __post_init__(self) -> None:
        if not (math.isfinite(self.duration_s) and self.duration_s > 0.0):
            raise DesignError(f"duration_s = {self.duration_s!r}: must be finite and > 0")
        if not (math.isfinite(self.start) and math.isfinite(self.target)) or self.start == self.target:
            raise DesignError(
                f"target = {self.target!r}: must be finite, and differ from start = {self.start!r}"
            )
        if self.order not in range(3, LARGEST_ORDER + 1, 2):
            raise DesignError(f"order = {self.order!r}: must be an odd number from 3 to {LARGEST_ORDER}")

    @property
    def travel(self) -> float:
        """Target less start."""
        return self.target - self.start

    @property
    def smoothness(self) -> int:
        """Highest derivative that is continuous."""
        return (self.order - 1) // 2

    @property
    def coefficients(self) -> tuple[Fraction, ...]:
        """Of the motion from 0 to 1 in time 1, rising powers, exact: whole numbers."""
        return _coefficients(self.order)

    def taylor(self, place: Fraction) -> FloatArray:
        """Give its exact coefficients around a place from 0 to 1, rounded; shape (order + 1,).

        Examples
        --------
        >>> PolynomialMotion(1.0, 1.0, order=3).taylor(Fraction(1, 2)).tolist()
        [0.5, 1.5, 0.0, -2.0]
        """
        return np.array(_taylor(self.order, place))

    def at(self, times_s: ArrayLike) -> FloatArray:
        """Give the position at times, in s from the start of the motion; before and after it rests."""
        share = np.clip(np.asarray(times_s, dtype=np.float64) / self.duration_s, 0.0, 1.0)
        # From the nearer end, where the terms do not cancel; the motion is the same from both.
        near = np.polynomial.polynomial.polyval(
            np.minimum(share, 1.0 - share), [float(each) for each in self.coefficients]
        )
        return np.asarray(self.start + self.travel * np.where(share > 0.5, 1.0 - near, near))


@cache
def _coefficients(order: int) -> tuple[Fraction, ...]:
    """Give the integral of u^q (1 - u)^q from 0 to the place, of that to 1."""
    q = (order - 1) // 2
    scale = Fraction(math.factorial(order), math.factorial(q) ** 2)
    return (Fraction(0),) * (q + 1) + tuple(
        scale * (-1) ** i * Fraction(math.comb(q, i), q + 1 + i) for i in range(q + 1)
    )


@cache
def _taylor(order: int, place: Fraction) -> tuple[float, ...]:
    """Give the coefficients around a place, computed exactly."""
    exact = _coefficients(order)
    return tuple(
        float(sum(math.comb(i, j) * exact[i] * place ** (i - j) for i in range(j, len(exact))))
        for j in range(len(exact))
    )
