"""`swayless design` and `swayless plot`: what a person reads, and what a machine does."""

from __future__ import annotations

import json

import pytest

from swayless.design import FAMILIES

PARAMETERS = {"zvm": ("--order", 2), "oatf": ("--delay", 0.2)}


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_can_be_designed(run, family):
    done = run("design", family, "--frequency", 1, *PARAMETERS.get(family, ()))
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith(f"{family} for 1 Hz, damping ratio 0\n")
    negative = FAMILIES[family].negative
    assert ("negative amplitudes: a new command waits until" in done.out) is negative


def test_every_family_stands_in_the_help(run):
    words = run("design", "--help").out.replace(".", " ").replace(";", " ").split()
    assert set(FAMILIES) <= set(words)


def test_impulses_and_taps_stand_side_by_side(run):
    out = run("design", "um-zv", "--rope-length", "24 ft", "--tick", "10 ms").out
    assert out.startswith("um-zv for 0.184275 Hz (rope 7.3152 m), damping ratio 0\n")
    facts = {
        line[2:22].strip(): line[22:].split("  ") for line in out.partition("guarantees")[2].splitlines()
    }
    assert [text.strip() for text in facts["duration"] if text] == ["1.80889 s", "1.81 s"]
    assert [text.strip() for text in facts["on ropes of"] if text] == ["6.931 to 7.739 m"] * 2
    assert {"leaves at most 5 %", "overtravel", "peak factor"} <= facts.keys()
    assert "the command is held for at least 1.81 s" in out
    assert "no taps" not in out


def test_a_frequency_is_no_rope(run):
    out = run("design", "ei", "--frequency", 4.5).out
    assert "rope" not in out
    assert "note: no taps: give --tick" in out


def test_a_guaranteed_range_is_printed_rounded_inward(run):
    out = run("design", "ei", "--rope-length", 5).out
    held = json.loads(run("design", "ei", "--rope-length", 5, "--json").out)["shapers"][0]["guarantee"]
    (line,) = (line for line in out.splitlines() if "on ropes of" in line)
    low, high = (float(word) for word in line.split()[3:6:2])
    assert held["rope_length_m"][0] <= low < high <= held["rope_length_m"][1]
    assert (low, high) == pytest.approx(held["rope_length_m"], rel=1e-3)  # four digits are printed


def test_period_and_frequency_of_one_mode_give_one_design(run):
    period_s = 1.0 / (2.0 * (1.0 - 0.1**2) ** 0.5)
    by_frequency = json.loads(run("design", "zv", "--frequency", 2, "--damping", 0.1, "--json").out)
    by_period = json.loads(run("design", "zv", "--period", period_s, "--damping", "10 %", "--json").out)
    assert by_period["shapers"][0]["times_s"] == pytest.approx(
        by_frequency["shapers"][0]["times_s"], rel=1e-11
    )


def test_json_is_the_design_file_itself(run, tmp_path):
    done = run("design", "ei", "--rope-length", 5, "--tick", "20 ms", "-o", "ei.json", "--json")
    assert (tmp_path / "ei.json").read_text() == done.out
    assert json.loads(done.out)["schema"] == "swayless.design/1"


@pytest.mark.parametrize(
    "line",
    [
        "init made.toml",
        "design zv --frequency 1",
        "plot sensitivity taps.json waits.json --span 3 6 -o a.svg",
        "plot sensitivity waits.json --over rope-length --definition magee -o a.png",
        "plot response waits.json --press 2 -o a.pdf",
        "generate c taps.json -o made",
        "generate st taps.json -o made",
        "generate st taps.json -o made --check",
        "verify taps.json --soak-ticks 0",
    ],
)
def test_json_is_one_document_on_standard_output_and_nothing_else(run, designs, tmp_path, line):
    for path in designs.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    done = run(*line.split(), "--json")
    assert done.err == ""
    assert isinstance(json.loads(done.out), dict)
    assert done.code == (1 if "--check" in line else 0)


def test_the_same_design_gives_the_same_code_and_check_agrees(run, designs):
    for language in ("c", "st"):
        run("generate", language, designs / "taps.json", "-o", language)
        done = run("generate", language, designs / "taps.json", "-o", language, "--check")
        assert done.code == 0
        assert all(line.endswith(": as generated") for line in done.out.splitlines())


def test_an_arm_is_not_drawn_over_rope_lengths(run, arm, blank_figures):
    run("build", arm.name, "--no-verify")
    done = run("plot", "sensitivity", "arm/arm.design.json", "--over", "rope-length", "-o", "a.svg")
    assert (done.code, done.out) == (2, "")
    assert "the design arm is of an arm, which hangs on no rope" in done.err
