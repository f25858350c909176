"""Arithmetic of a controller at run time: exact in each type, and loud where a controller is silent.

LREAL is Python's float, REAL is `numpy.float32`, INT and DINT are Python integers whose range is checked.
Not for: deciding types, which `expressions` does.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn, TypeAlias

import numpy as np

from swayless.verify.structured_text.faults import ExecutionError

Float: TypeAlias = float | np.float32

INTEGER_RANGES = {"INT": (-(2**15), 2**15 - 1), "DINT": (-(2**31), 2**31 - 1)}
"""Smallest and largest value of each integer type."""

FLOATS = ("REAL", "LREAL")


def lreal(text: str) -> float:
    """Round a decimal number to double precision."""
    return float(text)


def real(text: str) -> np.float32:
    """Round a decimal number to single precision, once.

    By way of a double it would be rounded twice, which differs when the double falls on a tie of singles.

    Parameters
    ----------
    text : str
        Decimal number of magnitude below 1e38.

    Examples
    --------
    >>> tie_and_a_bit = "1.00000017881393432617187499"  # the double nearest to it is a tie
    >>> float(real(tie_and_a_bit)), float(np.float32(float(tie_and_a_bit)))
    (1.0000001192092896, 1.000000238418579)
    """
    exact = Fraction(text)
    guess = np.float32(float(text))
    neighbours = np.nextafter(guess, np.array([-np.inf, np.inf], dtype=np.float32))
    return min(
        (guess, *neighbours), key=lambda single: (abs(Fraction(float(single)) - exact), _is_odd(single))
    )


def _is_odd(single: np.float32) -> int:
    return int(single.view(np.uint32)) & 1


def divide_lreal(dividend: float, divisor: float) -> float:
    """Divide as IEEE 754 does, where Python would raise.

    Examples
    --------
    >>> divide_lreal(-1.0, 0.0), divide_lreal(1.0, -0.0), divide_lreal(0.0, 0.0)
    (-inf, -inf, nan)
    """
    if divisor != 0.0:
        return dividend / divisor
    if dividend == 0.0 or math.isnan(dividend):
        return math.nan
    return math.copysign(math.inf, dividend) * math.copysign(1.0, divisor)


def sqrt_lreal(value: float) -> float:
    """Take the square root as IEEE 754 does: NaN below 0."""
    return math.nan if value < 0.0 else math.sqrt(value)


RUNTIME: dict[str, Callable[..., object]] = {
    "divide_LREAL": divide_lreal,
    "divide_REAL": operator.truediv,
    "sqrt_LREAL": sqrt_lreal,
    "sqrt_REAL": np.sqrt,
    "to_LREAL": float,
    "to_REAL": np.float32,
}
"""What translated code calls by name. Singles rely on `numpy.errstate` around the step to stay silent."""


@dataclass(frozen=True)
class Check:
    """One place of the source whose integer result must lie in a range.

    Parameters
    ----------
    line : int
        Line of the source, from 1.
    what : str
        What is computed there, as the source says it.
    low, high : int
        The range, ends included.
    names : tuple of str
        Variables in the expression; their values are passed as `values` when something is wrong.
    """

    line: int
    what: str
    low: int
    high: int
    names: tuple[str, ...]

    def outside(self, result: float, *values: object) -> NoReturn:
        """Report a result outside the range."""
        self._fail(f"{self.what} = {result} is outside {self.low} to {self.high}", values)

    def quotient(self, dividend: int, divisor: int, *values: object) -> int:
        """Divide integers, truncated toward zero."""
        if divisor == 0:
            self._fail(f"{self.what} divides {dividend} by zero", values)
        magnitude = abs(dividend) // abs(divisor)
        return magnitude if (dividend < 0) == (divisor < 0) else -magnitude

    def remainder(self, dividend: int, divisor: int, *values: object) -> int:
        """Remainder of `quotient`: it has the sign of the dividend."""
        return dividend - divisor * self.quotient(dividend, divisor, *values)

    def truncated(self, value: Float, *values: object) -> int:
        """Drop the fraction of a finite number whose integer part is in the range."""
        if not (math.isfinite(value) and self.low <= int(value) <= self.high):
            self.outside(float(value), *values)
        return int(value)

    def _fail(self, message: str, values: tuple[object, ...]) -> NoReturn:
        known = ", ".join(f"{name} = {value}" for name, value in zip(self.names, values, strict=True))
        raise ExecutionError(self.line, f"{message} ({known})" if known else message)
