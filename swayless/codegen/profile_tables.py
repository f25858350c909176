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
from swayless.controller.profile import Pieces, ProfileModel, ProfileSettings
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
    """Break rows of literals into lines; what each row is stands behind it, or above where it is too long."""
    texts = [f"{opening} {text} {closing}" for text, _ in rows]
    broken = [_broken(literals) for _, literals in rows]
    broken = [[f"{line}," for line in lines] for lines in broken]
    broken[-1][-1] = broken[-1][-1].removesuffix(",")
    behind = [f"{lines[0]} {text}" for lines, text in zip(broken, texts, strict=True)]
    if all(len(lines) == 1 for lines in broken) and max(map(len, behind)) <= WIDTH:
        yield from behind
        return
    for lines, text in zip(broken, texts, strict=True):
        yield text
        yield from lines


def _broken(literals: Sequence[str]) -> list[str]:
    """Put as many literals in each line as fit."""
    lines = [""]
    for literal in literals:
        if lines[-1] and len(lines[-1]) + len(literal) + 3 > WIDTH:
            lines.append("")
        lines[-1] += f"{', ' if lines[-1] else ''}{literal}"
    return lines


@dataclass(frozen=True)
class PlayedPieces:
    """A table that is played tick by tick, as the templates see it.

    Parameters
    ----------
    c_name, st_name : str
        What the names of its tables begin with.
    pieces : Pieces
        Values, or rows of gains.
    """

    c_name: str
    st_name: str
    pieces: Pieces

    @property
    def count(self) -> int:
        """Number of pieces."""
        return int(self.pieces.lengths.size)

    @property
    def degree(self) -> int:
        """Degree of each piece."""
        return self.pieces.degree

    @property
    def coefficients(self) -> int:
        """Coefficients of each piece."""
        return self.degree + 1

    @property
    def is_raw(self) -> bool:
        """Whether each tick has a piece of its own."""
        return self.pieces.is_raw


def move_pieces(settings: ProfileSettings) -> PlayedPieces:
    """Give what a move plays."""
    return PlayedPieces("MOVE", "Move", settings.pieces)


