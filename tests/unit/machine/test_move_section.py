from __future__ import annotations

from typing import Any

import pytest

from swayless.machine.move_section import Hoist, MoveSection, Wind, read_move, read_moves
from swayless.machine.problems import Report, Table


def read(keys: dict[str, Any], kind: Any = "crane") -> tuple[MoveSection | None, list[str]]:
    table = Table(keys, Report("crane.toml"), "[[move]] 1 ")
    move = read_move(kind, table, max_speed_m_s=0.8, rows=3)
    table.close()
    return move, table.report.problems


def test_an_empty_move_is_the_usual_one() -> None:
    assert read({}) == (MoveSection(), [])


def test_every_key_is_read_in_si() -> None:
    move, problems = read(
        {
            "name": "to the ship",
            "distance": "12 m",
            "speed": "36 m/min",
            "start": "500 ms",
            "row": [1, 3],
            "hoist": {"from": "29 ft", "to": 3.74, "rate": "0.3 m/s", "start": 1},
            "wind": {"push": "0.05 m/s2", "start": 3, "duration": "4 s"},
        }
    )
    assert problems == []
    assert move == MoveSection(
        name="to the ship",
        distance_m=12.0,
        speed_m_s=0.6,
        start_s=0.5,
        rows=(1, 3),
        hoist=Hoist(8.8392, 3.74, 0.3, 1.0),
        wind=Wind(0.05, 3.0, 4.0),
    )


def test_one_rope_or_several() -> None:
    one, several = read({"rope_length": "6 m"})[0], read({"rope_length": [3, "6 m"]})[0]
    assert one is not None
    assert several is not None
    assert (one.places, several.places) == ((6.0,), (3.0, 6.0))


def test_arms_have_frequencies_and_neither_ropes_nor_hoists_nor_wind() -> None:
    move, problems = read({"frequency": [4, "5 Hz"], "duration": 1}, kind="arm")
    assert (move, problems) == (MoveSection(duration_s=1.0, places=(4.0, 5.0)), [])
    found = read({"rope_length": 3, "hoist": {}, "wind": {}}, kind="arm")[1]
    assert found == [
        "crane.toml: [[move]] 1 rope_length = 3: only a move of a crane has this",
        "crane.toml: [[move]] 1 hoist = {...}: only a move of a crane has this",
        "crane.toml: [[move]] 1 wind = {...}: only a move of a crane has this",
    ]


HOIST = {"from": 9, "to": 4, "rate": 0.3}


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"speed": 0.9}, "speed = 0.9: is above max_speed, 0.8 m/s"),
        ({"speed": -0.5}, "speed = -0.5: must be > 0"),
        ({"distance": 12, "duration": 8}, "distance and duration: exclude each other: keep one"),
        ({"rope_length": 6, "hoist": HOIST}, "rope_length and hoist: exclude each other: keep one"),
        ({"rope_length": [6, 6.0]}, "rope_length = [6, 6.0]: names one value twice"),
        ({"rope_length": []}, "rope_length = []: must be one value or an array of 1 to 16"),
        ({"rope_length": [6, -1]}, "rope_length[1] = -1: must be > 0"),
        ({"row": 4}, "row = 4: must be an integer from 1 to 3"),
        ({"row": [1, 0]}, "row[1] = 0: must be an integer from 1 to 3"),
        ({"start": -1}, "start = -1: must be at least 0 and at most 10000 s"),
        ({"hoist": 3}, "hoist = 3: must be a table in braces, such as { from = 9, to = 4, rate = 0.3 }"),
        ({"hoist": {"from": 9, "to": 4}}, "hoist rate: missing"),
        ({"hoist": HOIST | {"to": 9}}, "hoist to = 9: is where it begins: a hoist goes somewhere else"),
        ({"hoist": HOIST | {"rate": "3 kg"}}, 'hoist rate = "3 kg": is not a speed: allowed units are '),
        ({"hoist": HOIST | {"stop": 3}}, "hoist stop: unknown key; nearest: "),
        ({"wind": {"start": 3}}, "wind push: missing"),
        ({"wind": {"push": "12 m/s"}}, 'wind push = "12 m/s": is not an acceleration: allowed units are '),
        ({"frequency": 0.2}, "frequency = 0.2: only a move of an arm without positions has this"),
        ({"sped": 0.5}, "sped: unknown key; nearest: speed; known: "),
    ],
)
def test_what_is_wrong_is_refused_where_it_stands(keys: dict[str, Any], message: str) -> None:
    found = read(keys)[1]
    assert len(found) == 1
    assert found[0].startswith(f"crane.toml: [[move]] 1 {message}")


def test_all_moves_are_read_and_every_problem_is_said_at_once() -> None:
    report = Report("crane.toml")
    root = Table({"move": [{"distance": 3}, {"distance": -3}, {"speed": 9}]}, report, "")
    moves = read_moves("crane", root, max_speed_m_s=0.8, rows=1)
    assert [move.distance_m for move in moves] == [3.0]
    assert report.problems == [
        "crane.toml: [[move]] 2 distance = -3: must be > 0",
        "crane.toml: [[move]] 3 speed = 9: is above max_speed, 0.8 m/s",
    ]


@pytest.mark.parametrize("value", [{}, [], [3], [{}] * 17])
def test_moves_are_sections_in_two_brackets(value: object) -> None:
    report = Report("crane.toml")
    assert read_moves("crane", Table({"move": value}, report, ""), max_speed_m_s=0.8, rows=1) == ()
    assert len(report.problems) == 1
    assert report.problems[0].endswith(": must be 1 to 16 sections [[move]], in two brackets")
