"""How a Structured Text block sums up its tables, number by number. Not for: the sums, see `checksum`."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.codegen.st_types import StTypes
from swayless.controller.checksum import BASE, Checksum, Table
from swayless.controller.settings import ShaperSettings
from swayless.controller.tables import tables_of
from swayless.errors import CodegenError

ST_NAMES = {
    "first taps": "FirstTaps",
    "tap counts": "TapCounts",
    "lags": "DelayTicks",
    "amplitudes": "Amplitudes",
    "tails": "TailTicks",
    "moments": "MomentTicks",
    "residual bounds": "ResidualBounds",
    "waits": "Waits",
    "row lower ends": "RowShortest",
    "row upper ends": "RowLongest",
    "spacing starts": "SpacingStarts",
    "spacing ticks": "SpacingTicks",
    "tick quanta": "PhaseTable",
    "stretches": "Stretches",
    "answers": "Answers",
    "leans": "Leans",
    "bound counts": "BoundCounts",
    "bound starts": "BoundStarts",
    "rope bounds": "RopeBounds",
    "turn cosine": "TurnCosines",
    "turn sine": "TurnSines",
    "turn metres": "TurnDeflections",
    "sway quanta": "PhaseTable",
}
"""Where the numbers of each table of a block stand."""

WHOLE_LIMIT = float(BASE**2)
"""Whole numbers that stand among reals are taken apart as reals below this."""


@dataclass(frozen=True)
class SummedTable:
    """How the numbers of one table are read: up to number `last` of all, by these lines."""

    last: int
    lines: tuple[str, ...]


@dataclass(frozen=True)
class StChecksum:
    """How all tables are summed up.

    Parameters
    ----------
    tables : tuple of SummedTable
        In order.
    most_digits : int
        Digits of any number, at most.
    sums : Checksum
        What must come out.
    """

    tables: tuple[SummedTable, ...]
    most_digits: int
    sums: Checksum

    @property
    def last(self) -> int:
        """Last number of all."""
        return self.tables[-1].last


def checksum_of(settings: ShaperSettings, types: StTypes) -> StChecksum:
    """List how each table of a block is read.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with design facts.
    types : StTypes
        Its types.
    """
    facts = settings.diagnostics.facts
    if facts is None:
        raise CodegenError("a block without design facts has no checksum")
    made, first, tables = [], 0, tables_of(settings)
    for table in tables:
        made.append(SummedTable(first + len(table.numbers) - 1, _lines(table, first, settings, types)))
        first += len(table.numbers)
    return StChecksum(tuple(made), max(table.digits for table in tables), facts.checksum)


def _lines(table: Table, first: int, settings: ShaperSettings, types: StTypes) -> tuple[str, ...]:
    """Read a number of a table, of which `first` of all is number 0."""
    place = first - 1 if table.name in {"row lower ends", "row upper ends"} else first
    number = f"{_name(table, settings)}[i - {place}]" if place else f"{_name(table, settings)}[i]"
    if table.name == "waits":
        return (f"IF {number} THEN", "  Whole := 1;", "END_IF;")
    if table.name in {"tick quanta", "sway quanta"}:
        return _of_real(number, WHOLE_LIMIT, 1.0, table.digits, types)
    if table.limit is None:
        return (f"Whole := {number};",)
    return _of_real(number, table.limit, table.least, table.digits, types)


def _name(table: Table, settings: ShaperSettings) -> str:
    name = ST_NAMES[table.name]
    phase = {"DelayTicks": "LagQuanta", "TailTicks": "TailQuanta", "MomentTicks": "MomentQuanta"}
    return name if settings.clock is None else phase.get(name, name)


def _of_real(number: str, limit: float, least: float, digits: int, types: StTypes) -> tuple[str, ...]:
    return (
        f"Number := {number};",
        "IsReal := TRUE;",
        f"DigitCount := {digits};",
        f"NumberLimit := {types.literal(limit)};",
        f"PerNumberLimit := {types.literal(1.0 / float(limit))};",
        f"LeastDigit := {types.literal(least)};",
    )
