"""One bad machine file for each message about functions of the operator: a good file, one change."""

from __future__ import annotations

from pathlib import Path

import pytest

from swayless.errors import ControllerError, FileError
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings

GOOD = """name = "good"
[crane]
rope_length = [4, 8]
hoist_speed = 0.2
max_speed = 0.5
acceleration = 0.3
[controller]
tick = 0.02
law = "phase"
start_from_zero = true
predicted_sway = true
design_check = true
[drive]
feedback = true
tracking_tolerance = 0.05
[steps]
sizes = [0.05, 0.1, 0.25]
speed = 0.2
[limits]
stop_switches = true
slow_speed = 0.1
margin = 0.3
[tuning]
speed_limit = true
rope_offset = [-0.3, 0.5]
[[row]]
name = "one"
family = "zvd"
"""

CONTACTOR = """name = "good"
[crane]
rope_length = [4, 8]
max_speed = 0.5
[controller]
tick = 0.02
[drive]
contactor = true
contactor_speeds = [0.1, 0.5]
[limits]
stop_switches = true
slow_speed = 0.1
margin = 0.3
[[row]]
name = "one"
family = "um-zv"
rope_length = 6
tolerance = 0.1
"""

SWAY = "[controller] predicted_sway: is of "


def _cases(name: str) -> list[str]:
    return (Path(__file__).parent / name).read_text(encoding="utf-8").split("\n\n")[1:]


CASES = [(GOOD, case) for case in _cases("function-cases.txt")]
CASES += [(CONTACTOR, case) for case in _cases("contactor-function-cases.txt")]


def _problems(folder: Path, text: str) -> list[str]:
    path = folder / "crane.toml"
    path.write_text(text)
    with pytest.raises(FileError) as caught:
        load_machine(path)
    return [problem.removeprefix(f"{path}: ") for problem in caught.value.problems]


def _part(case: str, sign: str) -> list[str]:
    return [line[2:] for line in case.splitlines() if line.startswith(sign)]


@pytest.mark.parametrize(("good", "case"), CASES, ids=[_part(case, "!")[0] for _, case in CASES])
def test_each_mistake_has_its_message(tmp_path: Path, good: str, case: str) -> None:
    old, new = "\n".join(_part(case, "-")), "\n".join(_part(case, "+"))
    assert old in good
    # Without a measured rope the row needs one of its own: the only case that takes more than one change.
    text = good.replace(old, new, 1)
    text = text if 'law = "phase"' in text or good is CONTACTOR else text + "rope_length = 5\n"
    assert _problems(tmp_path, text) == _part(case, "!")


@pytest.mark.parametrize("good", [GOOD, CONTACTOR], ids=["ramped", "contactor"])
def test_the_good_file_has_a_block(tmp_path: Path, good: str) -> None:
    path = tmp_path / "crane.toml"
    path.write_text(good)
    assert shaper_settings(design_machine(load_machine(path))).operator.has_stop_switches


PLAIN = """name = "good"
[crane]
rope_length = [4, 8]
max_speed = 0.5
[controller]
tick = 0.02
predicted_sway = true
[[row]]
name = "one"
family = "zvd"
rope_length = 6
"""


def test_sway_is_not_predicted_for_an_arm(tmp_path: Path) -> None:
    text = PLAIN.replace("[crane]\nrope_length = [4, 8]", "[arm]\nfrequency = 1")
    found = _problems(tmp_path, text.replace("rope_length = 6", "frequency = 1"))
    assert found == [SWAY + "a load on a rope, and this is an [arm]: leave it out"]


def test_sway_is_not_predicted_for_a_double_pendulum(tmp_path: Path) -> None:
    text = PLAIN.replace("max_speed", "sling_length = 2\nhook_mass = 50\nload_mass = 500\nmax_speed")
    found = _problems(tmp_path, text.replace('"zvd"\nrope_length = 6', '"si"\nrope_length = [4, 8]'))
    assert found == [SWAY + "a load that swings in one mode, and sling_length makes two: leave it out"]


def test_sway_is_not_predicted_below_a_driven_trolley(tmp_path: Path) -> None:
    drive = '[drive]\ntrolley_mass = "2 t"\nload_mass = "6 t"\nspeed_loop_lag = 0.1\n[[row]]'
    found = _problems(tmp_path, PLAIN.replace("[[row]]", drive))
    assert found == [SWAY + "an ideal trolley, and trolley_mass makes a driven one: leave it out"]


def test_a_bound_at_the_rope_needs_a_measured_rope(tmp_path: Path) -> None:
    (problem,) = _problems(tmp_path, PLAIN.replace("predicted_sway", "residual_bound_at_rope"))
    assert problem == (
        "[controller] residual_bound_at_rope: needs a measured rope: "
        'law = "phase", or a [bank] with selection = "rope_length"'
    )


def test_a_step_that_counts_cannot_make_is_refused_with_what_to_raise(tmp_path: Path) -> None:
    path = tmp_path / "crane.toml"
    counts = '[drive]\ncounts_per_m_s = 3\n[steps]\nsizes = ["50 mm", "100 mm", "250 mm"]\n[[row]]'
    text = PLAIN.replace("[[row]]", counts).replace("predicted_sway = true", 'number = "int32"')
    path.write_text(text)
    with pytest.raises(ControllerError, match=r"0\.05 m is not within 0\.1% .* raise counts_per_m_s"):
        shaper_settings(design_machine(load_machine(path)))
