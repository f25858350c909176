"""What a block plays, all of it, and what that leaves of the plant: the proof of a motion profile.

Not for: making it, or what is promised of it (`profile_design_promise`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swayless.controller.profile import (
    Extremes,
    Pieces,
    PlayedStops,
    ProfileModel,
    StopLaw,
    played_move,
    played_stops,
)
from swayless.design.playing import (
    error_ratio,
    largest_step,
    missed_by_move,
    missed_by_stops,
    swing_ratio,
    ticks_of,
)
from swayless.design.playing.stopping import blocks
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.machine.profile_design_numbers import NumberedMove

LARGEST_ERROR_RATIO = 0.01
"""A move, or a stop, that leaves more does not rest."""


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
    final_swing_ratio, stop_swing_ratio : float
        What the position of the plant as it is given swings by then, of the travel; 0 unless poles are split.
    largest_step : float
        Largest change of the input from tick to tick, of a move by 1.
    """

    extremes: Extremes
    final_error_ratio: float
    stop_error_ratio: float
    final_swing_ratio: float
    stop_swing_ratio: float
    largest_step: float

    @property
    def largest_shape(self) -> float:
        """Largest input of all that can be played, of a move by 1."""
        return max(abs(shape) for shape in self.extremes.shape)

    def keeps_input(self, numbered: NumberedMove) -> bool:
        """Whether the move of the design, and all its stops, keep the limits of the input."""
        low, high = numbered.limits
        references = numbered.references(np.array(self.extremes.shape))
        return bool(low <= references.min() and references.max() <= high)

    def check_rest(self, number: str) -> None:
        """Refuse what does not rest.

        Raises
        ------
        DesignError
            Naming the move, or the stop.
        """
        for what, left in (("command", self.final_error_ratio), ("stop", self.stop_error_ratio)):
            if not left <= LARGEST_ERROR_RATIO:
                raise DesignError(
                    f"{what}: leaves {left:.2g} of the states that the move has had, in {number}: must be at"
                    f" most {LARGEST_ERROR_RATIO:g}, the plant does not rest"
                )


def proved_table(numbered: NumberedMove, pieces: Pieces) -> ProfileProof:
    """Play the table alone: as in the move of the design, and without the rounding of its references."""
    shape = pieces.values(numbered.number)
    held = numbered.hold_ratio
    inputs = np.append(shape, [0.0, held])
    felt = numbered.felt(shape)
    sizes = numbered.model.sizes(felt)
    missed = np.hstack([missed_by_move(numbered.model, each) for each in (felt, shape)])
    return ProfileProof(
        Extremes((float(inputs.min()), float(inputs.max())), (0.0, 0.0)),
        error_ratio(numbered.model, missed, sizes),
        0.0,
        swing_ratio(numbered.model, missed),
        0.0,
        largest_step(np.zeros(1), shape[:, np.newaxis], np.array([held])),
    )


def proved(numbered: NumberedMove, pieces: Pieces, model: ProfileModel, stop: StopLaw | None) -> ProfileProof:
    """Play the table, and the stop from every tick in which it may begin."""
    table = proved_table(numbered, pieces)
    if stop is None:
        return table
    move = played_move(pieces, model, numbered.number)
    felt = numbered.felt(move.shape)
    states, sizes = numbered.model.states(felt)[1:-1], numbered.model.sizes(felt)
    extremes, error, swing, step = table.extremes, 0.0, 0.0, table.largest_step
    begins = ticks_of(stop.ranges)
    for begin, end in blocks(begins.size, stop.ticks):
        part = begins[begin:end] - 1
        stops = played_stops(stop, move.aborts[part], numbered.number)
        extremes = extremes.with_those_of(stops.extremes)
        missed = _missed_by(stops, numbered, states[part])
        error = max(error, error_ratio(numbered.model, missed, sizes))
        swing = max(swing, swing_ratio(numbered.model, missed))
        held = numbered.hold_ratio * stops.rests
        step = max(step, largest_step(move.shape[part], stops.inputs, held))
    return replace(
        table,
        extremes=extremes,
        stop_error_ratio=error,
        stop_swing_ratio=swing,
        largest_step=step,
    )


def _missed_by(stops: PlayedStops, numbered: NumberedMove, states: FloatArray) -> FloatArray:
    """Give what stops leave in the move of the design, with all rounding of its references."""
    return missed_by_stops(numbered.model, states, numbered.felt(stops.inputs), stops.rests)
