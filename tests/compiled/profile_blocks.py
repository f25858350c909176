"""Small motion profiles of every kind of table, plants of one state to four, in both number types."""

import dataclasses

import numpy as np

from swayless.codegen.profile_model import ProfileCode, ProfileOrigin
from swayless.controller import number_type
from swayless.controller.profile import (
    Extremes,
    MotionProfile,
    Pieces,
    ProfileInput,
    ProfileModel,
    ProfileSettings,
    StopLaw,
)

_RANDOM = np.random.default_rng(7)
LAG = ProfileModel([[-0.1]], [0.1], [1.0], 0.0), StopLaw(Pieces([1], [[[0.7, 0.2]]]), [1.0, -0.1], [[1, 9]])
NEVER = LAG[0], None
MASS = (
    ProfileModel([[0.0, 1.0], [0.0, 0.0]], [0.5, 1.0], [1.0, 0.0], 0.0),
    StopLaw(
        Pieces([1, 1], [[[0.0, -0.75, 0.125]], [[0.0, -0.25, 0.0]]]),
        [1.0, 0.875, 0.0],
        [[2, 3], [6, 6], [9, 10]],
    ),
)
SHORT = (
    LAG[0],
    StopLaw(Pieces([3, 1, 2], 0.3 * _RANDOM.normal(size=(3, 1, 2))), [1.0, 0.25], [[1, 2], [4, 6]]),
)
LINEAR = (
    MASS[0],
    StopLaw(Pieces([4, 1], 0.01 * _RANDOM.normal(size=(2, 2, 3))), [0.01, 0.02, 0.0], [[1, 7]]),
)
FOUR = (
    ProfileModel(0.1 * _RANDOM.normal(size=(4, 4)), _RANDOM.normal(size=4), _RANDOM.normal(size=4), 0.3),
    StopLaw(
        Pieces([5, 2], 0.1 * _RANDOM.normal(size=(2, 4, 5))), 0.1 * _RANDOM.normal(size=5), [[1, 1], [3, 4]]
    ),
)
"""Not a plant that anybody would move: only its arithmetic matters here."""

PIECES = {
    "plain": Pieces(np.ones(14, int), _RANDOM.normal(size=(14, 1))),
    "switching": Pieces([5, 3, 1, 4], [[1.3], [-1.1], [0.7], [-0.1]]),
    "straight": Pieces([6, 1, 5], _RANDOM.normal(size=(3, 2))),
    "polynomial": Pieces([8, 5], _RANDOM.normal(size=(2, 5))),
}
BLOCKS = {
    "plain, one state": (PIECES["plain"], LAG, 1.0, 9.0),
    "switching, a mass": (PIECES["switching"], MASS, 0.0, 2.0**49),
    "straight, one state": (PIECES["straight"], LAG, -0.7, 3.0),
    "plain, its stop in switches": (PIECES["plain"], SHORT, 0.3, 9.0),
    "switching, its stop in lines": (PIECES["switching"], LINEAR, 1.0, 9.0),
    "plain, no stop": (PIECES["plain"], NEVER, 0.3, 9.0),
    "polynomial, four states": (PIECES["polynomial"], FOUR, 0.4, 5.0),
}
"""Table, plant and stop, ratio of holding, longest travel."""


def block(name, number):
    """Make a block; the limits allow a bit more than the design's move, by 1 from 0.5."""
    pieces, (model, stop), hold_ratio, max_travel = BLOCKS[name]
    kind = number_type(number)

    def held(values):
        array = np.asarray(values, dtype=float)
        return array if number == "double" else array.astype(np.float32).astype(float)

    pieces = Pieces(pieces.lengths, held(pieces.coefficients))
    model = ProfileModel(
        held(model.change), held(model.input), held(model.output), float(held(model.feedthrough))
    )
    stop = stop and StopLaw(
        Pieces(stop.pieces.lengths, held(stop.pieces.coefficients)), held(stop.rest), stop.ranges
    )
    ratio = float(held(hold_ratio))
    loose = Extremes((-1.0, 1.0), (0.0, 1.0))
    settings = ProfileSettings(0.01, pieces, model, stop, loose, (-64.0, 64.0), max_travel=1.0, number=kind)
    settings = dataclasses.replace(
        settings,
        extremes=extremes_of(settings, ratio),
        limits=(float(held(-6.0)), float(held(7.0))),
        hold_ratio=ratio,
        max_travel=float(held(max_travel)),
    )
    return ProfileCode(settings, ProfileOrigin("cart", "swayless", None, ("One line of facts.",), (0.5, 1.5)))


def extremes_of(settings, hold_ratio):
    """Play a move by 1 from 0, and every stop of it: without holding the reference is the shape itself."""
    shapes, rests = [0.0, hold_ratio], [0.0]
    for abort_at in range(1, settings.pieces.ticks + 1):
        profile, zero, one = MotionProfile(settings), settings.number.scalar(0), settings.number.scalar(1)
        out, tick = profile.step(ProfileInput(True, False, zero, one)), 0
        while out.busy:
            shapes.append(float(out.reference))
            tick += 1
            out = profile.step(ProfileInput(True, tick == abort_at, zero, one))
        rests.append(float(out.position))
    return Extremes((min(shapes), max(shapes)), (min(rests), max(rests)))
