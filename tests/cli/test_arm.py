"""An arm whose frequency depends on its position, through every command."""

import json

import numpy as np
import pytest

from swayless.cli.ways import ways
from swayless.machine import example_text, load_design
from swayless.machine.running import shaper_settings

ANGLES = [
    ("position = [3.02, 3.20, 3.48, 3.71, 3.94]", 'position = ["-40 deg", "-20 deg", 0, "0.5 rad", 1]'),
    ("position_speed = 0.35", 'position_speed = "20 deg/s"'),
    ("[5.5, 5.05, 4.45, 4.05, 3.7]", "[5.5, 4.4, 3.7, 4.1, 4.8]"),
]


@pytest.fixture
def arm(tmp_path):
    path = tmp_path / "arm.toml"
    path.write_text(example_text("elbow-arm"))
    return path


def turning(path, *changes):
    """The same arm turning on a joint, slowest in the middle."""
    text = path.read_text()
    for old, new in (*ANGLES, *changes):
        assert old in text
        text = text.replace(old, new)
    path.write_text(text)


def simulated(run, *arguments):
    (move,) = json.loads(run("simulate", *arguments, "--json").out)["moves"]
    return move["cases"]


def test_where_the_arm_stands_it_leaves_no_more_than_twice_what_its_row_promises(run, arm):
    """A move is two changes of speed; an unshaped one leaves more."""
    cases = simulated(run, "arm.toml", "--move", "2 s", *(f"--position={p}" for p in (3.1, 3.3, "3.64 m")))
    shaped = [case for case in cases if case["knob"] == 1]
    assert [case["position"] for case in shaped] == [[3.1, 3.1], [3.3, 3.3], [3.64, 3.64]]
    assert [case["frequency_hz"] for case in shaped] == pytest.approx([5.3, 4.835714, 4.171739], abs=1e-6)
    assert all(case["residual_ratio"] <= 0.2 for case in shaped)
    jumps = [case for case in cases if case["moved_by"].startswith("jump")]
    assert all(jump["residual_ratio"] > case["residual_ratio"] for jump, case in zip(jumps, shaped))  # noqa: B905


def test_a_sweep_is_followed_and_drawn(run, arm, tmp_path):
    move = ("--move", "0.8 m", "--sweep", "3.02 m to 3.9 m at 0.35 m/s from 0.2 s")
    cases = {case["moved_by"]: case for case in simulated(run, "arm.toml", *move)}
    assert cases["1 any reach"]["position"] == [3.02, 3.9]
    assert cases["1 any reach"]["residual_ratio"] < 0.1 < cases["jump, no ramp"]["residual_ratio"]
    done = run("simulate", "arm.toml", *move, "-o", "moves")
    assert "sweep 3.02 to 3.9 m at 0.35 m/s from 0.2 s" in done.out
    assert "position [m]" in done.out
    (record,) = (tmp_path / "moves").glob("*.csv")
    names, *lines = record.read_text().splitlines()
    assert names.startswith("time_s,frequency_hz,")
    hertz = np.array([float(line.split(",")[1]) for line in lines])
    assert (hertz.max(), hertz.min()) == pytest.approx((5.5, 3.760870), abs=1e-5)  # straight to 3.9 m
    assert (tmp_path / "moves" / "elbow_arm-move-1-rope-1.svg").stat().st_size > 10_000


