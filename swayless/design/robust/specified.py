"""Specified insensitivity and fixed duration: the best shaper for a band, and the proof that it is.

Not for: families with a fixed recipe (`families`), nor for several shapers that share a range (`bank`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import Response
from swayless.design.robust.exact import WIDEST_RATIO, least, proven_duration, shortest, widest, worst_at_ends
from swayless.design.robust.lines import Line
from swayless.design.robust.stationary import Optimum
from swayless.design.robustness import TOUCH_SLACK, worst_residual_promised
from swayless.design.shaper import Guarantee, Shaper
from swayless.errors import DesignError
from swayless.plant import Band, Mode

TOLERANCES = (0.01, 0.2)
"""Smallest and largest tolerance that is designed for."""

Amplitudes: TypeAlias = Literal["positive", "bounded", "unity-magnitude"]

RULES = {
    "positive": AmplitudeRule.POSITIVE,
    "bounded": AmplitudeRule.BOUNDED,
    "unity-magnitude": AmplitudeRule.BOUNDED,
}
_LARGEST_DAMPING_RATIO = 0.2
_DAMPING_CHECKS = 65  # damping ratios of a range at which a design is checked
_DAMPING_ROUNDS = 5  # of further damping ratios inside a range
_SOURCE = "Singhose, Seering and Singer (1996), specified insensitivity; Kriikku et al. (1997), section III"


@dataclass(frozen=True, eq=False)
class RobustDesign:
    """A shaper that no other one of its kind can beat, and the proof.

    Parameters
    ----------
    shaper : Shaper
        Its guarantee is the band asked for (fixed duration: the band found).
    lower_bound_s : float
        No shaper of the kind that lasts this long or less holds the band at the tolerance: proved by a dual
        polynomial, bounded over continuous time.
    damping_ratio : tuple of float
        Lowest and highest damping ratio held.
    """

    shaper: Shaper
    lower_bound_s: float
    damping_ratio: tuple[float, float]

    @property
    def gap_ratio(self) -> float:
        """By how much the shaper may be longer than the shortest there is, relative to its bound."""
        return self.shaper.duration_s / self.lower_bound_s - 1.0


def specified_insensitivity(
    band: Band,
    *,
    tolerance: float = 0.05,
    damping_ratio: float | tuple[float, float] = 0.0,
    amplitudes: Amplitudes = "positive",
) -> RobustDesign:
    """Design the shortest shaper that leaves at most the tolerance over a band.

    Bounded designs (every partial sum in 0 .. 1) come out with amplitudes +1, -1, ..., +1: the dual
    polynomial has isolated extremes, between which the best level is 0 or 1. So "unity-magnitude" asks for
    the same.

    Parameters
    ----------
    band : Band
        Undamped natural frequencies, high_hz / low_hz at most 8.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float or (float, float)
        One value, or the lowest and highest: 0 to 0.2.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule.

    Returns
    -------
    RobustDesign

    Raises
    ------
    DesignError
        If a value is out of range, or no optimum is found.

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
    """
    low, high = _damping_range(damping_ratio)
    rule = _checked(tolerance, amplitudes)
    ratio = band.high_hz / band.low_hz
    if ratio > WIDEST_RATIO:
        raise DesignError(
            f"band {band.low_hz:g} to {band.high_hz:g} Hz: the ratio {ratio:g} must be at most "
            f"{WIDEST_RATIO:g}; split it into rows of a bank"
        )
    lines = [Line(1.0, ratio, damping) for damping in dict.fromkeys((low, high))]
    try:
        optimum = shortest(lines, tolerance, rule)
        bound = proven_duration(optimum, lines, tolerance, rule)
        bare = _held_between(optimum, lines, tolerance, rule)
    except DesignError as error:
        raise DesignError(
            f"{amplitudes} shaper for {band.low_hz:g} to {band.high_hz:g} Hz at {100 * tolerance:g} %: "
            f"{error}; another tolerance or band may do"
        ) from None
    shaper = _shaper(bare, band, low, high, tolerance, f"si-{amplitudes}")
    return RobustDesign(shaper, bound / band.low_hz, (low, high))


def fixed_duration(
    duration_s: float,
    low_hz: float,
    *,
    tolerance: float = 0.05,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
) -> RobustDesign:
    """Design the shaper of a given duration that holds the tolerance from `low_hz` up as far as any can.

    Parameters
    ----------
    duration_s : float
        Time of the last impulse, > 0.
    low_hz : float
        Lowest frequency to hold, > 0.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float
        Over the whole band, 0 to 0.2.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule, as for `specified_insensitivity`.

    Returns
    -------
    RobustDesign
        Its guarantee's band starts at `low_hz`.

    Raises
    ------
    DesignError
        If the duration is too short for any band, or so long that 8 times `low_hz` is not the end.

    References
    ----------
    Kriikku, Singer and Singhose (1997), section III, steps 3 and 4.

    Examples
    --------
    >>> design = fixed_duration(1.2, 0.8)
    >>> round(design.shaper.guarantee.band.high_hz, 3)
    1.714
    """
    damping, _ = _damping_range(damping_ratio)
    rule = _checked(tolerance, amplitudes)
    if not (math.isfinite(duration_s) and duration_s > 0.0):
        raise DesignError(f"duration_s = {duration_s!r}: must be finite and > 0")
    duration = duration_s * low_hz
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
    optimum = widest(duration, damping, tolerance, rule)
    ratio = float(optimum.frequency[-1])
    band, lines = Band(low_hz, low_hz * ratio), [Line(1.0, ratio, damping)]
    bound = proven_duration(optimum, lines, tolerance, rule)
    shaper = _shaper(optimum, band, damping, damping, tolerance, f"fd-{amplitudes}")
    return RobustDesign(shaper, bound / low_hz, (damping, damping))


def least_residual(
    duration_s: float, band: Band, *, damping_ratio: float = 0.0, amplitudes: Amplitudes = "positive"
) -> RobustDesign:
    """Design the shaper of a given duration that leaves the least worst residual over a band.

    Parameters
    ----------
    duration_s : float
        Time of the last impulse, > 0.
    band : Band
        Undamped natural frequencies, high_hz / low_hz at most 8.
    damping_ratio : float
        Over the whole band, 0 to 0.2.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule, as for `specified_insensitivity`.

    Returns
    -------
    RobustDesign
        The tolerance of its guarantee is the least there is.

    Raises
    ------
    DesignError
        If a value is out of range, or no optimum is found.

    Examples
    --------
    >>> design = least_residual(1.0, Band(0.8003, 1.1997))
    >>> round(design.shaper.guarantee.tolerance, 4)
    0.05
    """
    damping, _ = _damping_range(damping_ratio)
    rule = _checked(TOLERANCES[0], amplitudes)
    if not (math.isfinite(duration_s) and duration_s > 0.0):
        raise DesignError(f"duration_s = {duration_s!r}: must be finite and > 0")
    lines = [Line(1.0, band.high_hz / band.low_hz, damping)]
    optimum = least(lines, duration_s * band.low_hz, TOLERANCES[0], rule)
    bound = proven_duration(optimum, lines, optimum.worst, rule)
    shaper = _shaper(optimum, band, damping, damping, optimum.worst, f"fd-{amplitudes}")
    return RobustDesign(shaper, bound / band.low_hz, (damping, damping))


def _shaper(optimum: Optimum, band: Band, low: float, high: float, tolerance: float, family: str) -> Shaper:
    """Give impulses their units, and prove on these numbers that they hold the band."""
    mode = Mode(math.sqrt(band.low_hz * band.high_hz), low)
    times_s, amplitudes = optimum.times / band.low_hz, optimum.amplitudes / optimum.amplitudes.sum()
    promise = Guarantee(tolerance, mode, band, tolerance, highest_damping_ratio=None if high == low else high)
    claim = Shaper(times_s, amplitudes, family, promise, _SOURCE)
    worst = worst_residual_promised(claim, promise)
    if worst > tolerance * (1.0 + TOUCH_SLACK):
        raise DesignError(f"{family} leaves {100 * worst:.10g} % where {100 * tolerance:g} % is promised")
    return replace(claim, guarantee=replace(promise, worst_residual_ratio=worst))


def _held_between(optimum: Optimum, lines: Sequence[Line], tolerance: float, rule: AmplitudeRule) -> Optimum:
    """Hold the tolerance at every damping ratio between two lines, where the ends do not see to it.

    Lines are added where the residual is worst; what is then left over by the damping ratios between them is
    taken from the tolerance.
    """
    low, high = lines[0], lines[-1]
    goal = tolerance
    for _ in range(_DAMPING_ROUNDS):
        worst, damping = max(
            (_worst_on(optimum, replace(low, damping_ratio=ratio)), ratio)
            for ratio in _dampings(low.damping_ratio, high.damping_ratio)
        )
        if worst <= tolerance * (1.0 + TOUCH_SLACK):
            return optimum
        if damping in [line.damping_ratio for line in lines]:
            goal *= tolerance / worst * (1.0 - TOUCH_SLACK)
        lines = [*lines, replace(low, damping_ratio=damping)]
        optimum = shortest(lines, goal, rule)
    raise DesignError(
        f"damping ratios {low.damping_ratio:g} to {high.damping_ratio:g} leave {100 * worst:.6g} %"
    )


def _worst_on(optimum: Optimum, line: Line) -> float:
    """Largest residual vibration on a line."""
    response = Response.of_times(optimum.times, line.damping_ratio)
    low, high = line.low * optimum.duration, line.high * optimum.duration
    return response.peaks(optimum.amplitudes, low, high).worst


def _dampings(low: float, high: float) -> list[float]:
    """Damping ratios at which a range is checked."""
    return [low] if low == high else np.linspace(low, high, _DAMPING_CHECKS).tolist()


def _damping_range(damping_ratio: float | tuple[float, float]) -> tuple[float, float]:
    """Lowest and highest damping ratio, checked."""
    low, high = damping_ratio if isinstance(damping_ratio, tuple) else (damping_ratio, damping_ratio)
    if not 0.0 <= low <= high <= _LARGEST_DAMPING_RATIO:
        raise DesignError(
            f"damping_ratio = {damping_ratio!r}: must be 0 to {_LARGEST_DAMPING_RATIO:g}, lowest first"
        )
    return low, high


def _checked(tolerance: float, amplitudes: str) -> AmplitudeRule:
    """Check the tolerance, and find the rule by its name."""
    lowest, highest = TOLERANCES
    if not lowest <= tolerance <= highest:
        raise DesignError(f"tolerance = {tolerance!r}: must be {lowest:g} to {highest:g}")
    if amplitudes not in RULES:
        raise DesignError(f"amplitudes = {amplitudes!r}: must be one of {', '.join(RULES)}")
    return RULES[amplitudes]
