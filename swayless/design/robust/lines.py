"""What a robust design must hold, free of units: lines of frequencies, each at one damping ratio.

Frequencies are in units of the lowest one asked for and times in its periods, so that one scale fits every
crane. Not for: searching (`search`), nor for units (`design`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Line:
    """Frequencies from `low` to `high` at one damping ratio.

    Parameters
    ----------
    low, high : float
        0 < low <= high, in units of the lowest frequency asked for.
    damping_ratio : float
        0 <= damping_ratio < 1.
    """

    low: float
    high: float
    damping_ratio: float

    @property
    def turn(self) -> complex:
        """2 pi (z + j sqrt(1 - z^2)): the free vibration is exp(f turn t)."""
        return turn_of(self.damping_ratio)


def turn_of(damping_ratio: float) -> complex:
    """2 pi (z + j sqrt(1 - z^2)), of size 2 pi."""
    return 2.0 * math.pi * complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2))
