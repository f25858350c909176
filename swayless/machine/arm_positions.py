"""How the frequency of an arm depends on its position: keys of the ``[arm]`` section of a machine file.

Not for: arms of one frequency, nor for what a controller makes of a position (`swayless.controller.spacing`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np

from swayless.machine.checks import quantity, some
from swayless.machine.problems import Check, Table
from swayless.machine.quantity import UNITS

PositionUnit: TypeAlias = Literal["m", "rad"]

MOST_POSITIONS = 256
"""Places at which a file gives the frequency of an arm."""

POSITION_KEYS = ("position", "position_speed")

PLACE: Mapping[PositionUnit, Check[float]] = {
    "m": quantity("length", -1e4, 1e4),
    "rad": quantity("angle", -1e3, 1e3),
}
SPEED: Mapping[PositionUnit, Check[float]] = {
    "m": quantity("speed", 1e-4, 1e2),
    "rad": quantity("turning speed", 1e-4, 1e2),
}


@dataclass(frozen=True)
class ArmPositions:
    """Frequencies of an arm at some of its positions; straight between.

    Parameters
    ----------
    unit : "m" or "rad"
        Of the positions.
    places : tuple of float
        At least two, increasing.
    frequency_hz : tuple of float
        Undamped natural frequency at each, > 0, not all the same.
    speed_per_s : float or None
        Fastest that the position changes, in its unit per second, if the file gives it.
    """

    unit: PositionUnit
    places: tuple[float, ...]
    frequency_hz: tuple[float, ...]
    speed_per_s: float | None

    def frequency_at(self, place: float) -> float:
        """Frequency in Hz at a position, which counts as the nearer end where it is out of range.

        Examples
        --------
        >>> ArmPositions("m", (3.0, 3.5, 4.0), (5.5, 4.5, 3.7), None).frequency_at(3.25)
        5.0
        """
        return float(np.interp(place, self.places, self.frequency_hz))


def read_positions(table: Table, frequency_hz: tuple[float, ...] | None) -> ArmPositions | None:
    """Read the positions that belong to frequencies; None where a value is missing or wrong.

    Parameters
    ----------
    table : Table
        The section, in which one of `POSITION_KEYS` stands.
    frequency_hz : tuple of float or None
        Its frequencies; None if they are missing or wrong.
    """
    raw = table.raw.get("position")
    unit = position_unit(table.raw.get("position_speed") if raw is None else raw)
    if "position" not in table.raw:
        table.place("position").problem("missing: position_speed says how fast it changes")
    places = table.take("position", some(PLACE[unit], at_most=MOST_POSITIONS), None)
    speed_per_s = table.take("position_speed", SPEED[unit], None)
    if places is None or frequency_hz is None:
        return None
    reason = _disagreement(places, frequency_hz)
    if reason is not None:
        table.place("position").wrong(raw, reason)
        return None
    return ArmPositions(unit, places, frequency_hz, speed_per_s)


def position_unit(raw: object) -> PositionUnit:
    """Tell angles from lengths, and turning from moving, by the units; plain numbers are lengths.

    Examples
    --------
    >>> position_unit(["30 deg", 1.2]), position_unit([3.0, "3.2 m"])
    ('rad', 'm')
    """
    items = raw if isinstance(raw, list) else [raw]
    angles = tuple(UNITS["angle"])
    texts = [item.strip().removesuffix("/s") for item in items if isinstance(item, str)]
    return "rad" if any(text.endswith(angles) for text in texts) else "m"


def _disagreement(places: tuple[float, ...], frequency_hz: tuple[float, ...]) -> str | None:
    """Say what is wrong with positions and frequencies beside each other; None if nothing is."""
    if len(places) < 2 or len(places) != len(frequency_hz):
        return f"must be two values or more, as many as frequency has, {len(frequency_hz)}"
    if any(high <= low for low, high in pairwise(places)):
        return "must increase from value to value"
    if min(frequency_hz) == max(frequency_hz):
        return "the frequency is the same at all of them: leave position out"
    return None
