"""The C types of a block, and the parts of which its source is made. Not for: what is in them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from swayless.codegen.literals import c_literal
from swayless.controller.number import NumberType

VALUES_A_LINE = 6
"""Table values in one line of source."""


@dataclass(frozen=True)
class CTypes:
    """Names of the C types of a block, and literals in its number type.

    Parameters
    ----------
    name : str
        Prefix of every symbol.
    number : NumberType
        Number type of commands and references.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> types = CTypes("crane", number_type("int32"))
    >>> types.real, types.plain_real, types.sum, types.literal(7)
    ('crane_real_t', 'int32_t', 'int64_t', '7')
    """

    name: str
    number: NumberType

    @property
    def real(self) -> str:
        """Type of commands and references, as the block names it."""
        return f"{self.name}_real_t"

    @property
    def plain_real(self) -> str:
        """What that type is."""
        return "int32_t" if self.number.is_integer else self.number.name

    @property
    def sum(self) -> str:
        """Type of sums of references."""
        return "int64_t" if self.number.is_integer else self.real

    @property
    def input(self) -> str:
        """Structure of the inputs."""
        return f"{self.name}_shaper_input_t"

    @property
    def output(self) -> str:
        """Structure of the outputs."""
        return f"{self.name}_shaper_output_t"

    @property
    def cell(self) -> str:
        """Structure of a cell of the phase clock's ring."""
        return f"{self.name}_shaper_cell_t"

    def literal(self, value: Any) -> str:
        """Literal of the number type."""
        return c_literal(value, self.number)

    def wide(self, value: Any) -> str:
        """Literal of the type of sums."""
        return f"INT64_C({int(value)})" if self.number.is_integer else self.literal(value)


@dataclass(frozen=True)
class CField:
    """One member of a generated structure."""

    c_type: str
    c_name: str
    c_doc: str
    c_array: str = ""
    c_initial: str = ""
    elements: int = 1


@dataclass(frozen=True)
class CConstant:
    """One constant, or one ramp."""

    c_type: str
    name: str
    c_literal: str
    doc: str


@dataclass(frozen=True)
class CTable:
    """One constant table, broken into lines."""

    c_type: str
    name: str
    length: int
    c_lines: tuple[str, ...]
    doc: str


def c_table(c_type: str, name: str, rows: Sequence[Sequence[str]], doc: str) -> CTable:
    """Lay a table out; every row of the bank starts a line of its own.

    Parameters
    ----------
    c_type, name : str
        Type of an element, and name without prefix.
    rows : sequence of sequence of str
        Literals, by row.
    doc : str
        Comment.
    """
    return CTable(c_type, name, sum(len(row) for row in rows), tuple(_lines(rows)), doc)


def _lines(rows: Sequence[Sequence[str]]) -> Iterable[str]:
    chunks = [list(row[i : i + VALUES_A_LINE]) for row in rows for i in range(0, len(row), VALUES_A_LINE)]
    for position, chunk in enumerate(chunks):
        yield ", ".join(chunk) + ("," if position < len(chunks) - 1 else "")
