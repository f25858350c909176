"""`swayless design recommend`: a ranked table, a sentence for each line, and the same for machines."""

from __future__ import annotations

import importlib
import json

import pytest

from swayless.cli.options import OptionError
from swayless.cli.recommend import recommend
from swayless.errors import DesignError, FileError
from swayless.machine import load_machine
from swayless.machine.designing import design_machine


@pytest.fixture
def no_banks(monkeypatch):
    """Leave the banks out: their frontier takes most of the time, and is tested elsewhere."""
    module = importlib.import_module(
        "swayless.design.tradeoff.candidates"
    )  # the package has a function so named
    monkeypatch.setattr(module, "BANK_ROWS", ())


def document(capsys, *arguments, **options):
    capsys.readouterr()
    recommend(*arguments, json=True, **options)
    out, err = capsys.readouterr()
    assert err == ""
    return json.loads(out)


def test_the_table_has_a_line_and_a_sentence_for_each_candidate_in_order(gantry, no_banks, capsys):
    recommend(gantry, longest_overtravel="1.5 m")
    out, err = capsys.readouterr()
    assert err == ""
    lines = out.splitlines()
    assert lines[0] == "srtc_gantry: what holds 2.743 to 8.839 m of rope at 5 % within 1.5 m"
    assert max(len(line) for line in lines if line.startswith("  ")) <= 80
    table = [line.split() for line in lines if line.startswith("  ") and line.split()[0].isdigit()]
    sentences = [line for line in lines if line[:1].isdigit()]
    assert len(table) == len(sentences) == 15  # eleven families, two robust shapers, two ramps
    assert sentences[0].startswith(
        "1 bounded si: holds the whole range and stops within 1.4 m, sooner than all"
    )
    assert [" ".join(row[:2]) for row in table[:1]] == ["1 bounded"]


def test_json_holds_the_same_in_numbers(gantry, no_banks, capsys):
    made = document(capsys, gantry, tolerance="3 %", longest_overtravel="6 ft")
    assert (made["name"], made["tolerance"]) == ("srtc_gantry", 0.03)
    assert made["longest_overtravel_m"] == pytest.approx(1.8288, rel=1e-12)
    assert made["rope_length_m"] == pytest.approx([2.7432, 8.8392], rel=1e-12)
    assert made["not_possible"] == []
    shortfalls = [item["shortfall_ratio"] for item in made["candidates"]]
    assert shortfalls == sorted(shortfalls)
    for item in made["candidates"]:
        assert 0.0 <= item["share_of_ropes"] <= 1.0 + 1e-9
        assert 0.0 <= item["share_of_frequencies"] <= 1.0 + 1e-9
        assert item["reason"]
        assert (item["lower_bound_s"] is not None) == item["name"].endswith(" si")
        if item["shortfall_ratio"] == 0.0:
            assert item["worst_residual_ratio"] <= 0.03 * (1.0 + 1e-8)  # humps touch the tolerance
            assert item["overtravel_m"] <= 1.8288


def test_an_arm_has_no_ropes(arm, no_banks, capsys):
    made = document(capsys, arm)
    assert made["rope_length_m"] is None
    assert {item["share_of_ropes"] for item in made["candidates"]} == {None}


def test_what_is_recommended_can_be_written_into_the_machine_file_and_stops_as_far(gantry, no_banks, capsys):
    ei2 = next(item for item in document(capsys, gantry)["candidates"] if item["name"] == "ei2")
    (row,) = ei2["rows"]
    low_hz, high_hz = row["frequency_hz"]
    text, _, _ = gantry.read_text().partition("[[row]]")
    middle_hz = 1.0 / (row["times_s"][-1] / 1.5)  # two humps, undamped: one and a half periods
    gantry.write_text(text + f'[[row]]\nname = "all"\nfamily = "ei2"\nfrequency = {middle_hz!r}\n')
    (shaper,) = design_machine(load_machine(gantry)).shapers
    assert shaper.overtravel_s == pytest.approx(ei2["overtravel_s"], rel=1e-9)  # stored to 12 digits
    assert shaper.guarantee.frequency_hz == pytest.approx((low_hz, high_hz), rel=1e-9)


def test_all_wrong_options_are_said_at_once(gantry):
    with pytest.raises(OptionError) as error:
        recommend(gantry, tolerance="2", longest_overtravel="-1 m")
    assert error.value.problems == (
        "--tolerance = 2: must be at least 1e-06 and below 1",
        '--longest-overtravel = "-1 m": must be > 0',
    )


def test_a_missing_machine_is_a_file_error(tmp_path):
    with pytest.raises(FileError, match=r"none\.toml: cannot be read: there is no such file"):
        recommend(tmp_path / "none.toml")


def test_a_double_pendulum_is_refused(gantry):
    rows, _, _ = gantry.read_text().partition("[[row]]")
    masses = '[crane]\nsling_length = 2.0\nhook_mass = "200 kg"\nload_mass = "1000 kg"'
    row = '[[row]]\nname = "all"\nfamily = "si"\nrope_length = ["9 ft", "29 ft"]\n'
    gantry.write_text(rows.replace("[crane]", masses) + row)
    with pytest.raises(DesignError, match=r"gantry\.toml: \[crane\] sling_length: candidates are compared"):
        recommend(gantry)
