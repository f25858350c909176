"""What a motion profile refuses to be made of, and that it plays what was enumerated."""

from dataclasses import replace

import numpy as np
import pytest

from swayless.controller import number_type
from swayless.controller.profile import (
    Extremes,
    MotionProfile,
    Pieces,
    ProfileInput,
    ProfileModel,
    ProfileSettings,
    ProfileStatus,
    StopLaw,
    explain_profile,
    played_move,
    played_stops,
)
from swayless.errors import ControllerError

MODEL = ProfileModel([[0.0, 0.25], [-0.125, -0.0625]], [0.0, 0.125], [0.75, 0.5], 0.25)
GAINS = np.array([[[0.5, -1.0, 0.25], [0.25, 0.5, -0.125]], [[-0.5, 1.0, 0.125], [0.0, 0.25, 0.5]]])
STOP = StopLaw(Pieces([2, 1], GAINS), [1.0, 0.5, 0.25], [[1, 2], [4, 5]])
TABLE = Pieces([3, 2, 4], [[1.0, 0.125], [-0.5, 0.25], [-1.0, 0.5]])
BLOCK = ProfileSettings(
    0.01, TABLE, MODEL, STOP, Extremes((-4.0, 4.0), (-2.0, 2.0)), (-16.0, 16.0), hold_ratio=0.5
)


@pytest.mark.parametrize("number", ["double", "float"])
def test_every_stop_is_played_with_the_bits_that_were_enumerated(number):
    kind = number_type(number)
    block = replace(BLOCK, number=kind)
    move = played_move(TABLE, MODEL, kind)
    stops = played_stops(STOP, move.aborts, kind)
    for abort_at in range(1, 6):
        begins = 4 if abort_at == 3 else abort_at
        profile, shapes = MotionProfile(block), []
        for tick in range(begins + STOP.ticks + 1):
            output = profile.step(ProfileInput(tick == 0, tick == abort_at, kind.scalar(0), kind.scalar(1)))
            shapes.append(float(output.reference))
        assert shapes[:begins] == move.shape[:begins].tolist()
        assert shapes[begins:-1] == stops.inputs[:, begins - 1].tolist()
        assert float(output.position) == stops.rests[begins - 1]


@pytest.mark.parametrize("number", ["double", "float"])
def test_position_is_the_models_when_the_tick_begins(number):
    kind = number_type(number)
    profile, positions = MotionProfile(replace(BLOCK, number=kind)), []
    for tick in range(TABLE.ticks):
        pins = ProfileInput(tick == 0, False, kind.scalar(1), kind.scalar(3))
        positions.append(float(profile.step(pins).position))
    move = played_move(TABLE, MODEL, kind)
    shapes = move.states[:-1] @ MODEL.output + MODEL.feedthrough * move.shape
    # All factors are short binary fractions, but states grow digits: a few units of the last place in float.
    assert positions == pytest.approx((1.0 + 2.0 * shapes).tolist(), abs=1e-6 if number == "float" else 1e-14)


def test_where_a_stop_would_rest_beyond_the_limits_the_move_is_refused():
    # The references of table and stops stay below 16, but holding a rest at 2 x 20 takes 0.5 x 40.
    block = replace(BLOCK, extremes=Extremes((-0.5, 0.5), (0.0, 2.0)))
    output = MotionProfile(block).step(ProfileInput(True, False, 0.0, 20.0))
    assert output.status == ProfileStatus.LIMIT_EXCEEDED
    assert MotionProfile(block).step(ProfileInput(True, False, 0.0, 15.0)).busy


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tick_s": 0.0}, "profile: tick_s = 0.0: must be finite and > 0"),
        ({"limits": (1.0, 1.0)}, "profile: limits = (1.0, 1.0): must rise"),
        ({"limits": (-np.inf, 1.0)}, "profile: limits = -inf: must be finite, at most 1e+30 in size"),
        ({"max_travel": 0.0}, "profile: max_travel = 0.0: must be above 0"),
        ({"max_travel": 2e15}, "profile: max_travel = 2000000000000000.0: must be finite, at most"),
        ({"hold_ratio": np.nan}, "profile: hold_ratio = nan: must be finite"),
        ({"extremes": Extremes((0.0, 2e9), (0.0, 1.0))}, "profile: extremes.shape = 2000000000.0: must be"),
        ({"pieces": Pieces([1], [[[1.0]]])}, "profile: pieces of rows"),
        (
            {"stop": StopLaw(Pieces([1], [[[1.0]]]), [1.0], [[1, 1]])},
            "profile: stop of 1 gains a tick: must be 3",
        ),
        (
            {"stop": replace(STOP, ranges=[[1, 2], [4, 6]])},
            "profile: stop of 3 ticks from tick 6: must be over before the move, which has 9",
        ),
        ({"number": number_type("int32")}, "profile: number = 'int32': must be double or float"),
        (
            {"number": number_type("float"), "hold_ratio": 0.1},
            "profile: hold_ratio: every value must be a float",
        ),
    ],
)
def test_what_is_no_motion_profile_is_refused(change, message):
    with pytest.raises(ControllerError) as refused:
        replace(BLOCK, **change)
    assert message in str(refused.value)


def test_models_and_stops_of_shapes_that_do_not_fit_are_refused():
    with pytest.raises(ControllerError, match=r"profile: model of shapes \(1, 1\), \(2,\), \(2,\): must be"):
        ProfileModel([[0.0]], [1.0, 2.0], [1.0, 2.0], 0.0)
    with pytest.raises(ControllerError, match=r"profile: stop of gains \(1, 1\) and rest \(2,\): must be"):
        StopLaw(Pieces([1], [[1.0]]), [1.0, 2.0], [[1, 1]])


@pytest.mark.parametrize(
    "ranges", [[], [1, 2], [[0, 1]], [[2, 1]], [[1, 2], [3, 4]], [[4, 5], [1, 2]], [[1, 2, 3]]]
)
def test_ranges_that_do_not_rise_apart_from_each_other_are_refused(ranges):
    with pytest.raises(ControllerError, match=r"profile: stop of ranges \[.*\]: must be first and last tick"):
        replace(STOP, ranges=ranges)


def test_every_bit_is_explained():
    assert len({explain_profile(bit) for bit in ProfileStatus}) == len(ProfileStatus) == 8