def stop_pieces(settings: ProfileSettings) -> PlayedPieces | None:
    """Give what a stop plays, if there are any."""
    return None if settings.stop is None else PlayedPieces("STOP", "Stop", settings.stop.pieces)


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
    >>> stop = StopLaw(Pieces([1], [[[0.0, -1.0, 0.0]]]), [1.0, 0.5, 0.0], [[1, 2]])
    >>> pieces, extremes = Pieces([2, 2], [[0.25], [-0.25]]), Extremes((-1.0, 1.0), (0.0, 1.0))
    >>> tables = profile_tables(ProfileSettings(0.01, pieces, mass, stop, extremes, (-4.0, 4.0)))
    >>> for line in tables[0].c_lines:
    ...     print(line)
    0.25, /* ticks 0 to 1, 0 s */
    -0.25 /* ticks 2 to 3, 0.02 s */
    """
    return tuple(_tables(settings))


def _tables(settings: ProfileSettings) -> Iterator[ProfileTable]:
    number, tick_s = settings.number, settings.tick_s
    move, stop = move_pieces(settings), stop_pieces(settings)
    doc = "Shape of a move by 1: input less what held the plant"
    shapes = _plain_rows(move.pieces, tick_s) if move.is_raw else _piece_rows(move.pieces, tick_s)
    yield ProfileTable("MOVE_SHAPES", "MoveShapes", shapes, f"{doc}{_form(move)}.", number)
    yield from _timing(move, settings)
    doc = (
        "Plant of the design, sampled: what a tick adds to each state, and the position; of states and shape."
    )
    yield ProfileTable("PLANT", "PlantRows", _plant_rows(settings.model), doc, number)
    if stop is None or settings.stop is None:
        return
    doc = "Shape of a stop, of the states and the last shape before it"
    gains = _piece_rows(stop.pieces, tick_s)
    yield ProfileTable("STOP_GAINS", "StopGains", gains, f"{doc}{_form(stop)}.", number)
    yield from _timing(stop, settings)
    doc = "Where a stop comes to rest, of the same."
    yield ProfileTable("STOP_REST", "StopRest", [("share of the travel", settings.stop.rest)], doc, number)
    ranges = settings.stop.ranges
    for names, what, ticks in (
        (("STOP_FIRST", "StopFirst"), "First", ranges[:, 0]),
        (("STOP_LAST", "StopLast"), "Last", ranges[:, 1]),
    ):
        doc = f"{what} tick of the move in each range in which a stop may begin."
        yield ProfileTable(*names, [_range_row(tick, tick_s) for tick in ticks.tolist()], doc, None)


def _form(played: PlayedPieces) -> str:
    """Say what a row is."""
    if played.degree:
        return f", in polynomials of degree {played.degree}, highest power first"
    return "" if played.is_raw else ", from switch to switch"


def _plain_rows(pieces: Pieces, tick_s: float) -> Rows:
    """Put some values of a plain table in each row."""
    values = pieces.coefficients[:, 0]
    parts = [(tick, values[tick : tick + RAW_A_ROW]) for tick in range(0, values.size, RAW_A_ROW)]
    return [(_when(tick, tick + part.size - 1, tick_s), part) for tick, part in parts]


def _piece_rows(pieces: Pieces, tick_s: float) -> Rows:
    """Put one piece in each row; of gains, each power in a row of its own."""
    when, ordered = _whens(pieces, tick_s), pieces.coefficients[:, ::-1]
    if ordered.ndim == 2:
        return list(zip(when, ordered, strict=True))
    return [
        (f"{text}, power {pieces.degree - place}" if pieces.degree else text, row)
        for text, rows in zip(when, ordered, strict=True)
        for place, row in enumerate(rows)
    ]


def _timing(played: PlayedPieces, settings: ProfileSettings) -> Iterator[ProfileTable]:
    """Lengths of pieces, where not each is a tick, and the steps of their variables."""
    pieces, when = played.pieces, _whens(played.pieces, settings.tick_s)
    if not pieces.is_raw:
        lengths = [(text, np.array([length])) for text, length in zip(when, pieces.lengths, strict=True)]
        names = f"{played.c_name}_LENGTHS", f"{played.st_name}Lengths"
        yield ProfileTable(*names, lengths, "Ticks of each piece.", None)
    if pieces.degree:
        scales = pieces.scales(settings.number)
        steps = [(text, np.array([step])) for text, step in zip(when, scales, strict=True)]
        doc = "Step of a piece's own variable, which goes from -1 to 1: 2 over one tick less than it has."
        names = f"{played.c_name}_STEPS", f"{played.st_name}Steps"
        yield ProfileTable(*names, steps, doc, settings.number)


def _plant_rows(model: ProfileModel) -> Rows:
    changes = np.column_stack([model.change, model.input])
    rows: Rows = [(f"change of state {row}", values) for row, values in enumerate(changes)]
    return [*rows, ("position", np.append(model.output, model.feedthrough))]


def _range_row(tick: int, tick_s: float) -> tuple[str, FloatArray]:
    return f"{tick * tick_s:.6g} s", np.array([tick])


def _whens(pieces: Pieces, tick_s: float) -> list[str]:
    ends = np.cumsum(pieces.lengths).tolist()
    begins = [0, *ends[:-1]]
    return [_when(begin, end - 1, tick_s) for begin, end in zip(begins, ends, strict=True)]


def _when(first: int, last: int, tick_s: float) -> str:
    """Say which ticks a row is for, and when the first one is."""
    ticks = f"tick {first}" if first == last else f"ticks {first} to {last}"
    return f"{ticks}, {first * tick_s:.6g} s"
