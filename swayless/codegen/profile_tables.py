"""Tables of a motion profile as a reader wants them: what each row is for stands beside it.

Not for: the numbers in them (`swayless.controller.profile`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from swayless.codegen.literals import c_literal, st_literal
from swayless.codegen.st_types import ST_BYTES, ST_REALS
from swayless.controller.number import NumberType
from swayless.controller.profile import ProfileSettings
from swayless.design.shaper import FloatArray

WIDTH = 112
"""Longest line of values, with 4 spaces in front and a comma behind."""

RAW_A_ROW = 6
"""Values of a plain table that share a comment."""

Rows: TypeAlias = list[tuple[str, FloatArray]]
"""What each row is, and its numbers."""


@dataclass(frozen=True)
class ProfileTable:
    """One table in both languages.

    Parameters
    ----------
    c_name, st_name : str
        Name in each, in C without prefix.
    rows : list of tuples
        What each row is, and its numbers.
    doc : str
        What the table is, and where it comes from.
    number : NumberType or None
        Type of the numbers; None for counts of ticks.
    """

    c_name: str
    st_name: str
    rows: Rows
    doc: str
    number: NumberType | None

    @property
    def length(self) -> int:
        """Number of values."""
        return sum(len(values) for _, values in self.rows)

    @property
    def last(self) -> int:
        """Index of the last value."""
        return self.length - 1

    @property
    def st_type(self) -> str:
        """Structured Text type of a value."""
        return "DINT" if self.number is None else ST_REALS[self.number.name]

    @property
    def c_bytes(self) -> int:
        """Memory that the table takes in C."""
        return self.length * (2 if self.number is None else ST_BYTES[self.st_type])

    @property
    def c_lines(self) -> tuple[str, ...]:
        """Initialiser in C."""
        rows = [(text, [self._c(value) for value in values]) for text, values in self.rows]
        return tuple(_lines(rows, "/*", "*/"))

    @property
    def st_lines(self) -> tuple[str, ...]:
        """Initialiser in Structured Text."""
        rows = [(text, [self._st(value) for value in values]) for text, values in self.rows]
        return tuple(_lines(rows, "(*", "*)"))

    def _c(self, value: float) -> str:
        return f"{int(value)}u" if self.number is None else c_literal(value, self.number)

    def _st(self, value: float) -> str:
        return str(int(value)) if self.number is None else st_literal(value, self.number)


def _lines(rows: Sequence[tuple[str, list[str]]], opening: str, closing: str) -> Iterator[str]:
    """Break rows of literals into lines; what a row is stands behind its last one."""
    for place, (text, literals) in enumerate(rows):
        lines = [""]
        for literal in literals:
            if lines[-1] and len(lines[-1]) + len(literal) + 3 > WIDTH:
                lines.append("")
            lines[-1] += f"{', ' if lines[-1] else ''}{literal}"
        yield from (f"{line}," for line in lines[:-1])
        end = "," if place < len(rows) - 1 else ""
        yield f"{lines[-1]}{end} {opening} {text} {closing}"


def profile_tables(settings: ProfileSettings) -> tuple[ProfileTable, ...]:
    """Lay out every table of a block.

    Parameters
    ----------
    settings : ProfileSettings
        The block.

    Examples
    --------
    A mass of 1 kg that is pushed for two ticks, and braked for two:

    >>> from swayless.controller.profile import Extremes, Pieces, ProfileModel, ProfileSettings, StopLaw
    >>> mass = ProfileModel([[0.0, 1.0], [0.0, 0.0]], [0.5, 1.0], [1.0, 0.0], 0.0)
    >>> stop = StopLaw([[0.0, -1.0, 0.0]], [1.0, 0.5, 0.0])
    >>> pieces, extremes = Pieces([2, 2], [[0.25], [-0.25]]), Extremes((-1.0, 1.0), (0.0, 1.0))
    >>> tables = profile_tables(ProfileSettings(0.01, pieces, mass, stop, extremes, (-4.0, 4.0)))
    >>> for line in tables[0].c_lines:
    ...     print(line)
    0.25, /* ticks 0 to 1, 0 s */
    -0.25 /* ticks 2 to 3, 0.02 s */
    """
    return (*_piece_tables(settings), *_plant_tables(settings))


def _piece_tables(settings: ProfileSettings) -> Iterator[ProfileTable]:
    pieces, number = settings.pieces, settings.number
    if pieces.is_raw:
        doc = "Shape of a move by 1: the input of each tick, less what held the plant before."
        values = pieces.coefficients[:, 0]
        parts = [(tick, values[tick : tick + RAW_A_ROW]) for tick in range(0, values.size, RAW_A_ROW)]
        rows = [(_when(tick, tick + part.size - 1, settings.tick_s), part) for tick, part in parts]
        yield ProfileTable("PIECE_SHAPES", "PieceShapes", rows, doc, number)
        return
    ends = np.cumsum(pieces.lengths)
    when = [
        _when(int(end - length), int(end) - 1, settings.tick_s)
        for end, length in zip(ends, pieces.lengths, strict=True)
    ]
    doc = "Shape of a move by 1: the input, less what held the plant before, from switch to switch."
    if pieces.degree:
        doc = f"Shape of a move by 1, in polynomials of degree {pieces.degree}, the highest power first."
    shapes = pieces.coefficients[:, ::-1]
    yield ProfileTable("PIECE_SHAPES", "PieceShapes", list(zip(when, shapes, strict=True)), doc, number)
    lengths = [(text, np.array([length])) for text, length in zip(when, pieces.lengths, strict=True)]
    yield ProfileTable("PIECE_LENGTHS", "PieceLengths", lengths, "Ticks of each piece.", None)
    if pieces.degree:
        steps = [(text, np.array([step])) for text, step in zip(when, pieces.scales(number), strict=True)]
        doc = "Step of a piece's own variable, which goes from -1 to 1: 2 over one tick less than it has."
        yield ProfileTable("PIECE_STEPS", "PieceSteps", steps, doc, number)


def _plant_tables(settings: ProfileSettings) -> Iterator[ProfileTable]:
    model, stop, number = settings.model, settings.stop, settings.number
    changes = np.column_stack([model.change, model.input])
    rows: Rows = [(f"change of state {row}", values) for row, values in enumerate(changes)]
    rows.append(("position", np.append(model.output, model.feedthrough)))
    doc = (
        "Plant of the design, sampled: what a tick adds to each state, and the position; of states and shape."
    )
    yield ProfileTable("PLANT", "PlantRows", rows, doc, number)
    rows = [(f"tick {tick} of a stop", values) for tick, values in enumerate(stop.gains)]
    doc = (
        "Shape of a stop, by the states and the last shape before the abort: least change that leads to rest."
    )
    yield ProfileTable("STOP", "StopRows", rows, doc, number)
    doc = "Where a stop comes to rest, of the same."
    yield ProfileTable("STOP_REST", "StopRest", [("share of the travel", stop.rest)], doc, number)


def _when(first: int, last: int, tick_s: float) -> str:
    """Say which ticks a row is for, and when the first one is."""
    ticks = f"tick {first}" if first == last else f"ticks {first} to {last}"
    return f"{ticks}, {first * tick_s:.6g} s"
