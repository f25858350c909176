"""`swayless simulate`: the plant does what closed forms say, and the command what its pages say."""

from __future__ import annotations

import csv
import json
import math
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from swayless.cli.simulated_control import Press, plain_ramp
from swayless.machine import example_text, load_machine, save_text
from swayless.machine.designing import design_machine
from swayless.plant import STANDARD_GRAVITY_M_S2

PAGE = (Path(__file__).parents[2] / "docs" / "simulate.md").read_text(encoding="utf-8")
ROPE_M = 6.0
RAD_S = math.sqrt(STANDARD_GRAVITY_M_S2 / ROPE_M)
SLOW = ("--move", "8 s at 0.2 m/s", "--rope-length", "6 m")
"""A move of 1.5 degrees at the most, where the pendulum is linear to a part in 5000."""


@pytest.fixture
def machine(tmp_path):
    """Machine file of a workshop crane without damping."""
    path = tmp_path / "crane.toml"
    path.write_text(example_text("workshop-crane").replace('"0.2 %"', "0.0"))
    return path


@pytest.fixture(scope="module")
def crane(tmp_path_factory):
    """Design file of the same crane."""
    folder = tmp_path_factory.mktemp("design")
    path = folder / "crane.toml"
    path.write_text(example_text("workshop-crane").replace('"0.2 %"', "0.0"))
    design = folder / "crane.json"
    design.write_text(save_text(design_machine(load_machine(path))))
    return design


@pytest.fixture
def hoist(tmp_path):
    path = tmp_path / "hoist.toml"
    path.write_text(example_text("hoisting-gantry"))
    return path


@pytest.fixture
def simulated(run):
    """Give the document of a simulation."""

    def simulated(*arguments):
        done = run("simulate", *arguments, "--json")
        assert (done.code, done.err) == (0, "")
        return json.loads(done.out)

    return simulated


def cases(document, move=0):
    """Cases of a move on its one rope, by their names."""
    return {case["moved_by"]: case for case in document["moves"][move]["cases"]}


def ramp_ratio(ramp_s, press_s):
    """Residual of a press whose start and stop are ramps: 2 |sin(w press / 2)| |sin(w T / 2) / (w T / 2)|."""
    half = 0.5 * RAD_S * ramp_s
    return 2.0 * abs(math.sin(0.5 * RAD_S * press_s) * math.sin(half) / half)


def test_jumps_and_plain_ramps_leave_what_their_closed_form_says(crane, simulated):
    found = cases(simulated(crane, *SLOW, "--row", "2"))
    ramp = next(name for name in found if name.startswith("ramp of "))
    way_s = found["jump, no ramp"]["travel_m"] / 0.2
    # 1 %: the pendulum is not linear at 1.5 degrees, to 2e-4, and the name of the ramp has four digits.
    assert found["jump, no ramp"]["residual_ratio"] == pytest.approx(ramp_ratio(1e-9, way_s), rel=1e-2)
    ramp_s = float(ramp.split()[2])
    assert found[ramp]["residual_ratio"] == pytest.approx(ramp_ratio(ramp_s, way_s), rel=1e-2)


def test_a_row_leaves_what_its_taps_leave_of_both_ramps(crane, simulated):
    taps = json.loads(crane.read_text())["shapers"][1]["taps"]
    phase = RAD_S * 0.01 * np.array(taps["delays_ticks"])
    left = abs(np.dot(taps["amplitudes"], np.exp(1j * phase)))
    start, stop = (ramp * np.exp(1j * RAD_S * at) for ramp, at in ((ramp_of(0.3), 0.0), (-ramp_of(0.4), 8.0)))
    ratio = left * abs(start + stop)
    found = cases(simulated(crane, *SLOW, "--row", "2"))["2 3.2 to 7 m"]["residual_ratio"]
    # Half a point is what is promised up to 5 degrees; at 1.5 degrees a twentieth of it is left.
    assert found == pytest.approx(ratio, abs=2.5e-4)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05])
def test_left_is_an_amplitude_and_peak_what_was_seen_of_it(machine, simulated, damping_ratio):
    machine.write_text(machine.read_text().replace("damping_ratio = 0.0", f"damping_ratio = {damping_ratio}"))
    half_period_s = math.pi / RAD_S  # the stop adds to the swing of the start, so what is left is the largest
    move = ("--move", f"{half_period_s} s at 0.2 m/s", "--rope-length", "6 m", "--row", "1")
    jump = cases(simulated(machine, *move))["jump, no ramp"]
    seen = jump["peak_sway_m"] / jump["residual_m"]
    # 1e-4: in half a tick of 10 ms the load is off its turn by (w 5 ms)^2 / 2, 2e-5 of its swing.
    assert math.exp(-math.pi * damping_ratio) - 1e-4 < seen < 1.0 + 1e-4
    assert (seen < 0.99) == (damping_ratio > 0.0)


