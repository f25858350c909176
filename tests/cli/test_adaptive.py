"""`build` and `verify` of the example with an adaptive shaper."""

import json
from pathlib import Path

import pytest

from swayless.verify import adaptive

EXAMPLE = Path(__file__).parents[2] / "examples" / "adaptive-robot.toml"
FILES = [
    "adaptive_robot.adaptive.json",
    "c/adaptive_robot_adaptive.c",
    "c/adaptive_robot_adaptive.h",
    "c/adaptive_robot_example.c",
    "st/FB_adaptive_robot_Adaptive.st",
]


@pytest.fixture(autouse=True)
def few_moves(monkeypatch):
    """Bit equality is proven elsewhere; here a few moves show that the proof runs at all."""
    monkeypatch.setattr(adaptive, "MOVES", 4)


def test_the_example_builds_is_proved_and_can_be_verified_and_checked_again(run, tmp_path):
    out = tmp_path / "out"
    built = run("build", str(EXAMPLE), "-o", str(out), "--json")
    document = json.loads(built.out)
    assert (built.code, document["verified"]) == (0, "equal")
    assert sorted(document["files"]) == FILES
    assert {part["code"].split()[0] for part in document["runs"]} == {"C", "ST"}
    assert run("build", str(EXAMPLE), "-o", str(out), "--check").code == 0
    code = out / "st" / "FB_adaptive_robot_Adaptive.st"
    code.write_text(code.read_text().replace("Reference := HeldCommand", "Reference := -HeldCommand"))
    verified = run("verify", str(out))
    assert verified.code == 1
    assert "verified: C by" in verified.out
    assert "DIFFERS: ST by evaluator, LREAL" in verified.out
    assert run("build", str(EXAMPLE), "-o", str(out), "--check").code == 1


def test_without_the_proof_it_says_so(run, tmp_path):
    built = run("build", str(EXAMPLE), "-o", str(tmp_path / "out"), "--no-verify")
    assert built.code == 0
    assert "verified: not run (--no-verify)" in built.out
    assert "5 files written" in built.out
