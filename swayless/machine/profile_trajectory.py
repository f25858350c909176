"""The trajectory of a profile file: a CSV file with one output a tick. Not for: following it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from swayless.design.optimal.energy import LARGEST_TRACKED_TICKS
from swayless.design.shaper import FloatArray
from swayless.errors import FileError
from swayless.machine.source import read_source

_MAX_BYTES = 1_000_000


def read_trajectory(path: Path) -> FloatArray:
    """Read the wanted outputs at ticks 1, 2, ...: the last column of each line; a head may come first.

    Parameters
    ----------
    path : Path
        A CSV file.

    Raises
    ------
    FileError
        If it cannot be read, is empty or too long, or a line does not end in a finite number.
    """
    lines = [line for line in read_source(path, max_bytes=_MAX_BYTES).splitlines() if line.strip()]
    values = [_last(line) for line in lines]
    headed = bool(values) and values[0] is None
    wrong = [
        number for number, value in enumerate(values, 1) if value is None and not (headed and number == 1)
    ]
    if wrong:
        text = lines[wrong[0] - 1][:60]
        raise FileError([f"{path}: line {wrong[0]}: {text!r}: its last column must be a finite number"])
    outputs = np.array(values[headed:], dtype=np.float64)
    if not 1 <= outputs.size <= LARGEST_TRACKED_TICKS:
        raise FileError([f"{path}: {outputs.size} outputs: must be 1 to {LARGEST_TRACKED_TICKS}, one a tick"])
    return outputs


def _last(line: str) -> float | None:
    """Give the number in the last column; None if it is none."""
    try:
        value = float(line.replace(";", ",").split(",")[-1])
    except ValueError:
        return None
    return value if np.isfinite(value) else None