def test_an_arm_rests_within_a_fiftieth_of_its_unshaped_step_unless_said(tmp_path, run):
    path = tmp_path / "arm.toml"
    path.write_text(example_text("flexible-arm"))
    move = ("simulate", path, "--move", "1 m", "--frequency", "4.5")
    found, wide = (json.loads(run(*move, *more, "--json").out) for more in ((), ("--within", "50 mm")))
    # 1.2 m/s and at least 4 Hz, of the machine file.
    assert found["within_m"] == pytest.approx(0.02 * 1.2 / (2.0 * math.pi * 4.0), rel=1e-12)
    assert wide["within_m"] == 0.05
    rests_s, within_50_mm_s = (cases(each)["2 robust"]["rests_s"] for each in (found, wide))
    assert within_50_mm_s < rests_s
    assert cases(found)["jump, no ramp"]["rests_s"] is None
    assert "within 0.9549 mm of its end" in run(*move).out


def ramp_of(acceleration_m_s2):
    """Swing that a ramp to 0.2 m/s leaves, of a step's, about its beginning; ramps are tick by tick."""
    ticks = round(0.2 / acceleration_m_s2 / 0.01)
    return np.exp(1j * RAD_S * 0.01 * np.arange(ticks)).mean()


def test_every_case_goes_as_far_as_asked(crane, simulated):
    for way_m in (12.0, 0.5):
        document = simulated(crane, "--move", f"{way_m} m at 0.6 m/s", "--rope-length", "6")
        # A button is held for whole ticks: half a tick at 0.6 m/s is 3 mm.
        assert [case["travel_m"] for case in cases(document).values()] == pytest.approx(
            [way_m] * len(cases(document)), abs=0.0031
        )


def test_a_load_that_is_not_moved_does_not_sway(crane, simulated):
    found = cases(simulated(crane, "--move", "5 s at 0.01 m/s", "--rope-length", "6"))
    # The controller takes commands below its minimum speed of 1 m/min for 0.
    nothing = ("residual_m", "residual_rad", "residual_ratio", "peak_sway_m", "travel_m", "rests_s")
    assert len(found) == 7
    assert {case[key] for case in found.values() for key in nothing} == {0.0}


def test_without_options_every_row_runs_on_the_ends_of_the_range_and_its_middle(crane, simulated):
    found = simulated(crane)["moves"]
    assert len(found) == 1
    ropes = [case["rope_length_m"][0] for case in found[0]["cases"]]
    assert sorted(set(ropes)) == [2.0, 6.0, 10.0]
    knobs = [case["knob"] for case in found[0]["cases"] if case["rope_length_m"][0] == 6.0]
    assert knobs == [None, 0, 1, 2, 3, 4, None, None, None, None]


def test_many_cases_together_are_the_same_as_one_by_one(crane, simulated):
    together = simulated(crane, "--move", "4 s", "--rope-length", "3", "--rope-length", "6")["moves"][0]
    alone = simulated(crane, "--move", "4 s", "--rope-length", "6", "--row", "1")["moves"][0]
    names = [case["moved_by"] for case in alone["cases"]]
    same = [
        case for case in together["cases"] if case["rope_length_m"][0] == 6.0 and case["moved_by"] in names
    ]
    assert [case["knob"] for case in same] == [case["knob"] for case in alone["cases"]]
    # 1e-6 m: a shorter rope among them may make the steps of all shorter.
    assert [case["residual_m"] for case in same] == pytest.approx(
        [case["residual_m"] for case in alone["cases"]], abs=1e-6
    )


def test_a_design_file_runs_as_its_machine_does(machine, crane, simulated):
    assert simulated(machine, *SLOW) == simulated(crane, *SLOW)


MOVES = """
[[move]]
name = "there"
duration = 3
rope_length = 5
row = 1
[[move]]
name = "up"
duration = 3
hoist = { from = 6, to = 4, rate = 0.5, start = 1 }
"""


