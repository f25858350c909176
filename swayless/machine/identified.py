"""Writing what was identified into a machine file: the band that a design has to hold, and the damping.

A file that is there keeps its comments, its order and everything else; another one is written from scratch.

Not for: identifying.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

from swayless.design.robust.demand import LARGEST_DAMPING_RATIO
from swayless.errors import FileError
from swayless.machine.identified_text import replaced
from swayless.machine.machine_file import MAX_BYTES
from swayless.machine.names import name_problem
from swayless.machine.plant_section import PlantKind
from swayless.machine.quantity import UNITS, Dimension, QuantityError, parse_quantity, unit_of
from swayless.machine.source import read_source
from swayless.machine.writing import write_text_atomically
from swayless.plant import Band, pendulum_rope_length_m

_DIGITS = 6
_LAST_DIGIT = 10.0 ** (1 - _DIGITS)
"""The largest that a last digit can be, relative to the number."""

_TICKS_PER_PERIOD = 50

_ONE_ROPE = 0.1
"""A range of ropes that is narrower, relatively, is one rope and its uncertainty."""


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
        If the text is no machine file with one frequency range or rope range in a section of its own, or if
        it has a range of ropes and nobody knows which of them was measured.
    """
    try:
        document = tomllib.loads(text)
    except ValueError as error:
        raise FileError([f"{path}: not valid TOML: {error}"]) from error
    section = next((kind for kind in ("crane", "arm") if isinstance(document.get(kind), dict)), None)
    if section is None:
        raise FileError([f"{path}: has neither [crane] nor [arm], where the frequency stands"])
    old: dict[str, Any] = document[section]
    several = [key for key in ("sling_length", "position") if key in old]
    key = "rope_length" if "rope_length" in old else "frequency"
    if several or key not in old:
        reason = f"{several[0]} makes several modes of it" if several else f"there is no {key}"
        raise FileError([f"{path}: [{section}]: {reason}: write what was identified by hand"])
    place = f"{path}: [{section}]: {key} = {_shown(old[key])}"
    length = _lengths(place, old[key], plant) if key == "rope_length" else None
    values = {key: _range_text(key, old[key], plant.bands[0]) if length is None else length}
    if plant.damping_ratio is not None:
        values["damping_ratio"] = f"{plant.damping_ratio:.4g}"
    new = replaced(text.replace("\r\n", "\n"), section, values)
    expected = old | {name: tomllib.loads(f"x = {value}")["x"] for name, value in values.items()}
    if tomllib.loads(new) != document | {section: expected}:
        raise FileError(
            [f"{path}: [{section}]: is not written as a section with its keys below: write it by hand"]
        )
    why = {key: _reason(plant) if length is not None else "two standard deviations to either side"}
    said = ", ".join(
        f"{name} = {value} (was {'; '.join([_shown(old.get(name)), *([why[name]] if name in why else [])])})"
        for name, value in values.items()
    )
    return new.replace("\n", "\r\n") if "\r\n" in text else new, f"[{section}] {said}"


def _reason(plant: IdentifiedPlant) -> str:
    low_m, high_m = plant.rope_offset_m or (0.0, 0.0)
    return f"the pendulum is {low_m:+.4g} to {high_m:+.4g} m longer than shown"


def _lengths(place: str, old: object, plant: IdentifiedPlant) -> str | None:
    """Correct the ropes of a file by the offset; None for a single one, measured without its length."""
    ends = old if isinstance(old, list) else [old]
    try:
        lengths_m = [parse_quantity(end, "length") for end in ends]
    except QuantityError as error:
        raise FileError([f"{place}: {error}"]) from error
    if plant.rope_offset_m is None:
        if max(lengths_m) - min(lengths_m) > _ONE_ROPE * max(lengths_m):
            raise FileError(
                [
                    f"{place}: is a range of ropes, and the swing tells of one: give --rope-length, what the"
                    " crane showed, and the range is kept and corrected by the difference"
                ]
            )
        return None
    low_m, high_m = min(lengths_m) + plant.rope_offset_m[0], max(lengths_m) + plant.rope_offset_m[1]
    if low_m <= 0.0:
        raise FileError([f"{place}: corrected, its shortest would be {low_m:.4g} m: must be > 0"])
    return _ends_text("length", old, low_m, high_m)


def _shown(value: object) -> str:
    """Write a value as its file does, or that it was not there."""
    if value is None:
        return "not given"
    if isinstance(value, list):
        return f"[{', '.join(_shown(item) for item in value)}]"
    return f'"{value}"' if isinstance(value, str) else f"{value}"


def _range_text(key: str, old: object, band: Band) -> str:
    """Write a band as rope lengths or frequencies, in the unit of the file, rounded outward."""
    dimension: Dimension = "length" if key == "rope_length" else "frequency"
    low, high = band.low_hz, band.high_hz
    if dimension == "length":
        low, high = pendulum_rope_length_m(high), pendulum_rope_length_m(low)
    return _ends_text(dimension, old, low, high)


def _ends_text(dimension: Dimension, old: object, low: float, high: float) -> str:
    """Write a range in the unit of the file, rounded outward."""
    unit = unit_of(old, dimension)
    first = old[0] if isinstance(old, list) and old else old
    ends = (_rounded(low, dimension, unit, ROUND_FLOOR), _rounded(high, dimension, unit, ROUND_CEILING))
    texts = [f'"{end} {unit}"' for end in ends] if isinstance(first, str) else [str(end) for end in ends]
    return f"[{', '.join(texts)}]"


def _rounded(value: float, dimension: Dimension, unit: str, rounding: str) -> str:
    size = UNITS[dimension][unit]
    exact = Fraction(value) / size
    context = Context(prec=_DIGITS, rounding=rounding)
    return f"{context.divide(Decimal(exact.numerator), Decimal(exact.denominator)).normalize():f}"


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
    ranges = [_range_text("frequency", 0.0, band) for band in plant.bands]
    rows = [_range_text("frequency", 0.0, _wider(band)) for band in plant.bands]
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


def _wider(band: Band) -> Band:
    """Widen a band by a last digit or more, so that no rounding of a design leaves the plant's edge out."""
    return Band(band.low_hz * (1.0 - _LAST_DIGIT), band.high_hz * (1.0 + _LAST_DIGIT))


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
