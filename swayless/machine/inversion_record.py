"""The record of a measured move, in CSV: times, positions of the load, and the command if it was recorded.

Not for: tables as such (`identified_table`), or what the move says of the drive (`design.inversion`).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swayless.design.inversion import MeasuredMove
from swayless.design.shaper import FloatArray
from swayless.errors import FileError
from swayless.machine.identified_table import RecordTable, load_table, refuse_lines
from swayless.machine.identified_units import TIME_UNITS
from swayless.machine.inversion_file import InversionRequest
from swayless.machine.problems import shown
from swayless.machine.quantity import UNITS

POSITION_NAMES = ("position", "load", "load_position", "output", "y")
COMMAND_NAMES = ("command", "reference_command", "r")

FEWEST_SAMPLES = 20
"""During the motion."""

_JITTER = 0.1  # of a step: how far a sample may be from its place
_ALIKE = 1e-3  # of the command's range: how far a recorded command may be from the one that was computed
_STARTS = 0.1  # of the travel: how far from its start the load may be measured before it moves


def read_move(path: Path, request: InversionRequest, *, column: str | None = None) -> MeasuredMove:
    """Read what the load did under the command of a file.

    Parameters
    ----------
    path : Path
        CSV with heads: a time, from the start of the motion, positions, and perhaps the command.
    request : InversionRequest
        The file whose command was played.
    column : str or None
        Head of the positions; found by its name unless given.

    Raises
    ------
    FileError
        If a column is missing, a value is missing or infinite, samples are missing or not equally apart, the
        record does not span the motion, or it is of another move: with the line.
    DesignError
        If the file has no command.
    """
    table = load_table(path)
    time, position = _time(table), _position(table, column)
    command = _named(table, COMMAND_NAMES)
    columns = {"time": time, "position": position} | ({} if command is None else {"command": command})
    _refuse_missing(table, columns)
    time_s = table.values[:, time] * TIME_UNITS.get(table.heads[time].unit or "s", 1.0)
    step_s = _step(table, time_s)
    size = float(UNITS["length"].get(table.heads[position].unit or "m", 1))
    values = table.values[:, position] * size
    during = time_s >= -_JITTER * step_s
    _refuse_part(table, time_s, step_s, during, request)
    _refuse_elsewhere(table, values, during, request)
    if command is not None:
        _refuse_others(table, time_s, table.values[:, command], during, request)
    first = int(np.argmax(during))
    mean_step_s = float((time_s[-1] - time_s[first]) / (time_s.size - 1 - first))
    return MeasuredMove(max(0.0, float(time_s[first])), mean_step_s, values[during])


def _time(table: RecordTable) -> int:
    """Find the times."""
    found = [index for index, head in enumerate(table.heads) if head.is_time]
    if len(found) != 1:
        raise FileError([f"{table.path}: one column of times is needed, such as time_s; {_heads(table)}"])
    return found[0]


def _position(table: RecordTable, column: str | None) -> int:
    """Find the positions."""
    found = _named(table, POSITION_NAMES if column is None else (column,))
    if found is None:
        what = "such as position" if column is None else f"--column = {shown(column)}"
        raise FileError([f"{table.path}: a column of load positions is needed, {what}; {_heads(table)}"])
    return found


def _named(table: RecordTable, names: tuple[str, ...]) -> int | None:
    """Find the one column with one of some names, with or without its unit."""
    wanted = {name.strip().lower() for name in names}
    found = [
        index
        for index, head in enumerate(table.heads)
        if {head.text.strip().lower(), head.name.strip().lower().replace(" ", "_")} & wanted
    ]
    return found[0] if len(found) == 1 else None


def _heads(table: RecordTable) -> str:
    return f"there are: {', '.join(shown(head.text) for head in table.heads)}"


def _line(table: RecordTable, index: np.integer | int) -> str:
    return f"{table.path}: line {table.line[index]}"


def _refuse_missing(table: RecordTable, columns: dict[str, int]) -> None:
    """Refuse cells without a finite number."""
    problems = [
        f"{_line(table, index)}: {name} is missing or infinite"
        for name, column in columns.items()
        for index in np.flatnonzero(~np.isfinite(table.values[:, column]))
    ]
    refuse_lines(table.path, problems)


def _step(table: RecordTable, time_s: FloatArray) -> float:
    """Give the time between two samples; they have to be equally apart."""
    if time_s.size < FEWEST_SAMPLES:
        raise FileError([f"{table.path}: {time_s.size} samples: must be {FEWEST_SAMPLES} at least"])
    steps = np.diff(time_s)
    usual = float(np.median(steps))
    wrong = np.flatnonzero(np.abs(steps - usual) > _JITTER * abs(usual))
    if usual <= 0.0:
        wrong = np.flatnonzero(steps <= 0.0)
    problems = [
        f"{_line(table, index + 1)}: time = {time_s[index + 1]:.9g} s comes {steps[index]:.6g} s after the"
        f" line before, the others {usual:.6g} s: samples must rise and be equally apart"
        for index in wrong
    ]
    refuse_lines(table.path, problems)
    return usual


def _refuse_part(
    table: RecordTable,
    time_s: FloatArray,
    step_s: float,
    during: NDArray[np.bool_],
    request: InversionRequest,
) -> None:
    """Refuse a record that does not span the motion, or has too few samples of it."""
    duration_s = request.motion.duration_s
    if not during.any() or time_s[np.argmax(during)] > 1.5 * step_s or time_s[-1] < duration_s - step_s:
        raise FileError(
            [
                f"{table.path}: goes from {time_s[0]:.6g} to {time_s[-1]:.6g} s: must span the motion, 0 to"
                f" {duration_s:g} s from its start"
            ]
        )
    if step_s * FEWEST_SAMPLES > duration_s:
        raise FileError(
            [
                f"{table.path}: samples are {step_s:.6g} s apart: must be {duration_s / FEWEST_SAMPLES:.6g} s"
                f" at most, {FEWEST_SAMPLES} during the motion"
            ]
        )


def _refuse_elsewhere(
    table: RecordTable, values: FloatArray, during: NDArray[np.bool_], request: InversionRequest
) -> None:
    """Refuse positions that do not begin where the motion does: another unit, another zero."""
    first, motion = int(np.argmax(during)), request.motion
    if abs(values[first] - motion.start) > _STARTS * abs(motion.travel):
        raise FileError(
            [
                f"{_line(table, first)}: position = {values[first]:.6g} when the motion begins: must be near"
                f" [move] start = {motion.start:g}, in the same unit"
            ]
        )


def _refuse_others(
    table: RecordTable,
    time_s: FloatArray,
    recorded: FloatArray,
    during: NDArray[np.bool_],
    request: InversionRequest,
) -> None:
    """Refuse a command that is not the file's: what it moved says nothing of these parameters."""
    command = request.found.command
    played = np.append(command.values, command.final_value)
    ticks = np.floor(time_s / command.tick_s + _JITTER).astype(np.int64)
    # A recorder may be a tick early or late.
    near = played[np.clip(ticks[:, np.newaxis] + np.arange(-1, 2), 0, played.size - 1)]
    tolerance = _ALIKE * float(np.ptp(played))
    off = (recorded < near.min(axis=1) - tolerance) | (recorded > near.max(axis=1) + tolerance)
    wrong = np.flatnonzero(off & during)
    if wrong.size:
        index = wrong[0]
        raise FileError(
            [
                f"{_line(table, index)}: command = {recorded[index]:.9g}: the parameters of"
                f" {request.file} give {near[index, 1]:.9g}: this is the record of another command"
            ]
        )
