"""`swayless design bank`: rows for a whole range, what is printed of them, and what is refused."""

from __future__ import annotations

import json
from itertools import pairwise

import pytest

from tests.cli.conftest import snapshot

FT = 0.3048
CRANE = """
name = "yard"
[crane]
rope_length = ["10 ft", "28 ft"]
max_speed = 0.5
acceleration = 0.5
[controller]
tick = "50 ms"
[bank]
tolerance = "5 %"
duration = 3.2
amplitudes = "bounded"
"""


@pytest.fixture
def yard(tmp_path):
    """Machine file of a crane with a bank."""
    path = tmp_path / "yard.toml"
    path.write_text(CRANE)
    return path


def told(run, *arguments):
    done = run("design", "bank", *arguments, "--json")
    assert (done.code, done.err) == (0, "")
    return json.loads(done.out)


def test_a_bank_prints_labels_bounds_switching_lengths_and_the_pendant(run, yard):
    out = run("design", "bank", yard.name).out
    design = told(run, yard.name)
    bank, shapers = design["bank"], design["shapers"]
    lines = out.splitlines()
    assert lines[0] == f"yard: {len(shapers)} rows, at most 5 % is left"
    assert "  label  " in out
    for label, shaper in zip(bank["labels"], shapers, strict=True):
        (row,) = (line for line in lines if line.strip().startswith(label))
        assert f"  {shaper['taps']['duration_s']:.5g} " in row
        assert shaper["lower_bound_s"] == pytest.approx(3.2, rel=3e-3)  # the bound is within 0.3 %
    assert bank["labels"][0].startswith("1: 28-")
    assert bank["labels"][-1].endswith("-10 ft")
    (turns,) = (line for line in lines if line.startswith("turn the knob from "))
    for number, length_m in enumerate(bank["switching_rope_length_m"], start=1):
        assert f"{number} to {number + 1} at {length_m:.5g} m" in turns
    assert lines[-1] == f"on the pendant: {'   '.join(bank['labels'])}"


def test_options_stand_in_for_the_keys_of_the_file(run, yard):
    design = told(run, yard.name, "--tolerance", "8 %", "--longest-duration", 3.6, "--amplitudes", "positive")
    assert design["bank"]["tolerance"] == 0.08
    assert {shaper["amplitude_rule"] for shaper in design["shapers"]} == {"positive"}
    durations = [shaper["duration_s"] for shaper in design["shapers"]]
    assert durations[:-1] == pytest.approx([3.6] * (len(durations) - 1), rel=1e-11)  # stored to 12 digits
    assert durations[-1] <= 3.6


def test_a_number_of_rows_gets_the_smallest_equal_tolerance(run, yard):
    design = told(run, yard.name, "--rows", 2)
    tolerances = {shaper["taps"]["guarantee"]["tolerance"] for shaper in design["shapers"]}
    assert len(design["shapers"]) == 2
    assert max(tolerances) == design["bank"]["tolerance"]


def test_neighbours_overlap_by_the_hysteresis(run, yard):
    design = told(run, yard.name, "--hysteresis", "6 in")
    assert design["bank"]["hysteresis_m"] == pytest.approx(0.1524, rel=1e-11)  # stored to 12 digits
    assert min(design["bank"]["overlap_m"]) >= 0.1524 - 1e-6
    held = [shaper["taps"]["guarantee"]["rope_length_m"] for shaper in design["shapers"]]
    for (low_m, _), (_, high_m) in pairwise(held):
        assert high_m - low_m >= 0.1524 - 1e-6
    assert "there at least" in run("design", "bank", yard.name, "--hysteresis", "6 in").out


def test_rows_of_a_file_are_left_aside_for_a_bank_of_options(run, gantry):
    design = told(run, gantry.name, "--tolerance", "10 %", "--duration", 5)
    assert {shaper["family"] for shaper in design["shapers"]} <= {"si", "fd"}
    assert design["bank"]["labels"][0].startswith("1: 29-")


