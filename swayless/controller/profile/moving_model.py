"""The plant's model, run tick by tick, and the stop that begins where it is. Not for: when to stop."""

from __future__ import annotations

from typing import Any

from swayless.controller.number import NumberType
from swayless.controller.profile.model import ProfileModel, StopLaw
from swayless.controller.profile.table import TablePlayer, summed


class MovingModel:
    """Where the plant is, of a move by 1; in the number type.

    Parameters
    ----------
    model : ProfileModel
    stop : StopLaw or None
    number : NumberType
        ``double`` or ``float``.
    """

    def __init__(self, model: ProfileModel, stop: StopLaw | None, number: NumberType) -> None:
        scalar = number.scalar
        self._zero = scalar(0)
        self._rows = [
            [scalar(value) for value in [*row, into]]
            for row, into in zip(model.change.tolist(), model.input.tolist(), strict=True)
        ]
        self._output = [scalar(value) for value in [*model.output.tolist(), model.feedthrough]]
        self._stop = None if stop is None else TablePlayer(stop.pieces, number)
        self._rest = [] if stop is None else [scalar(value) for value in stop.rest.tolist()]
        self._ranges: list[list[int]] = [] if stop is None else stop.ranges.tolist()
        self.start()

    def start(self) -> None:
        """Be at rest."""
        self._states = [self._zero] * len(self._rows)
        self._last = self._zero
        self._known: list[Any] = []
        self._tick = self._range = 0

    def advance(self, shape: Any) -> Any:
        """Take the input of this tick; give the position when the tick begins."""
        now = [*self._states, shape]
        self._states = [state + summed(row, now) for state, row in zip(self._states, self._rows, strict=True)]
        self._last = shape
        self._tick += 1
        return summed(self._output, now)

    def stops(self, is_wanted: bool) -> bool:
        """Begin a stop, if one is wanted and may begin in this tick; to be called in each tick of a move."""
        if self._stop is None:
            return False
        if self._range < len(self._ranges) and self._tick > self._ranges[self._range][1]:
            self._range += 1
        begins = is_wanted and self._range < len(self._ranges) and self._tick >= self._ranges[self._range][0]
        if begins:
            self._stop.rewind()
            self._known = [*self._states, self._last]
        return begins

    @property
    def has_stopped(self) -> bool:
        """Whether the last tick of the stop has been played."""
        return self._stop is None or self._stop.is_over

    @property
    def rest(self) -> Any:
        """Position of rest after the stop."""
        return summed(self._rest, self._known)

    def next_of_stop(self) -> Any:
        """Give the input of this tick of the stop and go on to the next."""
        return self._zero if self._stop is None else self._stop.next(self._known)
