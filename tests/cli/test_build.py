"""`swayless build`: what is written, what is kept, what is said."""

from __future__ import annotations

import json

import numpy as np
import pytest

from swayless.machine import EXAMPLE_NAMES, example_text
from tests.cli.conftest import snapshot

FILES = [
    "arm.design.json",
    "c/arm_example.c",
    "c/arm_shaper.c",
    "c/arm_shaper.h",
    "figures/bank.svg",
    "figures/response-1.svg",
    "figures/response-2.svg",
    "figures/sensitivity.svg",
    "st/FB_arm_Shaper.st",
]


pytestmark = pytest.mark.usefixtures("blank_figures")


def files_in(folder):
    return sorted(path for path, content in snapshot(folder).items() if content is not None)


def test_a_build_writes_every_file_and_says_what_it_proved(run, arm, tmp_path):
    done = run("build", arm.name, "--soak-ticks", 500)
    assert (done.code, done.err) == (0, "")
    assert files_in(tmp_path / "arm") == FILES
    lines = done.out.splitlines()
    assert lines[0] == "arm: what each position of the knob guarantees"
    assert lines[-1] == "arm: 9 files written"
    verified = [line for line in lines if line.startswith("verified: ")]
    assert [line.split()[1] for line in verified] == ["C", "ST"]
    assert all(line.endswith("equals the reference, bit for bit") for line in verified)


def test_without_verification_a_build_says_not_run(run, arm):
    assert "verified: not run (--no-verify)\n" in run("build", arm.name, "--no-verify").out
    assert json.loads(run("build", arm.name, "--no-verify", "--json").out)["verified"] == "not run"


def test_int32_says_that_structured_text_was_left_out(run, arm, tmp_path):
    arm.write_text(arm.read_text().replace('"double"', '"int32"'))
    done = run("build", arm.name, "--soak-ticks", 0)
    assert "Structured Text: not generated, int32 is for C only\n" in done.out
    assert files_in(tmp_path / "arm") == [path for path in FILES if not path.startswith("st/")]
    told = json.loads(run("build", arm.name, "--no-verify", "--json").out)
    assert told["left_out"] == {"st": "not generated, int32 is for C only"}
    verified = run("verify", "arm", "--soak-ticks", 0)
    assert verified.code == 0
    assert "Structured Text: not generated, int32 is for C only\n" in verified.out


def test_rows_with_negative_amplitudes_come_with_a_warning(run, gantry):
    out = run("build", gantry.name, "--no-verify").out
    assert (
        "negative amplitudes in long, middle, short: a new command waits until the last one has come to rest"
        in out
    )
    assert "the shortest jog at full speed goes 1.405 m" in out


def test_what_no_row_holds_is_said(run, gantry, arm):
    assert "held by no row: 2.743 to 3.177, 3.547 to 4.621, 5.16 to 6.931, 7.74 to 8.839 m of rope" in (
        run("build", gantry.name, "--no-verify").out
    )
    assert "every point of the range is held by at least one row" in run("build", arm.name, "--no-verify").out


def test_a_second_build_keeps_the_design_and_every_byte(run, arm, tmp_path):
    # 40 m/min has no finite decimal: code made from the unrounded number would change when the file is read.
    arm.write_text(arm.read_text().replace("max_speed = 1.2", 'max_speed = "40 m/min"'))
    run("build", arm.name, "--no-verify")
    before = snapshot(tmp_path)
    assert "design: kept as stored\n" in run("build", arm.name, "--no-verify").out
    assert snapshot(tmp_path) == before
    assert run("build", arm.name, "--check").out == "arm: 5 files as generated, 4 figures there\n"


def test_stored_numbers_are_kept_where_they_agree_and_replaced_where_they_do_not(run, arm, tmp_path):
    run("build", arm.name, "--no-verify")
    stored = tmp_path / "arm" / "arm.design.json"
    text = stored.read_text()
    agreeing = text.replace('"worst_residual_ratio": 0.05', '"worst_residual_ratio": 0.0499999999999')
    assert agreeing != text
    stored.write_text(agreeing)
    assert "design: kept as stored\n" in run("build", arm.name, "--no-verify").out
    assert stored.read_text() == agreeing
    arm.write_text(arm.read_text().replace("acceleration = 6", "acceleration = 5"))
    out = run("build", arm.name, "--no-verify").out
    assert (
        "design: replaces the stored one, 3 differences, the first: "
        "drive.acceleration_m_s2: stored 6.0, fresh 5.0" in out
    )
    assert stored.read_text() != agreeing


