"""The exact optimum of a goal: the coarse one is approached until its structure is the exact one's.

Not for: units, rules by name and guarantees (`specified`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust.coarse import coarse_optimum
from swayless.design.robust.lines import Line
from swayless.design.robust.search import certificate_of, feasible, first_guess, settle
from swayless.design.robust.stationary import Goal, Optimum
from swayless.errors import DesignError

_TRIALS = 16  # of durations or edges; two or three are usual
_NEAR = 0.15  # log of the worst residual over the tolerance, within which the structure may be the final one
_NARROW = 0.02  # log of the bracket's ends: near enough where the residual jumps
_FINEST = 4  # times as many points as usual, where two impulses nearly meet
_LARGEST_MOVE = 0.4  # in logs, before there is a bracket
_STEEPNESS = 3.0  # a usual d log(worst) / d log(duration)
_GAPS = (
    1e-6,
    1e-5,
    1e-4,
    1e-3,
    3e-3,
)  # relative: how much shorter a duration is tried to be proved infeasible

WIDEST_RATIO = 8.0
"""Largest ratio of the band's ends that is solved."""


def shortest(lines: Sequence[Line], tolerance: float, rule: AmplitudeRule) -> Optimum:
    """Find the shortest impulses that leave at most the tolerance on every line.

    Raises
    ------
    DesignError
        If no optimum is found.
    """

    def problem(size: float) -> tuple[Sequence[Line], float]:
        return lines, math.exp(size)

    usual = math.acosh(1.0 / tolerance) / math.pi * (0.75 if rule is AmplitudeRule.POSITIVE else 0.5)
    return _approach(problem, math.log(usual), tolerance, Goal.DURATION, rule)


def widest(duration: float, damping_ratio: float, tolerance: float, rule: AmplitudeRule) -> Optimum:
    """Find the impulses of a duration that hold the tolerance from frequency 1 to the highest edge.

    Raises
    ------
    DesignError
        If no optimum is found.
    """

    def problem(size: float) -> tuple[Sequence[Line], float]:
        return [Line(1.0, max(1.0, math.exp(-size)), damping_ratio)], duration

    return _approach(problem, -0.4, tolerance, Goal.REACH, rule)


def worst_at_ends(
    duration: float, damping_ratio: float, tolerance: float, rule: AmplitudeRule
) -> tuple[float, float]:
    """Estimate what a duration leaves at frequency 1 alone, and from there to the widest ratio."""
    lines = ([Line(1.0, high, damping_ratio)] for high in (1.0, WIDEST_RATIO))
    narrow, wide = (coarse_optimum(line, duration, rule, tolerance=tolerance).worst for line in lines)
    return narrow, wide


def least(lines: Sequence[Line], duration: float, tolerance: float, rule: AmplitudeRule) -> Optimum:
    """Find the impulses of a duration that leave the least on all lines.

    Raises
    ------
    DesignError
        If no optimum is found.
    """
    optimum = _least(lines, duration, tolerance, rule)
    if optimum is None:
        raise DesignError(f"no optimum found for {duration:g} periods")
    return optimum


def _least(lines: Sequence[Line], duration: float, tolerance: float, rule: AmplitudeRule) -> Optimum | None:
    """Find it on finer and finer grids; None if none of them leads there."""
    for fineness in range(1, _FINEST + 1):
        coarse = coarse_optimum(lines, duration, rule, tolerance=tolerance, fineness=fineness)
        guess = first_guess(coarse, lines, rule, coarse.worst, Goal.WORST)
        optimum = settle(guess, lines, Goal.WORST, rule, thorough=fineness > 1)
        if optimum is not None:
            return optimum
    return None


def proven_duration(optimum: Optimum, lines: Sequence[Line], tolerance: float, rule: AmplitudeRule) -> float:
    """Find a duration that is proved too short for the lines, as near to the optimum's as the proof goes.

    Raises
    ------
    DesignError
        If nothing within 0.3 % can be proved.
    """
    shorter = [replace(optimum, times=optimum.times * (1.0 - gap)) for gap in _GAPS]
    for each in shorter:
        best = settle(each, lines, Goal.WORST, rule, thorough=True)
        if best is not None and certificate_of(best).bound(rule) > tolerance:
            return each.duration
    for each in shorter:  # where another structure holds just below the optimum's duration
        best = _least(lines, each.duration, tolerance, rule)
        if best is not None and certificate_of(best).bound(rule) > tolerance:
            return each.duration
    raise DesignError(
        f"no duration within {_GAPS[-1]:.1%} of {optimum.duration:.6g} periods is proved too short"
    )


def _approach(
    problem: Callable[[float], tuple[Sequence[Line], float]],
    size: float,
    tolerance: float,
    goal: Goal,
    rule: AmplitudeRule,
) -> Optimum:
    """Solve coarsely for sizes (logs: of the duration, or of how low the upper edge is), then exactly."""
    over, under, fineness = (-math.inf, math.inf), (math.inf, -math.inf), 1
    for trial in range(_TRIALS):
        lines, duration = problem(size)
        coarse = coarse_optimum(lines, duration, rule, tolerance=tolerance, fineness=fineness)
        excess = math.log(coarse.worst / tolerance)
        if excess > 0.0:
            over = max(over, (size, excess))
        else:
            under = min(under, (size, excess))
        width = under[0] - over[0]
        if abs(excess) < _NEAR or width < _NARROW:
            guess = first_guess(coarse, lines, rule, tolerance, goal)
            optimum = settle(guess, lines, goal, rule, thorough=fineness > 1)
            if optimum is not None:
                return optimum
            fineness = min(fineness + 1, _FINEST)
        size = _next_size(size, excess, over, under, halve=trial % 3 == 2)
    optimum = feasible(first_guess(coarse, lines, rule, tolerance, goal), lines, goal, rule)
    if optimum is None:
        raise DesignError(f"no optimum found in {_TRIALS} trials, the last of {duration:g} periods")
    return optimum


def _next_size(
    size: float, excess: float, over: tuple[float, float], under: tuple[float, float], *, halve: bool
) -> float:
    """Regula falsi inside a bracket, with a bisection now and then; before there is one, a usual step."""
    width = under[0] - over[0]
    if not math.isfinite(width):
        step = max(-_LARGEST_MOVE, min(_LARGEST_MOVE, excess / _STEEPNESS))
        return size + (step if abs(excess) > 0.1 else math.copysign(0.1, excess))
    share = 0.5 if halve else over[1] / (over[1] - under[1])
    return over[0] + width * min(max(share, 0.05), 0.95)
