"""The machine file of an adaptive shaper: one with a section ``[adaptive]``, and the same as stored in JSON.

Not for: machines whose frequency is designed for (`swayless.machine.machine_file`).
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import swayless
from swayless.controller.adaptive import AdaptiveSettings
from swayless.controller.adaptive.settings import (
    DELAYS_PER_WINDOW,
    LARGEST_PEAK_FACTOR,
    LONGEST_TICKS,
)
from swayless.controller.number import number_type
from swayless.errors import ControllerError, FileError
from swayless.machine.checks import choice, machine_name, number, quantity
from swayless.machine.controller_section import TICK
from swayless.machine.plant_section import DAMPING, FREQUENCY
from swayless.machine.problems import Place, Report, Table
from swayless.machine.source import read_source
from swayless.machine.toml_source import MAX_BYTES, read_toml
from swayless.plant import Mode

SCHEMA = "swayless.adaptive/1"
_TIME, _POSITIVE_TIME = quantity("time", 0.0, 1000.0), quantity("time", 1e-6, 1000.0)
_SIZE = number(1e-6, 1e6)
_SECTIONS = ("adaptive", "controller")


@dataclass(frozen=True)
class AdaptiveMachine:
    """A machine with an adaptive shaper.

    Parameters
    ----------
    name : str
        Prefix of every generated symbol.
    source : str
        Base name of the machine file.
    generator : str
        Name and version of what read it.
    settings : AdaptiveSettings
        Every constant of the block.
    """

    name: str
    source: str
    generator: str
    settings: AdaptiveSettings


def is_adaptive(path: Path) -> bool:
    """Whether a TOML file has a section ``[adaptive]``; whatever else is wrong is for others to report."""
    try:
        return "adaptive" in read_toml(path)
    except FileError:
        return False


def _stored(path: Path) -> object:
    """Read what `adaptive_text` made."""
    text = read_source(path, max_bytes=MAX_BYTES)
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileError([f"{path}: not valid JSON: {error}"]) from error


def load_adaptive(path: Path) -> AdaptiveMachine:
    """Load the machine file of an adaptive shaper, or what `adaptive_text` made of one.

    Parameters
    ----------
    path : Path
        TOML, or JSON if its name ends in ``.json``.

    Raises
    ------
    FileError
        With every problem found: file, key, value and what is allowed.
    """
    report = Report(str(path))
    document = _stored(path) if path.suffix == ".json" else read_toml(path)
    root = Table(document if isinstance(document, dict) else {}, report, "")
    root.take("schema", choice("schema", [SCHEMA]), SCHEMA)
    name = root.need("name", machine_name)
    source = root.take("source", _text, path.name)
    generator = root.take("generator", _text, f"swayless {swayless.__version__}")
    tables = {key: Table(root.need(key, _section) or {}, report, f"[{key}] ") for key in _SECTIONS}
    root.close()
    settings = _read_settings(tables["adaptive"], tables["controller"])
    if report.problems or name is None or source is None or generator is None or settings is None:
        raise FileError(report.problems)
    return AdaptiveMachine(name, source, generator, settings)


def _text(value: object, place: Place) -> str | None:
    """Take a text."""
    if isinstance(value, str):
        return value
    place.wrong(value, "must be a text")
    return None


def _section(value: object, place: Place) -> dict[str, object] | None:
    if isinstance(value, dict):
        return value
    place.wrong(value, "must be a section")
    return None


def _read_settings(table: Table, controller: Table) -> AdaptiveSettings | None:
    # A value that is missing or wrong is None here, and a problem in the report.
    tick_s: Any = controller.need("tick", TICK)
    kind: Any = controller.take("number", choice("number type", ("double", "float")), "double")
    delay_s: Any = table.need("delay", _POSITIVE_TIME)
    cycle_s: Any = table.need("cycle", _POSITIVE_TIME)
    lag_s: Any = table.take("lag", _TIME, 0.0)
    values: dict[str, Any] = {
        "max_command": table.need("max_command", _SIZE),
        "vibration_scale": table.need("vibration_scale", _SIZE),
        "max_reference": table.take("max_reference", number(1e-6, LARGEST_PEAK_FACTOR * 1e6), None),
        "dead_zone_ratio": table.take("dead_zone", number(0.0, 1.0), 0.001),
    }
    frequency_hz: Any = table.take("frequency", FREQUENCY, None)
    damping_ratio: Any = table.take("damping_ratio", DAMPING, None)
    if damping_ratio is not None and "frequency" not in table.raw:
        table.place("damping_ratio").wrong(damping_ratio, "needs frequency beside it")
    table.close()
    controller.close()
    if table.report.problems:
        return None
    values["mode"] = None if frequency_hz is None else Mode(frequency_hz, damping_ratio or 0.0)
    values["delay_ticks"] = _delay_ticks(table.place("delay"), delay_s, tick_s)
    values["cycle_ticks"] = _in_range(table.place("cycle"), cycle_s, tick_s, round(cycle_s / tick_s), 1)
    values["lag_ticks"] = _in_range(table.place("lag"), lag_s, tick_s, math.ceil(lag_s / tick_s - 1e-9), 0)
    if table.report.problems:
        return None
    try:
        return AdaptiveSettings(tick_s=tick_s, **values, number=number_type(kind))
    except ControllerError as error:
        Place(table.report, "").problem(f"{table.prefix}{error}")
        return None


def _delay_ticks(place: Place, delay_s: float, tick_s: float) -> int:
    """Give a delay in ticks; one that is not whole is a problem."""
    ticks = round(delay_s / tick_s)
    if abs(delay_s - ticks * tick_s) > 1e-9 * delay_s:
        place.wrong(delay_s, f"must be a whole number of ticks of {tick_s:g} s")
        return ticks
    return _in_range(place, delay_s, tick_s, ticks, 1, LONGEST_TICKS // DELAYS_PER_WINDOW)


def _in_range(
    place: Place, time_s: float, tick_s: float, ticks: int, least: int, most: int = LONGEST_TICKS
) -> int:
    """Give a number of ticks back; one out of range is a problem."""
    if not least <= ticks <= most:
        place.wrong(time_s, f"must be from {least} to {most} ticks of {tick_s:g} s")
    return ticks


def adaptive_text(machine: AdaptiveMachine) -> str:
    """Store a machine in JSON, in SI, as `load_adaptive` reads it.

    Parameters
    ----------
    machine : AdaptiveMachine
        The machine.
    """
    settings = machine.settings
    adaptive: dict[str, object] = {
        "delay": settings.delay_ticks * settings.tick_s,
        "cycle": settings.cycle_ticks * settings.tick_s,
        "lag": settings.lag_ticks * settings.tick_s,
        "max_command": settings.max_command,
        "vibration_scale": settings.vibration_scale,
        "dead_zone": settings.dead_zone_ratio,
    }
    if settings.max_reference is not None:
        adaptive["max_reference"] = settings.max_reference
    if settings.mode is not None:
        adaptive["frequency"] = settings.mode.frequency_hz
        adaptive["damping_ratio"] = settings.mode.damping_ratio
    document = {
        "schema": SCHEMA,
        "name": machine.name,
        "source": machine.source,
        "generator": machine.generator,
        "adaptive": adaptive,
        "controller": {"tick": settings.tick_s, "number": settings.number.name},
    }
    return json.dumps(document, indent=2) + "\n"
