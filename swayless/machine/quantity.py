"""Quantities as people write them, ``"29 ft"`` or ``10`` or ``"5 %"``, turned into SI numbers exactly.

Not for: printing quantities, or checking that one makes sense for a machine.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import Literal, TypeAlias

from swayless.errors import PlantError
from swayless.machine.problems import RefusedError, shown

Dimension: TypeAlias = Literal[
    "length", "angle", "time", "speed", "turning speed", "acceleration", "frequency", "mass", "ratio"
]

_LENGTHS = {
    "m": Fraction(1),
    "cm": Fraction("0.01"),
    "mm": Fraction("0.001"),
    "in": Fraction("0.0254"),
    "ft": Fraction("0.3048"),
}

_ANGLES = {
    "rad": Fraction(1),
    "mrad": Fraction("0.001"),
    "deg": Fraction("3.14159265358979323846264338327950288") / 180,
}

UNITS: Mapping[Dimension, Mapping[str, Fraction]] = MappingProxyType(
    {
        "length": _LENGTHS,
        "angle": _ANGLES,
        "time": {
            "s": Fraction(1),
            "ms": Fraction("0.001"),
            "us": Fraction("0.000001"),
            "min": Fraction(60),
        },
        "speed": {
            f"{length}/{time}": factor / seconds
            for time, seconds in (("s", 1), ("min", 60))
            for length, factor in _LENGTHS.items()
        },
        "turning speed": {f"{angle}/s": factor for angle, factor in _ANGLES.items()},
        "acceleration": {f"{length}/s2": factor for length, factor in _LENGTHS.items()},
        "frequency": {
            "Hz": Fraction(1),
            "mHz": Fraction("0.001"),
            "kHz": Fraction(1000),
            "rpm": Fraction(1, 60),
        },
        "mass": {"kg": Fraction(1), "t": Fraction(1000), "lb": Fraction("0.45359237")},
        "ratio": {"%": Fraction("0.01")},
    }
)
"""Exact size of each unit in SI, by dimension (inch, foot and pound: international agreement of 1959).

The size of a degree is not rational: it has 35 digits, more than any double can tell from all of them.
"""

_MAX_TEXT_LENGTH = 64
_TEXT = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?)\s*([^0-9\s].*)?")


class QuantityError(RefusedError, PlantError):
    """A value is not a quantity of its dimension. `reason` is the message without the value."""

    def __init__(self, value: object, reason: str) -> None:
        super().__init__(reason)
        self.args = (f"{shown(value)} {reason}",)


def parse_quantity(value: object, dimension: Dimension) -> float:
    """Turn a number or a text with a unit into SI.

    Parameters
    ----------
    value : object
        A number, taken as SI, or a text such as ``"29 ft"``; a text without a unit is SI too. ``m/s^2`` and
        ``m/s2`` are the same unit.
    dimension : str
        What the value has to be, one of `UNITS`.

    Returns
    -------
    float
        The double nearest to the exact value in m, rad, s, m/s, rad/s, m/s2, Hz or kg, or the ratio.

    Raises
    ------
    QuantityError
        If the value is not a number or a number with a unit of this dimension, or is not finite.

    Examples
    --------
    >>> parse_quantity("29 ft", "length"), parse_quantity("5 %", "ratio"), parse_quantity(2, "time")
    (8.8392, 0.05, 2.0)
    >>> parse_quantity("180 deg", "angle")
    3.141592653589793
    >>> parse_quantity("10 kg", "time")
    Traceback (most recent call last):
    swayless.machine.quantity.QuantityError: "10 kg" is not a time: allowed units are s, ms, us, min
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise QuantityError(value, f"is not {_article(dimension)}: write a number or a text with a unit")
    try:
        number = _from_text(value, dimension) if isinstance(value, str) else float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise QuantityError(value, "is not a finite number")
    return number


def unit_of(value: object, dimension: Dimension) -> str:
    """Give the unit that a quantity, or the first of an array of them, is written in; the SI unit if in none.

    Examples
    --------
    >>> unit_of(["9 ft", "29 ft"], "length"), unit_of(4, "length"), unit_of("0.2", "frequency")
    ('ft', 'm', 'Hz')
    """
    first = value[0] if isinstance(value, list) and value else value
    match = _TEXT.fullmatch(first.strip()) if isinstance(first, str) else None
    unit = str(match[2]) if match else ""
    return unit if unit in UNITS[dimension] else next(iter(UNITS[dimension]))


def _from_text(text: str, dimension: Dimension) -> float:
    match = _TEXT.fullmatch(text.strip()) if len(text) <= _MAX_TEXT_LENGTH else None
    units = UNITS[dimension]
    unit = ((match and match[2]) or "").replace("^", "")
    if match is None or (unit and unit not in units):
        raise QuantityError(text, f"is not {_article(dimension)}: allowed units are {', '.join(units)}")
    return float(Fraction(match[1]) * units.get(unit, 1))


def _article(dimension: Dimension) -> str:
    return f"an {dimension}" if dimension[0] == "a" else f"a {dimension}"
