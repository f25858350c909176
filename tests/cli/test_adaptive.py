"""`build` and `verify` of the example with an adaptive shaper."""

import json
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from swayless.cli.adaptive_learning import MOVES, simulated_learning
from swayless.machine.adaptive_file import load_adaptive
from swayless.plant import Mode
from swayless.verify import adaptive

ROOT = Path(__file__).parents[2]
EXAMPLE, PAGE = ROOT / "examples" / "adaptive-robot.toml", ROOT / "docs" / "adaptive.md"
FILES = [
    "adaptive_robot.adaptive.json",
    "c/adaptive_robot_adaptive.c",
    "c/adaptive_robot_adaptive.h",
    "c/adaptive_robot_example.c",
    "figures/learning.svg",
    "st/FB_adaptive_robot_Adaptive.st",
]


@pytest.fixture(autouse=True)
def few_moves(monkeypatch):
    """Bit equality is proven elsewhere; here a few moves show that the proof runs at all."""
    monkeypatch.setattr(adaptive, "MOVES", 1)


def test_the_command_lines_of_the_page_build_the_example_which_can_be_verified_and_checked_again(
    run, tmp_path
):
    first, second = (line for line in PAGE.read_text().splitlines() if line.startswith("swayless "))
    assert run(*shlex.split(first)[1:]).code == 0
    assert (tmp_path / "adaptive-robot.toml").read_text() == EXAMPLE.read_text()
    built = run(*shlex.split(second)[1:], "--json", "--soak-ticks", "300")
    document, out = json.loads(built.out), tmp_path / "adaptive-robot"
    assert (built.code, document["verified"]) == (0, "equal")
    assert (document["quiet_s"], document["window_s"]) == (0.101, 0.2)
    assert sorted(document["files"]) == FILES
    assert {part["code"].split()[0] for part in document["runs"]} == {"C", "ST"}
    soaks = [(part["code"][0], part["ticks"]) for part in document["runs"] if part["stimulus"] == "soak"]
    assert soaks == [("C", 300)]
    assert run("build", str(EXAMPLE), "-o", str(out), "--check").code == 0
    code = out / "st" / "FB_adaptive_robot_Adaptive.st"
    code.write_text(code.read_text().replace("Reference := HeldCommand", "Reference := -HeldCommand"))
    verified = run("verify", str(out), "--soak-ticks", "0")
    assert verified.code == 1
    assert "verified: C by" in verified.out
    assert "DIFFERS: ST by evaluator, LREAL" in verified.out
    assert run("build", str(EXAMPLE), "-o", str(out), "--check").code == 1


def test_without_the_proof_it_says_so_and_what_rests_must_last_for(run, tmp_path):
    built = run("build", str(EXAMPLE), "-o", str(tmp_path / "out"), "--no-verify")
    assert built.code == 0
    assert "learns from 0.101 s after the command has come to rest, by windows of 0.2 s" in built.out
    assert "frequency: not given" in built.out
    assert "verified: not run (--no-verify)" in built.out
    assert "6 files written" in built.out


@pytest.mark.parametrize(
    ("changes", "title"),
    [
        ({}, "adaptive_robot: learning a vibration of 16 Hz (0.4 periods in a delay)"),
        ({"mode": Mode(14.0, 0.02)}, "adaptive_robot: learning the file's vibration of 14 Hz, simulated"),
        ({"mode": Mode(14.0)}, "adaptive_robot: learning the file's vibration of 14 Hz, damping ratio 0.01,"),
        ({"delay_ticks": 25_000, "lag_ticks": 1_000_000}, "adaptive_robot: learning a vibration of 0.016 Hz"),
    ],
)
def test_the_figure_shows_how_the_file_s_vibration_is_learned(changes, title):
    machine = load_adaptive(EXAMPLE)
    learning = simulated_learning(replace(machine, settings=replace(machine.settings, **changes)))
    assert learning.title.startswith(title)
    # 5 % of noise over windows of 200 samples or more.
    assert learning.coefficients[-1] == pytest.approx(learning.wanted, abs=2e-3)
    assert np.abs(learning.vibration_ratio[: learning.time_s.size // MOVES]).max() > 0.8
    assert np.abs(learning.vibration_ratio[-200:]).max() < 0.05
    assert learning.in_use_from_s is not None


def test_the_figure_of_a_vibration_that_dies_too_fast_to_be_learned_says_so_by_what_it_leaves_out():
    machine = load_adaptive(EXAMPLE)
    learning = simulated_learning(replace(machine, settings=replace(machine.settings, mode=Mode(14.0, 0.3))))
    assert (learning.coefficients == learning.coefficients[0]).all()
    assert learning.in_use_from_s is None
