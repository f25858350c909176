"""The number types a controller may calculate in: double, float and int32. Not for: printing literals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from swayless.errors import ControllerError


@dataclass(frozen=True)
class NumberType:
    """How a controller represents commands, references and amplitudes.

    Parameters
    ----------
    name : str
        ``"double"``, ``"float"`` or ``"int32"``.
    amplitude_bits : int
        Amplitudes are whole multiples of ``2**-amplitude_bits``. On that lattice every partial sum of
        amplitudes between 0 and 1 is exact, so they sum to exactly 1, in any order.
    significand_bits : int
        Bits of the significand; 31 for int32.
    scalar : callable
        Makes one number of this type from a Python number, rounding once.
    """

    name: str
    amplitude_bits: int
    significand_bits: int
    scalar: Callable[[Any], Any]

    @property
    def is_integer(self) -> bool:
        """Whether commands and references are whole counts."""
        return self.name == "int32"


NUMBER_TYPES: Mapping[str, NumberType] = {
    "double": NumberType("double", 53, 53, float),
    "float": NumberType("float", 24, 24, np.float32),
    "int32": NumberType("int32", 30, 31, int),
}
"""Every number type by name."""


def number_type(name: str) -> NumberType:
    """Find a number type by its name.

    Raises
    ------
    ControllerError
        If there is no such type.

    Examples
    --------
    >>> number_type("int32").amplitude_bits
    30
    """
    if name not in NUMBER_TYPES:
        raise ControllerError(f"number = {name!r}: must be one of {', '.join(NUMBER_TYPES)}")
    return NUMBER_TYPES[name]


SUM_ROUNDING = 1e-12
"""How far a sum of amplitudes may be off by rounding: a handful of doubles and no more."""


def as_written(value: float) -> Fraction:
    """Give the number that the shortest decimal of a float says.

    Parameters
    ----------
    value : float
        Finite.

    Examples
    --------
    >>> as_written(0.01)
    Fraction(1, 100)
    """
    return Fraction(repr(float(value)))


def amplitudes_on_lattice(amplitudes: np.typing.ArrayLike, bits: int) -> list[int]:
    """Quantise amplitudes to whole multiples of ``2**-bits`` that sum to exactly ``2**bits``.

    The *partial sums* are rounded and their differences taken, so that positive amplitudes stay positive and
    partial sums within [0, 1], but for rounding, are so exactly. Each amplitude moves by at most one unit of
    the lattice and that rounding.

    Parameters
    ----------
    amplitudes : array_like, shape (n,)
        Amplitudes that sum to 1 but for rounding.
    bits : int
        Fineness of the lattice.

    Returns
    -------
    list of int
        Numerators over ``2**bits``.

    Raises
    ------
    ControllerError
        If the amplitudes do not sum to 1.

    Examples
    --------
    >>> amplitudes_on_lattice([0.25, 0.5, 0.25], 30)
    [268435456, 536870912, 268435456]
    >>> sum(amplitudes_on_lattice([1 / 3, 1 / 3, 1 / 3], 24)) == 2**24
    True
    """
    one = 1 << bits
    partial = Fraction(0)
    sums = [0]
    for amplitude in np.asarray(amplitudes, dtype=np.float64).tolist():
        partial += Fraction(amplitude)
        sums.append(round(_within_0_and_1(partial) * one))
    if abs(partial - 1) > SUM_ROUNDING:
        raise ControllerError(f"amplitudes sum to {float(partial)!r}, not to 1")
    sums[-1] = one
    return [high - low for low, high in pairwise(sums)]


def _within_0_and_1(partial: Fraction) -> Fraction:
    """Bring a partial sum back that left [0, 1] by rounding; one that left it by more stays."""
    nearest = min(max(partial, Fraction(0)), Fraction(1))
    return nearest if abs(partial - nearest) <= SUM_ROUNDING else partial
