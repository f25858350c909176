"""One bad design file for each message: the documented file with one thing changed."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swayless.errors import FileError
from swayless.machine import load_design

POSITIVE = "must be finite and > 0"
CASES = (Path(__file__).parent / "design-file-cases.txt").read_text(encoding="utf-8").split("\n\n")[1:]

TEXTS = [
    ("", "is empty: a design file is JSON that 'swayless design' or 'swayless build' writes"),
    (" \n", "is empty: a design file is JSON that 'swayless design' or 'swayless build' writes"),
    ("[1, 2]", "[1, 2]: must be an object"),
    ("null", "null: must be an object"),
    ('{"a": 1,}', "line 1, column 9: not valid JSON: "),
    ("{\n'a': 1}", "line 2, column 1: not valid JSON: Expecting property name enclosed in double quotes"),
    ('{"a": 1', "line 1, column 8: not valid JSON: Expecting ',' delimiter"),
    ("\x00\x01", "line 1, column 1: not valid JSON: Expecting value"),
    ("[" * 100_000, "not valid JSON: "),
    ('{"tick_s": ' + "9" * 5000 + "}", "not valid JSON: "),
    ("name = 'a machine file'", "line 1, column 1: not valid JSON: Expecting value"),
]


@pytest.fixture
def document(design_text: str) -> Any:
    return json.loads(design_text)


@pytest.fixture
def problems(tmp_path: Path) -> Callable[[str | bytes], list[str]]:
    def of(content: str | bytes) -> list[str]:
        """Write a design file, and give what loading it reports, without the path."""
        path = tmp_path / "gantry.json"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        with pytest.raises(FileError) as caught:
            load_design(path)
        found = caught.value.problems
        assert all(problem.startswith(f"{path}: ") for problem in found)
        assert all(problem.isascii() and problem.isprintable() and len(problem) < 400 for problem in found)
        return [problem.removeprefix(f"{path}: ") for problem in found]

    return of


@pytest.mark.parametrize("case", CASES, ids=[case.splitlines()[2][2:] for case in CASES])
def test_each_wrong_value_has_its_message(problems, document: Any, case: str) -> None:
    path, value, expected = (line[2:] for line in case.splitlines())
    *parents, last = path.split(".")
    target = document
    for key in parents:
        target = target[int(key) if key.isdigit() else key]
    target[last] = json.loads(value)
    assert problems(json.dumps(document))[0] == expected


@pytest.mark.parametrize(("text", "start"), TEXTS)
def test_what_is_no_json_object_says_so(problems, text: str, start: str) -> None:
    (problem,) = problems(text)
    assert problem.startswith(start)


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_not_finite_are_refused(problems, design_text: str, number: str) -> None:
    (problem,) = problems(design_text.replace('"damping_ratio": 0.0', f'"damping_ratio": {number}', 1))
    assert problem.startswith("plant.damping_ratio = ")
    assert problem.endswith(": must be at least 0 and below 1")


def test_a_key_that_stands_twice_is_refused(problems, design_text: str) -> None:
    text = design_text.replace('"law": "fixed"', '"law": "fixed", "law": "fixed"')
    assert problems(text) == ['key "law" stands 2 times in one object']


def test_taps_without_a_tick_are_refused(problems, document: Any) -> None:
    document["tick_s"] = None
    assert problems(json.dumps(document)) == [
        "shapers[0].taps: tick_s is null and shapers[0].taps is not: both or neither"
    ]


def test_rows_of_one_name_are_refused(problems, document: Any) -> None:
    document["shapers"] *= 2
    assert problems(json.dumps(document)) == ["shapers[1].name: is also the name of shapers[0]"]


def test_every_missing_key_is_reported_at_once(problems, document: Any) -> None:
    found = problems("{}")
    assert found == [f"{key}: missing" for key in document]


def test_all_mistakes_of_a_file_are_reported_at_once(problems, document: Any) -> None:
    document["tick_s"] = 0
    del document["drive"]["units"]
    document["shapers"][0]["mode"]["frequency_hz"] = "x"
    document["shapers"][0]["taps"]["amplitudes"] = [2]
    assert problems(json.dumps(document)) == [
        f"tick_s = 0: {POSITIVE}",
        "drive.units: missing",
        'shapers[0].mode.frequency_hz = "x": must be a number',
        "shapers[0].taps.amplitudes: must sum to exactly 1, sum to 2.0",
    ]


def test_a_huge_file_is_not_parsed(problems) -> None:
    assert problems(" " * 4_000_001) == ["is larger than 4000000 bytes, the most that is read"]


def test_binary_garbage_is_located(problems) -> None:
    assert problems(b"{\n\x80") == ["is not UTF-8 text: byte 0x80 in line 2"]