def test_the_moves_of_the_machine_file_run_unless_the_options_describe_another(machine, simulated):
    machine.write_text(machine.read_text() + MOVES)
    there, up = simulated(machine)["moves"]
    assert there["move"] == "there: 3 s at 0.6667 m/s"
    assert up["move"] == "up: 3 s at 0.6667 m/s, hoist 6 to 4 m at 0.5 m/s from 1 s"
    assert {case["knob"] for case in there["cases"]} == {None, 0, 1}
    assert all(case["rope_length_m"] == [6.0, 4.0] for case in up["cases"])
    assert [len(move["cases"]) for move in simulated(machine, "--row", "2")["moves"]] == [4, 4]
    assert [move["move"] for move in simulated(machine, "--move", "1 s")["moves"]] == ["1 s at 0.6667 m/s"]


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_a_block_that_follows_the_rope_is_told_of_it_in_its_number_type(hoist, simulated, number):
    text = hoist.read_text().replace('number = "double"', f'number = "{number}"')
    hoist.write_text(text + "\n[drive]\ncounts_per_m_s = 1000000\n" if number == "int32" else text)
    found = cases(
        simulated(hoist, "--move", "12 m at 0.6 m/s", "--hoist", "8.84 m to 3.74 m at 0.3 m/s from 1 s")
    )
    # 0.1 % is what a hoist that runs steadily through the move may leave; int32 reads the rope in whole mm.
    assert found["1 any rope"]["residual_ratio"] < 1e-3
    assert found["unshaped"]["residual_ratio"] > 1.0


def test_a_gust_kicks_what_no_shaper_can_foresee(crane, simulated):
    move = ("--move", "8 s at 0.2 m/s", "--rope-length", "6", "--row", "2")
    calm, blown = (
        cases(simulated(crane, *move, *wind))["2 3.2 to 7 m"]["residual_m"]
        for wind in ((), ("--wind", "0.2 m/s2 from 2 s for 2.5 s"))
    )
    # A gust of half a period moves the load by some of its standing deflection, 0.2 / w^2 = 0.12 m.
    assert blown - calm > 0.05


def test_a_double_pendulum_and_an_arm_run_too(tmp_path, simulated):
    for name in ("double-pendulum", "flexible-arm"):
        path = tmp_path / f"{name}.toml"
        path.write_text(example_text(name))
        move = simulated(path, "--row", "2")["moves"][0]
        assert len(move["cases"]) == 12
        assert all((case["residual_rad"] is None) == (name == "flexible-arm") for case in move["cases"])


def test_a_record_and_a_figure_of_every_rope_are_written(crane, run):
    done = run("simulate", crane, "--move", "3 s", "--rope-length", "3", "--rope-length", "6", "-o", "moves")
    assert done.code == 0
    names = [f"workshop_crane-move-1-rope-{place}" for place in (1, 2)]
    assert sorted(path.name for path in Path("moves").iterdir()) == [
        f"{name}{suffix}" for name in names for suffix in (".csv", ".svg")
    ]
    with (Path("moves") / f"{names[1]}.csv").open() as stream:
        heads, *rows = list(csv.reader(stream))
    record = np.array(rows, dtype=float)
    assert heads[:5] == [
        "time_s",
        "rope_length_m",
        "jump no ramp: reference_m_s",
        "jump no ramp: trolley_m",
        "jump no ramp: sway_m",
    ]
    assert set(record[:, 1]) == {6.0}
    # 1e-9: nine digits are written.
    np.testing.assert_allclose(np.diff(record[:, 0]), 0.01, atol=1e-9)
    reference, trolley = record[:, heads.index("unshaped: reference_m_s")], record[:, 6]
    assert heads[6] == "unshaped: trolley_m"
    np.testing.assert_allclose(np.cumsum(reference)[:-1] * 0.01, trolley[1:], atol=1e-6)


def test_all_that_is_wrong_is_said_at_once(crane, run):
    done = run(
        *(
            "simulate",
            crane,
            "--move",
            "3 q at 5 m/s at 6",
            "--hoist",
            "9 m at 0.3 m/s",
            "--rope-length",
            "-3",
        ),
        *("--frequency", "0.2", "--row", "9", "--wind", "12 kg", "--within", "5 s"),
    )
    assert (done.code, done.out) == (2, "")
    said = [line.removeprefix("error: ").partition(": must")[0] for line in done.err.splitlines()]
    assert said == [
        '--within = "5 s": is not a length: allowed units are m, cm, mm, in, ft',
        '--move = "3 q at 5 m/s at 6": "at" stands twice',
        '--move = "3 q": is not a length: allowed units are m, cm, mm, in, ft',
        "--row = 9",
        "--rope-length = -3",
        "--hoist to: missing",
        '--wind push = "12 kg": is not an acceleration: allowed units are m/s2, cm/s2, mm/s2, in/s2, ft/s2',
        "--frequency = 0.2: only a move of an arm without positions has this",
        "--rope-length and hoist: exclude each other: keep one",
        "--move = 6: is above max_speed, 0.666667 m/s",
    ]


