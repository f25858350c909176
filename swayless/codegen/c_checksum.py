"""The sums of all tables of the C block, in the order and with the digits of the reference.

Not for: the sums themselves (`controller.checksum`), nor for which tables there are (`controller.tables`).
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.codegen.c_types import CTable, CTypes
from swayless.codegen.clock_names import clock_names
from swayless.controller.checksum import Table, checksum
from swayless.controller.settings import ShaperSettings
from swayless.controller.tables import tables_match, tables_of
from swayless.errors import CodegenError

COUNTED = {"tap counts": "FIRST_TAP", "bound counts": "FIRST_BOUND"}
"""Counts, which in C are differences of places, and what these are called."""

NAMES = {
    "first taps": "FIRST_TAP",
    "amplitudes": "AMPLITUDE",
    "moments, fractions": "MOMENT_Q30",
    "residual bounds": "RESIDUAL_BOUND",
    "waits": "WAITS",
    "row lower ends": "ROW_SHORTEST",
    "row upper ends": "ROW_LONGEST",
    "spacing starts": "PIECE_START",
    "spacing ticks": "PIECE_TICKS",
    "tick quanta": "TICK_QUANTA",
    "sway quanta": "TICK_QUANTA",
    "stretches": "STRETCH",
    "answers": "ANSWER",
    "leans": "LEAN",
    "bound starts": "BOUND_START",
    "rope bounds": "ROPE_BOUND",
    "turn cosine": "TURN_COSINE",
    "turn sine": "TURN_SINE",
    "turn metres": "TURN_METRES",
}
"""Tables of the reference, and what they are called in C."""

FROM_ONE = ("row lower ends", "row upper ends")
"""Tables that in C have a place for row 0, which is not summed."""

ADDERS = {
    "bool": ("flags", "number ? 1 : 0"),
    "uint16_t": ("shorts", "(int32_t)number"),
    "uint32_t": ("words", "(int32_t)number"),
    "int32_t": ("wholes", "number"),
}
"""By type of element: name of the function that sums, and its element as a number of 32 bits."""


@dataclass(frozen=True)
class CAdder:
    """A function that sums a table of whole numbers."""

    name: str
    c_type: str
    c_element: str
    c_number: str


@dataclass(frozen=True)
class CDigits:
    """How the reals of one table are taken apart."""

    name: str
    c_literal: str


class CChecked:
    """The check of one block's tables.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with design facts.
    types : CTypes
        Its types.
    tables : list of CTable
        Its tables in C; those that the reference has besides are formulas there.

    Raises
    ------
    CodegenError
        If the tables are not those of the design's checksum, or one of them has no name in C.
    """

    def __init__(self, settings: ShaperSettings, types: CTypes, tables: list[CTable]) -> None:
        clock = clock_names(settings)
        by_clock = {"lags": clock.c_lags, "tails": clock.c_tails, "moments": clock.c_moments}
        self._names, self._types = {**NAMES, **COUNTED, **by_clock}, types
        self._tables = {table.name: table for table in tables}
        found = tables_of(settings)
        unknown = [table.name for table in found if table.name not in self._names]
        if unknown:
            raise CodegenError(f"tables {', '.join(unknown)}: have no checksum in C")
        self._summed = [table for table in found if self._names[table.name] in self._tables]
        sums = checksum(self._summed)
        if sums is None or not tables_match(settings):
            raise CodegenError("the tables of the block are not those of its design: make its facts again")
        self.first, self.second = sums

    def _type_of(self, table: Table) -> str:
        c_type = self._tables[self._names[table.name]].c_type
        return "int32_t" if c_type == self._types.real and self._types.number.is_integer else c_type

    @property
    def adders(self) -> list[CAdder]:
        """Functions that sum tables of whole numbers: those that are called."""
        kinds = {self._type_of(table) for table in self._summed if table.name not in COUNTED}
        adders = [
            CAdder(name, kind, "table[i]", number) for kind, (name, number) in ADDERS.items() if kind in kinds
        ]
        if any(table.name in COUNTED for table in self._summed):
            adders.append(CAdder("counts", "uint32_t", "table[i + 1u] - table[i]", "(int32_t)number"))
        return adders

    @property
    def digits(self) -> list[CDigits]:
        """Digits of each table of reals."""
        literal = self._types.literal
        return [
            CDigits(
                f"{self._names[table.name]}_DIGITS",
                ", ".join(map(literal, (table.limit, 1 / table.limit, table.least))) + f", {table.digits}u",
            )
            for table in self._summed
            if table.limit is not None
        ]

    @property
    def calls(self) -> list[str]:
        """Calls that sum all tables, in order."""
        return [self._call(table) for table in self._summed]

    def _call(self, table: Table) -> str:
        prefix, name, count = self._types.name, self._names[table.name], len(table.numbers)
        place = f"&{prefix}_{name}[1]" if table.name in FROM_ONE else f"{prefix}_{name}"
        if table.limit is not None:
            return f"{prefix}_add_reals(&sums, {place}, {count}u, &{prefix}_{name}_DIGITS);"
        adder = "counts" if table.name in COUNTED else ADDERS[self._type_of(table)][0]
        return f"{prefix}_add_{adder}(&sums, {place}, {count}u);"
