"""A table of values, one a tick, as consecutive pieces that are polynomials of one degree.

Switch times are pieces of degree 0, breakpoints those of a higher degree, and a plain table has pieces of
one tick. A value is a number, or a row of gains. Not for: choosing the pieces (`compression`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType
from swayless.design.shaper import FloatArray
from swayless.errors import ControllerError

LARGEST_DEGREE = 9
"""Of a piece: beyond it a coefficient costs more than it saves."""

LENGTH_BYTES = 2
"""A length is stored in 16 bits: no command is longer than 20000 ticks."""

LARGEST_LENGTH = 65_535


def dtype_of(number: NumberType) -> np.dtype[Any]:
    """Give the numpy type whose arrays calculate as one number after the other does.

    Raises
    ------
    ControllerError
        If the number type is int32.
    """
    if number.is_integer:
        raise ControllerError(
            "profile: number = 'int32': must be double or float; shapes are fractions of a travel that is"
            " known only when a move starts"
        )
    return np.dtype(np.float64 if number.name == "double" else np.float32)


@dataclass(frozen=True, eq=False)
class Pieces:
    """Values, one a tick.

    Parameters
    ----------
    lengths : ndarray of int, shape (p,)
        Ticks of each piece, 1 to 65535.
    coefficients : ndarray, shape (p, d + 1) or (p, d + 1, k)
        Of each piece, the constant first; 0 <= d <= 9. The local variable goes from -1 at the first tick of
        the piece to 1 at its last, and is -1 in a piece of one tick. With k, a value is a row of k numbers.

    Raises
    ------
    ControllerError
        If shapes do not fit or a value is out of range.

    Examples
    --------
    Two ticks of 1.5, then a straight line:

    >>> from swayless.controller.number import number_type
    >>> Pieces([2], [[1.5]]).values(number_type("double")).tolist()
    [1.5, 1.5]
    >>> Pieces([3, 1], [[0.5, 0.5], [1.0, 0.0]]).values(number_type("float")).tolist()
    [0.0, 0.5, 1.0, 1.0]
    """

    lengths: NDArray[np.int64]
    coefficients: FloatArray

    def __post_init__(self) -> None:
        lengths = np.array(self.lengths, dtype=np.int64)
        coefficients = np.array(self.coefficients, dtype=np.float64)
        if lengths.ndim != 1 or coefficients.ndim not in {2, 3} or not lengths.size == len(coefficients) > 0:
            raise ControllerError(
                f"pieces: lengths of shape {lengths.shape}, coefficients of shape {coefficients.shape}:"
                " must be (p,) and (p, d + 1) or (p, d + 1, k), p >= 1"
            )
        if not 1 <= coefficients.shape[1] <= LARGEST_DEGREE + 1:
            raise ControllerError(
                f"pieces: {coefficients.shape[1]} coefficients each: must be 1 to {LARGEST_DEGREE + 1}"
            )
        if lengths.min() < 1 or lengths.max() > LARGEST_LENGTH:
            raise ControllerError(
                f"pieces: lengths {lengths.min()} to {lengths.max()}: must be 1 to {LARGEST_LENGTH}"
            )
        if not np.isfinite(coefficients).all():
            raise ControllerError("pieces: every coefficient must be finite")
        for name, array in (("lengths", lengths), ("coefficients", coefficients)):
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def degree(self) -> int:
        """Of every piece."""
        return int(self.coefficients.shape[1]) - 1

    @cached_property
    def ticks(self) -> int:
        """Ticks that the table lasts."""
        return int(self.lengths.sum())

    @property
    def is_raw(self) -> bool:
        """Whether it is a plain table of values: no lengths need to be stored."""
        return self.degree == 0 and self.ticks == self.lengths.size

    def scales(self, number: NumberType) -> FloatArray:
        """Step of the local variable in each piece, in the number type, shape (p,); 0 in one of one tick."""
        last = np.maximum(self.lengths - 1, 1)
        return np.where(self.lengths > 1, 2.0 / last, 0.0).astype(dtype_of(number)).astype(np.float64)

    def values(self, number: NumberType) -> FloatArray:
        """Give the values as the block plays them, shape (ticks,) or (ticks, k), operation by operation."""
        return self.valued(self.coefficients.astype(dtype_of(number)), number).astype(np.float64)

    def valued(self, coefficients: NDArray[Any], number: NumberType) -> NDArray[Any]:
        """Give the values of other coefficients, shape (p, d + 1, ...), in the number type."""
        dtype = dtype_of(number)
        piece = np.repeat(np.arange(self.lengths.size), self.lengths)
        values = coefficients[piece, -1]
        if self.degree:
            index = np.arange(self.ticks) - (np.cumsum(self.lengths) - self.lengths)[piece]
            local = index.astype(dtype) * self.scales(number).astype(dtype)[piece] - dtype.type(1)
            local = local.reshape(-1, *[1] * (values.ndim - 1))
            for power in range(self.degree - 1, -1, -1):
                values = values * local + coefficients[piece, power]
        return np.asarray(values)

    def stored_bytes(self, number: NumberType) -> int:
        """Size of the table in a controller: coefficients, and where needed lengths and steps."""
        size: int = dtype_of(number).itemsize
        each = size * self.coefficients[0].size + (size if self.degree else 0)
        return int(self.lengths.size * (each + (0 if self.is_raw else LENGTH_BYTES)))
