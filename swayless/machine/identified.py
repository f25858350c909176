"""Writing what was identified into a machine file: the band that a design has to hold, and the damping.

A file that is there keeps its comments, its order and everything else; another one is written from scratch.

Not for: identifying.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from pathlib import Path
from typing import Any

from swayless.design.robust.demand import LARGEST_DAMPING_RATIO
from swayless.errors import FileError
from swayless.machine.identified_ranges import (
    LAST_DIGIT,
    Exchange,
    exchanged_frequencies,
    exchanged_ropes,
    range_ends,
    shown_value,
    toml_value,
)
from swayless.machine.identified_text import replaced, written
from swayless.machine.names import name_problem
from swayless.machine.plant_section import PlantKind
from swayless.machine.source import read_source
from swayless.machine.toml_source import MAX_BYTES
from swayless.machine.writing import write_text_atomically
from swayless.plant import Band

_TICKS_PER_PERIOD = 50

_KINDS: tuple[PlantKind, ...] = ("crane", "arm")


@dataclass(frozen=True)
class IdentifiedPlant:
    """What was identified, as a machine file needs it.

    Parameters
    ----------
    kind : {"crane", "arm"}
        Section of a new file.
    bands : tuple of Band
        Frequencies that a design has to hold, a band for each mode; the first stands in the plant's section.
    damping_ratio : float or None
        Of the first mode; None where it is not known, and a file keeps its own.
    damping_range : tuple of two floats
        Lowest and highest damping ratio that a row has to hold.
    rope_offset_m : tuple of two floats or None
        By how much the pendulum is longer than the rope that the crane shows, from and to; None where the
        rope was not known.
    """

    kind: PlantKind
    bands: tuple[Band, ...]
    damping_ratio: float | None
    damping_range: tuple[float, float]
    rope_offset_m: tuple[float, float] | None = None


def write_identified(path: Path, plant: IdentifiedPlant) -> str:
    """Write what was identified into a machine file, in one step.

    Parameters
    ----------
    path : Path
        A machine file with its frequency or its rope length, or a name for a new one.
    plant : IdentifiedPlant

    Returns
    -------
    str
        What was written, in a few words.

    Raises
    ------
    FileError
        If the file cannot be read or written, or does not hold one frequency range or rope range.
    """
    if not path.exists():
        write_text_atomically(path, new_machine_text(path.stem, plant))
        return "written; edit max_speed and tick, then build it"
    text, said = updated_machine_text(path, read_source(path, max_bytes=MAX_BYTES), plant)
    write_text_atomically(path, text)
    return said


def updated_machine_text(path: Path, text: str, plant: IdentifiedPlant) -> tuple[str, str]:
    """Put what was identified into the text of a machine file; give the text, and what was exchanged.

    Parameters
    ----------
    path : Path
        For messages.
    text : str
        The file as it is.
    plant : IdentifiedPlant

    Raises
    ------
    FileError
        If the text is no machine file with one frequency range or rope range in a section of its own; if it
        has a range of ropes and nobody knows which of them was measured, or one that was corrected already;
        if it has a range of frequencies and what was identified lies outside of it.
    """
    try:
        document = tomllib.loads(text)
    except ValueError as error:
        raise FileError([f"{path}: not valid TOML: {error}"]) from error
    section, key = _place(path, document)
    old: dict[str, Any] = document[section]
    place = f"{path}: [{section}]: {key} = {shown_value(old[key])}"
    plain = text.replace("\r\n", "\n")
    value, comment = written(plain, section, key)
    exchange = (
        exchanged_frequencies(place, old[key], plant.bands[0])
        if key == "frequency"
        else exchanged_ropes(place, old[key], plant.bands[0], plant.rope_offset_m, comment)
    )
    values: dict[str, str | tuple[str, ...]] = {key: exchange.ends or value}
    if plant.damping_ratio is not None:
        values["damping_ratio"] = f"{plant.damping_ratio:.4g}"
    new = replaced(plain, section, values, {} if exchange.note is None else {key: exchange.note})
    expected = old | {name: tomllib.loads(f"x = {toml_value(to)}")["x"] for name, to in values.items() if to}
    if tomllib.loads(new) != document | {section: expected}:
        raise FileError(
            [f"{path}: [{section}]: is not written as a section with its keys below: write it by hand"]
        )
    said = f"[{section}] {_said(old, key, values, exchange)}{_rope_input(document, plant, exchange)}"
    return new.replace("\n", "\r\n") if "\r\n" in text else new, said


def _place(path: Path, document: dict[str, Any]) -> tuple[PlantKind, str]:
    """Find the section of the plant, and the key of its range."""
    section = next((kind for kind in _KINDS if isinstance(document.get(kind), dict)), None)
    if section is None:
        raise FileError([f"{path}: has neither [crane] nor [arm], where the frequency stands"])
    several = [key for key in ("sling_length", "position") if key in document[section]]
    key = "rope_length" if "rope_length" in document[section] else "frequency"
    if several or key not in document[section]:
        reason = f"{several[0]} makes several modes of it" if several else f"there is no {key}"
        raise FileError([f"{path}: [{section}]: {reason}: write what was identified by hand"])
    return section, key


def _rope_input(document: dict[str, Any], plant: IdentifiedPlant, exchange: Exchange) -> str:
    """Say what a block that is told its rope has to be told from now on."""
    controller, bank = (
        part if isinstance(part := document.get(name), dict) else {} for name in ("controller", "bank")
    )
    is_told = controller.get("law", "fixed") != "fixed" or bank.get("selection") == "rope_length"
    if exchange.note is None or plant.rope_offset_m is None or not is_told:
        return ""
    return (
        "; the block is told its rope, and has to be told the pendulum's length from now on: what the crane"
        f" shows and {sum(plant.rope_offset_m) / 2.0:.4g} m"
    )


def _said(
    old: dict[str, Any], key: str, values: Mapping[str, str | tuple[str, ...]], exchange: Exchange
) -> str:
    """Say what was exchanged, why, and what stood there."""
    said = []
    for name, value in values.items():
        was = f"was {shown_value(old.get(name))}" if name != key or exchange.ends else "kept"
        said.append(f"{name} = {toml_value(value)} ({was}{f'; {exchange.why}' if name == key else ''})")
    return ", ".join(said)


def new_machine_text(name: str, plant: IdentifiedPlant) -> str:
    """Give a machine file that holds what was identified, with the rest to be edited.

    Parameters
    ----------
    name : str
        Prefix of generated symbols, if it can be one.
    plant : IdentifiedPlant

    Examples
    --------
    >>> plant = IdentifiedPlant("crane", (Band(0.1981, 0.2019),), 0.004, (0.003, 0.005))
    >>> new_machine_text("yard", plant).splitlines()[3:6:2]
    ['name = "yard"', '[crane]']
    """
    symbol = name.lower().replace("-", "_")
    symbol = "machine" if name_problem(symbol) else symbol
    ranges = [_frequency_text(band) for band in plant.bands]
    rows = [_frequency_text(_wider(band)) for band in plant.bands]
    held = f"frequency = {rows[0]}" if len(rows) == 1 else f"bands = [{', '.join(rows)}]"
    damping = [min(LARGEST_DAMPING_RATIO, ratio) for ratio in plant.damping_range]
    return "\n".join(
        [
            "# What swayless identified: ranges are two standard deviations to either side of the estimate.",
            "# max_speed and tick are guesses: edit them, and add what else there is to say of the machine.",
            "",
            f'name = "{symbol}"',
            "",
            f"[{plant.kind}]",
            f"frequency = {ranges[0]}        # Hz, of small swings",
            f"damping_ratio = {plant.damping_ratio or 0.0:.4g}",
            "max_speed = 0.5                     # m/s",
            "",
            "[controller]",
            f'tick = "{_tick(plant.bands)}"',
            "",
            "[[row]]",
            'name = "identified"',
            'family = "si"',
            held,
            f"damping_ratio = {_damping_text(damping)}",
            'tolerance = "5 %"',
            "",
        ]
    )


def _frequency_text(band: Band) -> str:
    return toml_value(range_ends("frequency", 0.0, band.low_hz, band.high_hz))


def _wider(band: Band) -> Band:
    """Widen a band by a last digit or more, so that no rounding of a design leaves the plant's edge out."""
    return Band(band.low_hz * (1.0 - LAST_DIGIT), band.high_hz * (1.0 + LAST_DIGIT))


def _damping_text(ratios: Sequence[float]) -> str:
    """Write a range of damping ratios, rounded outward, or its one value."""
    low, high = (
        Context(prec=4, rounding=rounding).create_decimal(repr(ratio)).normalize()
        for ratio, rounding in zip(ratios, (ROUND_FLOOR, ROUND_CEILING), strict=True)
    )
    return f"[{low:f}, {high:f}]" if low < high else f"{low:f}"


def _tick(bands: Sequence[Band]) -> str:
    """Give a usual tick: 10 ms, or less for fast modes."""
    finest_ms = 1e3 / (_TICKS_PER_PERIOD * max(band.high_hz for band in bands))
    decade = 10.0 ** math.floor(math.log10(finest_ms))
    usual = max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= finest_ms)
    return f"{min(10.0, usual):g} ms"
