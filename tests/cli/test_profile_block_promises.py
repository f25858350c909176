"""What `build` says of a motion profile: of split poles, limits of the rate, float, other moves."""

import json
from dataclasses import replace

import pytest

from swayless.cli.profile_summary import profile_lines
from swayless.design.optimal import Command, LinearPlant
from swayless.machine.profile_design import make_profile_design
from swayless.machine.profile_design_move import ProfileMove

HELD = """name = "held"
[plant]
numerator = [3.0]
denominator = [1.0, 0.4, 37.0]
[move]
tick = "20 ms"
start = 0.7
target = 3.0
limit = [-20, 60]
"""


@pytest.fixture
def built(run, tmp_path):
    """Build with some more keys; give the lines, the facts, and the head of the C."""

    def build(more):
        file, out = tmp_path / "held.toml", tmp_path / "out"
        file.write_text(HELD + more)
        printed = run("build", file, "-o", out, "--no-verify")
        assert printed.code == 0, printed.err
        known = json.loads(run("build", file, "-o", out, "--no-verify", "--json").out)
        head = (out / "c" / "held_profile.h").read_text().split("*/")[0]
        return printed.out, known, head

    return build


@pytest.mark.usefixtures("blank_figures")
def test_split_poles_are_named_with_what_the_plant_as_given_keeps(built):
    lines, known, head = built('ei = "10 %"\n')
    promise = known["guarantee"]
    assert promise["final_swing_ratio"] > 0.005
    move, worst = promise["final_swing_ratio"], max(promise["final_swing_ratio"], promise["stop_swing_ratio"])
    sentence = f"swings then by up to {100 * move:g} % of the travel, after an abort {100 * worst:g} %"
    for text in (lines, head):
        assert sentence in text
        assert "where frequencies are 10 % off: the move of the design leaves" in text
    assert "Design: 0.7 to 3, ei 10 %, zero-order hold" in head


@pytest.mark.usefixtures("blank_figures")
def test_a_limit_of_the_rate_is_named_with_how_strictly_it_is_kept(built):
    lines, known, head = built("rate_limit = 300\n")
    assert known["rate_limit_per_s"] == 300.0
    assert "Design: 0.7 to 3, rate limit 300 a second, zero-order hold" in head
    excess = known["guarantee"]["rate_excess_ratio"]
    kept = ", that of the rate too" if excess == 0.0 else f", that of the rate to {excess:g} of itself"
    assert f"of the limits{kept}\n" in lines
    assert f"Limits are kept{kept}." in head


@pytest.mark.usefixtures("blank_figures")
def test_in_float_other_moves_may_leave_more_and_it_is_said_how_much(built):
    lines, known, head = built('number = "float"\n')
    gain = known["guarantee"]["rounding_gain"]
    assert 1e-9 < gain < 1e-6
    sentence = f"Another start or travel T adds at most {gain:g} R / |T|, R its largest reference"
    assert f"{sentence}\n" in lines
    assert f"{sentence}." in head
    assert known["guarantee"]["final_swing_ratio"] is None
    assert "note:" not in lines


@pytest.mark.parametrize(("number", "more"), [("float", "; use double"), ("double", "")])
def test_what_hardly_rests_is_noted(number, more):
    mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    move = ProfileMove(mass, Command(0.5, [1.0, 1.0, -1.0, -1.0], 0.0), (-1.5, 1.5), 0.0, 1.0)
    made = make_profile_design("mass", "mass.toml", move, number)
    notes = [
        [line for line in profile_lines(replace(made, guarantee=guarantee), "new") if "note" in line]
        for guarantee in (made.guarantee, replace(made.guarantee, stop_error_ratio=0.005))
    ]
    assert notes == [[], [f"note: 0.5 % of the largest is much, the plant hardly rests{more}"]]