def test_a_design_without_ticks_cannot_run(designs, run):
    done = run("simulate", designs / "plain.json")
    assert (done.code, done.out) == (2, "")
    assert done.err == "error: the design has no tick: design it with --tick, for instance --tick '10 ms'\n"


def test_a_move_of_too_many_ticks_is_refused(crane, run):
    done = run("simulate", crane, "--move", "9999 s from 9999 s")
    assert done.code == 2
    assert done.err == ("error: a move of 19998 s in ticks of 0.01 s: at most 200000 ticks are simulated\n")


def test_a_contactor_drive_runs_at_full_speed_only_and_has_no_ramps(tmp_path, simulated, run):
    path = tmp_path / "contactor.toml"
    text = example_text("srtc-gantry").replace("acceleration =", "# acceleration =")
    path.write_text(text.replace("[controller]", "[drive]\ncontactor = true\n[controller]"))
    found = simulated(path, "--move", "8 s", "--rope-length", "24 ft")["moves"][0]["cases"]
    assert [case["knob"] for case in found] == [0, 1, 2, 3]
    done = run("simulate", path, "--move", "8 s at 0.2 m/s")
    assert (done.code, done.out) == (2, "")
    assert done.err == ("error: a move at 0.2 m/s: a contactor drive gives 0 or full speed, 0.5 m/s\n")


def test_a_row_of_a_bank_that_turns_out_smaller_is_refused(tmp_path, run):
    path = tmp_path / "bank.toml"
    path.write_text(example_text("srtc-gantry-bank") + "\n[[move]]\nrow = 8\n")
    done = run("simulate", path)
    assert done.code == 2
    assert re.fullmatch(r"error: \[\[move\]\] 1 row = 8: the knob has positions 0 to [2-7]\n", done.err)


def test_where_the_rope_chooses_the_row_one_position_follows_it(tmp_path, simulated):
    path = tmp_path / "bank.toml"
    chosen = 'hysteresis = "6 in"\nselection = "rope_length"\n'
    text = example_text("srtc-gantry-bank").replace("[crane]\n", "[crane]\nhoist_speed = 0.3\n")
    path.write_text(text.replace('label_step = "1 ft"', f'label_step = "1 ft"\n{chosen}'))
    found = simulated(path, "--move", "9 s", "--rope-length", "3.5", "--rope-length", "8")["moves"][0]
    by_rope = [case for case in found["cases"] if case["knob"] == 1]
    assert [case["moved_by"] for case in by_rope] == ["1 row by the rope"] * 2
    # Start and stop may each leave the tolerance of the bank; and half a point, for up to 5 degrees.
    assert all(case["residual_ratio"] < 2 * 0.05 + 0.005 for case in by_rope)


def test_a_place_that_is_a_file_is_refused(crane, run):
    Path("there").write_text("")
    done = run("simulate", crane, "--move", "1 s", "-o", "there")
    assert (done.code, done.err) == (2, "error: there: cannot be made: File exists\n")


@pytest.mark.parametrize(("held", "ticks"), [(40, 1), (40, 25), (10, 25)])
def test_a_plain_ramp_is_straight_and_goes_as_far_as_the_press(held, ticks):
    reference = plain_ramp(Press(5, 5 + held), ticks, 0.6)
    # 1e-12: sums of at most 70 terms of size 0.6.
    assert reference.sum() == pytest.approx(0.6 * held, abs=1e-12)
    steps = np.unique(np.diff(reference, prepend=0.0, append=0.0).round(12))
    np.testing.assert_allclose(steps, sorted({-0.6 / ticks, 0.0, 0.6 / ticks}), atol=1e-12)
    assert not reference[:5].any()


def test_what_the_page_shows_is_what_the_command_prints(run):
    shown = re.findall(r"```sh\n(.*?)```\n\n(?:```text\n(.*?)```)?", PAGE, re.DOTALL)
    assert len(shown) >= 3
    for name, text in re.findall(r"```toml\n# (\S+\.toml)\n(.*?)```", PAGE, re.DOTALL):
        Path(name).write_text(text)
    for lines, output in shown:
        for line in lines.splitlines():
            done = run(*shlex.split(line, comments=True)[1:])
            assert (done.code, done.err) == (0, ""), line
        assert not output or done.out.splitlines() == output.splitlines()