def test_the_design_is_written_and_can_be_generated_and_drawn(run, yard, tmp_path):
    done = run("design", "bank", yard.name, "-o", "bank.json")
    assert done.out.endswith("bank.json: written\n")
    assert (tmp_path / "bank.json").read_text() == run("design", "bank", yard.name, "--json").out
    assert run("generate", "c", "bank.json", "-o", "c").code == 0
    assert run("plot", "bank", "bank.json", "-o", "bank.svg").code == 0


@pytest.mark.usefixtures("blank_figures")
def test_a_build_shows_the_bank_in_its_closing_lines_and_in_json(run, yard):
    out = run("build", yard.name, "--no-verify").out
    design = told(run, yard.name)
    labels = design["bank"]["labels"]
    assert f"\non the pendant: {'   '.join(labels)}\n" in out
    assert "\nturn the knob from 1 to 2 at " in out
    assert out.count(", proved: no shaper whose partial sums stay in 0 to 1 holds this in ") == len(labels)
    assert "every point of the range is held by at least one row" in out
    document = json.loads(run("build", yard.name, "--no-verify", "--json").out)
    assert document["bank"] == design["bank"]
    for row, shaper in zip(document["rows"][1:], design["shapers"], strict=True):
        assert row["lower_bound_s"] == shaper["lower_bound_s"]
        assert 0.0 <= row["gap_ratio"] < 3e-3


BAD = [
    ("bank", "MACHINE.toml"),
    ("bank none.toml", "none.toml: cannot be read: there is no such file"),
    (
        "bank gantry.toml",
        "gantry.toml: has rows of its own and no [bank]; say which bank to design, for instance --tolerance",
    ),
    (
        "bank gantry.toml --rows 2",
        "[bank] duration or longest_duration: exactly one is needed, none is given",
    ),
    ("bank gantry.toml --duration 3", "[bank] tolerance or rows: exactly one is needed, none is given"),
    (
        "bank gantry.toml --rows 2 --tolerance 0.05 --duration 3",
        "tolerance or rows: exactly one is needed, tolerance and rows are given",
    ),
    ("bank yard.toml --rows 9", "--rows = 9: must be an integer from 1 to 8"),
    ("bank yard.toml --rows 0", "--rows = 0: must be an integer from 1 to 8"),
    ("bank yard.toml --rows two", '--rows = "two": must be an integer from 1 to 8'),
    ("bank yard.toml --tolerance 50%", '--tolerance = "50%": must be at least 0.01 and at most 0.2'),
    ("bank yard.toml --duration -1", '--duration = "-1": must be > 0'),
    ("bank yard.toml --duration 0.5", "yard.toml: [bank]: duration_s = 0.5: too short"),
    ("bank yard.toml --longest-duration 3kg", '--longest-duration = "3kg": is not a time'),
    ("bank yard.toml --amplitudes negative", "--amplitudes"),
    ("bank yard.toml --impulses 5", '--impulses = 5: only with amplitudes = "unity-magnitude"'),
    ("bank yard.toml --hysteresis 5Hz", '--hysteresis = "5Hz": is not a length'),
    ("bank yard.toml --label-step 0", "--label-step = 0: must be > 0"),
    ("bank yard.toml -o folder", "folder: cannot be written: it is a directory"),
    ("bank yard.toml -o no/a.json", "no/a.json: cannot be written: there is no folder no"),
]


@pytest.mark.parametrize(("line", "message"), BAD, ids=[line for line, _ in BAD])
def test_wrong_input_is_refused_with_a_message_and_leaves_nothing_behind(
    run, yard, gantry, tmp_path, line, message
):
    (tmp_path / "folder").mkdir()
    before = snapshot(tmp_path)
    done = run("design", *line.split())
    assert message in done.err
    assert (done.code, done.out) == (2, "")
    assert snapshot(tmp_path) == before


def test_all_that_is_wrong_with_options_and_file_is_said_at_once(run, yard):
    yard.write_text(CRANE.replace("max_speed = 0.5", "max_speed = -1"))
    lines = run("design", "bank", yard.name, "--rows", 9, "--label-step", "1 kg").err.splitlines()
    assert [line.split()[1] for line in lines] == ["yard.toml:", "--rows", "--label-step"]
