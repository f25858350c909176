"""Names and units in the heads of a record: ``angle [deg]``, ``time_s``, ``Weg in mm``.

Not for: the values below them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from swayless.machine.quantity import UNITS
from swayless.plant import STANDARD_GRAVITY_M_S2
from swayless.plant.identification import Quantity

_SPELLINGS = {
    "sec": "s",
    "seconds": "s",
    "second": "s",
    "degree": "deg",
    "degrees": "deg",
    "\N{DEGREE SIGN}": "deg",
}

TIME_UNITS: Mapping[str, float] = MappingProxyType(
    {unit: float(size) for unit, size in UNITS["time"].items()}
)
"""Sizes of the units of time, in s."""

VALUE_UNITS: Mapping[str, tuple[Quantity, float]] = MappingProxyType(
    {
        "rad": (Quantity.angle, 1.0),
        "mrad": (Quantity.angle, 1e-3),
        "deg": (Quantity.angle, math.pi / 180.0),
        **{unit: (Quantity.position, float(size)) for unit, size in UNITS["length"].items()},
        **{unit: (Quantity.acceleration, float(size)) for unit, size in UNITS["acceleration"].items()},
        "g": (Quantity.acceleration, STANDARD_GRAVITY_M_S2),
    }
)
"""What a unit measures, and its size in rad, m or m/s2."""

_BRACKETS = re.compile(r"(.*?)\s*[\[(]\s*(.*?)\s*[\])]\s*")
_SLASH = re.compile(r"(.+?)\s*/\s*(\S+)")
_SUFFIX = re.compile(r"(.+?)(?:_|\s+in\s+|\s+)([^_\s]+(?:_s2)?)")
_TIME_NAMES = re.compile(r"t|time.*|zeit.*|temps.*|tiempo.*|tempo.*|timestamp.*", re.IGNORECASE)
_SWING_NAMES = re.compile(
    r"n|k|i|#|no\.?|index|(swing|cycle|peak|period)s?([ _]*(number|count|no\.?|#))?", re.IGNORECASE
)
_COUNT_NAMES = re.compile(
    r"(sample|row|line|point|frame|scan|record|step|count|counter|number|nr\.?|idx|id)s?"
    r"([ _-]*(number|count|no\.?|nr\.?|id|index|idx|#))?",
    re.IGNORECASE,
)
_ROPE_NAMES = re.compile(r"(rope|cable|hoist|pendulum)([ _-]*(length|height))?|rope[ _-]*m", re.IGNORECASE)


class Head(NamedTuple):
    """Head of a column.

    Parameters
    ----------
    text : str
        As it stands in the file.
    name : str
        Without its unit.
    unit : str or None
        As in `TIME_UNITS` or `VALUE_UNITS`; None where there is none, or another one.
    """

    text: str
    name: str
    unit: str | None

    @property
    def is_time(self) -> bool:
        """Whether the column looks like times: by its name or its unit."""
        return bool(_TIME_NAMES.fullmatch(self.name)) or self.unit in TIME_UNITS

    @property
    def is_swing(self) -> bool:
        """Whether the column looks like a count of swings."""
        return bool(_SWING_NAMES.fullmatch(self.name))

    @property
    def is_count(self) -> bool:
        """Whether the column looks like a count of samples or of swings, rather than a measurement."""
        return self.is_swing or bool(_COUNT_NAMES.fullmatch(self.name))

    @property
    def is_rope(self) -> bool:
        """Whether the column looks like rope lengths."""
        return bool(_ROPE_NAMES.fullmatch(self.name))


def unit_named(text: str) -> str | None:
    """Give the unit that a text means; None if it is none of those known.

    Examples
    --------
    >>> unit_named("m/s^2"), unit_named("Degrees"), unit_named("furlong")
    ('m/s2', 'deg', None)
    """
    plain = text.strip().replace("^", "").replace("\N{SUPERSCRIPT TWO}", "2").replace("_", "/")
    for spelling in (plain, plain.lower()):
        unit = _SPELLINGS.get(spelling, spelling)
        if unit in TIME_UNITS or unit in VALUE_UNITS:
            return unit
    return None


def read_head(text: str) -> Head:
    """Take the unit off the head of a column.

    Examples
    --------
    >>> read_head("angle [deg]")
    Head(text='angle [deg]', name='angle', unit='deg')
    >>> [read_head(text).unit for text in ("load_m_s2", "time_s", "Weg in mm", "phi")]
    ['m/s2', 's', 'mm', None]
    """
    for pattern in (_BRACKETS, _SLASH, _SUFFIX):
        match = pattern.fullmatch(text.strip())
        unit = unit_named(match[2]) if match else None
        if match and unit is not None:
            return Head(text, match[1].strip(), unit)
    match = _BRACKETS.fullmatch(text.strip())
    return Head(text, match[1] if match else text.strip(), None)
