"""Whatever stands in a profile file or a trajectory, it is read, or refused with readable problems."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from swayless.errors import SwaylessError
from swayless.machine import example_text
from swayless.machine.profile_file import load_profile
from swayless.machine.profile_trajectory import read_trajectory

FUZZ = settings(
    derandomize=True,
    deadline=None,
    max_examples=150,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
LINES = example_text("time-optimal-oscillator").splitlines()
KEYS = [number for number, line in enumerate(LINES) if " = " in line]
VALUES = [
    *("0", "-1", "1e308", "1e-308", "1e99", "1e12", "nan", "inf", "true", "[]", "[[]]", "{}", "'x'", "''"),
    *("[1]", "[0, 0]", "[1, 2, 3]", "[[1, 2], [3, 4]]", "'5 ms'", "'10 %'", "'1 km'", "2024-01-01", "9" * 20),
]


def read_or_refused(work: Callable[[], object]) -> None:
    """Whatever is wrong is one of ours, in lines that can be read."""
    refused = ""
    try:
        assert work() is not None
    except SwaylessError as error:
        refused = str(error)
    assert all(0 < len(line) < 400 and line.isprintable() for line in refused.splitlines()), refused


@FUZZ
@given(st.lists(st.tuples(st.sampled_from(KEYS), st.sampled_from(VALUES)), min_size=1, max_size=3))
def test_profile_files_with_other_values(tmp_path: Path, changes: list[tuple[int, str]]) -> None:
    lines = list(LINES)
    for number, value in changes:
        lines[number] = f"{lines[number].partition('=')[0]}= {value}"
    path = tmp_path / "move.toml"
    path.write_text("\n".join(lines))
    read_or_refused(lambda: load_profile(path, {}).task.rest)


@FUZZ
@given(st.text(alphabet="0123456789.,;eE+- \nnaif\x00é", max_size=60))
def test_trajectories_of_anything(tmp_path: Path, text: str) -> None:
    path = tmp_path / "wanted.csv"
    path.write_text(text, encoding="utf-8")
    read_or_refused(lambda: read_trajectory(path))
