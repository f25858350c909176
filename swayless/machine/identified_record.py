"""Which columns of a table are what: the swings of a record, or the heights of peaks.

Not for: reading the table (`swayless.machine.identified_table`) or finding the mode.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swayless.errors import FileError, PlantError
from swayless.machine.identified_table import RecordTable, refuse_lines
from swayless.machine.identified_units import TIME_UNITS, VALUE_UNITS, Head, unit_named
from swayless.machine.problems import shown
from swayless.plant.identification import Quantity, SwingRecord, outliers
from swayless.plant.identification.record import FloatArray

_LATEST_S = 1e10
"""Seconds since 1970 in the year 2286: no clock shows more, unless it counts something shorter."""


@dataclass(frozen=True)
class Reading:
    """How to read a table.

    Parameters
    ----------
    time, column, rope_column : str or None
        Head or number (from 1) of the times, the values and the rope lengths; None finds them by their heads.
    unit : str or None
        Of the values; that of the head unless given.
    rate_hz : float or None
        Samples per second, for a file without times.
    start_s, end_s : float or None
        Part of the record to read, on its own clock.
    """

    time: str | None = None
    column: str | None = None
    rope_column: str | None = None
    unit: str | None = None
    rate_hz: float | None = None
    start_s: float | None = None
    end_s: float | None = None


@dataclass(frozen=True, eq=False)
class ReadRecord:
    """A record as read from a table.

    Parameters
    ----------
    record : SwingRecord
    head : Head
        Of the values.
    unit_size : float
        Size in SI of the unit in which the values stand in the file.
    missing : int
        Samples without a value.
    rope_length_m : float or None
        From a rope column.
    time_unit_is_assumed : bool
        Whether nothing says that the times are seconds, as which they were taken.
    """

    record: SwingRecord
    head: Head
    unit_size: float
    missing: int
    rope_length_m: float | None = None
    time_unit_is_assumed: bool = False


def read_swings(table: RecordTable, reading: Reading) -> list[ReadRecord]:
    """Read the swing of a table, or one for each rope length of its rope column.

    Raises
    ------
    FileError
        If a column is missing or ambiguous, or a time or value is wrong: with the line.
    """
    _refuse_counts(table, reading)
    rope, time_s, value = _columns(table, reading)
    quantity, size = _quantity(table, reading, table.heads[value])
    ropes = np.zeros(time_s.size) if rope is None else _ropes(table, rope)
    groups = np.flatnonzero(np.concatenate([[True], np.diff(ropes) != 0.0]))
    assumed = reading.rate_hz is None and table.heads[_time_column(table, reading)].unit is None
    records = [
        _record(
            table,
            reading,
            slice(first, last),
            time_s,
            value,
            (quantity, size),
            None if rope is None else float(ropes[first]),
        )
        for first, last in zip(groups, [*groups[1:], time_s.size], strict=True)
    ]
    return [replace(each, time_unit_is_assumed=assumed) for each in records]


def read_peaks(table: RecordTable, reading: Reading) -> tuple[FloatArray, FloatArray, bool]:
    """Read the heights of peaks: times or counts of swings, heights, and whether they are times.

    Raises
    ------
    FileError
        If a column is missing, or a value is wrong: with the line.
    """
    _, time_s, value = _columns(table, reading)
    height = table.values[:, value]
    keep = ~np.isnan(height)
    problems = [
        f"{_line(table, index)}: height = {height[index]:g}: must be finite and > 0"
        for index in np.flatnonzero(keep & ~((height > 0.0) & np.isfinite(height)))
    ]
    problems += _time_problems(table, time_s, keep)
    refuse_lines(table.path, problems)
    return time_s[keep], height[keep], reading.rate_hz is not None or not _are_counted(table, reading)


def _refuse_counts(table: RecordTable, reading: Reading) -> None:
    """Refuse a file whose samples are only counted: counts are no seconds."""
    if reading.rate_hz is not None or reading.time is not None:
        return
    column = _time_column(table, reading)
    head, steps = table.heads[column], np.diff(table.values[:, column])
    if not head.is_time and (head.is_count or (steps.size and (steps == 1.0).all())):
        raise FileError(
            [
                f"{table.path}: {shown(head.text)} counts samples or swings, which are no times: give --rate,"
                f" or --time {column + 1} if it does hold seconds; heights of peaks need --peaks"
            ]
        )


def _are_counted(table: RecordTable, reading: Reading) -> bool:
    """Whether peaks stand over counts of swings, as the head says; whole or half numbers may be either."""
    column = _time_column(table, reading)
    head = table.heads[column]
    if head.is_time or head.is_swing:
        return not head.is_time
    halves = 2.0 * np.diff(table.values[:, column])
    if reading.time is None and (halves == np.round(halves)).all():
        raise FileError(
            [
                f"{table.path}: {shown(head.text)} may be times or counts of swings: give it a head,"
                ' "time [s]" or "swing"'
            ]
        )
    return False


def _columns(table: RecordTable, reading: Reading) -> tuple[int | None, FloatArray, int]:
    """Find the rope column, the times in s, and the column of the values."""
    taken: list[int] = []
    rope = None if reading.rope_column is None else _column(table, reading.rope_column, "--rope-column")
    taken += [] if rope is None else [rope]
    if reading.rate_hz is None:
        column = _time_column(table, reading)
        taken.append(column)
        time_s = table.values[:, column] * _time_unit_s(table, reading, column)
    else:
        _refuse_times(table)
        time_s = np.arange(table.line.size) / reading.rate_hz
    if reading.column is not None:
        return rope, time_s, _column(table, reading.column, "--column")
    left = [index for index in range(len(table.heads)) if index not in taken]
    if len(left) > 1:
        left = [index for index in left if _may_be_measured(table.heads[index])]
    if len(left) != 1:
        names = ", ".join(shown(table.heads[index].text) for index in left)
        what = f"which one is the swing? give --column: {names}" if left else "there is no column of values"
        raise FileError([f"{table.path}: {what}"])
    return rope, time_s, left[0]


def _time_unit_s(table: RecordTable, reading: Reading, column: int) -> float:
    """Give the unit of the times; what stands in its place and is none is not taken for seconds."""
    head = table.heads[column]
    place, known = f"{table.path}: line {table.head_line}: {shown(head.text)}", ", ".join(TIME_UNITS)
    unknown = head.unknown or (None if reading.time else head.last_word)
    if unknown is not None:
        hint = "" if head.unknown else f"; or give --time {column + 1} if it does hold seconds"
        raise FileError([f"{place}: {shown(unknown)} is no unit of time; known: {known}{hint}"])
    if head.unit is not None and head.unit not in TIME_UNITS:
        raise FileError([f"{place}: {shown(head.unit)} is no unit of time; known: {known}"])
    if head.unit is None and np.nanmax(np.abs(table.values[:, column]), initial=0.0) > _LATEST_S:
        raise FileError([f'{place}: too large for seconds: say their unit: "time [ms]"; known: {known}'])
    return TIME_UNITS[head.unit or "s"]


def _refuse_times(table: RecordTable) -> None:
    """Refuse a rate beside times, which say something else or the same."""
    times = [head.text for head in table.heads if head.is_time]
    if times:
        raise FileError(
            [
                f"{table.path}: line {table.head_line}: {shown(times[0])} holds the times: --rate is for a"
                " file without; leave it out, or rename that column"
            ]
        )


def _time_column(table: RecordTable, reading: Reading) -> int:
    if reading.time is not None:
        return _column(table, reading.time, "--time")
    if len(table.heads) == 1:
        raise FileError(
            [f"{table.path}: line {table.line[0]}: one column: give --rate, or a file with a column of times"]
        )
    times = [index for index, head in enumerate(table.heads) if head.is_time]
    counts = [index for index, head in enumerate(table.heads) if head.is_count]
    return [*times, *counts, 0][0]


def _may_be_measured(head: Head) -> bool:
    """Whether a column may be the swing: it has a name, and not that of a time or a count."""
    return bool(head.text) and not (head.is_time or head.is_count)


def _column(table: RecordTable, asked: str, option: str) -> int:
    """Find a column by its head, by its head without the unit, or by its number."""
    for texts in ([head.text for head in table.heads], [head.name for head in table.heads]):
        found = [index for index, text in enumerate(texts) if text.lower() == asked.strip().lower()]
        if len(found) == 1:
            return found[0]
    if asked.isdecimal() and 1 <= int(asked) <= len(table.heads):
        return int(asked) - 1
    known = ", ".join(shown(head.text) for head in table.heads)
    raise FileError(
        [
            f"{table.path}: {option} = {shown(asked)}: no such column; known: {known}, or 1 to"
            f" {len(table.heads)}"
        ]
    )


def _quantity(table: RecordTable, reading: Reading, head: Head) -> tuple[Quantity, float]:
    """Give what the values are, and the size of their unit."""
    if reading.unit is None:
        return VALUE_UNITS.get(head.unit or "", (Quantity.value, 1.0))
    unit = unit_named(reading.unit)
    if unit is None or unit not in VALUE_UNITS:
        known = ", ".join(VALUE_UNITS)
        raise FileError([f"{table.path}: --unit = {shown(reading.unit)}: unknown unit; known: {known}"])
    return VALUE_UNITS[unit]


def _ropes(table: RecordTable, column: int) -> FloatArray:
    """Give the rope of every sample in m."""
    head = table.heads[column]
    quantity, size = VALUE_UNITS.get(head.unknown or head.unit or "m", (Quantity.value, 1.0))
    ropes = table.values[:, column] * size
    wrong = np.flatnonzero(~((ropes > 0.0) & np.isfinite(ropes)))
    problems = [f"{_line(table, index)}: rope length = {ropes[index]:g}: must be > 0" for index in wrong]
    if quantity is not Quantity.position:
        problems = [
            f"{table.path}: line {table.head_line}: {shown(head.text)}: is not a length that is known"
        ]
    refuse_lines(table.path, problems)
    return np.asarray(ropes)


def _record(
    table: RecordTable,
    reading: Reading,
    part: slice,
    time_s: FloatArray,
    value: int,
    measured: tuple[Quantity, float],
    rope_length_m: float | None,
) -> ReadRecord:
    """Cut one record out of a table, leave missing samples out, and report wrong ones with their line."""
    quantity, size = measured
    low = -np.inf if reading.start_s is None else reading.start_s
    high = np.inf if reading.end_s is None else reading.end_s
    wanted = np.zeros(time_s.size, dtype=bool)
    wanted[part] = True
    wanted &= ~((time_s < low) | (time_s > high))
    values = table.values[:, value] * size
    present = wanted & ~np.isnan(values)
    problems = _time_problems(table, time_s, wanted)
    problems += [
        f"{_line(table, index)}: value is infinite" for index in np.flatnonzero(present & np.isinf(values))
    ]
    refuse_lines(table.path, problems)
    try:
        record = SwingRecord(time_s[present], values[present], quantity)
    except PlantError as error:
        span = f"lines {table.line[part][0]} to {table.line[part][-1]}"
        raise FileError([f"{table.path}: {span}: {error}"]) from error
    rows = np.flatnonzero(present)[outliers(record.value)]
    refuse_lines(
        table.path,
        [
            f"{_line(table, row)}: value = {table.values[row, value]:g} stands alone, far outside of the"
            " swing: leave its cell empty if the reading failed"
            for row in rows
        ],
    )
    missing = int(wanted.sum() - present.sum())
    return ReadRecord(record, table.heads[value], size, missing, rope_length_m)


def _time_problems(table: RecordTable, time_s: FloatArray, wanted: NDArray[np.bool_]) -> list[str]:
    """Report times that are missing or do not rise."""
    lost = np.flatnonzero(wanted & ~np.isfinite(time_s))
    if lost.size:
        return [f"{_line(table, index)}: the time is missing or infinite" for index in lost]
    rows = np.flatnonzero(wanted)
    back = np.flatnonzero(np.diff(time_s[rows]) <= 0.0)
    return [
        f"{_line(table, rows[index + 1])}: time = {time_s[rows[index + 1]]:.9g} s does not come after"
        f" {time_s[rows[index]]:.9g} s"
        for index in back
    ]


def _line(table: RecordTable, index: np.integer | int) -> str:
    return f"{table.path}: line {table.line[index]}"
