"""Robust design, proved optimal: the shortest shaper for a band, the widest band for a duration, banks.

Not for: cranes and their rope lengths (`swayless.machine`), nor for named families (`families`).
"""

from swayless.design.robust.bank import cover, cover_with
from swayless.design.robust.specified import (
    Amplitudes,
    RobustDesign,
    fixed_duration,
    least_residual,
    specified_insensitivity,
)
from swayless.design.robust.ticks import RobustTaps, specified_insensitivity_on_ticks

__all__ = [
    "Amplitudes",
    "RobustDesign",
    "RobustTaps",
    "cover",
    "cover_with",
    "fixed_duration",
    "least_residual",
    "specified_insensitivity",
    "specified_insensitivity_on_ticks",
]