def test_a_damaged_stored_design_is_replaced_and_said(run, arm, tmp_path):
    run("build", arm.name, "--no-verify")
    stored = tmp_path / "arm" / "arm.design.json"
    text = stored.read_text()
    stored.write_text(text[: len(text) // 2])
    checked = run("build", arm.name, "--check")
    assert (checked.code, checked.out.splitlines()[0]) == (1, "--- arm.design.json (there)")
    done = run("build", arm.name, "--no-verify")
    assert done.code == 0
    assert "design: replaces a stored one that is damaged: arm/arm.design.json: line " in done.out
    assert stored.read_text() == text


def test_check_writes_nothing_and_names_every_difference(run, arm, tmp_path):
    missing = run("build", arm.name, "--check")
    assert missing.code == 1
    assert missing.out.splitlines() == [
        f"{path}: missing"
        for path in sorted(FILES, key=lambda p: (p.startswith("figures"), missing.out.index(p)))
    ]
    assert not (tmp_path / "arm").exists()
    run("build", arm.name, "--no-verify")
    (tmp_path / "arm" / "stray.txt").touch()
    (tmp_path / "arm" / "c" / "arm_shaper.c").write_text("int changed;\n")
    before = snapshot(tmp_path)
    done = run("build", arm.name, "--check", "--json")
    assert (done.code, done.err) == (1, "")
    told = json.loads(done.out)
    assert (told["directory"], told["checked"], sorted(told["files"])) == ("arm", True, FILES)
    assert told["differences"][0].startswith("--- c/arm_shaper.c (there)")
    assert told["differences"][1:] == ["stray.txt: too much, the generator does not make it"]
    assert snapshot(tmp_path) == before


def test_an_extra_file_is_refused_before_anything_is_proved(run, arm, tmp_path, monkeypatch):
    run("build", arm.name, "--no-verify")
    (tmp_path / "arm" / "mine.txt").write_text("mine")
    monkeypatch.setattr("swayless.verify.verify_block", None)
    done = run("build", arm.name)
    assert (done.code, done.out) == (2, "")
    assert "arm/mine.txt: is not a file that swayless makes here" in done.err


def test_code_that_differs_is_not_written(run, arm, tmp_path, monkeypatch):
    from swayless.codegen import GeneratedFile
    from swayless.codegen import generate as right

    def wrong(settings, origin, target):
        return tuple(
            GeneratedFile(file.path, file.text.replace("s->status = 0u;", "s->status = 1u;"))
            for file in right(settings, origin, target)
        )

    monkeypatch.setattr("swayless.codegen.generate", wrong)
    for arguments in (("--soak-ticks", 0), ("--soak-ticks", 0, "--json")):
        done = run("build", arm.name, *arguments)
        assert done.code == 1
        assert not (tmp_path / "arm").exists()
        assert "status: expected 2, got 3" in done.out
    told = json.loads(done.out)
    assert (told["verified"], told["files"]) == ("differs", [])


def ramp_down(speed, rate, tick_s):
    """Speeds from the tick of the release on."""
    ticks = np.arange(1, int(speed / (rate * tick_s)) + 3)
    return np.maximum(speed - rate * tick_s * ticks, 0.0)


def has_one_axis_and_fixed_delays(text):
    return not any(word in text for word in ('law = "phase"', 'law = "modified"', "[axis."))


@pytest.mark.parametrize(
    "name", [name for name in EXAMPLE_NAMES if has_one_axis_and_fixed_delays(example_text(name))]
)
def test_the_stop_distances_are_the_sums_of_an_independent_convolution(run, tmp_path, name):
    (tmp_path / "m.toml").write_text(example_text(name))
    rows = json.loads(run("build", "m.toml", "--no-verify", "--json").out)["rows"]
    (stored,) = (tmp_path / "m").glob("*.design.json")
    design = json.loads(stored.read_text())
    drive, tick_s, speed = design["drive"], design["tick_s"], design["drive"]["max_speed_m_s"]
    # Ramp steps are rounded to the number type, and int32 blocks give whole millimetres and counts.
    tolerance_m = {"double": 1e-9, "float": 3e-5, "int32": 1.1e-3}[design["number"]]
    quick_m = tick_s * ramp_down(speed, drive["quick_stop_m_s2"], tick_s).sum()
    release = ramp_down(speed, drive["deceleration_m_s2"], tick_s)
    assert rows[0]["stop_distance_released_m"] == pytest.approx(tick_s * release.sum(), abs=tolerance_m)
    for row, shaper in zip(rows[1:], design["shapers"], strict=True):
        delays, amplitudes = shaper["taps"]["delays_ticks"], shaper["taps"]["amplitudes"]
        longest = max(delays)
        command = np.concatenate([np.full(longest, speed), release, np.zeros(longest)])
        kernel = np.zeros(longest + 1)
        kernel[delays] = amplitudes
        reference = np.convolve(command, kernel, mode="valid")
        assert row["stop_distance_released_m"] == pytest.approx(tick_s * reference.sum(), abs=tolerance_m)
        assert row["stop_distance_quick_m"] == pytest.approx(quick_m, abs=tolerance_m)
