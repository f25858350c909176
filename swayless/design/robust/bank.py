"""Rows that share a range of frequencies: as few as a tolerance allows, or as exact as their number allows.

Not for: rope lengths, knobs and hysteresis (`swayless.machine`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust.exact import WIDEST_RATIO, widest, worst_at_ends
from swayless.design.robust.specified import (
    RULES,
    TOLERANCES,
    Amplitudes,
    RobustDesign,
    fixed_duration,
    least_residual,
    specified_insensitivity,
)
from swayless.errors import DesignError
from swayless.plant import Band

_MOST_ROWS = 64  # more positions than a knob has
_TOLERANCE_ACCURACY = 1e-9  # relative
_EXCESS_ACCURACY = 1e-9  # of the logarithm of the end reached, never below it
_ON_TIME = 1e-9  # relative: a row this little longer than allowed is as long, by rounding
_TRIALS = 60


def cover(
    low_hz: float,
    high_hz: float,
    *,
    tolerance: float = 0.05,
    duration_s: float | None = None,
    longest_duration_s: float | None = None,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
) -> tuple[RobustDesign, ...]:
    """Cover a range of frequencies with the fewest rows that hold a tolerance.

    Each row starts where the one before ends and reaches as far as any can. No bank has fewer rows: a row
    that starts lower reaches no farther.

    Parameters
    ----------
    low_hz, high_hz : float
        The range, 0 < low_hz < high_hz.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    duration_s : float, optional
        Duration of all rows, > 0. The last row, which need not reach so far, leaves the least instead.
    longest_duration_s : float, optional
        Duration of all rows but the last, which is as short as what is left allows. Give one of the two.
    damping_ratio : float
        Over the whole range, 0 to 0.2.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule, as for `specified_insensitivity`.

    Returns
    -------
    tuple of RobustDesign
        Rows by rising frequency; their bands meet.

    Raises
    ------
    DesignError
        If a value is out of range, the duration is too short, or more than 64 rows were needed.

    References
    ----------
    Kriikku, Singer and Singhose (1997), section III, steps 1 to 5.

    Examples
    --------
    >>> rows = cover(0.5, 1.0, duration_s=1.2, amplitudes="bounded")
    >>> [round(row.shaper.guarantee.band.high_hz, 3) for row in rows]
    [0.721, 1.0]
    """
    duration = longest_duration_s if duration_s is None else duration_s
    if duration is None or (duration_s is not None and longest_duration_s is not None):
        raise DesignError("a bank needs either duration_s or longest_duration_s")
    Band(low_hz, high_hz)
    rows: list[RobustDesign] = []
    start_hz = low_hz
    while len(rows) < _MOST_ROWS:
        rest = _rest(start_hz, high_hz, tolerance, duration, damping_ratio, amplitudes)
        if rest is not None:
            shortened = duration_s is None
            last = (
                rest
                if shortened
                else least_residual(
                    duration, rest.shaper.guarantee.band, damping_ratio=damping_ratio, amplitudes=amplitudes
                )
            )
            return (*rows, last)
        row = fixed_duration(
            duration, start_hz, tolerance=tolerance, damping_ratio=damping_ratio, amplitudes=amplitudes
        )
        rows.append(row)
        start_hz = row.shaper.guarantee.band.high_hz
    raise DesignError(
        f"{low_hz:g} to {high_hz:g} Hz at {tolerance:g}: more than {_MOST_ROWS} rows of {duration:g} s; "
        "a longer duration or a larger tolerance needs fewer"
    )


def cover_with(
    rows: int,
    low_hz: float,
    high_hz: float,
    *,
    duration_s: float,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
) -> tuple[RobustDesign, ...]:
    """Cover a range of frequencies with a number of rows at the smallest equal tolerance.

    Parameters
    ----------
    rows : int
        Number of rows, at least 1.
    low_hz, high_hz : float
        The range, 0 < low_hz < high_hz.
    duration_s : float
        Duration of all rows, > 0.
    damping_ratio, amplitudes
        As for `cover`.

    Returns
    -------
    tuple of RobustDesign
        Rows by rising frequency; their bands meet.

    Raises
    ------
    DesignError
        If a value is out of range, or the smallest tolerance is not between 0.01 and 0.2.

    Examples
    --------
    >>> rows = cover_with(2, 0.5, 1.0, duration_s=1.1, amplitudes="bounded")
    >>> round(rows[0].shaper.guarantee.tolerance, 4)
    0.0769
    """
    if rows < 1:
        raise DesignError(f"rows = {rows!r}: must be at least 1")
    program = _Reach(rows, low_hz, high_hz, duration_s, damping_ratio, RULES[amplitudes])
    ends = [(tolerance, program.excess(tolerance)) for tolerance in TOLERANCES]
    what = f"rows = {rows}: {duration_s:g} s hold {low_hz:g} to {high_hz:g} Hz"
    if ends[0][1] >= 0.0:
        raise DesignError(f"{what} at {TOLERANCES[0]:g} already; fewer rows or a shorter duration do")
    if ends[1][1] < 0.0:
        raise DesignError(f"{what} not even at {TOLERANCES[1]:g}; more rows or a longer duration do")
    return cover(
        low_hz,
        high_hz,
        tolerance=program.least_tolerance(*ends),
        duration_s=duration_s,
        damping_ratio=damping_ratio,
        amplitudes=amplitudes,
    )


@dataclass(frozen=True)
class _Reach:
    """How far a number of rows reach, as a function of their tolerance."""

    rows: int
    low_hz: float
    high_hz: float
    duration_s: float
    damping_ratio: float
    rule: AmplitudeRule

    def excess(self, tolerance: float) -> float:
        """Log of the highest frequency reached over the one asked for."""
        start_hz = self.low_hz
        for _ in range(self.rows):
            start_hz *= self._ratio(self.duration_s * start_hz, tolerance)
        return math.log(start_hz / self.high_hz)

    def _ratio(self, duration: float, tolerance: float) -> float:
        """Ratio of the ends of the widest band that a duration holds from frequency 1: 1 to 8."""
        narrow, wide = worst_at_ends(duration, self.damping_ratio, tolerance, self.rule)
        if narrow > tolerance or wide <= tolerance:
            return 1.0 if narrow > tolerance else WIDEST_RATIO
        return float(widest(duration, self.damping_ratio, tolerance, self.rule).frequency[-1])

    def least_tolerance(self, below: tuple[float, float], above: tuple[float, float]) -> float:
        """Tolerance at which the excess is 0, from one at which it is below and one at which it is not."""
        (left, short), (right, beyond) = below, above
        for _ in range(_TRIALS):
            if right / left - 1.0 < _TOLERANCE_ACCURACY or beyond < _EXCESS_ACCURACY:
                break
            share = min(max(short / (short - beyond), 0.01), 0.99)
            middle = left * (right / left) ** share
            excess = self.excess(middle)
            # Illinois: the end that stays counts half, so that it too comes to move.
            if excess >= 0.0:
                right, beyond, short = middle, excess, short / 2.0
            else:
                left, short, beyond = middle, excess, beyond / 2.0
        return right


def _rest(
    start_hz: float,
    high_hz: float,
    tolerance: float,
    duration_s: float,
    damping_ratio: float,
    amplitudes: Amplitudes,
) -> RobustDesign | None:
    """Design the shortest row for all that is left, if it is short enough."""
    if high_hz > WIDEST_RATIO * start_hz:
        return None
    rest = specified_insensitivity(
        Band(start_hz, high_hz), tolerance=tolerance, damping_ratio=damping_ratio, amplitudes=amplitudes
    )
    return rest if rest.shaper.duration_s <= duration_s * (1.0 + _ON_TIME) else None
