"""One bad speed loop for each message, in a good machine file and a good design file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from swayless.errors import FileError
from swayless.machine import load_design, load_machine, save_text
from swayless.machine.designing import design_machine

LOOP = 'trolley_mass = 2000\nload_mass = "6 t"\nspeed_loop_lag = "0.1 s"\n'
GOOD = f"""name = "good"
[crane]
rope_length = [4, 8]
max_speed = 1
[drive]
{LOOP}[controller]
tick = 0.01
[[row]]
name = "one"
family = "zv"
rope_length = 5
"""
ROW = '[[row]] 1 ("one")'
CASES = (Path(__file__).parent / "speed-loop-cases.txt").read_text(encoding="utf-8").split("\n\n")[1:]


def problems_of(path: Path, text: str) -> list[str]:
    path.write_text(text)
    with pytest.raises(FileError) as caught:
        load_machine(path)
    return [problem.removeprefix(f"{path}: ") for problem in caught.value.problems]


def part(case: str, sign: str) -> list[str]:
    return [line[2:] for line in case.splitlines() if line.startswith(sign)]


@pytest.mark.parametrize("case", CASES, ids=[part(case, "!")[0] for case in CASES])
def test_each_mistake_has_its_message(tmp_path, case):
    old, new = "\n".join(part(case, "-")), "\n".join(part(case, "+"))
    assert GOOD.count(old) == 1
    assert problems_of(tmp_path / "crane.toml", GOOD.replace(old, new)) == part(case, "!")


def test_a_row_on_a_rope_that_does_not_vibrate_is_refused(tmp_path):
    text = GOOD.replace('"6 t"', "60000").replace('"0.1 s"', "0.8")
    text = text.replace("rope_length = 5", "rope_length = 1.2")
    assert problems_of(tmp_path / "crane.toml", text) == [
        f"{ROW} rope_length = 1.2: the speed loop damps the load on 1.2 m of rope so well that nothing "
        "vibrates; a mode needs a stiffer speed loop"
    ]


def test_an_arm_has_no_speed_loop(tmp_path):
    text = GOOD.replace("[crane]\nrope_length = [4, 8]", "[arm]\nfrequency = 1")
    text = text.replace("rope_length = 5", "frequency = 1")
    reason = "a speed loop is felt by the load of a [crane] given by rope_length; leave it out"
    assert problems_of(tmp_path / "arm.toml", text) == [f"[drive] trolley_mass: {reason}"]


@pytest.fixture(scope="module")
def document(tmp_path_factory) -> Any:
    path = tmp_path_factory.mktemp("driven") / "crane.toml"
    path.write_text(GOOD)
    return json.loads(save_text(design_machine(load_machine(path))))


BELONGS = 'drive.speed_loop: needs plant.kind = "crane", plant.rope_length_m and law = "fixed"'
POSITIVE = "must be finite and > 0"
STORED = [
    ("drive.speed_loop.trolley_mass_kg", -1.0, f"drive.speed_loop.trolley_mass_kg = -1.0: {POSITIVE}"),
    ("drive.speed_loop.load_mass_kg", 0, f"drive.speed_loop.load_mass_kg = 0: {POSITIVE}"),
    ("drive.speed_loop.gain_n_s_m", None, "drive.speed_loop.gain_n_s_m = null: must be a number"),
    ("drive.speed_loop.integral_time_s", "1", 'drive.speed_loop.integral_time_s = "1": must be a number'),
    ("drive.speed_loop", [], "drive.speed_loop = []: must be an object"),
    ("plant.kind", "mode", BELONGS),
    ("plant.rope_length_m", None, BELONGS),
]


@pytest.mark.parametrize(("key", "value", "expected"), STORED, ids=[case[0] for case in STORED])
def test_each_wrong_value_of_a_design_file_has_its_message(tmp_path, document, key, value, expected):
    changed = json.loads(json.dumps(document))
    *parents, last = key.split(".")
    target = changed
    for parent in parents:
        target = target[parent]
    target[last] = value
    path = tmp_path / "crane.json"
    path.write_text(json.dumps(changed))
    with pytest.raises(FileError) as caught:
        load_design(path)
    assert list(caught.value.problems) == [f"{path}: {expected}"]


def test_each_key_of_the_speed_loop_is_needed(tmp_path, document):
    for key in document["drive"]["speed_loop"]:
        changed = json.loads(json.dumps(document))
        del changed["drive"]["speed_loop"][key]
        path = tmp_path / "crane.json"
        path.write_text(json.dumps(changed))
        with pytest.raises(FileError) as caught:
            load_design(path)
        assert list(caught.value.problems) == [f"{path}: drive.speed_loop.{key}: missing"]
