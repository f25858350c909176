"""Playing pieces tick by tick, in the number type. Not for: all ticks at once (`Pieces.values`)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from swayless.controller.number import NumberType
from swayless.controller.profile.pieces import Pieces


class TablePlayer:
    """Gives the value of one tick after the other; nothing is searched.

    Parameters
    ----------
    pieces : Pieces
        What to play.
    number : NumberType
        ``double`` or ``float``.

    Attributes
    ----------
    left : int
        Ticks that have not been played.
    """

    def __init__(self, pieces: Pieces, number: NumberType) -> None:
        scalar = number.scalar
        self._scalar, self._one = scalar, scalar(1)
        self._lengths = pieces.lengths.tolist()
        self._scales = [scalar(value) for value in pieces.scales(number).tolist()]
        self._coefficients = _scalars(pieces.coefficients.tolist(), scalar)
        self._now: list[Any] = []
        self.rewind()

    def rewind(self) -> None:
        """Begin again."""
        self._piece = self._index = 0
        self.left: int = sum(self._lengths)

    @property
    def is_over(self) -> bool:
        """Whether the last tick has been played."""
        return self.left == 0

    def next(self, factors: Sequence[Any] = ()) -> Any:
        """Give the value of this tick and go on to the next.

        Parameters
        ----------
        factors : sequence
            Of a table of rows: the value is the sum of the row's products with them.
        """
        if self._index == 0:
            coefficients = self._coefficients[self._piece]
            self._now = [summed(row, factors) for row in coefficients] if factors else coefficients
        *lower, value = self._now
        if lower:
            local = (self._scalar(self._index) * self._scales[self._piece]) - self._one
            for coefficient in reversed(lower):
                value = (value * local) + coefficient
        self.left -= 1
        self._index += 1
        if self._index == self._lengths[self._piece]:
            self._index = 0
            self._piece += 1
        return value


def summed(weights: Sequence[Any], values: Sequence[Any]) -> Any:
    """Sum products from left to right.

    Examples
    --------
    >>> summed([1.0, 2.0], [3.0, 4.0])
    11.0
    """
    total = weights[0] * values[0]
    for weight, value in zip(weights[1:], values[1:], strict=True):
        total = total + (weight * value)
    return total


def _scalars(values: Any, scalar: Any) -> Any:
    return [_scalars(value, scalar) for value in values] if isinstance(values, list) else scalar(values)
