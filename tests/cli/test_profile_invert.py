"""`swayless profile invert` and `profile tune`: files and records in, commands out, a simulated machine."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
import typer

from swayless.cli.app import app
from swayless.design.optimal import Command, LinearPlant, output_at_ticks
from swayless.machine import example_text
from swayless.machine.inversion import asks_for_inversion, inverted_move
from swayless.machine.inversion_file import load_inversion
from swayless.plant.elastic_drive import ElasticDrive

PAGE = (Path(__file__).parents[2] / "docs" / "profile-invert.md").read_text(encoding="utf-8")
(GUESS,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
TRUE = ElasticDrive(0.00011, 0.0034, 0.05, 0.2, 1.0, 0.22, 3.05)


def found(done):
    assert (done.code, done.err) == (0, "")
    return json.loads(done.out)


def true_plant():
    top, bottom = TRUE.transfer_function
    return LinearPlant.from_transfer_function(top.tolist(), bottom.tolist())


def record(machine, path, *, every=1, resolution=1e-4, head="time_s,position,command"):
    """Play the command of a file on the true drive, and write what a sensor sees."""
    command = load_inversion(machine).found.command
    position = np.round(output_at_ticks(true_plant(), command) / resolution) * resolution
    inputs = np.append(command.values, command.final_value)
    rows = [
        f"{tick * command.tick_s:.6f},{position[tick]:.6f},{inputs[tick]:.6f}"
        for tick in range(0, position.size, every)
    ]
    path.write_text("\n".join([head, *rows]) + "\n")


def write_record(path, time_s, position):
    np.savetxt(path, np.column_stack([time_s, position]), "%.6f", ",", header="time_s,position", comments="")


@pytest.fixture
def servo(tmp_path):
    """The first guess of the page, and what the machine does under its command."""
    path = tmp_path / "servo.toml"
    path.write_text(GUESS)
    record(path, tmp_path / "measured.csv")
    return path


def test_the_command_of_the_example_moves_an_independent_model_along_the_polynomial(run, tmp_path):
    (tmp_path / "servo.toml").write_text(example_text("inverted-servo"))
    document = found(run("profile", "invert", "servo.toml", "--json"))
    assert (document["tick_s"], document["hold"]) == (0.005, "zero-order")
    assert document["final_value"] == 1.0
    command = Command(document["tick_s"], document["command"], document["final_value"])
    output = output_at_ticks(true_plant(), command, ticks=1500)
    share = np.clip(0.005 * np.arange(1501) / 2.0, 0.0, 1.0)
    wanted = -20 * share**7 + 70 * share**6 - 84 * share**5 + 35 * share**4
    assert np.abs(output - wanted).max() <= document["deviation"] * 1.001 < 5e-6
    assert output[document["ticks"] :] == pytest.approx(1.0, abs=1e-11)
    assert output[: document["ticks"] + 1] == pytest.approx(document["reference"], abs=1e-12)
    assert wanted[: document["ticks"] + 1] == pytest.approx(document["polynomial"], abs=1e-13)


def test_the_closed_form_in_the_document_is_the_exact_command(run, tmp_path):
    (tmp_path / "servo.toml").write_text(example_text("inverted-servo"))
    document = found(run("profile", "invert", "servo.toml", "--json"))
    form, times_s = document["closed_form"], 0.005 * np.arange(document["ticks"] + 1)
    early, late = np.minimum(times_s, 2.0), np.maximum(times_s - 2.0, 0.0)
    moving = np.polynomial.polynomial.polyval(early, form["polynomial"])
    ended = np.full(times_s.size, form["final_change"])
    for each in form["exponentials"]:
        assert each["rate_rad_s"][0] < 0.0
        rate = complex(*each["rate_rad_s"])
        moving = moving + (complex(*each["amplitude"]) * np.exp(rate * early)).real
        ended = ended + (complex(*each["amplitude_after"]) * np.exp(rate * late)).real
    formula = np.where(times_s <= 2.0, moving, ended) + form["initial_value"]
    assert formula == pytest.approx(document["exact_command"], abs=1e-11)
    # Held for a tick, the mean: between the values at both ends, but for the curvature and the correction.
    middle = 0.5 * (formula[:-1] + formula[1:])
    assert document["command"] == pytest.approx(middle, abs=2e-4)


def test_the_formula_is_left_out_where_it_loses_its_digits(run, tmp_path):
    text = example_text("inverted-servo").replace('"0.2 s"', f'"{0.22 / 3.05 * (1 + 1e-12)!r} s"')
    (tmp_path / "servo.toml").write_text(text)
    document = found(run("profile", "invert", "servo.toml", "--json"))
    assert document["closed_form"] is None
    assert document["deviation"] < 5e-6


def test_command_and_trajectory_are_written_and_drawn(run, tmp_path):
    (tmp_path / "servo.toml").write_text(example_text("inverted-servo"))
    done = run("profile", "invert", "servo.toml", "-o", "move.csv", "-o", "move.svg")
    assert (done.code, done.err) == (0, "")
    assert (tmp_path / "move.svg").read_text().startswith("<?xml")
    lines = (tmp_path / "move.csv").read_text().splitlines()
    assert lines[0] == "tick,time_s,command,reference"
    rows = np.array([line.split(",") for line in lines[1:]], dtype=float)
    assert rows.shape == (1143, 4)
    assert rows[-1, 2:].tolist() == pytest.approx([1.0, 1.0], abs=1e-9)


def test_a_plant_of_its_own_is_inverted_too(run, tmp_path):
    (tmp_path / "lag.toml").write_text(
        "[plant]\nnumerator = [0.1, 2]\ndenominator = [0.5, 1, 2]\n"
        "[move]\ntick = 0.01\ntarget = 3\nduration = 1\n"
    )
    document = found(run("profile", "invert", "lag.toml", "--json"))
    assert document["final_value"] == pytest.approx(3.0)
    assert run("profile", "tune", "x.csv", "--machine", "lag.toml").err.startswith(
        "error: lag.toml: [drive]: missing: a [plant] has no parameters to correct"
    )


def test_the_move_of_a_block_rests_at_both_ends_and_has_limits(tmp_path):
    path = tmp_path / "servo.toml"
    path.write_text(GUESS)
    move = inverted_move(path)
    assert (move.limits, move.start, move.target, move.number) == ((-0.5, 1.5), 0.0, 1.0, "double")
    path.write_text(GUESS.replace("limit =", "# limit ="))
    values, (low, high) = move.command.values, inverted_move(path).limits
    margin = 0.1 * (values.max() - min(0.0, values.min()))
    assert [low, high] == pytest.approx([min(0.0, values.min()) - margin, values.max() + margin], rel=1e-9)
    assert asks_for_inversion({"move": {"duration": 1}})
    assert not asks_for_inversion({"move": {"duration": 1}, "crane": {}})


def test_tuning_writes_the_parameters_keeps_the_comments_and_gives_the_next_command(run, servo, tmp_path):
    before = servo.read_text()
    document = found(run("profile", "tune", "measured.csv", "--machine", "servo.toml", "--json"))
    after = servo.read_text()
    assert [line.partition("#")[2] for line in after.splitlines()] == [
        line.partition("#")[2] for line in before.splitlines()
    ]
    assert document["after"]["damping / load_mass"] == pytest.approx(0.22, rel=1e-3)
    assert document["after"]["stiffness / load_mass"] == pytest.approx(3.05, rel=1e-4)
    assert document["before"]["stiffness"] == 5.0
    assert "load_mass" in document["not_identifiable"]
    # The command in the document is that of the file as it is now.
    again = found(run("profile", "invert", "servo.toml", "--json"))
    assert again["command"] == document["command"]
    assert again["reference"] == document["reference"]


def test_the_cost_over_the_experiments_is_the_table_of_the_page(run, servo, tmp_path):
    rows = []
    for experiment in range(1, 4):
        record(servo, tmp_path / "measured.csv")
        document = found(run("profile", "tune", "measured.csv", "--machine", "servo.toml", "--json"))
        before = document["before"]
        ratios = before["damping / load_mass"], before["stiffness / load_mass"]
        shown = f"{document['cost']:.5f}" if document["cost"] > 1e-4 else "below 1e-8"
        rows.append(f"| {experiment} | {ratios[0]:.3f} | {ratios[1]:.3f} | {shown} |\n")
        assert document["cost"] < (1.0 if experiment == 1 else 1e-8)
    assert "".join(rows) in PAGE, "".join(rows)


def test_several_records_and_slower_sensors_are_read_together(run, servo, tmp_path):
    record(servo, tmp_path / "slow.csv", every=7, head="time [s],load [m],note")
    options = ("--machine", "servo.toml", "-o", "next.toml", "--command", "next.csv", "--json")
    before = servo.read_text()
    document = found(run("profile", "tune", "measured.csv", "slow.csv", *options))
    assert document["records"] == 2
    assert document["after"]["stiffness / load_mass"] == pytest.approx(3.05, rel=1e-4)
    assert servo.read_text() == before
    lines = (tmp_path / "next.csv").read_text().splitlines()
    assert len(lines) == document["ticks"] + 2
    assert load_inversion(tmp_path / "next.toml").drive is not None


def test_the_papers_step_is_taken_when_asked_for(run, servo):
    options = ("--machine", "servo.toml", "--step", "paper", "--json")
    document = found(run("profile", "tune", "measured.csv", *options))
    assert 0.99 * document["cost"] < document["expected_cost"] < document["cost"]


def test_when_nothing_is_left_to_explain_it_is_said(run, tmp_path):
    (tmp_path / "servo.toml").write_text(example_text("inverted-servo"))
    record(tmp_path / "servo.toml", tmp_path / "measured.csv", resolution=1e-2)
    done = run("profile", "tune", "measured.csv", "--machine", "servo.toml")
    assert "note: no parameters explain the rest" in done.out


DRIVES = {
    "stiffness = 5.0": ("stiffness = 0", "[drive] stiffness = 0: must be a number from 1e-12 to 1e+12"),
    'integral_time = "0.2 s"': (
        'integral_time = "50 ms"',
        "[drive] integral_time_s = 0.05: must be above motor_inertia / motor_friction = 0.05 s, or the",
    ),
    'duration = "2 s"': ('duration = "20 ms"', "duration = 0.02 s, 4 ticks of 0.005 s: must be 10 to 20000"),
    "order = 7 ": ("order = 8 ", "[move] order = 8: must be an odd number from 3 to 15"),
    "order = 7  ": (
        "order = 5  ",
        "order = 5: is continuous to derivative 2, and a plant of relative degree 3",
    ),
    "damping = 0.1 ": ("damping = 0.0 ", "relative degree 4 needs order 9"),
    "limit = [-0.5, 1.5]": ("limit = [0.0, 0.9]", "limit = 0 to 0.9: the command goes from"),
    "limit = [-0.5, 1.5] ": (
        "limit = 1.5 ",
        "[move] limit = 1.5: must be the lowest and the highest command",
    ),
    "target = 1.0": ("target = 0.0", "[move] target = 0.0: must be finite, and differ from start = 0.0"),
    "truncation = 1e-9": (
        "truncation = 1.0",
        "[move] truncation = 1.0: must be at least 1e-12 and at most 0.1",
    ),
    "gain = 0.05": ("gian = 0.05", "[drive] gian: unknown key; nearest: gain"),
    "[drive]": ("[plant]", "[plant] numerator: missing"),
    "[move]": ("[moves]", "move: missing"),
    "name =": ("= ", "not valid TOML"),
}


@pytest.mark.parametrize("old", DRIVES)
def test_what_is_wrong_in_a_file_is_said_with_its_place(run, tmp_path, old):
    new, message = DRIVES[old]
    assert old in GUESS
    (tmp_path / "servo.toml").write_text(GUESS.replace(old, new))
    done = run("profile", "invert", "servo.toml")
    assert (done.code, done.out) == (2, "")
    assert "servo.toml" in done.err
    assert message in done.err


def test_zeros_to_the_right_are_refused_by_name(run, tmp_path):
    (tmp_path / "arm.toml").write_text(
        "[plant]\nnumerator = [-0.2, 1]\ndenominator = [1, 2, 2]\n"
        "[move]\ntick = 0.01\ntarget = 1\nduration = 1\n"
    )
    done = run("profile", "invert", "arm.toml")
    assert (done.code, done.out) == (2, "")
    assert "arm.toml: plant: zero at 5 rad/s, right of the imaginary axis" in done.err


RECORDS = {
    "a value is missing": (lambda rows: rows.__setitem__(40, "0.195,,0.1"), "line 41: position is missing"),
    "a value is nan": (lambda rows: rows.__setitem__(40, "0.195,nan,0.1"), "line 41: position is missing"),
    "a value is infinite": (
        lambda rows: rows.__setitem__(9, "0.04,inf,0"),
        "line 10: position is missing or inf",
    ),
    "a word": (lambda rows: rows.__setitem__(40, "0.195,much,0.1"), 'line 41: "much" is not a number'),
    "a gap": (
        lambda rows: rows.__delitem__(slice(50, 60)),
        "line 51: time = 0.295 s comes 0.055 s after the",
    ),
    "times that fall": (lambda rows: rows.__setitem__(30, rows[5]), "line 31: time = 0.02 s comes"),
    "it ends early": (
        lambda rows: rows.__delitem__(slice(200, None)),
        "goes from 0 to 0.99 s: must span the motion",
    ),
    "it begins late": (lambda rows: rows.__delitem__(slice(1, 200)), "goes from 0.995 to"),
    "no head": (lambda rows: rows.__delitem__(0), "one column of times is needed"),
    "other heads": (lambda rows: rows.__setitem__(0, "time_s,a,b"), "a column of load positions is needed"),
    "another command": (
        lambda rows: rows.__setitem__(300, "1.495,0.9,0.1"),
        "line 301: command = 0.1: the parameters of servo.toml give",
    ),
    "another unit": (
        lambda rows: rows.__setitem__(1, "0.0,250.0,0.0"),
        "line 2: position = 250 when the motion",
    ),
    "few samples": (lambda rows: rows.__delitem__(slice(15, None)), "14 samples: must be 20 at least"),
    "empty": (lambda rows: rows.clear(), "measured.csv: is empty"),
}


@pytest.mark.parametrize("what", RECORDS)
def test_garbage_in_a_record_is_refused_with_its_line(run, servo, tmp_path, what):
    spoil, message = RECORDS[what]
    rows = (tmp_path / "measured.csv").read_text().splitlines()
    spoil(rows)
    (tmp_path / "measured.csv").write_text("\n".join(rows))
    before = servo.read_text()
    done = run("profile", "tune", "measured.csv", "--machine", "servo.toml")
    assert (done.code, done.out) == (2, "")
    assert f"measured.csv: {message}" in done.err or message in done.err
    assert servo.read_text() == before


NONSENSE = {
    "in another unit": (lambda position: 1000.0 * position, None),
    "with another sign": (np.negative, None),
    "with another sign, up to the end of the motion": (np.negative, 401),
    "of a dead sensor, up to the end of the motion": (np.zeros_like, 401),
}


@pytest.mark.parametrize("what", NONSENSE)
def test_a_record_that_no_drive_explains_is_refused_and_nothing_is_written(run, servo, tmp_path, what):
    spoil, rows = NONSENSE[what]
    before = servo.read_text()
    time_s, position, _ = np.loadtxt(tmp_path / "measured.csv", delimiter=",", skiprows=1)[:rows].T
    write_record(tmp_path / "spoilt.csv", time_s, spoil(position))
    done = run("profile", "tune", "spoilt.csv", "--machine", "servo.toml", "--command", "next.csv")
    assert (done.code, done.out) == (2, "")
    assert "spoilt.csv: no drive explains the motion: its cost is" in done.err
    assert servo.read_text() == before
    assert not (tmp_path / "next.csv").exists()


def test_a_sensor_that_lags_or_scales_is_suspected_by_its_size(run, servo, tmp_path):
    time_s, position, _ = np.loadtxt(tmp_path / "measured.csv", delimiter=",", skiprows=1).T
    write_record(tmp_path / "late.csv", time_s, np.interp(time_s - 0.1, time_s, position))
    done = run("profile", "tune", "late.csv", "--machine", "servo.toml", "-o", "next.toml")
    (lag,) = re.findall(
        r"note: a lag of ([0-9.]+) s in the record would explain most of what stays", done.out
    )
    # To a fiftieth: a step of the fit is a straight line.
    assert float(lag) == pytest.approx(0.1, rel=0.02)
    write_record(tmp_path / "wide.csv", time_s, 1.05 * position)
    document = found(run("profile", "tune", "wide.csv", "--machine", "servo.toml", "-o", "n.toml", "--json"))
    # To a hundredth: the drive explains a part of the scale.
    assert document["doubt"] == {"scale_ratio": pytest.approx(1.05, abs=0.01)}


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--command", "measured.csv"), "measured.csv: would be written over, and it is read"),
        (("-o", "measured.csv"), "measured.csv: would be written over, and it is read"),
        (("-o", "a.csv", "--command", "../{here}/a.csv"), "a.csv: would be written twice"),
    ],
)
def test_what_is_read_is_never_written_over(run, servo, tmp_path, options, message):
    before = (tmp_path / "measured.csv").read_text()
    given = [option.format(here=tmp_path.name) for option in options]
    done = run("profile", "tune", "measured.csv", "--machine", "servo.toml", *given)
    assert (done.code, done.out) == (2, "")
    assert message in done.err
    assert (tmp_path / "measured.csv").read_text() == before
    assert servo.read_text() == GUESS


def test_samples_too_far_apart_and_unknown_columns_are_refused(run, servo, tmp_path):
    record(servo, tmp_path / "coarse.csv", every=30)
    done = run("profile", "tune", "coarse.csv", "--machine", "servo.toml")
    assert "coarse.csv: samples are 0.15 s apart: must be 0.1 s at most" in done.err
    done = run("profile", "tune", "measured.csv", "--machine", "servo.toml", "--column", "height")
    assert 'a column of load positions is needed, --column = "height"; there are: "time_s"' in done.err


def test_a_drive_that_cannot_be_written_is_refused_before_anything_is(run, servo, tmp_path):
    inline = GUESS.replace("stiffness = 5.0\n", "").replace("damping = 0.1 ", "stiffness = 5.0 # ")
    servo.write_text(inline.replace("# ", "\n# ", 1))
    done = run("profile", "tune", "measured.csv", "--machine", "servo.toml")
    assert "[drive] damping: missing" in done.err


def test_the_page_shows_what_the_program_prints(run, servo, tmp_path):
    (tmp_path / "inverted-servo.toml").write_text(example_text("inverted-servo"))
    shown = re.findall(r"```sh\n(.*?)```\n(?:\n```text\n(.*?)```)?", PAGE, re.DOTALL)
    assert len(shown) == 2
    rounding = ("misses rest", "left unexplained", "motor_inertia")
    for lines, output in shown:
        for line in lines.splitlines():
            done = run(*shlex.split(line)[1:])
            assert (done.code, done.err) == (0, ""), line
        kept, wanted = (
            [text for text in side.splitlines() if not any(each in text for each in rounding)]
            for side in (done.out, output)
        )
        assert kept == wanted, done.out


@pytest.mark.parametrize("command", ["invert", "tune"])
def test_every_option_is_in_the_table_of_the_page_and_no_other(command):
    parameters = typer.main.get_command(app).commands["profile"].commands[command].params
    options = {name for parameter in parameters for name in parameter.opts if name.startswith("-")}
    table = PAGE.partition(f"| option of `{command}`")[2].partition("\n\n")[0]
    assert set(re.findall(r"^\| `.*?` \|", table, re.MULTILINE))
    heads = [row.split("|")[1] for row in table.splitlines()[2:]]
    assert set(re.findall(r"`(--?[a-z-]+)`", " ".join(heads))) == options - {"--help", "-h"}
