"""Playing pieces tick by tick, in the number type. Not for: all ticks at once (`Pieces.values`)."""

from __future__ import annotations

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
    """

    def __init__(self, pieces: Pieces, number: NumberType) -> None:
        scalar = number.scalar
        self._scalar = scalar
        self._lengths = pieces.lengths.tolist()
        self._scales = [scalar(value) for value in pieces.scales(number).tolist()]
        self._coefficients = [[scalar(c) for c in piece] for piece in pieces.coefficients.tolist()]
        self.rewind()

    def rewind(self) -> None:
        """Begin again."""
        self._piece = self._index = 0

    @property
    def is_over(self) -> bool:
        """Whether the last tick has been played."""
        return self._piece == len(self._lengths)

    def next(self) -> Any:
        """Give the value of this tick and go on to the next."""
        *lower, value = self._coefficients[self._piece]
        if lower:
            local = (self._scalar(self._index) * self._scales[self._piece]) - self._scalar(1)
            for coefficient in reversed(lower):
                value = (value * local) + coefficient
        self._index += 1
        if self._index == self._lengths[self._piece]:
            self._index = 0
            self._piece += 1
        return value
