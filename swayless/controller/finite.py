"""Readings that may not be numbers, without a library that a controller does not have. Not for: ranges."""

from __future__ import annotations

from typing import Any

from swayless.controller.number import NumberType


def is_finite(value: Any, number: NumberType) -> bool:
    """Whether a reading is a number: only what is finite and not 0 shrinks when halved.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> [is_finite(value, number_type("double")) for value in (-1e300, 0.0, float("inf"), float("nan"))]
    [True, True, False, False]
    """
    return bool(number.is_integer or value == 0 or abs(value) * number.scalar(0.5) < abs(value))


def clamped(value: Any, low: Any, high: Any, number: NumberType) -> Any:
    """Bring a reading into a range; one that is not a number counts as 0, and a lower end of 0 is never -0.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> [clamped(value, -2.0, 1.0, number_type("double")) for value in (-3.0, 0.5, float("inf"))]
    [-2.0, 0.5, 0.0]
    """
    if not is_finite(value, number):
        return number.scalar(0)
    if value <= low:
        return low
    return min(value, high)
