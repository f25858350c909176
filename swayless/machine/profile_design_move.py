"""A move that a block shall play: a command, the plant that it was computed for, and its limits.

Not for: finding the command; it may be time-optimal, of least energy, or inverted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from swayless.controller.profile.settings import LARGEST_INPUT, LARGEST_SHAPE
from swayless.design.optimal import Command, LinearPlant, Robustness
from swayless.design.playing import ShapeModel, shape_model
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.machine.stored_numbers import nearest_12

_ROUNDING = 1e-9  # of the limits' width
_NEAR = 1e-9  # of the largest input: how near ends of a command are to what holds the plant there


@dataclass(frozen=True, eq=False)
class ProfileMove:
    """A command from rest to rest, and all that is needed to play it.

    Parameters
    ----------
    plant : LinearPlant
        From the command to the position that moves.
    command : Command
        Zero-order or first-order.
    limits : tuple of two floats
        Lowest and highest input.
    start, target : float
        Position before and after; other ones may be given when the block runs.
    rate_limit_per_s : float or None
        Largest change of the input per second, > 0.
    robustness : Robustness
        Of the command: stops are as robust.

    Raises
    ------
    DesignError
        If a value is out of range, the plant cannot be played to, or the command does not begin and end where
        it holds the plant.
    """

    plant: LinearPlant
    command: Command
    limits: tuple[float, float]
    start: float
    target: float
    rate_limit_per_s: float | None = None
    robustness: Robustness = field(default_factory=Robustness)

    def __post_init__(self) -> None:
        self.plant.check()
        low, high = self.limits
        rate = self.rate_limit_per_s
        if not -LARGEST_INPUT <= low < high <= LARGEST_INPUT:
            raise DesignError(f"limit = {low!r} to {high!r}: must rise, up to {LARGEST_INPUT:g} in size")
        if rate is not None and not (math.isfinite(rate) and rate > 0.0):
            raise DesignError(f"rate_limit = {rate!r}: must be finite and > 0")
        if not (math.isfinite(self.start) and math.isfinite(self.target)) or self.start == self.target:
            raise DesignError(f"start = {self.start!r}, target = {self.target!r}: must be finite and differ")
        if not np.abs(self.command.values - self.command.initial_value).max() <= LARGEST_SHAPE * abs(
            self.target - self.start
        ):
            raise DesignError(
                f"start = {self.start!r}, target = {self.target!r}: inputs must be at most {LARGEST_SHAPE:g}"
                " times the travel"
            )
        self._check_ends(_NEAR * max(float(np.abs(self.command.values).max()), -low, high))
        self._check_limits()

    def _check_ends(self, near: float) -> None:
        """Refuse a command that does not begin or end at rest."""
        for what, value, position in (
            ("initial_value", self.command.initial_value, self.start),
            ("final_value", self.command.final_value, self.target),
        ):
            held = self.plant.equilibrium(position)[1]
            if abs(value - held) > near:
                raise DesignError(
                    f"command: {what} = {value:g}: the plant stays at {position:g} under {held:g} only"
                )

    def _check_limits(self) -> None:
        """Refuse a command beyond the limits, but for what solving leaves of rounding."""
        low, high = self.limits
        command, near = self.command, _ROUNDING * (high - low)
        inputs = np.array([command.initial_value, *command.values, command.final_value])
        if inputs.min() < low - near or inputs.max() > high + near:
            raise DesignError(
                f"command: {inputs.min():.6g} to {inputs.max():.6g}: the limit is {low:g} to {high:g}"
            )
        most = float(np.abs(np.diff(inputs)).max()) / command.tick_s
        if self.rate_limit_per_s is not None and most > self.rate_limit_per_s + near / command.tick_s:
            raise DesignError(
                f"command: changes by {most:.6g} a second: the rate_limit is {self.rate_limit_per_s:g}"
            )

    def as_stored(self) -> ProfileMove:
        """Give the move to the 12 digits that are kept: beyond them is a solver's noise.

        Plant and limits stay as they are.
        """
        given, split = self.command, self.robustness.split_ratio
        command = Command(
            nearest_12(given.tick_s),
            np.array([nearest_12(value) for value in given.values.tolist()]),
            nearest_12(given.final_value),
            given.hold,
            nearest_12(given.initial_value),
        )
        return replace(
            self,
            command=command,
            start=nearest_12(self.start),
            target=nearest_12(self.target),
            robustness=Robustness(self.robustness.order, None if split is None else nearest_12(split)),
        )

    @property
    def shape(self) -> FloatArray:
        """Input of a move by 1, less what held the plant before."""
        return (self.command.values - self.command.initial_value) / (self.target - self.start)

    def model(self) -> ShapeModel:
        """Give the plant from tick to tick, with the chains of its robustness."""
        return shape_model(self.plant, self.command.tick_s, self.command.hold, self.robustness)
