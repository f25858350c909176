"""Motion profiles from a move to a stored file and back: proved, compressed, refused."""

import json
from dataclasses import replace

import numpy as np
import pytest

from swayless.controller.profile import MotionProfile, ProfileInput
from swayless.controller.profile.compression import raw_pieces
from swayless.design.optimal import Command, LinearPlant, MoveTask, Robustness, time_optimal
from swayless.design.playing import shape_model
from swayless.errors import DesignError, FileError
from swayless.machine.profile_design import make_profile_design
from swayless.machine.profile_design_file import load_profile_design, profile_design_text, same_profile
from swayless.machine.profile_design_move import ProfileMove

OSCILLATOR = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
MASS = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])


@pytest.fixture(scope="module")
def oscillator():
    """The example of Xu and Meckl: 58 ticks of at most 5 either way."""
    command = time_optimal(MoveTask(OSCILLATOR, 0.005, (-5.0, 5.0), 1.0, robustness=Robustness(1))).command
    return ProfileMove(OSCILLATOR, command, (-5.0, 5.0), 0.0, 1.0, robustness=Robustness(1))


@pytest.fixture(scope="module", params=["double", "float"])
def design(request, oscillator):
    return make_profile_design("osc", "osc.toml", oscillator, request.param)


@pytest.fixture(scope="module")
def stored_text(oscillator):
    return profile_design_text(make_profile_design("osc", "osc.toml", oscillator))


def test_the_example_is_played_from_seven_switches_and_rests_in_51_ticks_after_an_abort(oscillator):
    made = make_profile_design("osc", "osc.toml", oscillator)
    assert made.settings.pieces.lengths.tolist() == [10, 1, 17, 1, 20, 1, 8]
    assert made.table_bytes == (464, 70)
    assert made.settings.rest_ticks == 51
    # Another library may cut a piece a tick later: decision 31 says 1230.
    assert made.stop_bytes[0] == 1880
    assert 1150 <= made.stop_bytes[1] <= 1300
    assert made.settings.stop.ranges.tolist() == [[1, 6]]
    assert (made.guarantee.final_error_ratio, made.guarantee.stop_error_ratio) == (1e-12, 1e-12)
    low, high = made.settings.extremes.rest
    assert low == 0.0
    assert high < 0.4  # no stop of this move comes to rest beyond 0.4 of the travel


def test_in_float_less_is_promised(oscillator):
    made = make_profile_design("osc", "osc.toml", oscillator, "float")
    assert made.table_bytes == (232, 42)
    assert 1e-8 < made.guarantee.final_error_ratio <= 1e-6
    assert 1e-8 < made.guarantee.stop_error_ratio <= 2e-6
    assert made.stop_bytes == (940, 186)


def test_two_thousand_ticks_of_switching_are_two_pieces_and_their_stop_is_one():
    shape = np.repeat([1.0, -1.0], 1000)
    move = ProfileMove(MASS, Command(0.01, shape, 0.0), (-1.0, 1.0), 0.0, 100.0)
    made = make_profile_design("mass", "mass.toml", move)
    assert made.table_bytes == (16000, 20)
    assert made.stop_bytes == (24000, 26)  # a mass is braked evenly: three gains and a length
    assert made.settings.rest_ticks == 1000


def test_a_stored_design_is_read_back_as_the_same_block(design, tmp_path):
    path = tmp_path / "osc.profile.json"
    path.write_text(profile_design_text(design), encoding="ascii")
    loaded = load_profile_design(path)
    assert profile_design_text(loaded) == profile_design_text(design)
    assert same_profile(loaded, design) == []
    scalar = design.settings.number.scalar
    blocks = [MotionProfile(each.settings) for each in (design, loaded)]
    for tick in range(70):
        pins = ProfileInput(tick == 0, tick == 5, scalar(0.0), scalar(1.0))
        first, second = (block.step(pins) for block in blocks)
        assert first == second


def test_designs_that_differ_say_where(design):
    other = replace(design, move=replace(design.move, limits=(-5.0, 6.0)), generator="another")
    assert same_profile(design, other) == ["limit: differs"]
    named = replace(design, name="other")
    assert same_profile(design, named) == ["name: stored 'osc', fresh 'other'"]


