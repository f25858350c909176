"""Several axes in one machine file: what is shared, what is an axis's own, and where a problem is said."""

from __future__ import annotations

from pathlib import Path

import pytest

from swayless.errors import FileError
from swayless.machine import example_text, load_machine
from swayless.machine.machine_file import load_axes

FILE = """
name = "yard"
[crane]
rope_length = [3, 9]
max_speed = 1.0
acceleration = 0.5
[controller]
tick = "10 ms"
[[row]]
name = "any"
family = "zvd"
rope_length = 5
[axis.bridge.crane]
max_speed = 0.8
[axis.trolley.drive]
minimum_speed = 0.01
[[axis.trolley.row]]
name = "own"
family = "zv"
rope_length = 4
"""


@pytest.fixture
def written(tmp_path: Path):
    def write(text: str) -> Path:
        path = tmp_path / "crane.toml"
        path.write_text(text)
        return path

    return write


def problems(path: Path, **options) -> list[str]:
    with pytest.raises(FileError) as refused:
        load_machine(path, **options) if options else load_axes(path)
    return [problem.split("crane.toml: ", 1)[1] for problem in refused.value.problems]


def test_sections_are_merged_key_by_key_and_rows_replaced_as_a_whole(written) -> None:
    axes = load_axes(written(FILE))
    bridge, trolley = axes.machines
    assert (axes.name, bridge.name, trolley.name) == ("yard", "yard_bridge", "yard_trolley")
    assert (bridge.axis, trolley.axis) == ("bridge", "trolley")
    assert (bridge.drive.max_speed_m_s, trolley.drive.max_speed_m_s) == (0.8, 1.0)
    assert (bridge.drive.minimum_speed_m_s, trolley.drive.minimum_speed_m_s) == (0.0, 0.01)
    assert [row.name for row in bridge.rows] == ["any"]
    assert [row.name for row in trolley.rows] == ["own"]
    assert bridge.plant == trolley.plant


def test_one_axis_can_be_loaded_and_none_is_chosen_silently(written) -> None:
    path = written(FILE)
    assert load_machine(path, axis="trolley") == load_axes(path).machines[1]
    assert problems(path, axis="trolly") == [
        'axis: no axis "trolly": nearest: trolley; known: bridge, trolley'
    ]
    with pytest.raises(FileError, match="the file has axes bridge, trolley: choose one with --axis"):
        load_machine(path)


def test_a_file_without_axes_is_one_machine_and_has_no_axis_to_choose(written) -> None:
    path = written(example_text("srtc-gantry"))
    axes = load_axes(path)
    assert axes.machines == (load_machine(path),)
    assert (axes.name, axes.machines[0].axis) == ("srtc_gantry", "")
    assert problems(path, axis="bridge") == ['axis: no axis "bridge": the file has none']


def test_a_problem_of_all_axes_is_reported_once_and_one_of_an_axis_in_its_own_section(written) -> None:
    wrong = FILE.replace("acceleration = 0.5", "acceleration = -1").replace(
        "max_speed = 0.8", "max_speed = 0"
    )
    assert problems(written(wrong)) == [
        "[axis.bridge.crane] max_speed = 0: must be > 0",
        "[crane] acceleration = -1: must be > 0",
    ]
    assert problems(written(wrong), axis="trolley") == ["[crane] acceleration = -1: must be > 0"]


def test_what_is_missing_in_one_axis_only_names_that_axis(written) -> None:
    assert problems(written(FILE.replace("max_speed = 1.0\n", ""))) == [
        "[axis.trolley.crane] max_speed: missing"
    ]
    assert problems(written(FILE.replace("rope_length = 4\n", "rope_length = -4\n"))) == [
        '[[axis.trolley.row]] 1 ("own") rope_length = -4: must be > 0'
    ]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (
            "axis = 3\n" + FILE.split("[axis", maxsplit=1)[0],
            "axis = 3: must be sections [axis.NAME], one for each axis",
        ),
        (FILE + "[axis.hoist]\nname = 'x'\n", '[axis.hoist] name = "x": stands once in the file'),
        ("axis = {}\n" + FILE.split("[axis", maxsplit=1)[0], "axis: 0 axes: 1 to 4 are allowed"),
        (FILE + "".join(f"[axis.a{n}]\n" for n in range(3)), "axis: 5 axes: 1 to 4 are allowed"),
        (FILE + "[axis.Hoist]\n", '[axis.Hoist] name = "yard_Hoist": '),
        (FILE + "[axis.trolley.crne]\n", "[axis.trolley] crne: unknown section"),
        (FILE + "[axis.bridge]\ncrane2 = 1\n", None),
    ],
)
def test_garbage_in_axes_is_refused(written, text: str, problem: str | None) -> None:
    found = problems(written(text))
    assert found
    if problem is not None:
        assert any(line.startswith(problem) for line in found), found
