"""Every constant of a motion profile, in its number type. Not for: where they come from (`machine`)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from swayless.controller.number import NUMBER_TYPES, NumberType
from swayless.controller.profile.enumeration import Extremes
from swayless.controller.profile.model import ProfileModel, StopLaw
from swayless.controller.profile.pieces import Pieces, dtype_of
from swayless.design.playing import ticks_to_rest
from swayless.design.shaper import FloatArray
from swayless.errors import ControllerError

LARGEST_POSITION = 2.0**50
"""Largest start, target and travel: with the bounds below, no product can overflow, in float neither."""

LARGEST_INPUT = 1e30

LARGEST_SHAPE, LARGEST_REST = 1e9, 1e3
"""Largest input, and largest position of rest after a stop, of a move by 1."""


@dataclass(frozen=True, eq=False)
class ProfileSettings:
    """How a motion profile runs; every array holds numbers of the number type.

    Parameters
    ----------
    tick_s : float
        Length of a tick, > 0.
    pieces : Pieces
        Input of a move by 1 from 0, less what held the plant before: its shape.
    model : ProfileModel
        The plant from tick to tick.
    stop : StopLaw or None
        What is played from the first tick of its ranges at or after an abort; where none is left, or where
        stop is None, the move goes on to its end.
    extremes : Extremes
        Of all that can be played.
    limits : tuple of two floats
        Lowest and highest reference.
    hold_ratio : float
        Reference that holds the plant, per unit of position; 0 where it stays anywhere by itself.
    max_travel : float
        Largest distance of start and target, > 0, up to 2**50: what a limit of the rate leaves.
    first_position : float
        Where the block holds before any start has been good.
    number : NumberType
        ``double`` or ``float``.

    Raises
    ------
    ControllerError
        If a value is out of range or is no number of the type.
    """

    tick_s: float
    pieces: Pieces
    model: ProfileModel
    stop: StopLaw | None
    extremes: Extremes
    limits: tuple[float, float]
    hold_ratio: float = 0.0
    max_travel: float = LARGEST_POSITION
    first_position: float = 0.0
    number: NumberType = field(default=NUMBER_TYPES["double"])

    def __post_init__(self) -> None:
        dtype_of(self.number)
        self._check_sizes()
        for name, values in self._numbers().items():
            self._check_numbers(name, values)
        if not (math.isfinite(self.tick_s) and self.tick_s > 0.0):
            raise ControllerError(f"profile: tick_s = {self.tick_s!r}: must be finite and > 0")
        if not self.limits[0] < self.limits[1]:
            raise ControllerError(f"profile: limits = {self.limits!r}: must rise")
        if not 0.0 < self.max_travel <= LARGEST_POSITION:
            raise ControllerError(
                f"profile: max_travel = {self.max_travel!r}: must be above 0, at most {LARGEST_POSITION:g}"
            )

    @property
    def rest_ticks(self) -> int:
        """At most so many ticks after an abort the plant rests: by a stop, or by the end of the move."""
        ticks, stop = self.pieces.ticks, self.stop
        if stop is None:
            return ticks - 1
        return int(ticks_to_rest(stop.ranges, stop.ticks, ticks).max())

    def _check_sizes(self) -> None:
        if self.pieces.coefficients.ndim != 2:
            raise ControllerError("profile: pieces of rows: the value of a tick must be one number")
        if self.stop is not None and self.stop.rest.size != self.model.order + 1:
            raise ControllerError(
                f"profile: stop of {self.stop.rest.size} gains a tick: must be {self.model.order + 1}, for"
                " the states of the model and the input before"
            )
        if self.stop is not None and self.stop.ranges[-1, 1] + self.stop.ticks >= self.pieces.ticks:
            raise ControllerError(
                f"profile: stop of {self.stop.ticks} ticks from tick {self.stop.ranges[-1, 1]}: must be over"
                f" before the move, which has {self.pieces.ticks}"
            )

    def _numbers(self) -> dict[str, tuple[FloatArray, float]]:
        """Every number of the block, with the largest that it may be."""
        model, stop, wide = self.model, self.stop, LARGEST_POSITION
        gains = {} if stop is None else {"stop.pieces": stop.pieces.coefficients, "stop.rest": stop.rest}
        return {
            **{name: (values, wide) for name, values in gains.items()},
            "pieces": (self.pieces.coefficients, wide),
            "model.change": (model.change, wide),
            "model.input": (model.input, wide),
            "model.output": (model.output, wide),
            "model.feedthrough": (np.array([model.feedthrough]), LARGEST_REST),
            "extremes.shape": (np.array(self.extremes.shape), LARGEST_SHAPE),
            "extremes.rest": (np.array(self.extremes.rest), LARGEST_REST),
            "limits": (np.array(self.limits), LARGEST_INPUT),
            "hold_ratio": (np.array([self.hold_ratio]), LARGEST_SHAPE),
            "first_position": (np.array([self.first_position]), wide),
            "max_travel": (np.array([self.max_travel]), wide),
        }

    def _check_numbers(self, name: str, given: tuple[FloatArray, float]) -> None:
        values, largest = given
        allowed = np.abs(values) <= largest
        if not allowed.all():
            wrong = float(values[~allowed][0])
            raise ControllerError(f"profile: {name} = {wrong!r}: must be finite, at most {largest:g} in size")
        if (values.astype(dtype_of(self.number)) != values).any():
            raise ControllerError(f"profile: {name}: every value must be a {self.number.name}")
