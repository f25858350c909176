"""What `swayless simulate` runs: a ``[[move]]`` of a machine file.

Not for: designing or generating; moves change neither, and stand in no design file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from swayless.machine.arm_positions import PLACE, PositionUnit
from swayless.machine.arm_positions import SPEED as POSITION_SPEED
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
"""Ropes, positions or frequencies of one move."""


@dataclass(frozen=True)
class PlaceKeys:
    """How the moves of a machine say where it stands.

    Parameters
    ----------
    place : str
        Key of a place where it stands still.
    check : Check
        For a place.
    way : str or None
        Key of a way from place to place, if there is one.
    rate : Check
        For the speed of that way.
    """

    place: str
    check: Check[float]
    way: str | None
    rate: Check[float]

    @property
    def all(self) -> tuple[str, ...]:
        """Both keys."""
        return (self.place,) if self.way is None else (self.place, self.way)


_CRANE = PlaceKeys("rope_length", LENGTH, "hoist", SPEED)
_ARM = PlaceKeys("frequency", FREQUENCY, None, SPEED)
_POSITIONS: Mapping[PositionUnit, PlaceKeys] = {
    "m": PlaceKeys("position", PLACE["m"], "sweep", POSITION_SPEED["m"]),
    "rad": PlaceKeys("position", PLACE["rad"], "sweep", POSITION_SPEED["rad"]),
}

PLACE_KEYS = (_CRANE.place, _ARM.place, _POSITIONS["m"].place)
"""Keys of places, of all machines."""

WAY_KEYS = ("hoist", "sweep")
"""Keys of ways, of all machines."""

_OWNERS: Mapping[str, str] = {
    "rope_length": "a crane",
    "hoist": "a crane",
    "wind": "a crane",
    "frequency": "an arm without positions",
    "position": "an arm with positions",
    "sweep": "an arm with positions",
}


@dataclass(frozen=True)
class Hoist:
    """A hoist at a steady speed, or a sweep from one position of an arm to another.

    Parameters
    ----------
    from_m, to_m : float
        Rope before and after, > 0; of an arm positions, in their unit.
    rate_m_s : float
        Speed of the hoist, > 0; of an arm that of the position.
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
        Ropes in m, of an arm frequencies in Hz, or positions in their unit; None for the ends of the
        machine's range and its middle.
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


def read_move(
    kind: PlantKind,
    table: Table,
    *,
    max_speed_m_s: float | None,
    rows: int,
    position_unit: PositionUnit | None = None,
) -> MoveSection | None:
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
    position_unit : "m", "rad" or None
        Of the positions of an arm that has some.

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
    keys = _CRANE if kind == "crane" else _ARM if position_unit is None else _POSITIONS[position_unit]
    move = MoveSection(
        name=table.take("name", label, None),
        speed_m_s=table.take("speed", SPEED, None),
        distance_m=table.take("distance", WAY, None),
        duration_s=table.take("duration", PRESS, None),
        start_s=table.take("start", START, 0.0) or 0.0,
        rows=table.take("row", _one_or_more(integer(1, rows), rows), None),
        places=table.take(keys.place, _one_or_more(keys.check, MAX_PLACES), None),
        hoist=None if keys.way is None else _way(table, keys.way, keys),
        wind=_wind(table) if kind == "crane" else None,
    )
    _refuse_others((*keys.all, "wind") if kind == "crane" else keys.all, table)
    _refuse_both(table, "distance", "duration")
    _refuse_both(table, *keys.all)
    if max_speed_m_s is not None and move.speed_m_s is not None and move.speed_m_s > max_speed_m_s:
        table.place("speed").wrong(table.raw["speed"], f"is above max_speed, {max_speed_m_s:g} m/s")
    return None if len(table.report.problems) > found_before else move


def _refuse_others(own: tuple[str, ...], table: Table) -> None:
    """Report keys that only moves of other kinds of machines have."""
    for key, owner in _OWNERS.items():
        if key not in own:
            table.asked.append(key)
            if key in table.raw:
                table.place(key).wrong(table.raw[key], f"only a move of {owner} has this")


def _refuse_both(table: Table, *keys: str) -> None:
    if len(keys) > 1 and all(key in table.raw for key in keys):
        table.place(" and ".join(keys)).problem("exclude each other: keep one")


def _way(table: Table, key: str, keys: PlaceKeys) -> Hoist | None:
    inner = table.take(key, _section, None)
    if inner is None:
        return None
    start_m, end_m = inner.need("from", keys.check), inner.need("to", keys.check)
    rate_m_s, start_s = inner.need("rate", keys.rate), inner.take("start", START, 0.0)
    inner.close()
    if start_m is None or end_m is None or rate_m_s is None or start_s is None:
        return None
    if start_m == end_m:
        inner.place("to").wrong(inner.raw["to"], f"is where it begins: a {key} goes somewhere else")
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
    kind: PlantKind,
    root: Table,
    *,
    max_speed_m_s: float | None,
    rows: int,
    position_unit: PositionUnit | None = None,
) -> tuple[MoveSection, ...]:
    """Read all moves of a machine file; none is the usual case.

    Parameters
    ----------
    kind, max_speed_m_s, rows, position_unit
        As for `read_move`.
    root : Table
        The whole file.
    """
    moves = []
    tables = root.take("move", _sections, None) or []
    for position, raw in enumerate(tables, start=1):
        table = Table(raw, root.report, f"[[move]] {position} ")
        moves.append(
            read_move(kind, table, max_speed_m_s=max_speed_m_s, rows=rows, position_unit=position_unit)
        )
        table.close()
    return tuple(move for move in moves if move is not None)