def test_how_a_design_is_cut_into_pieces_is_no_difference(design):
    plain = raw_pieces(design.settings.pieces.values(design.settings.number))
    assert same_profile(design, replace(design, settings=replace(design.settings, pieces=plain))) == []
    assert same_profile(design, replace(design, settings=replace(design.settings, stop=None))) == []


def test_last_digits_of_another_library_are_no_problem(stored_text, tmp_path):
    document = json.loads(stored_text)
    document["hold_ratio"] = np.nextafter(1.0, 2.0)
    document["plant"]["a"][0][1] *= 1.0 + 1e-14
    file = tmp_path / "other.profile.json"
    file.write_text(json.dumps(document), encoding="ascii")
    assert load_profile_design(file).settings.hold_ratio == np.nextafter(1.0, 2.0)


def broken(document, path, value):
    *way, last = path
    for key in way:
        document = document[key]
    document[last] = value


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (["schema"], "swayless.profile/2", "schema"),
        (["number"], "int32", 'number = "int32": unknown number type'),
        (["tick_s"], 0, "tick_s = 0: must be from 1e-06 to 1"),
        (["tick_s"], 1e308, "tick_s = 1e+308: must be from 1e-06 to 1"),
        (["tick_s"], 0.006, "model: is not the one of this plant, tick and robustness"),
        (["limit"], [1.0], "limit = [1.0]: must be an array of 2"),
        (["limit"], [-5.0, 1e308], "limit[1] = 1e+308: must be at most 1e+30 in size"),
        (["limit"], [-4.0, 5.0], "command: -4.68263 to 4.68263: the limit is -4 to 5"),
        (["rate_limit_per_s"], 1.0, "command: changes by"),
        (["start"], 1.0, "start = 1.0, target = 1.0: must be finite and differ"),
        (["start"], 1e-6, "command: initial_value = 0: the plant stays at 1e-06 under 1e-06 only"),
        (["target"], 1.0 + 1e-6, "command: final_value = 1: the plant stays at 1 under 1 only"),
        (["start"], 1.0 - 1e-9, "inputs must be at most 1e+09 times the travel"),
        (["start"], 0.5, "command: initial_value = 0: the plant stays at 0.5 under 0.5 only"),
        (["robust_order"], 9, "robust_order = 9: must be an integer from 0 to 6"),
        (["robust_order"], 0, "model: is not the one of this plant, tick and robustness"),
        (["split_ratio"], 0.1, "split_ratio: robust order and split"),
        (["plant", "a"], [[0.0, 1.0], [2.0]], "plant: rows must be of one length"),
        (["plant", "a"], [[1.0, 0.0], [0.0, 2.0]], "unstable"),
        (["plant", "c"], [0.0, 1.6], "command: final_value"),
        (["command", "hold"], "second-order", "command.hold"),
        (["command", "values"], [], "command.values"),
        (["command", "values", 3], 0.0, "table: does not play the command from start to target"),
        (["command", "values", 3], "x", 'command.values[3] = "x": must be a number'),
        (["hold_ratio"], 1.5, "hold_ratio: = 1.5: must be 1.0, as of this plant"),
        (["max_travel"], -1.0, "max_travel: profile: max_travel = -1.0: must be above 0"),
        (["max_travel"], 1.0, "max_travel: = 1.0: must be 1125899906842624.0"),
        (["extremes", "shape"], [-4.7, 4.7], "extremes: must be"),
        (["extremes", "rest"], [0.0, 0.1], "extremes: must be"),
        (["table", "lengths", 0], 11, "table: lasts 59 ticks, the command 58"),
        (["table", "coefficients", 1, 0], 2.2, "table: does not play the command from start to target"),
        (["table", "coefficients", 1], [1.0, 2.0], "table: rows must be of one length"),
        (["model", "change", 0, 0], 0.01, "model: is not the one of this plant"),
        (["model", "output"], [1.0], "model: profile: model of shapes"),
        (["stop", "coefficients", 0, 0, 0], 0.01, "guarantee.stop_error_ratio: promises"),
        (["stop", "rest", 0], 0.5, "guarantee.stop_error_ratio: promises"),
        (["stop", "ranges", 0, 1], 8, "extremes: must be"),
        (
            ["stop", "ranges", 0, 1],
            57,
            "max_travel: profile: stop of 47 ticks from tick 57: must be over before",
        ),
        (["stop", "ranges", 0, 0], 7, "stop: profile: stop of ranges [[7, 6]]: must be first and last tick"),
        (["stop", "rest"], [1.0, 2.0], "stop: profile: stop of gains"),
        (["guarantee", "final_error_ratio"], 1e-18, "guarantee.final_error_ratio: promises 1e-18"),
        (["guarantee", "final_error_ratio"], 1e-9, "guarantee.final_error_ratio: promises 1e-09"),
        (["guarantee", "stop_error_ratio"], 1e308, "guarantee.stop_error_ratio: promises 1e+308"),
        (["guarantee", "rounding_gain"], 1e-18, "guarantee.rounding_gain: promises 1e-18"),
        (["guarantee", "final_swing_ratio"], 0.1, "guarantee.final_swing_ratio: = 0.1: must be None"),
        (["surplus"], 1, "surplus: unknown key"),
    ],
)
def test_a_stored_design_that_is_not_what_it_promises_is_refused(stored_text, tmp_path, path, value, message):
    document = json.loads(stored_text)
    broken(document, path, value)
    file = tmp_path / "bad.profile.json"
    file.write_text(json.dumps(document), encoding="ascii")
    with pytest.raises(FileError) as refused:
        load_profile_design(file)
    assert message in str(refused.value)
    assert str(refused.value).startswith(str(file))


