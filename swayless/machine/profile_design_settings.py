"""From a move to the constants of the block that plays it, in a number type. Not for: storing them."""

from __future__ import annotations

import numpy as np

from swayless.controller.profile import (
    MotionProfile,
    Pieces,
    ProfileInput,
    ProfileModel,
    ProfileSettings,
    ProfileStatus,
    StopLaw,
)
from swayless.controller.profile.compression import TABLE_RATIOS, TOLERANCE_RATIO, compressed, raw_pieces
from swayless.design.playing import ShapeLimits, Stop, quickest_stop
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.machine.profile_design_numbers import NumberedMove
from swayless.machine.profile_design_proof import ProfileProof, proved, proved_table
from swayless.machine.profile_design_rate import check_rate, keeps_rate, longest_travel

ADDED_ERROR_RATIO = {"double": 2.0**-36, "float": 2.0**-23}
"""What pieces may add to the error that the plain table leaves at the end: in double the rounding of a
command to twelve digits, in float a unit of the last place. Or half as much as it leaves, if that is more.
"""

LEAST_GAIN_RATIO = 0.05
"""Of the move: a stop that shortens the worst abort by no more than that is not worth its table."""


def settings_for(numbered: NumberedMove) -> tuple[ProfileSettings, ProfileProof]:
    """Make the constants of a block, and prove them.

    Raises
    ------
    DesignError
        If the move does not rest, or rounding exceeds a limit.
    """
    pieces = _pieces(numbered)
    model = block_model(numbered)
    stop, proof = _stop(numbered, pieces, model)
    proof.check_rest(numbered.number.name)
    check_rate(numbered, proof)
    move = numbered.move
    settings = ProfileSettings(
        move.command.tick_s,
        pieces,
        model,
        stop,
        proof.extremes,
        numbered.limits,
        numbered.hold_ratio,
        longest_travel(numbered, proof),
        numbered.start,
        numbered.number,
    )
    check_own_move(numbered, settings)
    return settings, proof


def block_model(numbered: NumberedMove) -> ProfileModel:
    """Give the model in the number type."""
    model, rounded = numbered.model, numbered.rounded_all
    return ProfileModel(
        rounded(model.change),
        rounded(model.system.b),
        rounded(model.output),
        numbered.rounded(model.feedthrough),
    )


def check_own_move(numbered: NumberedMove, settings: ProfileSettings) -> None:
    """Refuse a block that refuses the very move it was made for.

    Raises
    ------
    DesignError
        With the reasons of the block.
    """
    scalar = numbered.number.scalar
    pins = ProfileInput(True, False, scalar(numbered.move.start), scalar(numbered.move.target))
    status = ProfileStatus(MotionProfile(settings).step(pins).status)
    if status:
        raise DesignError(f"profile: the block refuses its own move in {numbered.number.name}: {status.name}")


def _pieces(numbered: NumberedMove) -> Pieces:
    """Find the smallest table that leaves hardly more at the end than the plain one, within the limits."""
    raw = proved_table(numbered, raw_pieces(numbered.shape))
    raw.check_rest(numbered.number.name)
    left = raw.final_error_ratio
    allowed = left + max(0.5 * left, ADDED_ERROR_RATIO[numbered.number.name])

    def is_kept(pieces: Pieces) -> bool:
        found = proved_table(numbered, pieces)
        return found.final_error_ratio <= allowed and _keeps_limits(numbered, found)

    number = numbered.number
    tried = [compressed(numbered.shape, number, ratio, is_kept) for ratio in TABLE_RATIOS[number.name]]
    return min(tried, key=lambda pieces: pieces.stored_bytes(number))


def _stop(numbered: NumberedMove, pieces: Pieces, model: ProfileModel) -> tuple[StopLaw | None, ProfileProof]:
    """Find the quickest stop, if it gains enough, and the smallest table of it that keeps the limits."""
    shape = pieces.values(numbered.number)
    found = quickest_stop(numbered.model, shape, _shape_limits(numbered))
    if found is None or found.rests(shape.size).max() > (1.0 - LEAST_GAIN_RATIO) * (shape.size - 1):
        return None, proved(numbered, pieces, model, None)
    for gains in _tables(numbered, found, shape):
        stop = StopLaw(gains, numbered.rounded_all(found.rest), found.ranges)
        proof = proved(numbered, pieces, model, stop)
        if _keeps_limits(numbered, proof):
            return stop, proof
    raise DesignError(f"stop: in {numbered.number.name} its rounding exceeds the limits; widen them")


def _keeps_limits(numbered: NumberedMove, proof: ProfileProof) -> bool:
    """Whether the move of the design and all its stops keep input and rate."""
    return proof.keeps_input(numbered) and keeps_rate(numbered, proof)


def _tables(numbered: NumberedMove, found: Stop, shape: FloatArray) -> tuple[Pieces, Pieces]:
    """Give the gains in few pieces, and as they are."""
    # What the last input is multiplied by is made as large as the states are, so that all count alike.
    units = np.ones(found.rest.size)
    units[-1] = 2.0 ** np.round(np.log2(np.abs(shape).max()))
    ratio = TOLERANCE_RATIO[numbered.number.name]
    few = compressed(numbered.rounded_all(found.gains * units), numbered.number, ratio)
    return Pieces(few.lengths, few.coefficients / units), raw_pieces(numbered.rounded_all(found.gains))


def _shape_limits(numbered: NumberedMove) -> ShapeLimits:
    """Give the limits of a move by 1, a little within, so that rounding keeps them."""
    move, travel = numbered.move, numbered.travel
    held = float(numbered.references(np.zeros(1))[0])
    low, high = sorted((limit - held) / travel for limit in numbered.limits)
    margin = 64.0 * TOLERANCE_RATIO[numbered.number.name]
    within = margin * (high - low)
    if move.rate_limit_per_s is None:
        return ShapeLimits(low + within, high - within)
    change = move.rate_limit_per_s * move.command.tick_s / abs(travel)
    return ShapeLimits(low + within, high - within, change * (1.0 - margin))
