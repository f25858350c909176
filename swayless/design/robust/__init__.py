"""Robust design, proved optimal: the shortest shaper for a band, the widest band for a duration, banks.

Not for: cranes and their rope lengths (`swayless.machine`), nor for named families (`families`).
"""

from swayless.design.robust.bank import MOST_ROWS, ContinuousRows, RowDesigner, TickRows, cover, cover_with
from swayless.design.robust.demand import FewerDoError, NotHeldError
from swayless.design.robust.specified import (
    RULES,
    TOLERANCES,
    Amplitudes,
    RobustDesign,
    fixed_duration,
    least_residual,
    specified_insensitivity,
)
from swayless.design.robust.ticks import (
    RobustTaps,
    fixed_duration_on_ticks,
    least_residual_on_ticks,
    specified_insensitivity_on_ticks,
)
from swayless.design.robust.whole_ticks import whole_tick_taps

__all__ = [
    "MOST_ROWS",
    "RULES",
    "TOLERANCES",
    "Amplitudes",
    "ContinuousRows",
    "FewerDoError",
    "NotHeldError",
    "RobustDesign",
    "RobustTaps",
    "RowDesigner",
    "TickRows",
    "cover",
    "cover_with",
    "fixed_duration",
    "fixed_duration_on_ticks",
    "least_residual",
    "least_residual_on_ticks",
    "specified_insensitivity",
    "specified_insensitivity_on_ticks",
    "whole_tick_taps",
]
