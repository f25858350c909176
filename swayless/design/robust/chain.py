"""Rows one after the other, each as wide as it can be: how far they come short of a range.

Not for: the rows of a finished bank (`bank`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from swayless.design.robust.demand import RULES, TOLERANCES, WIDEST_RATIO
from swayless.design.robust.exact import worst_at_ends
from swayless.design.robust.rows import ContinuousRows
from swayless.design.robust.specified import RobustDesign
from swayless.errors import DesignError
from swayless.plant import Band


def same(end_hz: float) -> float:
    """Let a row start where the one before it ends."""
    return end_hz


def next_start(next_start_hz: Callable[[float], float], start_hz: float, end_hz: float) -> float:
    """Find where the next row starts, checked: no higher than this one ends, and higher than it starts.

    Raises
    ------
    DesignError
        If it is not.
    """
    following_hz = next_start_hz(end_hz)
    if not start_hz < following_hz <= end_hz:
        raise DesignError(
            f"a row from {start_hz:g} to {end_hz:g} Hz is followed by one from {following_hz:g} Hz: must be "
            "above its start, not above its end; less overlap, a longer duration or a larger tolerance do"
        )
    return following_hz


def is_too_long(rows: ContinuousRows, start_hz: float, tolerance: float, duration_s: float) -> bool:
    """Whether a duration does for the widest band from a start: then a row fails by having no end."""
    rule = RULES[rows.amplitudes]
    return worst_at_ends(duration_s * start_hz, rows.damping_ratio, tolerance, rule)[1] <= tolerance


class Walk(NamedTuple):
    """Rows one after the other, the last one over all that is left.

    Parameters
    ----------
    designs : list of RobustDesign
        All but the last one, by rising frequency.
    rest : Band
        What is left to the last one.
    excess : float
        How far the last row is from holding that: `ContinuousRows.excess`. Negative infinity where fewer rows
        do; infinity where a row holds nothing, or far too little is held.
    """

    designs: list[RobustDesign]
    rest: Band
    excess: float


@dataclass(frozen=True)
class Chain:
    """Rows in continuous time over a range of frequencies.

    Parameters
    ----------
    rows : ContinuousRows
        Their designer.
    low_hz, high_hz : float
        The range.
    next_start_hz : callable
        Where a row starts, of where the one before it ends.
    """

    rows: ContinuousRows
    low_hz: float
    high_hz: float
    next_start_hz: Callable[[float], float]

    def walk(self, tolerances: Sequence[float], duration_s: float) -> Walk:
        """Put as many rows as tolerances one after the other."""
        allowed = [min(max(tolerance, TOLERANCES[0]), TOLERANCES[1]) for tolerance in tolerances]
        designs, rest = list[RobustDesign](), Band(self.low_hz, self.high_hz)
        for tolerance in allowed[:-1]:
            try:
                design = self.rows.widest(duration_s, rest.low_hz, tolerance)
                end_hz = design.shaper.guarantee.band.high_hz
                if end_hz >= self.high_hz:
                    return Walk(designs, rest, -math.inf)
                rest = replace(rest, low_hz=next_start(self.next_start_hz, rest.low_hz, end_hz))
            except DesignError:
                endless = is_too_long(self.rows, rest.low_hz, tolerance, duration_s)
                return Walk(designs, rest, -math.inf if endless else math.inf)
            designs.append(design)
        if rest.high_hz > WIDEST_RATIO * rest.low_hz:
            return Walk(designs, rest, math.inf)
        return Walk(designs, rest, self.rows.excess(duration_s, rest, allowed[-1]))
