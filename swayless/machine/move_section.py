"""What `swayless simulate` runs: a ``[[move]]`` of a machine file.

Not for: designing or generating; moves change neither, and stand in no design file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from swayless.machine.checks import integer, label, quantity
from swayless.machine.plant_section import FREQUENCY, LENGTH, PlantKind
from swayless.machine.problems import Check, Place, RefusedError, T, Table, plain

SPEED = quantity("speed", 1e-6, 1e4)
PUSH = quantity("acceleration", -10.0, 10.0)
WAY = quantity("length", 1e-3, 1e6)
PRESS = quantity("time", 1e-6, 1e4)
START = quantity("time", 0.0, 1e4)

MAX_MOVES = 16
MAX_PLACES = 16
"""Ropes or frequencies of one move."""

PLACE_KEYS: Mapping[PlantKind, str] = {"crane": "rope_length", "arm": "frequency"}
_OTHERS_KEYS: Mapping[PlantKind, tuple[str, ...]] = {
    "crane": ("frequency",),
    "arm": ("rope_length", "hoist", "wind"),
}


@dataclass(frozen=True)
class Hoist:
    """A hoist at a steady speed.

    Parameters
    ----------
    from_m, to_m : float
        Rope before and after, > 0.
    rate_m_s : float
        Speed of the hoist, > 0.
    start_s : float
        When it starts.
    """

    from_m: float
    to_m: float
    rate_m_s: float
    start_s: float


@dataclass(frozen=True)
class Wind:
    """Wind that pushes the load: steadily, or in one gust that rises and falls as (1 - cos) / 2.

    Parameters
    ----------
    push_m_s2 : float
        Force per load mass, at the most.
    start_s : float
        When it starts.
    duration_s : float or None
        Of a gust; None for a wind that stays.
    """

    push_m_s2: float
    start_s: float
    duration_s: float | None


@dataclass(frozen=True)
class MoveSection:
    """One move: a button pressed and released, on ropes that stand or on one that is hoisted.

    Parameters
    ----------
    name : str or None
        What people call it.
    speed_m_s : float or None
        Command while the button is pressed; None for the full speed.
    distance_m, duration_s : float or None
        How far to go, or how long to press; both None for a press long enough to settle in.
    start_s : float
        When the button is pressed.
    rows : tuple of int or None
        Positions of the knob to run; None for all.
    places : tuple of float or None
        Ropes in m, of an arm frequencies in Hz; None for the ends of the machine's range and its middle.
    hoist : Hoist or None
        Instead of `places`.
    wind : Wind or None
        What blows.
    """

    name: str | None = None
    speed_m_s: float | None = None
    distance_m: float | None = None
    duration_s: float | None = None
    start_s: float = 0.0
    rows: tuple[int, ...] | None = None
    places: tuple[float, ...] | None = None
    hoist: Hoist | None = None
    wind: Wind | None = None


def read_move(kind: PlantKind, table: Table, *, max_speed_m_s: float | None, rows: int) -> MoveSection | None:
    """Read one move.

    Parameters
    ----------
    kind : {"crane", "arm"}
        Cranes have ropes and hoists, arms frequencies.
    table : Table
        The section, or options with the same keys.
    max_speed_m_s : float or None
        Full speed of the machine, where it is known.
    rows : int
        How many rows there are.

    Returns
    -------
    MoveSection or None
        None where a value is wrong.

    Examples
    --------
    >>> from swayless.machine.problems import Report
    >>> keys = {"distance": "12 m", "speed": 0.6, "hoist": {"from": 8.84, "to": 3.74, "rate": 0.3}}
    >>> move = read_move("crane", Table(keys, Report("crane.toml"), "[[move]] 1 "), max_speed_m_s=0.8, rows=1)
    >>> move.distance_m, move.hoist.to_m, move.rows
    (12.0, 3.74, None)
    """
    found_before = len(table.report.problems)
    place_key = PLACE_KEYS[kind]
    move = MoveSection(
        name=table.take("name", label, None),
        speed_m_s=table.take("speed", SPEED, None),
        distance_m=table.take("distance", WAY, None),
        duration_s=table.take("duration", PRESS, None),
        start_s=table.take("start", START, 0.0) or 0.0,
        rows=table.take("row", _one_or_more(integer(1, rows), rows), None),
        places=table.take(
            place_key, _one_or_more(LENGTH if kind == "crane" else FREQUENCY, MAX_PLACES), None
        ),
        hoist=_hoist(table) if kind == "crane" else None,
        wind=_wind(table) if kind == "crane" else None,
    )
    _refuse_others(kind, table)
    _refuse_both(table, "distance", "duration")
    _refuse_both(table, place_key, "hoist")
    if max_speed_m_s is not None and move.speed_m_s is not None and move.speed_m_s > max_speed_m_s:
        table.place("speed").wrong(table.raw["speed"], f"is above max_speed, {max_speed_m_s:g} m/s")
    return None if len(table.report.problems) > found_before else move


def _refuse_others(kind: PlantKind, table: Table) -> None:
    """Report keys that only moves of the other kind of machine have."""
    other = "an arm" if kind == "crane" else "a crane"
    for key in _OTHERS_KEYS[kind]:
        table.asked.append(key)
        if key in table.raw:
            table.place(key).wrong(table.raw[key], f"only a move of {other} has this")


def _refuse_both(table: Table, one: str, other: str) -> None:
    if one in table.raw and other in table.raw:
        table.place(f"{one} and {other}").problem("exclude each other: keep one")


def _hoist(table: Table) -> Hoist | None:
    inner = table.take("hoist", _section, None)
    if inner is None:
        return None
    start_m, end_m = inner.need("from", LENGTH), inner.need("to", LENGTH)
    rate_m_s, start_s = inner.need("rate", SPEED), inner.take("start", START, 0.0)
    inner.close()
    if start_m is None or end_m is None or rate_m_s is None or start_s is None:
        return None
    if start_m == end_m:
        inner.place("to").wrong(inner.raw["to"], "is where the rope begins: a hoist goes somewhere else")
    return Hoist(start_m, end_m, rate_m_s, start_s)


def _wind(table: Table) -> Wind | None:
    inner = table.take("wind", _section, None)
    if inner is None:
        return None
    push_m_s2 = inner.need("push", PUSH)
    start_s, duration_s = inner.take("start", START, 0.0), inner.take("duration", PRESS, None)
    inner.close()
    return None if push_m_s2 is None or start_s is None else Wind(push_m_s2, start_s, duration_s)


@dataclass(frozen=True)
class InnerTable(Table):
    """A table within a place of another one.

    Parameters
    ----------
    at : Place
        Where the table stands.
    """

    at: Place = field(kw_only=True)

    def place(self, key: str) -> Place:
        """Where the value of `key` stands."""
        return Place(self.report, f"{self.at.path} {key}")


def _section(value: object, place: Place) -> InnerTable | None:
    if not isinstance(value, dict):
        place.wrong(value, "must be a table in braces, such as { from = 9, to = 4, rate = 0.3 }")
        return None
    return InnerTable(value, place.report, "", at=place)


def _one_or_more(single: Check[T], at_most: int) -> Check[tuple[T, ...]]:
    """Check for one value, or an array of different ones."""

    def check(value: object, place: Place) -> tuple[T, ...] | None:
        items = value if isinstance(value, list) else [value]
        if not 1 <= len(items) <= at_most:
            place.wrong(value, f"must be one value or an array of 1 to {at_most}")
            return None
        places = [place.item(index) for index in range(len(items))] if isinstance(value, list) else [place]
        checked = [single(item, where) for item, where in zip(items, places, strict=True)]
        good = tuple(item for item in checked if item is not None)
        if len(set(good)) < len(good):
            place.wrong(value, "names one value twice")
        return good if len(good) == len(items) else None

    return check


@plain
def _sections(value: object) -> list[dict[str, object]]:
    moves = value if isinstance(value, list) else []
    if not 1 <= len(moves) <= MAX_MOVES or not all(isinstance(move, dict) for move in moves):
        raise RefusedError(f"must be 1 to {MAX_MOVES} sections [[move]], in two brackets")
    return moves


def read_moves(
    kind: PlantKind, root: Table, *, max_speed_m_s: float | None, rows: int
) -> tuple[MoveSection, ...]:
    """Read all moves of a machine file; none is the usual case.

    Parameters
    ----------
    kind, max_speed_m_s, rows
        As for `read_move`.
    root : Table
        The whole file.
    """
    moves = []
    tables = root.take("move", _sections, None) or []
    for position, raw in enumerate(tables, start=1):
        table = Table(raw, root.report, f"[[move]] {position} ")
        moves.append(read_move(kind, table, max_speed_m_s=max_speed_m_s, rows=rows))
        table.close()
    return tuple(move for move in moves if move is not None)
