"""A move in the numbers of a controller: what a shape becomes when it is played. Not for: what it leaves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType
from swayless.controller.profile.compression import TOLERANCE_RATIO
from swayless.controller.profile.pieces import dtype_of
from swayless.design.playing import ShapeModel
from swayless.design.shaper import FloatArray
from swayless.machine.profile_design_move import ProfileMove


@dataclass(frozen=True, eq=False)
class NumberedMove:
    """A move whose every number is one of a number type.

    Parameters
    ----------
    move : ProfileMove
    number : NumberType
        ``double`` or ``float``.
    stored_hold_ratio : float or None
        What holds the plant per unit of position, of a design that has one: another mathematical library may
        find another last digit.
    """

    move: ProfileMove
    number: NumberType
    stored_hold_ratio: float | None = None

    @cached_property
    def model(self) -> ShapeModel:
        """The plant, its states in powers of two of about their largest value in the move."""
        model = self.move.model()
        largest = np.abs(model.states(self.move.shape)).max(axis=0)
        powers = np.round(np.log2(np.where(largest > 0.0, largest, 1.0)))
        return model.in_units_of(np.ldexp(1.0, powers.astype(np.int64)))

    @property
    def hold_ratio(self) -> float:
        """Input per unit of position that holds the plant."""
        stored = self.stored_hold_ratio
        return self.rounded(self.model.hold_ratio) if stored is None else stored

    @property
    def start(self) -> float:
        """Position before."""
        return self.rounded(self.move.start)

    @property
    def travel(self) -> float:
        """Target less start."""
        dtype = dtype_of(self.number).type
        return float(dtype(self.move.target) - dtype(self.move.start))

    @property
    def limits(self) -> tuple[float, float]:
        """The limits, or the next numbers within."""
        return -self.rounded_down(-self.move.limits[0]), self.rounded_down(self.move.limits[1])

    @property
    def largest_change(self) -> float | None:
        """Largest change of the reference from tick to tick; None where the rate has no limit."""
        rate = self.move.rate_limit_per_s
        return None if rate is None else rate * self.move.command.tick_s

    def rounded(self, value: float) -> float:
        """Give the nearest number of the type."""
        return float(dtype_of(self.number).type(value))

    def rounded_down(self, value: float) -> float:
        """Give the next number of the type that is not above."""
        near = dtype_of(self.number).type(value)
        # Compared as doubles: numpy compares a number of its own with a Python number in its own type.
        return float(
            near if float(near) <= value else np.nextafter(near, dtype_of(self.number).type(-np.inf))
        )

    def rounded_all(self, values: FloatArray) -> FloatArray:
        """Give the nearest numbers of the type."""
        return values.astype(dtype_of(self.number)).astype(np.float64)

    def references(self, shape: FloatArray) -> FloatArray:
        """Give what the block plays for a shape, operation by operation."""
        dtype = dtype_of(self.number)
        hold, start, travel = (dtype.type(value) for value in (self.hold_ratio, self.start, self.travel))
        played: NDArray[Any] = (hold * start) + (travel * shape.astype(dtype))
        return played.astype(np.float64)

    def felt(self, shape: FloatArray) -> FloatArray:
        """Give the shape that the plant feels: with all rounding of its reference."""
        return np.asarray((self.references(shape) - self.references(np.zeros(1))) / self.travel)

    @cached_property
    def shape(self) -> FloatArray:
        """The shape of the command, so far within the limits that pieces near it keep them too."""
        held = float(self.references(np.zeros(1))[0])
        low, high = sorted((limit - held) / self.travel for limit in self.limits)
        near = TOLERANCE_RATIO[self.number.name] * (high - low)
        return self.rounded_all(np.clip(self.move.shape, low + near, high - near))
