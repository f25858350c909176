"""Whatever stands in the stored file of a motion profile, it is proved, or refused with readable problems."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from swayless.design.optimal import Command, LinearPlant, MoveTask, Robustness, time_optimal
from swayless.errors import FileError
from swayless.machine.profile_design import make_profile_design
from swayless.machine.profile_design_file import load_profile_design, profile_design_text
from swayless.machine.profile_design_move import ProfileMove

MASS = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
HELD = LinearPlant.from_transfer_function([3.0], [1.0, 0.4, 37.0])
SPLIT = Robustness(split_ratio=0.1)
FREE_TEXT = {("name",), ("source",), ("generator",)}
VALUES: list[Any] = [
    *(None, True, "x", "", [], [[]], {}, [1, 2], [[1, 2], [3]], float("nan"), float("inf"), 10**400, 1e308),
    *(-1e308, 1e-308, 1e18, 1e9, 2.0, 1, 0, -1, 1e-12),
]


def stored() -> Iterator[Any]:
    """A mass with a limit of the rate, and a plant that must be held, with split poles and in float."""
    pushes = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0]
    mass = ProfileMove(MASS, Command(0.5, pushes, 0.0), (-1.5, 1.5), 0.0, 4.0, rate_limit_per_s=6.0)
    yield json.loads(profile_design_text(make_profile_design("mass", "mass.toml", mass)))
    command = time_optimal(MoveTask(HELD, 0.05, (-20.0, 60.0), 3.0, 0.7, robustness=SPLIT)).command
    held = ProfileMove(HELD, command, (-20.0, 60.0), 0.7, 3.0, robustness=SPLIT)
    yield json.loads(profile_design_text(make_profile_design("held", "held.toml", held, "float")))


def paths(document: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Give the way to everything in a document, of long arrays to the first two."""
    if path:
        yield path
    items = document.items() if isinstance(document, dict) else ()
    for key, value in enumerate(document[:2]) if isinstance(document, list) else items:
        yield from paths(value, (*path, key))


DOCUMENTS = list(stored())
PATHS = [(number, path) for number, document in enumerate(DOCUMENTS) for path in paths(document)]


def changed(number: int, path: tuple[Any, ...], value: Any, *, deleted: bool) -> Any:
    document = copy.deepcopy(DOCUMENTS[number])
    inner = document
    for key in path[:-1]:
        inner = inner[key]
    if deleted:
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    return document


@settings(
    derandomize=True,
    deadline=None,
    max_examples=250,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(where=st.sampled_from(PATHS), value=st.sampled_from(VALUES), deleted=st.integers(0, 7))
def test_a_stored_profile_with_anything_anywhere_is_the_same_design_or_refused(
    tmp_path: Path, where: tuple[int, tuple[Any, ...]], value: Any, deleted: int
) -> None:
    number, path = where
    document = changed(number, path, value, deleted=deleted == 0)
    file = tmp_path / "bad.profile.json"
    file.write_text(json.dumps(document), encoding="ascii")
    refused, taken = "", None
    try:
        taken = json.loads(profile_design_text(load_profile_design(file)))
    except FileError as error:
        refused = str(error)
    assert all(0 < len(line) < 400 and line.isprintable() for line in refused.splitlines()), refused
    # What is taken is what was designed, but for names, wider limits and what is within rounding.
    assert taken is None or path in FREE_TEXT or path[0] == "limit" or nearly(taken, number)


def nearly(document: Any, number: int) -> bool:
    """Whether a document says what the design said: numbers to 1e-6 of the largest beside them, or of 1."""
    return all(
        _same(_at(document, path), _at(DOCUMENTS[number], path)) for which, path in PATHS if which == number
    )


def _at(document: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        document = document[key]
    return document


def _same(one: Any, other: Any) -> bool:
    if isinstance(other, float | int) and not isinstance(other, bool):
        return abs(one - other) <= 1e-6 * max(1.0, abs(other))
    return isinstance(other, dict | list) or one == other
