"""What `swayless identify` is asked, checked, and what it finds: swings, peaks and stopwatch readings.

Not for: printing it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np

from swayless.cli.option_table import option_table, refuse
from swayless.cli.options import OptionError
from swayless.errors import FileError, PlantError
from swayless.machine.checks import quantity
from swayless.machine.identified_record import Reading, ReadRecord, read_peaks, read_swings
from swayless.machine.identified_table import load_table
from swayless.machine.identified_units import TIME_UNITS, VALUE_UNITS, unit_named
from swayless.machine.plant_section import LENGTH
from swayless.machine.problems import shown
from swayless.plant.identification import (
    Decrement,
    IdentifiedMode,
    IdentifiedSwing,
    Quantity,
    RopeOffset,
    decrement,
    fit_rope_offset,
    identify_peaks,
    identify_periods,
    identify_swing,
    mode_of_period,
)

PERIOD = quantity("time", 1e-4, 1e5)
RATE = quantity("frequency", 1e-3, 1e9)
_SEVERAL = re.compile(r"[0-9]\s*(?:;|,\s|,.*[.,])|\..*,")
_DECIMAL_COMMA = re.compile(r"(?<=[0-9]),(?=[0-9])")
_ANGLE = re.compile(r"([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)\s*(\S+)")


@dataclass(frozen=True)
class Asked:
    """The options of the command, as the shell gives them; `swayless identify --help` says what they mean."""

    records: tuple[Path, ...] = ()
    periods: tuple[str, ...] = ()
    swings: int = 1
    amplitude: str | None = None
    peaks: bool = False
    both_sides: bool = False
    rate: str | None = None
    time: str | None = None
    column: str | None = None
    rope_column: str | None = None
    unit: str | None = None
    rope_length: tuple[str, ...] = ()
    start: str | None = None
    end: str | None = None
    pendulum: bool | None = None
    modes: int | None = None


@dataclass(frozen=True, eq=False)
class Found:
    """What one record tells.

    Parameters
    ----------
    source : str
        Name of the record.
    modes : tuple of IdentifiedMode
    rope_length_m : float or None
        Rope that the crane showed.
    swing : IdentifiedSwing or None
        Of a sampled swing.
    read : ReadRecord or None
        Of a sampled swing.
    decrement : Decrement or None
        Of peak heights.
    """

    source: str
    modes: tuple[IdentifiedMode, ...]
    rope_length_m: float | None = None
    swing: IdentifiedSwing | None = None
    read: ReadRecord | None = None
    decrement: Decrement | None = None


@dataclass(frozen=True, eq=False)
class AllFound:
    """What all records tell.

    Parameters
    ----------
    records : tuple of Found
        At least one.
    offset : RopeOffset or None
        From several ropes.
    is_pendulum : bool
        Whether a load on a rope was measured, as far as is known.
    """

    records: tuple[Found, ...]
    offset: RopeOffset | None = None
    is_pendulum: bool = False


def identified(asked: Asked, *, plot: Path | None = None) -> AllFound:
    """Find what was asked for.

    Parameters
    ----------
    asked : Asked
    plot : Path or None
        A figure is wanted, which shows one sampled swing.

    Raises
    ------
    OptionError
        If options are wrong or do not go together.
    FileError
        If a record cannot be read, or shows no swing: with the line where there is one.
    """
    asked = _with_points(asked)
    problems = _conflicts(asked, plot)
    options = option_table(
        {
            "periods": list(asked.periods) or None,
            "rope_length": list(asked.rope_length) or None,
            "rate": asked.rate,
            "start": asked.start,
            "end": asked.end,
        },
        problems,
    )
    ropes_m = options.take("rope_length", _each(LENGTH), ())
    periods_s = options.take("periods", _each(PERIOD), ())
    rate_hz = options.take("rate", RATE, None)
    start_s, end_s = (options.take(key, quantity("time", -1e9, 1e9), None) for key in ("start", "end"))
    amplitude_rad = _angle(asked.amplitude, problems)
    refuse(problems)
    reading = Reading(asked.time, asked.column, asked.rope_column, asked.unit, rate_hz, start_s, end_s)
    stopwatch = _stopwatch(asked, periods_s or (), amplitude_rad, one_each=len(ropes_m or ()) > 1)
    if asked.peaks:
        found = [_peaks(path, asked, reading, stopwatch) for path in asked.records]
    elif asked.records:
        found = [each for path in asked.records for each in _swings(path, reading, asked)]
    else:
        found = [Found("stopwatch", (mode,)) for mode in stopwatch]
    return _with_ropes(found, ropes_m or (), asked)


def _each(check: Callable[..., float | None]) -> Callable[..., tuple[float, ...] | None]:
    """Check for some values, as many as there are."""

    def checked(value: object, place: Any) -> tuple[float, ...] | None:
        items = value if isinstance(value, list) else [value]
        numbers = [check(item, place) for item in items]
        good = tuple(number for number in numbers if number is not None)
        return good if len(good) == len(numbers) else None

    return checked


def _with_points(asked: Asked) -> Asked:
    """Read decimal commas; several values in one, which commas may also mean, are refused."""
    changed: dict[str, Any] = {}
    for key in ("periods", "rope_length", "amplitude", "rate", "start", "end"):
        given = getattr(asked, key)
        texts = given if isinstance(given, tuple) else (given,)
        several = [text for text in texts if text and _SEVERAL.search(text)]
        if several:
            option = f"--{key.replace('_', '-')}"
            raise OptionError(
                [f"{option} = {shown(text)}: must be one value: blanks separate several" for text in several]
            )
        pointed = tuple(text and _DECIMAL_COMMA.sub(".", text) for text in texts)
        changed[key] = pointed if isinstance(given, tuple) else pointed[0]
    return replace(asked, **changed)


def _conflicts(asked: Asked, plot: Path | None) -> list[str]:
    """Say which options do not go together."""
    rules = {
        "give a record, or --periods": not asked.records and not asked.periods,
        "--periods beside records: only with --peaks over counts of swings": bool(asked.records)
        and bool(asked.periods)
        and not asked.peaks,
        "--peaks needs a record": asked.peaks and not asked.records,
        "--both-sides is for --peaks": asked.both_sides and not asked.peaks,
        "--amplitude and --swings are for --periods": not asked.periods
        and (asked.amplitude is not None or asked.swings > 1),
        "--plot shows one sampled swing": plot is not None
        and (len(asked.records) != 1 or asked.peaks or asked.rope_column is not None),
        "--rope-length and --rope-column: only one of them": bool(asked.rope_length)
        and asked.rope_column is not None,
        "--rate and --time: only one of them": asked.rate is not None and asked.time is not None,
    }
    return [problem for problem, broken in rules.items() if broken]


def _angle(text: str | None, problems: list[str]) -> float:
    """Read an angle with its unit."""
    if text is None:
        return 0.0
    match = _ANGLE.fullmatch(text.strip())
    unit = unit_named(match[2]) if match else None
    if match is None or unit is None or VALUE_UNITS.get(unit, (None, 0.0))[0] is not Quantity.angle:
        problems.append(f"--amplitude = {text!r}: must be an angle with its unit: '10 deg' or '0.17 rad'")
        return 0.0
    angle = float(match[1]) * VALUE_UNITS[unit][1]
    if not 0.0 <= angle < math.pi / 2.0:
        problems.append(f"--amplitude = {text!r}: must be at least 0 and below 90 deg")
    return angle


def _stopwatch(
    asked: Asked, periods_s: tuple[float, ...], amplitude_rad: float, *, one_each: bool
) -> list[IdentifiedMode]:
    """Give the mode of all readings together, or of each one where each has its rope."""
    if not periods_s:
        return []
    groups = [np.array([period]) for period in periods_s] if one_each else [np.array(periods_s)]
    resolution_s = min(_resolution_s(text) for text in asked.periods)
    return [
        identify_periods(group, swings=asked.swings, resolution_s=resolution_s, amplitude_rad=amplitude_rad)
        for group in groups
    ]


def _resolution_s(text: str) -> float:
    """Give the size of the last digit of a time, in s."""
    number = text.strip().rstrip("abcdefghijklmnopqrstuvwxyz ")
    unit_s = TIME_UNITS[text.strip()[len(number) :].strip() or "s"]
    return unit_s * 10.0 ** int(Decimal(number).as_tuple().exponent)


def _swings(path: Path, reading: Reading, asked: Asked) -> Iterator[Found]:
    """Identify the swings of one file."""
    for read in read_swings(load_table(path), reading):
        all_high = bool((read.record.value > 0.0).all())
        with _named(path, hint="; heights of peaks need --peaks" if all_high else ""):
            swing = identify_swing(read.record, pendulum=_pendulum(asked, read), modes=asked.modes)
        yield Found(str(path), swing.modes, read.rope_length_m, swing, read)


def _pendulum(asked: Asked, read: ReadRecord) -> bool | None:
    """Say whether a load on a rope swings: it does where its rope is given."""
    has_rope = bool(asked.rope_length) or read.rope_length_m is not None
    if asked.pendulum is None and has_rope and read.record.quantity is not Quantity.value:
        return True
    return asked.pendulum


def _peaks(path: Path, asked: Asked, reading: Reading, stopwatch: list[IdentifiedMode]) -> Found:
    """Identify the peaks of one file; counts of swings need a period from elsewhere."""
    at, height, are_times = read_peaks(load_table(path), reading)
    if are_times and not stopwatch:
        with _named(path):
            mode, found = identify_peaks(at, height, peaks_per_swing=2 if asked.both_sides else 1)
        return Found(str(path), (mode,), decrement=found)
    if are_times:
        raise OptionError([f"{path}: heights over times show the period: leave --periods out"])
    if not stopwatch:
        raise OptionError([f"{path}: heights over counts of swings do not show the period: give --periods"])
    with _named(path):
        found = decrement(at - at[0], height)
    watch = stopwatch[0]
    period_s = watch.mode.damped_period_s
    mode = mode_of_period(period_s, period_s * watch.frequency_hz_std / watch.frequency_hz, found)
    return Found(str(path), (mode,), decrement=found)


@contextmanager
def _named(path: Path, hint: str = "") -> Iterator[None]:
    """Name the file in what the record refuses."""
    try:
        yield
    except PlantError as error:
        raise FileError([f"{path}: {error}{hint}"]) from error


def _with_ropes(found: list[Found], ropes_m: tuple[float, ...], asked: Asked) -> AllFound:
    """Put the ropes beside the records, and fit the offset where there are several."""
    if ropes_m and len(ropes_m) != len(found):
        raise OptionError([f"--rope-length: {len(ropes_m)} given, for {len(found)} records: one for each"])
    if ropes_m:
        found = [replace(each, rope_length_m=rope) for each, rope in zip(found, ropes_m, strict=True)]
    lengths = [each.rope_length_m for each in found if each.rope_length_m is not None]
    bent = any(each.swing is not None and each.swing.fit.model.waveform is not None for each in found)
    several = len(lengths) == len(found) and len(set(lengths)) > 1
    offset = fit_rope_offset(np.array(lengths), [each.modes[0] for each in found]) if several else None
    if len(found) > 1 and offset is None:
        raise OptionError(["several records: give --rope-length for each, two different ones at least"])
    return AllFound(tuple(found), offset, bool(lengths) or bent or bool(asked.pendulum))
