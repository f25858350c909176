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
    **dict.fromkeys(("sec", "sec.", "secs", "second", "seconds", "sek", "sekunden"), "s"),
    **dict.fromkeys(("msec", "msecs", "millis", "millis()", "millisec", "milliseconds"), "ms"),
    **dict.fromkeys(("usec", "micros", "micros()", "microsec", "microseconds"), "us"),
    **dict.fromkeys(("\N{MICRO SIGN}s", "\N{GREEK SMALL LETTER MU}s"), "us"),
    **dict.fromkeys(("nsec", "nanos", "nanosec", "nanoseconds"), "ns"),
    **dict.fromkeys(("mins", "minute", "minutes", "minuten"), "min"),
    **dict.fromkeys(("hr", "hrs", "hour", "hours", "stunden"), "h"),
    **dict.fromkeys(("day", "days"), "d"),
    "degree": "deg",
    "degrees": "deg",
    "\N{DEGREE SIGN}": "deg",
}

TIME_UNITS: Mapping[str, float] = MappingProxyType(
    {**{unit: float(size) for unit, size in UNITS["time"].items()}, "ns": 1e-9, "h": 3600.0, "d": 86400.0}
)
"""Sizes of the units of time, in s: those of a machine file, and those of clocks."""

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
_IN = re.compile(r"(.+?)\s+in\s+(\S+)")
_SUFFIX = re.compile(r"(.+?)(?:_|\s+)([^_\s]+(?:_s2)?)")
_CAMEL = re.compile(r"(t|.*[a-z])([A-Z][a-z]*)")
_TIME_NAMES = re.compile(r"t|time.*|zeit.*|temps.*|tiempo.*|tempo.*", re.IGNORECASE)
_TIME_AND_WORD = re.compile(
    r"(?:t|time|timestamp|zeit|temps|tiempo|tempo)[_\s]+(?!stamp\b)(\S+)", re.IGNORECASE
)
_AMBIGUOUS = frozenset({"min", "h", "d", "in"})
"""Joined to a name that is none of a time these may be a minimum, a height, a difference, an input."""

_SWING_NAMES = re.compile(
    r"n|k|i|#|no\.?|index|(swing|cycle|peak|period)s?([ _]*(number|count|no\.?|#))?", re.IGNORECASE
)
_COUNT_NAMES = re.compile(
    r"(sample|tick|row|line|point|frame|scan|record|step|count|counter|number|nr\.?|idx|id)s?"
    r"([ _-]*(number|count|no\.?|nr\.?|id|index|idx|#))?",
    re.IGNORECASE,
)


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
    unknown : str or None
        What stands in the place of a unit, and is none that is known.
    """

    text: str
    name: str
    unit: str | None
    unknown: str | None = None

    @property
    def is_time(self) -> bool:
        """Whether the column looks like times: by its name or its unit."""
        return bool(_TIME_NAMES.fullmatch(self.name)) or self.unit in TIME_UNITS

    @property
    def last_word(self) -> str | None:
        """What is joined to the plain name of a time, and may be a unit: ``ticks`` of ``time_ticks``."""
        match = _TIME_AND_WORD.fullmatch(self.name) if self.unit is None else None
        return match[1] if match else None

    @property
    def is_swing(self) -> bool:
        """Whether the column looks like a count of swings."""
        return bool(_SWING_NAMES.fullmatch(self.name))

    @property
    def is_count(self) -> bool:
        """Whether the column looks like a count of samples or of swings, rather than a measurement."""
        return self.is_swing or bool(_COUNT_NAMES.fullmatch(self.name))


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
    Head(text='angle [deg]', name='angle', unit='deg', unknown=None)
    >>> [read_head(text).unit for text in ("load_m_s2", "time_s", "Weg in mm", "tMs", "millis", "phi")]
    ['m/s2', 's', 'mm', 'ms', 'ms', None]
    >>> read_head("time [fortnights]").unknown
    'fortnights'
    """
    plain = text.strip()
    if len(plain) > 1 and plain.lower() not in _AMBIGUOUS and unit_named(plain) in TIME_UNITS:
        return Head(text, plain, unit_named(plain))
    for pattern in (_BRACKETS, _SLASH, _IN, _SUFFIX, _CAMEL):
        match = pattern.fullmatch(plain)
        unit = unit_named(match[2]) if match else None
        if match and unit is not None and _is_meant(pattern, match[1], unit):
            return Head(text, match[1].strip(), unit)
    match = next(filter(None, (pattern.fullmatch(plain) for pattern in (_BRACKETS, _SLASH, _IN))), None)
    bracketed = _BRACKETS.fullmatch(plain)
    return Head(text, bracketed[1] if bracketed else plain, None, (match[2] or None) if match else None)


def _is_meant(pattern: re.Pattern[str], name: str, unit: str) -> bool:
    """Whether a unit is meant as one: ``deg/s`` is no time, ``xMin`` no minutes, but ``height_in`` inches."""
    if _TIME_NAMES.fullmatch(name) or pattern in {_BRACKETS, _IN}:
        return True
    if pattern is _CAMEL:
        return len(unit) > 1 and unit not in _AMBIGUOUS
    return unit not in (TIME_UNITS if pattern is _SLASH else _AMBIGUOUS & TIME_UNITS.keys())