@pytest.mark.parametrize("text", ["", "[]", "{", "null", '{"schema": "swayless.profile/1"}', "[" * 5000])
def test_garbage_is_refused(tmp_path, text):
    file = tmp_path / "bad.profile.json"
    file.write_text(text, encoding="ascii")
    with pytest.raises(FileError, match=r"bad\.profile\.json"):
        load_profile_design(file)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"limits": (5.0, -5.0)}, "limit = 5.0 to -5.0: must rise, up to 1e+30 in size"),
        ({"rate_limit_per_s": 0.0}, "rate_limit = 0.0: must be finite and > 0"),
        ({"target": 2.0}, "command: final_value = 1: the plant stays at 2 under 2 only"),
        ({"limits": (-1.0, 1.0)}, "command: -4.68263 to 4.68263: the limit is -1 to 1"),
    ],
)
def test_what_is_no_move_is_refused(oscillator, change, message):
    with pytest.raises(DesignError) as refused:
        replace(oscillator, **change)
    assert message in str(refused.value)


def test_a_command_that_does_not_rest_is_refused(oscillator):
    swinging = Command(0.005, np.full(58, 1.0), 1.0)
    with pytest.raises(DesignError, match=r"command: leaves .* of the states that the move has had"):
        make_profile_design("osc", "osc.toml", replace(oscillator, command=swinging))


def test_under_a_first_order_hold_the_block_plays_what_a_drive_joins_by_straight_lines():
    tick_s, ticks = 0.02, 40
    move_1 = ProfileMove(OSCILLATOR, _first_order_command(tick_s, ticks), (-9.0, 9.0), 0.0, 1.0)
    made = make_profile_design("osc", "osc.toml", move_1)
    profile = MotionProfile(made.settings)
    played = [profile.step(ProfileInput(True, False, 0.0, 1.0)).reference for _ in range(ticks + 1)]
    # A hundred small steps of the drive between two ticks, of the plant's own equations.
    state, before = np.zeros(2), 0.0
    fine = tick_s / 100.0
    for reference in played:
        for step in range(100):
            value = before + (reference - before) * (step + 0.5) / 100.0
            middle = state + 0.5 * fine * (OSCILLATOR.a @ state + OSCILLATOR.b * value)
            state = state + fine * (OSCILLATOR.a @ middle + OSCILLATOR.b * value)
        before = reference
    # The midpoint rule in steps of 2e-4 s, at 10 rad/s, over 0.8 s: some 1e-6 of states of order 1.
    assert state == pytest.approx(OSCILLATOR.equilibrium(1.0)[0], abs=1e-5)


def _first_order_command(tick_s, ticks):
    """The least of all that rest under straight lines, by the block's own model; the test checks its end."""
    model = shape_model(OSCILLATOR, tick_s, "first-order")
    values = np.linalg.lstsq(model.kept @ model.system.reach(ticks), model.final, rcond=None)[0]
    return Command(tick_s, values, 1.0, hold="first-order")