def test_angles_are_read_and_shown_in_degrees_and_simulated_and_recorded_in_radians(run, arm, tmp_path):
    turning(arm)
    sweep = ("--sweep", "-30 deg to 40 deg at 20 deg/s")
    (case,) = [case for case in simulated(run, "arm.toml", *sweep) if case["knob"] == 1]
    assert case["position"] == pytest.approx([-np.pi / 6, np.pi * 2 / 9], abs=1e-9)
    assert "position [deg]" in run("simulate", "arm.toml").out
    done = run("simulate", "arm.toml", *sweep, "-o", "moves")
    assert "sweep -30 to 40 deg at 20 deg/s from 0 s" in done.out
    assert "  -30 to 40  " in done.out
    (record,) = (tmp_path / "moves").glob("*.csv")
    names, *lines = record.read_text().splitlines()
    assert names.startswith("time_s,frequency_hz,position_rad,")
    places = [float(line.split(",")[2]) for line in lines]
    assert (places[0], places[-1]) == pytest.approx((-np.pi / 6, np.pi * 2 / 9), abs=1e-8)  # nine digits


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (("--hoist", "3 m to 4 m at 0.1 m/s"), "--hoist = {...}: only a move of a crane has this"),
        (("--frequency", "4"), "--frequency = 4: only a move of an arm without positions has this"),
        (("--position", "30 deg"), '--position = "30 deg": is not a length'),
        (("--sweep", "3.1 to 3.9 at 0"), '--sweep rate = "0": must be > 0'),
        (("--sweep", "3.1 to 3.1 at 0.1"), "is where it begins: a sweep goes somewhere else"),
        (("--position", "3.1", "--sweep", "3.1 to 3.9 at 0.1"), "exclude each other: keep one"),
    ],
)
def test_moves_that_such_an_arm_does_not_make_are_refused(run, arm, arguments, problem):
    done = run("simulate", "arm.toml", *arguments)
    assert done.code == 2
    assert problem in done.err


def test_moves_of_the_machine_file_have_positions_and_sweeps(run, arm):
    arm.write_text(
        arm.read_text()
        + '[[move]]\nposition = [3.1, "3.5 m"]\n[[move]]\nsweep = { from = 3.1, to = 3.9, rate = 0.3 }\n'
    )
    moves = json.loads(run("simulate", "arm.toml", "--json").out)["moves"]
    found = [{tuple(case["position"]) for case in move["cases"]} for move in moves]
    assert found == [{(3.02, 3.9)}, {(3.1, 3.1), (3.5, 3.5)}, {(3.1, 3.9)}]  # the first is the example's own


def test_the_stop_distance_is_that_where_the_arm_is_slowest(run, arm, tmp_path):
    turning(arm)
    run("build", "arm.toml", "--no-verify")
    design = load_design(tmp_path / "arm" / "elbow_arm.design.json")
    settings = shaper_settings(design)
    # The slowest place is 0 rad, in the middle: 6 ticks of 20 ms are the widest spacing.
    (shaper,) = design.shapers
    drive = design.drive
    ramp_m = 0.5 * drive.max_speed_m_s**2 / drive.deceleration_m_s2
    way_m = ramp_m + drive.max_speed_m_s * shaper.taps.overtravel_s
    # A ramp in ticks is up to half a tick longer than its half triangle.
    assert ways(settings, 1).released_m == pytest.approx(way_m, abs=0.51 * drive.max_speed_m_s * 0.02)
    assert shaper.taps.duration_s == pytest.approx(2 * 6 * 0.02)


def test_figures_and_proven_code_of_a_turning_arm_in_int32(run, arm, tmp_path, blank_figures):
    turning(
        arm,
        ('number = "double"', 'number = "int32"'),
        ("[controller]", "[drive]\ncounts_per_m_s = 10000\n\n[controller]"),
    )
    assert "verified: C by" in run("build", "arm.toml", "--soak-ticks", 300).out
    header = (tmp_path / "arm" / "c" / "elbow_arm_shaper.h").read_text()
    assert "position_mrad" in header
    assert "position_speed_mrad_s" in header
    stored = "arm/elbow_arm.design.json"
    assert run("plot", "sensitivity", stored, "-o", "s.svg").code == 0
    assert run("plot", "response", stored, "-o", "r.svg").code == 0
    done = run("plot", "bank", stored, "-o", "b.svg")
    assert done.code != 0
    assert 'law = "modified": each row works on all of the range' in done.err
    done = run("plot", "sensitivity", stored, "--over", "rope-length", "-o", "s.svg")
    assert done.code == 2
    assert "is of an arm, which hangs on no rope" in done.err
