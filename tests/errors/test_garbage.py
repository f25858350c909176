"""Whatever stands in a file, the loaders raise `FileError` with readable problems, and nothing else."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from swayless.errors import FileError
from swayless.machine import load_design, load_machine

FUZZ = settings(
    derandomize=True,
    deadline=None,
    max_examples=200,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
LOADERS = pytest.mark.parametrize("load", [load_machine, load_design])

# Values, one by one, as they stand in a file.
JSON_VALUES = r"""null|true|0|-1|0.5|1e308|5e-324|NaN|-Infinity|1e999|9223372036854775808|-0.0|""|"zv"
"\ud800"|"\u00e4"|[]|[[]]|{}|{"a":1}|[0.0,1.0]|[0,1]|[0.5,0.5]|[1e308,-1e308]|[null]|[true,"x"]"""
TOML_VALUES = r"""0|-1|1e400|nan|-inf|true|0xffffffffffffffffffffffffffffffffffffffff|1979-05-27|07:32:00|[]
[[1]]|{}|''|'zv'|'5 %'|'1e999 m'|'9 ft'|[1,'2 m']|{a={b=1}}|1_000|"\u00e4"|"\u0000"|[nan,inf,1]"""


def _one_of(values: str) -> st.SearchStrategy[str]:
    return st.sampled_from(values.replace("\n", "|").split("|"))


def _refuse_or_load(load: Callable[[Path], object], path: Path) -> None:
    try:
        load(path)
    except FileError as error:
        problems = error.problems
    else:
        return
    assert problems
    assert all(problem.startswith(f"{path}: ") and problem.isprintable() for problem in problems)


def _mutated(content: bytes, cuts: list[tuple[int, int, bytes]]) -> bytes:
    for start, length, new in cuts:
        at = start % (len(content) + 1)
        content = content[:at] + new + content[at + length :]
    return content


CUTS = st.lists(
    st.tuples(st.integers(0, 10_000), st.integers(0, 12), st.binary(max_size=6)), min_size=1, max_size=4
)


@LOADERS
@FUZZ
@given(content=st.binary(max_size=200))
def test_random_bytes(load: Callable[[Path], object], tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "file"
    path.write_bytes(content)
    _refuse_or_load(load, path)


@FUZZ
@given(which=st.integers(0, 1), cuts=CUTS)
def test_mutated_machine_files(
    tmp_path: Path, machine_texts: tuple[str, ...], which: int, cuts: list[tuple[int, int, bytes]]
) -> None:
    path = tmp_path / "crane.toml"
    path.write_bytes(_mutated(machine_texts[which].encode(), cuts))
    _refuse_or_load(load_machine, path)


@FUZZ
@given(which=st.integers(0, 1), cuts=CUTS)
def test_mutated_design_files(
    tmp_path: Path, design_texts: tuple[str, ...], which: int, cuts: list[tuple[int, int, bytes]]
) -> None:
    path = tmp_path / "gantry.json"
    path.write_bytes(_mutated(design_texts[which].encode(), cuts))
    _refuse_or_load(load_design, path)


@FUZZ
@given(which=st.integers(0, 1), line=st.integers(0, 100), value=_one_of(TOML_VALUES))
def test_machine_files_with_another_value_somewhere(
    tmp_path: Path, machine_texts: tuple[str, ...], which: int, line: int, value: str
) -> None:
    lines = machine_texts[which].splitlines()
    line %= len(lines)
    lines[line] = lines[line].split("=")[0] + f"= {value}"
    path = tmp_path / "crane.toml"
    path.write_text("\n".join(lines), encoding="utf-8")
    _refuse_or_load(load_machine, path)


@FUZZ
@given(
    which=st.integers(0, 1),
    steps=st.lists(st.integers(0, 30), min_size=1, max_size=6),
    value=_one_of(JSON_VALUES).map(json.loads),
)
def test_design_files_with_another_value_somewhere(
    tmp_path: Path, design_texts: tuple[str, ...], which: int, steps: list[int], value: Any
) -> None:
    document = json.loads(design_texts[which])
    target: Any = document
    for step in steps:
        keys = list(target) if isinstance(target, dict) else range(len(target))
        key = keys[step % len(keys)]
        if not isinstance(target[key], dict | list) or step == steps[-1]:
            target[key] = value
            break
        target = target[key]
    path = tmp_path / "gantry.json"
    path.write_text(json.dumps(document))
    _refuse_or_load(load_design, path)
