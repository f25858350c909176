"""Declarations of a Structured Text block: variables, constants, tables. Not for: which ones a block has."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from swayless.codegen.literals import st_literal
from swayless.controller.number import NumberType
from swayless.errors import CodegenError

VALUES_A_LINE = 6
"""Most table values in one line of source."""

LINE_WIDTH = 120
"""Longest line of source, its indentation of 2 or 4 included."""

ST_REALS = {"double": "LREAL", "float": "REAL"}
"""Structured Text type of each number type."""

ST_BYTES = {"BOOL": 1, "DINT": 4, "REAL": 4, "LREAL": 8}
"""Memory of each type that a block uses."""

RealConstant: TypeAlias = tuple[str, Any, str]
"""Name, value and comment of a constant of the number type."""


@dataclass(frozen=True)
class Variable:
    """One declared variable."""

    st_name: str
    st_type: str
    st_doc: str
    st_initial: str = ""
    st_reset: str = ""

    @property
    def st_lines(self) -> tuple[str, ...]:
        """Declaration in source."""
        return declared(f"{self.st_name} : {self.st_type}{self.st_initial};", self.st_doc)


@dataclass(frozen=True)
class Constant:
    """One declared constant."""

    st_name: str
    st_type: str
    st_literal: str
    doc: str

    @property
    def st_lines(self) -> tuple[str, ...]:
        """Declaration in source."""
        return declared(f"{self.st_name} : {self.st_type} := {self.st_literal};", self.doc)


@dataclass(frozen=True)
class Table:
    """One table, broken into lines."""

    st_name: str
    st_type: str
    last: int
    st_lines: tuple[str, ...]
    doc: str

    @property
    def bytes(self) -> int:
        """Memory that the table takes."""
        return (self.last + 1) * ST_BYTES[self.st_type]


class StTypes:
    """Types and literals of one block.

    Parameters
    ----------
    number : NumberType
        ``double`` or ``float``.

    Raises
    ------
    CodegenError
        If the number type is int32.
    """

    def __init__(self, number: NumberType) -> None:
        if number.name not in ST_REALS:
            raise CodegenError(
                f"number = {number.name!r}: Structured Text calculates in LREAL (double) or REAL (float)"
            )
        self.number = number
        self.real = ST_REALS[number.name]

    def type_of(self, kind: str) -> str:
        """Structured Text type of a kind: ``"bool"``, ``"real"``, ``"row"`` or ``"word"``."""
        return {"bool": "BOOL", "real": self.real, "row": "DINT", "word": "DINT"}[kind]

    def literal(self, value: Any) -> str:
        """Literal of the number type."""
        return st_literal(self.number.scalar(value), self.number)

    def constants(self, reals: Iterable[RealConstant]) -> list[Constant]:
        """Declare constants of the number type."""
        return [Constant(name, self.real, self.literal(value), doc) for name, value, doc in reals]

    def array_of(self, kind: str, last: int) -> str:
        """Type of an array with indices 0 to `last`."""
        return f"ARRAY[0..{last}] OF {self.type_of(kind)}"


def declared(text: str, doc: str) -> tuple[str, ...]:
    """Put a comment behind a declaration, or above it where the line would be too long.

    Examples
    --------
    >>> declared("Row : DINT;", "row in use")
    ('Row : DINT; (* row in use *)',)
    """
    line, comment = f"{text} (* {doc} *)", f"(* {doc} *)"
    return (line,) if len(line) <= LINE_WIDTH - 2 else (comment, text)


def bytes_of(st_type: str) -> int:
    """Memory that a variable takes.

    Parameters
    ----------
    st_type : str
        Elementary type, or array of one from index 0 on.

    Examples
    --------
    >>> bytes_of("BOOL"), bytes_of("LREAL"), bytes_of("ARRAY[0..120] OF DINT")
    (1, 8, 484)
    """
    array = re.fullmatch(r"ARRAY\[0\.\.(\d+)\] OF (\w+)", st_type)
    return ST_BYTES[st_type] if array is None else (int(array[1]) + 1) * ST_BYTES[array[2]]


def st_table(name: str, st_type: str, rows: Sequence[Sequence[str]], doc: str) -> Table:
    """Lay out a table: every row begins a new line.

    Parameters
    ----------
    name, st_type : str
        Name, and type of an element.
    rows : sequence of sequence of str
        Literals.
    doc : str
        Comment.
    """
    chunks: list[str] = []
    for row in rows:
        chunks += _chunks(row)
    lines = [f"{chunk}," for chunk in chunks[:-1]] + chunks[-1:]
    return Table(name, st_type, sum(len(row) for row in rows) - 1, tuple(lines), doc)


def _chunks(row: Sequence[str]) -> list[str]:
    """Break a row of literals into lines: no more values, nor characters, than one may have."""
    lines: list[list[str]] = [[]]
    for value in row:
        full = len(", ".join((*lines[-1], value))) >= LINE_WIDTH - 4
        if full or len(lines[-1]) == VALUES_A_LINE:
            lines.append([])
        lines[-1].append(value)
    return [", ".join(line) for line in lines]
