"""One bad machine file for each message: the good file below with one thing changed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swayless.errors import FileError
from swayless.machine import load_machine
from swayless.machine.examples import example_path

GOOD = """name = "good"
[crane]
rope_length = [4, 8]
max_speed = 1
[controller]
tick = 0.01
[[row]]
name = "one"
family = "zv"
rope_length = 5
"""

ROW = '[[row]] 1 ("one")'


def _cases(name: str) -> list[str]:
    return (Path(__file__).parent / name).read_text(encoding="utf-8").split("\n\n")[1:]


CASES, ARM_CASES = _cases("machine-file-cases.txt"), _cases("arm-file-cases.txt")

SYNTAX = [
    ("[4, 8]", "29 ft", "line 3, column 18: 'rope_length = 29 ft': not valid TOML: ",
     '; a quantity with a unit stands in quotes: "29 ft"'),
    ("[4, 8]", "[4, 8", "line 4, column 1: 'max_speed = 1': not valid TOML: ", ""),
    ("max_speed = 1", "rope_length = 1", "line 4, column 16: 'rope_length = 1': not valid TOML: ", ""),
    ("rope_length = 5", "rope_length = '5", "not valid TOML: ", "(at end of document)"),
    ("rope_length = 5\n", "x = [", "not valid TOML: ", ""),
    ("rope_length = 5\n", f"x = {'[' * 5000}", "not valid TOML: nested too deeply", ""),
    ("rope_length = 5\n", f"x = {'9' * 5000}", "not valid TOML: ", ""),
]  # fmt: skip


def _problems(folder: Path, content: str | bytes) -> list[str]:
    """Write a machine file, and give what loading it reports, without the path."""
    path = folder / "crane.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(FileError) as caught:
        load_machine(path)
    problems = caught.value.problems
    assert all(problem.startswith(f"{path}: ") for problem in problems)
    assert all(problem.isascii() and problem.isprintable() and len(problem) < 400 for problem in problems)
    return [problem.removeprefix(f"{path}: ") for problem in problems]


def test_the_good_file_is_good(tmp_path: Path) -> None:
    path = tmp_path / "crane.toml"
    path.write_text(GOOD)
    assert load_machine(path).name == "good"


def _part(case: str, sign: str) -> list[str]:
    return [line[2:] for line in case.splitlines() if line.startswith(sign)]


@pytest.mark.parametrize("case", CASES, ids=[_part(case, "!")[0] for case in CASES])
def test_each_mistake_has_its_message(tmp_path: Path, case: str) -> None:
    old, new = "\n".join(_part(case, "-")), "\n".join(_part(case, "+"))
    assert old in GOOD
    assert _problems(tmp_path, GOOD.replace(old, new, 1)) == _part(case, "!")


@pytest.mark.parametrize("case", ARM_CASES, ids=[_part(case, "!")[0] for case in ARM_CASES])
def test_each_mistake_of_an_arm_with_positions_has_its_message(
    tmp_path: Path, arm_text: str, case: str
) -> None:
    old, new = "\n".join(_part(case, "-")), "\n".join(_part(case, "+"))
    assert old in arm_text
    assert _problems(tmp_path, arm_text.replace(old, new, 1)) == _part(case, "!")


@pytest.mark.parametrize(("old", "new", "start", "end"), SYNTAX)
def test_a_syntax_error_shows_its_line(tmp_path: Path, old: str, new: str, start: str, end: str) -> None:
    assert old in GOOD
    (problem,) = _problems(tmp_path, GOOD.replace(old, new, 1))
    assert problem.startswith(start)
    assert problem.endswith(end)


def test_an_unknown_family_names_the_nearest_and_all(tmp_path: Path) -> None:
    (problem,) = _problems(tmp_path, GOOD.replace('"zv"', '"zvv"'))
    assert problem.startswith(f'{ROW} family = "zvv": unknown family; nearest: zv')
    assert "; known: zv, zvd, zvdd, " in problem


def test_all_mistakes_of_a_file_are_reported_at_once(tmp_path: Path) -> None:
    text = GOOD
    for old, new in [
        ('"good"', '"int"'),
        ("[4, 8]", "[0, 8]"),
        ("max_speed = 1", ""),
        ("0.01", "2"),
        ('"zv"', '"sv"'),
    ]:
        text = text.replace(old, new, 1)
    problems = _problems(tmp_path, text + "\nrope = 1\n")
    assert [problem.split(" = ")[0].split(": ")[0] for problem in problems] == [
        "name",
        "[crane] rope_length[0]",
        "[crane] max_speed",
        "[controller] tick",
        f"{ROW} family",
        f"{ROW} rope",
    ]


@pytest.mark.parametrize("content", ["", "\n \n", "# only a comment\n", "\ufeff"])
def test_an_empty_file_says_what_is_needed_and_how_to_start(tmp_path: Path, content: str) -> None:
    assert _problems(tmp_path, content) == [
        "is empty: a machine file needs name, [crane] or [arm], [controller] and at least one [[row]] or a "
        "[bank]; 'swayless init' writes a commented file to start from"
    ]


@pytest.mark.parametrize(
    ("example", "says"),
    [
        ("adaptive-robot", "[adaptive]: an adaptive shaper"),
        ("time-optimal-oscillator", "[plant]: a move computed ahead"),
        ("inverted-servo", "[move]: a move computed ahead"),
    ],
)
def test_a_file_of_another_block_is_named_as_such(example: str, says: str) -> None:
    with pytest.raises(FileError, match=re.escape(says)):
        load_machine(example_path(example))


def test_bytes_that_are_not_utf8_are_located(tmp_path: Path) -> None:
    assert _problems(tmp_path, b'name = "a"\nx = "\xff"') == ["is not UTF-8 text: byte 0xff in line 2"]


def test_a_file_that_is_no_machine_file_by_size_is_not_parsed(tmp_path: Path) -> None:
    assert _problems(tmp_path, "#" * 1_000_001) == ["is larger than 1000000 bytes, the most that is read"]


@pytest.mark.parametrize(
    ("name", "reason"),
    [("none.toml", "there is no such file"), ("", "it is a directory"), ("\0", "embedded null byte")],
)
def test_a_path_that_is_no_file_says_why(tmp_path: Path, name: str, reason: str) -> None:
    with pytest.raises(FileError, match=f": cannot be read: {reason}$"):
        load_machine(tmp_path / name)


def test_a_forbidden_file_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def forbid(self: Path, mode: str) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", forbid)
    with pytest.raises(FileError, match=r"crane\.toml: cannot be read: permission denied$"):
        load_machine(tmp_path / "crane.toml")
