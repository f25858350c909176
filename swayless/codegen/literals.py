"""Numbers as text: the shortest that reads back to the same bits of the target type. Not for: rounding."""

from __future__ import annotations

from typing import Any

import numpy as np

from swayless.controller.number import NumberType
from swayless.errors import CodegenError

ST_LARGEST = 1.0e38
"""A released ST compiler rejects larger literals, even of LREAL."""


def shortest(value: Any, number: NumberType) -> str:
    """Print a float or double with as few digits as read back to the same bits, always with a point.

    Parameters
    ----------
    value : float or numpy.float32
        Finite.
    number : NumberType
        ``double`` or ``float``.

    Raises
    ------
    CodegenError
        If the value is not finite.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> shortest(0.1, number_type("double")), shortest(1e-7, number_type("float"))
    ('0.1', '1.0e-07')
    """
    exact = number.scalar(value)
    if not np.isfinite(exact):
        raise CodegenError(f"{value!r} is not finite and has no literal in {number.name}")
    magnitude = abs(float(exact))
    if magnitude != 0.0 and not 1e-4 <= magnitude < 1e16:
        return str(np.format_float_scientific(exact, unique=True, trim="0"))
    return str(np.format_float_positional(exact, unique=True, trim="0"))


def c_literal(value: Any, number: NumberType) -> str:
    """Print a number as a C99 literal of the type.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> c_literal(0.25, number_type("float")), c_literal(-3, number_type("int32"))
    ('0.25f', '-3')
    """
    if number.is_integer:
        return str(int(value))
    return shortest(value, number) + ("f" if number.name == "float" else "")


def st_literal(value: Any, number: NumberType) -> str:
    """Print a number as an LREAL or REAL literal.

    Raises
    ------
    CodegenError
        If the number is too large to be portable.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> st_literal(1e-7, number_type("double"))
    '1.0E-07'
    """
    if abs(float(value)) >= ST_LARGEST:
        raise CodegenError(f"{value!r}: literals from {ST_LARGEST} on are not portable Structured Text")
    return shortest(value, number).upper()
