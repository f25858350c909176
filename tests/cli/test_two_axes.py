"""A machine with two axes on the command line: both blocks, their wiring, and the report of both."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from swayless.machine import example_text

ROW = '[[row]]\nname = "mid"\nfamily = "zvd"\nrope_length = 5\n'
OF_ROPE = {"residual_bound_at_rope = true", 'rope_offset = ["0 m", "2 m"]'}
"""What the example asks for that needs its measured rope."""

TEXT = "".join(
    line
    for line in example_text("two-axis-crane").split("[bank]")[0].splitlines(keepends=True)
    if line.split("#")[0].strip() not in OF_ROPE
)
TEXT += (
    ROW + "[axis.bridge.crane]\nmax_speed = 1.0\nacceleration = 0.25\n[axis.trolley.crane]\nmax_speed = 0.5\n"
)
"""The example with a row that takes no time to design; the example itself is built by the golden tests."""


@pytest.fixture(scope="module")
def text() -> str:
    return TEXT


@pytest.fixture
def built(run, blank_figures, tmp_path: Path, text: str) -> Path:
    (tmp_path / "crane.toml").write_text(text)
    assert run("build", "crane.toml", "--no-verify").code == 0
    return tmp_path / "crane"


def test_a_build_makes_and_proves_both_blocks_and_their_wiring(run, built: Path) -> None:
    document = json.loads(run("build", "crane.toml", "--json", "--soak-ticks", 300).out)
    assert [axis["axis"] for axis in document["axes"]] == ["bridge", "trolley"]
    assert [axis["name"] for axis in document["axes"]] == ["two_axis_crane_bridge", "two_axis_crane_trolley"]
    assert document["verified"] == "equal"
    codes = {each["code"] for each in document["runs"]}
    assert {code.split(" by")[0] for code in codes} == {
        *(f"{axis}, {language}" for axis in ("bridge", "trolley") for language in ("C", "ST")),
        "wiring in C",
        "wiring in ST",
    }
    assert sorted(path.name for path in (built / "st").iterdir()) == [
        "FB_two_axis_crane_Axes.st",
        "FB_two_axis_crane_bridge_Shaper.st",
        "FB_two_axis_crane_trolley_Shaper.st",
    ]
    assert run("build", "crane.toml", "--check").code == 0


def test_crossed_wires_in_c_are_found(run, built: Path) -> None:
    shutil.rmtree(built / "st")
    wiring = built / "c" / "two_axis_crane_example.c"
    honest = wiring.read_text()
    for right, wrong in (
        (
            "trolley.rope_length_m = pendant->rope_length_m",
            "trolley.rope_length_m = pendant->hoist_speed_m_s",
        ),
        ("bridge.command = pendant->bridge_command", "bridge.command = pendant->trolley_command"),
    ):
        if right in honest:
            wiring.write_text(honest.replace(right, wrong))
            done = run("verify", "crane", "--soak-ticks", 0)
            assert (done.code, "DIFFERS: wiring in C" in done.out) == (1, True), wrong


def test_crossed_wires_are_found(run, built: Path) -> None:
    assert run("verify", "crane", "--soak-ticks", 0).code == 0
    shutil.rmtree(built / "c")
    wiring = built / "st" / "FB_two_axis_crane_Axes.st"
    honest = wiring.read_text()
    for wrong in (
        honest.replace("Command := BridgeCommand", "Command := TrolleyCommand"),
        honest.replace("TrolleyReference := Trolley.Reference", "TrolleyReference := Bridge.Reference"),
        honest.replace("QuickStop := QuickStop,", "QuickStop := EmergencyStop,", 1),
    ):
        assert wrong != honest
        wiring.write_text(wrong)
        done = run("verify", "crane", "--soak-ticks", 0)
        assert (done.code, "DIFFERS: wiring in ST" in done.out) == (1, True)


def test_an_example_in_c_that_does_not_compile_is_found(run, built: Path) -> None:
    example = built / "c" / "two_axis_crane_example.c"
    example.write_text(example.read_text().replace("pendant->bridge_command", "pendant->brigde_command"))
    done = run("verify", "crane", "--soak-ticks", 0)
    assert done.code != 0
    assert "brigde_command" in done.err


def test_axes_in_different_number_types_are_refused(run, tmp_path: Path, text: str) -> None:
    (tmp_path / "crane.toml").write_text(text + '[axis.trolley.controller]\nnumber = "float"\n')
    done = run("build", "crane.toml", "--no-verify")
    assert done.code == 2
    assert "axes bridge and trolley differ in number type or tick" in done.err
    assert not (tmp_path / "crane").exists()


@pytest.mark.parametrize(
    "command",
    [
        ("simulate", "crane.toml"),
        ("design", "recommend", "crane.toml"),
        ("design", "bank", "crane.toml"),
        ("plot", "tradeoff", "crane.toml", "-o", "x.svg"),
    ],
    ids=lambda words: words[1] if words[0] == "design" else words[0],
)
def test_commands_for_one_axis_ask_which(run, tmp_path: Path, text: str, command: tuple[str, ...]) -> None:
    (tmp_path / "crane.toml").write_text(text)
    done = run(*command)
    assert (done.code, "choose one with --axis" in done.err) == (2, True)
    done = run(*command, "--axis", "hoist")
    assert (done.code, 'no axis "hoist"' in done.err) == (2, True)


def test_simulate_runs_the_axis_asked_for(run, tmp_path: Path, text: str) -> None:
    (tmp_path / "crane.toml").write_text(text)
    done = run("simulate", "crane.toml", "--axis", "trolley", "--move", "5 m", "--json")
    assert done.code == 0, done.err
    assert json.loads(done.out)["name"] == "two_axis_crane_trolley"


def test_a_directory_that_lost_a_design_is_refused(run, built: Path) -> None:
    for design in built.glob("*.design.json"):
        design.unlink()
    done = run("verify", "crane")
    assert (done.code, "holds 0 files *.design.json" in done.err) == (2, True)
    shutil.rmtree(built)
