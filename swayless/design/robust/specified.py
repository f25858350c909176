"""Specified insensitivity and fixed duration: the best shaper for a band, and the proof that it is.

Not for: families with a fixed recipe (`families`), nor for several shapers that share a range (`bank`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from swayless.design.robust import unity
from swayless.design.robust.between import with_points_between
from swayless.design.robust.demand import (
    RULES,
    TOLERANCES,
    WIDEST_RATIO,
    Amplitudes,
    Demand,
    check_amplitudes,
    check_duration,
    check_tolerance,
    damping_range,
)
from swayless.design.robust.exact import (
    LEAST_RESIDUAL,
    least,
    proven_duration,
    shortest,
    widest,
    worst_at_ends,
)
from swayless.design.robust.lines import Line
from swayless.design.robust.stationary import Optimum
from swayless.design.robustness import TOUCH_SLACK, worst_residual_promised
from swayless.design.shaper import Shaper
from swayless.errors import DesignError
from swayless.plant import Band

__all__ = [
    "RULES",
    "TOLERANCES",
    "Amplitudes",
    "RobustDesign",
    "fixed_duration",
    "least_residual",
    "specified_insensitivity",
]

_ROUNDS = 3  # of a tolerance lowered by what a design left above it
_SOURCE = "Singhose, Seering and Singer (1996), specified insensitivity; Kriikku et al. (1997), section III"


@dataclass(frozen=True, eq=False)
class RobustDesign:
    """A shaper, and the proof of how near it is to the best of its kind.

    Parameters
    ----------
    shaper : Shaper
        Its guarantee is what was asked for (fixed duration: the band found).
    lower_bound_s : float
        No shaper of the kind that lasts this long or less holds the guarantee: proved by a dual polynomial,
        bounded over continuous time. For a given number of impulses: no bounded shaper at all.
    """

    shaper: Shaper
    lower_bound_s: float

    @property
    def gap_ratio(self) -> float:
        """By how much the shaper may be longer than the shortest there is, relative to its bound."""
        return self.shaper.duration_s / self.lower_bound_s - 1.0


def specified_insensitivity(
    band: Band | Sequence[Band],
    *,
    tolerance: float = 0.05,
    damping_ratio: float | tuple[float, float] = 0.0,
    amplitudes: Amplitudes = "positive",
    impulses: int | None = None,
) -> RobustDesign:
    """Design the shortest shaper that leaves at most the tolerance over a band, or over several.

    Parameters
    ----------
    band : Band or sequence of Band
        Undamped natural frequencies. high_hz / low_hz at most 8 for each band, 24 over all; bands that
        overlap are one.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float or (float, float)
        One value, or the lowest and highest: 0 to 0.2, over all bands.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule: all at least 0; every partial sum in 0 .. 1; or +1, -1, ..., +1. The best bounded shaper is
        one of unity magnitude, so that the last two ask for the same.
    impulses : int, optional
        With "unity-magnitude": exactly so many, odd and at least 3. By default as many as it takes.

    Returns
    -------
    RobustDesign

    Raises
    ------
    DesignError
        If a value is out of range, or so many impulses cannot hold the bands.

    References
    ----------
    Singhose, Seering and Singer (1996): specified insensitivity.
    Pao and Singhose (1996): unity-magnitude shapers and time-optimal control.

    Examples
    --------
    One period of the centre is what 5 % over 39.94 % needs: the EI shaper is optimal.

    >>> design = specified_insensitivity(Band(0.8003, 1.1997), tolerance=0.05)
    >>> round(design.shaper.duration_s, 3), round(design.lower_bound_s, 3)
    (1.0, 1.0)

    The hook and the load of one crane:

    >>> design = specified_insensitivity([Band(0.2, 0.25), Band(0.8, 1.0)])
    >>> round(design.shaper.duration_s, 3)
    4.454
    """
    check_tolerance(tolerance)
    demand = Demand.of(band, damping_ratio, amplitudes, impulses)
    goal = tolerance
    for _ in range(_ROUNDS):
        optimum, lines = _shortest_between(demand, goal)
        shaper = _shaper(optimum, demand, tolerance, "si")
        excess = shaper.guarantee.worst_residual_ratio / tolerance
        if excess <= 1.0 + TOUCH_SLACK:
            return RobustDesign(shaper, _bound_s(optimum, lines, demand, tolerance))
        goal /= excess
    raise DesignError(f"{demand}: leaves {excess:.9g} times the tolerance {tolerance!r}")


def fixed_duration(
    duration_s: float,
    low_hz: float,
    *,
    tolerance: float = 0.05,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
    impulses: int | None = None,
) -> RobustDesign:
    """Design the shaper of a given duration that holds the tolerance from `low_hz` up as far as any can.

    Parameters
    ----------
    duration_s : float
        Time of the last impulse, > 0.
    low_hz : float
        Lowest frequency to hold, > 0.
    tolerance, amplitudes, impulses
        As for `specified_insensitivity`.
    damping_ratio : float
        Over the whole band, 0 to 0.2.

    Returns
    -------
    RobustDesign
        Its guarantee's band starts at `low_hz`.

    Raises
    ------
    DesignError
        If a value is out of range, the duration is too short for any band, or so long that 8 times `low_hz`
        is not the end.

    References
    ----------
    Kriikku, Singer and Singhose (1997), section III, steps 3 and 4.

    Examples
    --------
    >>> design = fixed_duration(1.2, 0.8)
    >>> round(design.shaper.guarantee.band.high_hz, 3)
    1.714
    """
    check_duration(duration_s)
    check_tolerance(tolerance)
    check_amplitudes(amplitudes, impulses)
    damping, _ = damping_range(damping_ratio)
    rule, duration = RULES[amplitudes], duration_s * Band(low_hz, low_hz).low_hz
    narrow, wide = worst_at_ends(duration, damping, tolerance, rule)
    if narrow > tolerance:
        raise DesignError(
            f"duration_s = {duration_s!r}: too short, {amplitudes} shapers leave {100 * narrow:.3g} % at "
            f"{low_hz:g} Hz alone; a longer one, or a larger tolerance than {tolerance:g}, does"
        )
    if wide <= tolerance:
        raise DesignError(
            f"duration_s = {duration_s!r}: enough for {low_hz:g} to {WIDEST_RATIO * low_hz:g} Hz and "
            "more; ask for the shortest shaper of the band you need instead"
        )
    if impulses is None:
        optimum = widest(duration, damping, tolerance, rule)
    else:
        optimum = unity.widest(duration, damping, tolerance, impulses)
    band = Band(low_hz, low_hz * min(float(optimum.frequency[-1]), WIDEST_RATIO))
    demand = Demand.of(band, damping, amplitudes, impulses)
    bound_s = _bound_s(optimum, demand.lines, demand, tolerance)
    return RobustDesign(_shaper(optimum, demand, tolerance, "fd"), bound_s)


def least_residual(
    duration_s: float,
    band: Band | Sequence[Band],
    *,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
    impulses: int | None = None,
) -> RobustDesign:
    """Design the shaper of a given duration that leaves the least worst residual over a band, or several.

    Parameters
    ----------
    duration_s : float
        Time of the last impulse, > 0.
    band, amplitudes, impulses
        As for `specified_insensitivity`.
    damping_ratio : float
        Over all bands, 0 to 0.2.

    Returns
    -------
    RobustDesign
        The tolerance of its guarantee is the least there is; where that is below 0.1 %, it is the shortest
        design, no longer than asked for, that leaves 0.1 %.

    Raises
    ------
    DesignError
        If a value is out of range.

    Examples
    --------
    >>> design = least_residual(1.0, Band(0.8003, 1.1997))
    >>> round(design.shaper.guarantee.tolerance, 4)
    0.05
    """
    check_duration(duration_s)
    demand = Demand.of(band, damping_range(damping_ratio), amplitudes, impulses)
    lines, duration = demand.lines, duration_s * demand.unit_hz
    if impulses is None:
        optimum = least(lines, duration, TOLERANCES[0], demand.rule)
    else:
        optimum = unity.least(lines, duration, impulses)
    tolerance = optimum.worst
    if tolerance < LEAST_RESIDUAL:
        optimum, tolerance = _shortest(lines, LEAST_RESIDUAL, demand), LEAST_RESIDUAL
    bound_s = _bound_s(optimum, lines, demand, tolerance)
    return RobustDesign(_shaper(optimum, demand, tolerance, "fd"), bound_s)


def _shortest_between(demand: Demand, tolerance: float) -> tuple[Optimum, list[Line]]:
    """Find the shortest impulses for all damping ratios, and the lines that they were found for."""
    return with_points_between(demand.lines, lambda lines: _shortest(lines, tolerance, demand))


def _shortest(lines: Sequence[Line], tolerance: float, demand: Demand) -> Optimum:
    """Find the shortest impulses, as many as are asked for."""
    if demand.impulses is None:
        return shortest(lines, tolerance, demand.rule)
    return unity.shortest(lines, tolerance, demand.impulses)


def _bound_s(optimum: Optimum, lines: Sequence[Line], demand: Demand, tolerance: float) -> float:
    """Prove a duration too short; for a given number of impulses, too short for any bounded shaper."""
    best = optimum if demand.impulses is None else shortest(lines, tolerance, demand.rule)
    return proven_duration(best, lines, tolerance, demand.rule) / demand.unit_hz


def _shaper(optimum: Optimum, demand: Demand, tolerance: float, family: str) -> Shaper:
    """Give impulses their units, and prove on these very numbers what they leave in the bands."""
    times_s, amplitudes = optimum.times / demand.unit_hz, optimum.amplitudes / optimum.amplitudes.sum()
    promise = demand.promise(tolerance)
    claim = Shaper(times_s, amplitudes, family, promise, _SOURCE)
    worst = worst_residual_promised(claim, promise)
    return replace(claim, guarantee=replace(promise, worst_residual_ratio=worst))
