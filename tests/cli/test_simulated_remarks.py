"""`swayless simulate` says where a move leaves its machine, and what the block says of it."""

from __future__ import annotations

import json

import pytest

from swayless.cli.simulated_control import Press, shaped_reference
from swayless.controller import Status
from swayless.machine import example_text, load_machine
from swayless.machine.designing import design_machine
from swayless.machine.move_section import Hoist
from swayless.machine.running import shaper_settings

CRANE = """
name = "x"
[crane]
rope_length = [3, 9]
hoist_speed = 0.4
max_speed = 0.8
acceleration = 0.4
[controller]
tick = "20 ms"
law = "phase"
[[row]]
name = "a"
family = "zv"
"""
ARM = """
name = "turning"
[arm]
position = ["-40 deg", "50 deg"]
frequency = [2.1, 3.3]
position_speed = "50 deg/s"
max_speed = 0.7
acceleration = 1.5
[drive]
counts_per_m_s = 100000
minimum_speed = 0.05
[controller]
tick = "8 ms"
number = "NUMBER"
law = "modified"
[[row]]
name = "one"
family = "zv"
tolerance = 0.1
"""


@pytest.fixture
def moved(tmp_path, run):
    """Give the move of a machine on the command line."""

    def moved(text, *arguments):
        path = tmp_path / "machine.toml"
        path.write_text(text)
        done = run("simulate", path, *arguments, "--json")
        assert (done.code, done.err) == (0, "")
        return json.loads(done.out)["moves"][0]

    return moved


def statuses(move):
    """Bits by contender."""
    return {case["moved_by"]: case["status"] for case in move["cases"]}


def test_a_hoist_from_a_longer_rope_faster_than_the_machine_s_is_said_by_move_and_block(moved, run, tmp_path):
    asked = ("--move", "2 s", "--hoist", "20 m to 3 m at 4 m/s")
    move = moved(CRANE, *asked)
    assert move["remarks"] == [
        "a rope of 20 m: outside the machine's, 3 to 9 m",
        "a hoist at 4 m/s: faster than the machine's hoist_speed, 0.4 m/s",
        "on 20 to 3 m of rope, by unshaped, 1 a: ROPE_OUT_OF_RANGE,"
        " the rope length is out of range and was clamped to it",
        "on 20 to 3 m of rope, by 1 a: ROPE_JUMP,"
        " the rope length is farther off than the hoist could move: the last one holds",
        "on 20 to 3 m of rope, by 1 a: ROPE_FROZEN,"
        " the hoist moves and the rope length does not: one of them is wrong",
    ]
    ramp = next(name for name in statuses(move) if name.startswith("ramp of"))
    assert statuses(move)["1 a"] == ["ROPE_OUT_OF_RANGE", "ROPE_JUMP", "ROPE_FROZEN"]
    assert statuses(move)[ramp] == []
    printed = run("simulate", tmp_path / "machine.toml", *asked).out.splitlines()
    assert [line for line in printed if line in move["remarks"]] == move["remarks"]


def test_moves_of_the_machine_file_are_watched_too(moved):
    assert moved(CRANE + "[[move]]\nrope_length = [3, 9.5]\n")["remarks"] == [
        "a rope of 9.5 m: outside the machine's, 3 to 9 m",
        "on 9.5 m of rope, by unshaped, 1 a: ROPE_OUT_OF_RANGE,"
        " the rope length is out of range and was clamped to it",
    ]


def test_a_block_that_measures_no_rope_leaves_it_to_the_move_to_say(moved):
    move = moved(example_text("workshop-crane"), "--move", "1 s", "--rope-length", "12 m", "--row", "1")
    assert move["remarks"] == ["a rope of 12 m: outside the machine's, 2 to 10 m"]
    assert {tuple(bits) for bits in statuses(move).values()} == {()}


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_all_of_the_machine_s_range_at_its_full_speed_is_nothing_to_remark(moved, number):
    text = ARM.replace("NUMBER", number)
    # 50 deg end the range, and are no 12 digits of rad, nor thousandths: neither rounding is a way out of it.
    whole = moved(text, "--move", "1 s", "--sweep", "-40 deg to 50 deg at 50 deg/s")
    still = moved(text, "--move", "1 s")
    assert (whole["remarks"], still["remarks"]) == ([], [])


def test_angles_are_remarked_in_degrees(moved):
    move = moved(ARM.replace("NUMBER", "float"), "--move", "1 s", "--sweep", "-60 deg to 50 deg at 90 deg/s")
    assert move["remarks"] == [
        "a position of -60 deg: outside the machine's, -40 to 50 deg",
        "a sweep at 90 deg/s: faster than the machine's position_speed, 50 deg/s",
        "on -60 to 50 deg, by unshaped, 1 one: ROPE_OUT_OF_RANGE,"
        " the position is out of range and was clamped to it",
    ]


def test_a_command_that_counts_as_nothing_is_said(moved):
    move = moved(ARM.replace("NUMBER", "float"), "--move", "1 s at 0.04 m/s", "--position", "0")
    assert move["remarks"] == [
        "on 0 deg, by unshaped, 1 one: BELOW_MINIMUM, the command is below the minimum and counts as 0"
    ]


def test_a_frequency_that_no_part_gives_an_arm_is_said(moved):
    move = moved(example_text("flexible-arm"), "--move", "1 s", "--frequency", "4.2", "--frequency", "6")
    assert move["remarks"] == ["a frequency of 6 Hz: outside the machine's, 4 to 5 Hz"]


def test_the_status_of_a_block_is_that_of_all_its_ticks(tmp_path):
    path = tmp_path / "crane.toml"
    path.write_text(CRANE)
    settings = shaper_settings(design_machine(load_machine(path)))
    # Out of range in the first second only, which the ten that follow do not hide.
    shaped = shaped_reference(settings, 1, Press(0, 100), 0.8, (Hoist(9.3, 6.0, 0.3, 0.0), 9.3))
    assert Status(shaped.status) == Status.ROPE_OUT_OF_RANGE
