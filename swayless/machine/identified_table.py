"""The table in a CSV file: commas, semicolons, tabs or blanks, decimal points or commas, heads or none.

Every cell is a number or missing (empty, NaN, N/A); what is neither is reported with its line.

Not for: which column is what (`swayless.machine.identified_record`).
"""

from __future__ import annotations

import codecs
import csv
import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swayless.errors import FileError
from swayless.machine.identified_units import Head, read_head, unit_named
from swayless.machine.problems import shown
from swayless.machine.source import read_source
from swayless.plant.identification.record import FloatArray

MAX_BYTES = 500_000_000
MOST_PROBLEMS = 10
"""Problems of one file that are named; the others are counted."""

_MISSING = frozenset({"", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--"})
_NUMBER = re.compile(
    r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[+-]?inf(?:inity)?", re.IGNORECASE
)
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?")
_NAME_AND_UNIT = re.compile(r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?")
_SEPARATOR = re.compile(r"\"?sep=(.)\"?\s*", re.IGNORECASE)
_DELIMITERS = (";", "\t", ",", None)
_SAMPLE = 20


@dataclass(frozen=True, eq=False)
class RecordTable:
    """Numbers of a file, row by row.

    Parameters
    ----------
    path : Path
        The file, for messages.
    heads : tuple of Head
        One for each column; ``column 1`` and so on in a file without heads.
    values : ndarray, shape (rows, columns)
        NaN where a value is missing.
    line : ndarray of int, shape (rows,)
        Where each row stands in the file, from 1.
    head_line : int
        Where the heads stand, or the first row in a file without.
    """

    path: Path
    heads: tuple[Head, ...]
    values: FloatArray
    line: NDArray[np.int64]
    head_line: int


def load_table(path: Path) -> RecordTable:
    """Load a CSV file.

    Parameters
    ----------
    path : Path
        UTF-8 text, or UTF-16 with its byte order mark. Blank lines, lines that begin with ``#`` and a first
        line ``sep=;``, which spreadsheets write, do not count.

    Raises
    ------
    FileError
        With every problem found: file, line, cell and what is allowed.
    """
    text = _text(path).replace("\r\n", "\n").replace("\r", "\n")
    lines = text.split("\n")
    kept = [index for index, line in enumerate(lines) if line.strip() and line.lstrip()[0] != "#"]
    separator = _SEPARATOR.fullmatch(lines[kept[0]]) if kept else None
    kept = kept[1:] if separator else kept
    if not kept:
        raise FileError([f"{path}: is empty: a record has a line for each sample, with a time and a value"])
    contents, number = [lines[index] for index in kept], np.array(kept, dtype=np.int64) + 1
    delimiter = _delimiter(
        contents[1 : _SAMPLE + 1] or contents, separator[1].strip(" ") if separator else ""
    )
    names, units, first = _heads(_split(contents[:2], delimiter), delimiter)
    if first == len(contents):
        raise FileError([f"{path}: line {number[-1]}: has no numbers: a record has a line for each sample"])
    width = len(names) if names else len(_split(contents[:1], delimiter)[0])
    values = _plain_numbers(contents[first:], width, delimiter)
    if values is None:
        values = _numbers(path, number[first:], _split(contents[first:], delimiter), width, delimiter)
    heads = tuple(
        _head(names[column] if names else f"column {column + 1}", units[column] if units else "")
        for column in range(width)
    )
    filled = [
        column for column in range(width) if heads[column].text or not np.isnan(values[:, column]).all()
    ]
    kept_heads = tuple(heads[column] for column in filled)
    return RecordTable(path, kept_heads, values[:, filled], number[first:], int(number[0]))


def _text(path: Path) -> str:
    """Read a file; spreadsheets write UTF-16 too, and say so in its first bytes."""
    try:
        with path.open("rb") as stream:
            mark = stream.read(2)
            wide = mark in {codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE}
            data = mark + stream.read(MAX_BYTES) if wide else b""
    except (OSError, ValueError):
        wide = False  # `read_source` says why.
    if not wide:
        text = read_source(path, max_bytes=MAX_BYTES)
        if "\0" in text:
            line = text.count("\n", 0, text.index("\0")) + 1
            raise FileError([f"{path}: line {line}: holds null bytes, which no text does: save it as UTF-8"])
        return text
    if len(data) > MAX_BYTES:
        raise FileError([f"{path}: is larger than {MAX_BYTES} bytes, the most that is read"])
    try:
        return data.decode("utf-16")
    except UnicodeDecodeError as error:
        raise FileError([f"{path}: is not UTF-16 text, as its first bytes say: save it as UTF-8"]) from error


def _delimiter(sample: Sequence[str], likely: str) -> str | None:
    """Find what separates the cells: what leaves most of them numbers; None for blanks."""
    known = (likely, *_DELIMITERS) if likely else _DELIMITERS
    present = [each for each in known if each is None or any(each in line for line in sample)]
    return max(present, key=lambda each: _numeric_part(sample, each))


def _numeric_part(sample: Sequence[str], delimiter: str | None) -> float:
    cells = [cell for row in _split(sample, delimiter) for cell in row]
    return sum(_is_number(cell, delimiter) for cell in cells) / len(cells)


def _split(lines: Iterable[str], delimiter: str | None) -> list[list[str]]:
    if delimiter is None:
        return [line.split() for line in lines]
    return [_cells(line, delimiter) if '"' in line else line.split(delimiter) for line in lines]


def _cells(line: str, delimiter: str) -> list[str]:
    """Split a line with quotes; each line for itself, so that one quote too many spoils no other."""
    try:
        return next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
    except csv.Error:
        return [line]


def _is_number(cell: str, delimiter: str | None) -> bool:
    text = cell.strip()
    return bool(
        text.lower() in _MISSING
        or _NUMBER.fullmatch(text)
        or (delimiter != "," and _DECIMAL_COMMA.fullmatch(text))
    )


def _heads(rows: list[list[str]], delimiter: str | None) -> tuple[list[str], list[str], int]:
    """Give names and units above the numbers, and the row in which the numbers begin."""
    if any(_is_number(cell, delimiter) and cell.strip() for cell in rows[0]):
        return [], [], 0
    names = [cell.strip() for cell in rows[0]]
    if delimiter is None:
        names = _NAME_AND_UNIT.findall(" ".join(names))
    if len(rows) > 1 and len(rows[1]) == len(names):
        units = [cell.strip(" []()-") for cell in rows[1]]
        if any(unit_named(unit) for unit in units):
            return names, units, 2
    return names, [], 1


def _head(text: str, unit: str) -> Head:
    """Read a head whose unit may stand below it."""
    head, known = read_head(text), unit_named(unit)
    return head._replace(unit=known, unknown=None if known else unit) if unit else head


def _plain_numbers(lines: Sequence[str], width: int, delimiter: str | None) -> FloatArray | None:
    """Turn lines into numbers at once; None if any cell is not a plain number."""
    try:
        values = np.loadtxt(lines, delimiter=delimiter, ndmin=2, comments=None)
    except ValueError:
        return None
    return values if values.shape[1] == width else None


def _numbers(
    path: Path, line: NDArray[np.int64], rows: list[list[str]], width: int, delimiter: str | None
) -> FloatArray:
    """Turn the cells into numbers one by one, missing ones into NaN, and report what is neither."""
    problems: list[str] = []
    values = np.full((len(rows), width), np.nan)
    for index, row in enumerate(rows):
        cells = row[:width] if all(not cell.strip() for cell in row[width:]) else row
        if len(cells) > width or len(cells) < min(width, 2):
            problems.append(_wrong_width(f"{path}: line {line[index]}", len(cells), width))
            continue
        for column, cell in enumerate(cells):
            number = _number(cell.strip(), delimiter)
            if number is None:
                problems.append(f"{path}: line {line[index]}: {shown(cell.strip())} is not a number")
            else:
                values[index, column] = number
    refuse_lines(path, problems)
    return values


def _wrong_width(place: str, count: int, width: int) -> str:
    hint = "; decimal commas need semicolons between the columns" if count == 2 * width else ""
    hint = "; a remark above the heads begins with #" if width == 1 else hint
    return f"{place}: has {count} cells, where there are {width} columns{hint}"


def _number(text: str, delimiter: str | None) -> float | None:
    if text.lower() in _MISSING:
        return math.nan
    if delimiter != "," and _DECIMAL_COMMA.fullmatch(text):
        return float(text.replace(",", "."))
    return float(text) if _NUMBER.fullmatch(text) else None


def refuse_lines(path: Path, problems: list[str]) -> None:
    """Raise a `FileError` for the problems of a file, the first ten by name, if there are any."""
    if problems:
        more = len(problems) - MOST_PROBLEMS
        counted = [f"{path}: and {more} more lines like these"] if more > 0 else []
        raise FileError([*problems[:MOST_PROBLEMS], *counted])
