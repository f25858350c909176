"""What a block plays, all of it, and what that leaves of the plant: the proof of a motion profile.

Not for: making it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from swayless.controller.profile import (
    Extremes,
    Pieces,
    ProfileModel,
    StopLaw,
    played_move,
    played_stops,
)
from swayless.controller.profile.compression import TOLERANCE_RATIO
from swayless.design.playing import error_after_stops, final_error_ratio, largest_step, stops_needed
from swayless.design.playing.stopping import blocks
from swayless.machine.profile_design_numbers import NumberedMove

LARGEST_ERROR_RATIO = 0.01
"""A move, or a stop, that leaves more does not rest."""

_STEPS = (1.0, 2.0, 5.0, 10.0)
_LEAST_PROMISE = 1e-12


@dataclass(frozen=True)
class ProfileProof:
    """What was found when all that a block can play was played.

    Parameters
    ----------
    extremes : Extremes
        Of a move by 1.
    final_error_ratio : float
        How far the states are from rest after the move, each of its largest in the move.
    stop_error_ratio : float
        The same, after the worst of all stops; 0 where there are none.
    largest_step : float
        Largest change of the input from tick to tick, of a move by 1.
    largest_shape : float
        Largest input of the table, of a move by 1.
    """

    extremes: Extremes
    final_error_ratio: float
    stop_error_ratio: float
    largest_step: float
    largest_shape: float

    def rounding(self, numbered: NumberedMove) -> float:
        """How far a step may exceed the limit of the rate: the last places of a reference, of a move by 1."""
        return 8.0 * TOLERANCE_RATIO[numbered.number.name] * self.largest_shape

    def max_travel(self, numbered: NumberedMove, rate_limit_per_s: float | None, most: float) -> float:
        """Longest travel that keeps the limit of the rate, or `most` if that is less or there is none."""
        if rate_limit_per_s is None:
            return most
        step = self.largest_step - self.rounding(numbered)
        allowed = rate_limit_per_s * numbered.move.command.tick_s
        return numbered.rounded(allowed / step) if allowed < most * step else most

    def input_share(self, numbered: NumberedMove) -> float:
        """Largest share of the input's limits that the move, or a stop of it, takes: 1 at a limit."""
        low, high = numbered.limits
        references = numbered.references(np.array(self.extremes.shape))
        return float(np.abs(references - 0.5 * (low + high)).max() / (0.5 * (high - low)))

    def keeps_limits(self, numbered: NumberedMove) -> bool:
        """Whether the move and all its stops keep input and rate."""
        low, high = numbered.limits
        references = numbered.references(np.array(self.extremes.shape))
        travel = self.max_travel(numbered, numbered.move.rate_limit_per_s, math.inf)
        return bool(low <= references.min() and references.max() <= high and abs(numbered.travel) <= travel)


def proved_table(numbered: NumberedMove, pieces: Pieces) -> ProfileProof:
    """Play the table alone."""
    shape = pieces.values(numbered.number)
    held = numbered.hold_ratio
    inputs = np.append(shape, [0.0, held])
    return ProfileProof(
        Extremes((float(inputs.min()), float(inputs.max())), (0.0, 0.0)),
        final_error_ratio(numbered.model, numbered.felt(shape)),
        0.0,
        largest_step(np.zeros(1), shape[:, np.newaxis], np.array([held])),
        float(np.abs(shape).max()),
    )


def proved(numbered: NumberedMove, pieces: Pieces, model: ProfileModel, stop: StopLaw | None) -> ProfileProof:
    """Play the table, and the stop from every tick from which one plays."""
    table = proved_table(numbered, pieces)
    if stop is None:
        return table
    move = played_move(pieces, model, numbered.number)
    felt = numbered.felt(move.shape)
    states, sizes = numbered.model.states(felt)[1:-1], numbered.model.sizes(felt)
    extremes, error, step = table.extremes, 0.0, table.largest_step
    for begin, end in blocks(stops_needed(len(felt), stop.ticks), stop.ticks):
        part = slice(begin, end)
        stops = played_stops(stop, move.aborts[part], numbered.number)
        extremes = extremes.with_those_of(stops.extremes)
        left = error_after_stops(
            numbered.model, sizes, states[part], numbered.felt(stops.inputs), stops.rests
        )
        error = max(error, left)
        held = numbered.hold_ratio * stops.rests
        step = max(step, largest_step(move.shape[begin:end], stops.inputs, held))
    return ProfileProof(extremes, table.final_error_ratio, error, step, table.largest_shape)


def promised(measured: float) -> float:
    """Promise an error: the next 1, 2 or 5 of a power of ten above twice what was measured.

    Another mathematical library may measure a little more.

    Examples
    --------
    >>> promised(3.1e-10), promised(1e-16)
    (1e-09, 1e-12)
    """
    least = max(2.0 * measured, _LEAST_PROMISE)
    power = 10.0 ** math.floor(math.log10(least))
    text = next(f"{step * power:.0e}" for step in _STEPS if step * power >= least * (1.0 - 1e-9))
    return float(text)
