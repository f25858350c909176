"""The optimum of a goal: nearly found by exchange, then exactly by Newton's method, then proved.

Not for: units, rules by name and guarantees (`specified`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust.demand import WIDEST_RATIO
from swayless.design.robust.guess import cleaned, first_guess
from swayless.design.robust.lines import Line
from swayless.design.robust.refined import refined
from swayless.design.robust.search import certificate_of, settle
from swayless.design.robust.stationary import Goal, Optimum
from swayless.errors import DesignError

Problem: TypeAlias = Callable[[float], tuple[Sequence[Line], float]]

_STAGES = ((0.15, 1e-2), (0.02, 1e-3), (2e-3, 2e-4), (2e-4, 5e-5))
"""How near (in logs) the worst residual must come to the tolerance before an exact solve is tried from there,
and the gap at which it is found: the structure is nearly always right at the first or second."""

LEAST_RESIDUAL = 1e-3
"""Residual vibration below which nothing is gained."""

_AMPLE = 3.0  # periods: enough for the widest band at the smallest tolerance
_TRIALS = 60  # of durations or edges; three to ten are usual
_NARROW = 1e-6  # log of the bracket's ends: there the residual jumps
_NEAREST = 1e-4  # the least change of a size before there is a bracket
_LESS = 1e-6  # relative: by how much more than it must a design that is not settled stays below its tolerance
_LARGEST_MOVE = 0.4  # in logs, before there is a bracket
_STEEPNESS = 3.0  # a usual d log(worst) / d log(duration)
_RESOLVED = 0.25  # of the tolerance: below it nothing needs to be told apart
_LEAST = 1e-3  # of the tolerance: less than that is as good as nothing, and has no log
_GAPS = (1e-6, 1e-5, 1e-4, 1e-3, 2.9e-3)
"""How much shorter, relative, a duration is tried to be proved infeasible."""


def shortest(lines: Sequence[Line], tolerance: float, rule: AmplitudeRule) -> Optimum:
    """Find the shortest impulses that leave at most the tolerance on every line.

    Raises
    ------
    DesignError
        If none are found.
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
        If none are found.
    """

    def problem(size: float) -> tuple[Sequence[Line], float]:
        return [Line(1.0, max(1.0, math.exp(-size)), damping_ratio)], duration

    return _approach(problem, -0.4, tolerance, Goal.REACH, rule)


def worst_at_ends(
    duration: float, damping_ratio: float, tolerance: float, rule: AmplitudeRule
) -> tuple[float, float]:
    """Bound what a duration leaves at frequency 1 alone from below, and up to the widest ratio from above.

    A duration that is ample for the widest ratio is as good as any longer one.
    """
    ample = min(duration, _AMPLE)
    narrow, _ = residual_range([Line(1.0, 1.0, damping_ratio)], ample, tolerance, rule)
    widest_line = Line(1.0, WIDEST_RATIO, damping_ratio)
    _, wide = residual_range([widest_line], ample, tolerance, rule)
    return narrow, wide


def residual_range(
    lines: Sequence[Line], duration: float, tolerance: float, rule: AmplitudeRule
) -> tuple[float, float]:
    """Bound the least worst residual of a duration from below and from above, to tell it from a tolerance."""
    found = refined(
        lines, duration, rule, gap=_STAGES[-1][1], resolved=_RESOLVED * tolerance, decided=tolerance
    )
    return found.bound, found.worst


def least(lines: Sequence[Line], duration: float, tolerance: float, rule: AmplitudeRule) -> Optimum:
    """Find the impulses of a duration that leave the least on all lines, resolved to a share of a tolerance.

    Where that is less than `LEAST_RESIDUAL`, they are the shortest that leave so much.

    Raises
    ------
    DesignError
        If none are found.
    """
    for _, gap in _STAGES:
        found = refined(lines, duration, rule, gap=gap, resolved=_RESOLVED * tolerance)
        if found.worst < LEAST_RESIDUAL:
            return shortest(lines, LEAST_RESIDUAL, rule)
        guess = first_guess(found, lines, rule, found.worst, Goal.WORST)
        optimum = settle(guess, lines, Goal.WORST, rule, thorough=gap < _STAGES[0][1])
        if optimum is not None:
            return optimum
    return cleaned(found, lines, rule)


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
        if best is not None and _on_lines(best, lines) and certificate_of(best).bound(rule) > tolerance:
            return each.duration
    for each in shorter[2:]:  # where another structure holds just below the optimum's duration
        bound, _ = residual_range(lines, each.duration, tolerance, rule)
        if bound > tolerance:
            return each.duration
    raise DesignError(
        f"the design found, of {optimum.duration:.6g} periods of the lowest frequency, is not proved within "
        f"{_GAPS[-1]:.2%} of the shortest: {shorter[-1].duration:.6g} periods leave at least {bound:.6g}, "
        f"not {tolerance:.6g}; try a larger tolerance or a narrower band"
    )


def _on_lines(optimum: Optimum, lines: Sequence[Line]) -> bool:
    """Whether every peak lies on a line: what lies outside is not asked for, and proves nothing."""
    held = np.zeros(optimum.frequency.size, dtype=np.bool_)
    for line in lines:
        inside = (optimum.frequency >= line.low) & (optimum.frequency <= line.high)
        held |= inside & (optimum.turn == line.turn)
    return bool(held.all())


@dataclass
class _Bracket:
    """Sizes (logs: of the duration, or of how low the upper edge is) on both sides of what is aimed at."""

    steepness: float = _STEEPNESS
    over: tuple[float, float] = (-math.inf, math.inf)
    under: tuple[float, float] = (math.inf, -math.inf)
    trials: int = 0

    @property
    def width(self) -> float:
        """Distance of the two."""
        return self.under[0] - self.over[0]

    def restarted(self) -> _Bracket:
        """Forget the sizes, which belong to another gap or aim, but not how steep they were."""
        if not math.isfinite(self.width):
            return _Bracket(self.steepness)
        return _Bracket(max(1.0, (self.over[1] - self.under[1]) / self.width))

    def next_size(self, size: float, excess: float) -> float:
        """Regula falsi inside a bracket, with a bisection now and then; before there is one, a usual step."""
        self.trials += 1
        if excess > 0.0:
            self.over = max(self.over, (size, excess))
        else:
            self.under = min(self.under, (size, excess))
        if self.width < _NARROW:
            return self.under[0]
        if not math.isfinite(self.width):
            step = 1.1 * excess / self.steepness * self.trials
            return size + max(-_LARGEST_MOVE, min(_LARGEST_MOVE, step)) + math.copysign(_NEAREST, excess)
        share = 0.5 if self.trials % 3 == 0 else self.over[1] / (self.over[1] - self.under[1])
        return self.over[0] + self.width * min(max(share, 0.02), 0.98)


def _approach(problem: Problem, size: float, tolerance: float, goal: Goal, rule: AmplitudeRule) -> Optimum:
    """Approach the size at which the tolerance is just held, and settle there what is active."""
    bracket, aim = _Bracket(), tolerance
    stages = iter(_STAGES)
    near, gap = next(stages)
    for _ in range(_TRIALS):
        lines, duration = problem(size)
        found = refined(lines, duration, rule, gap=gap, resolved=_RESOLVED * tolerance)
        excess, last = math.log(max(found.worst / aim, _LEAST)), gap == _STAGES[-1][1]
        if not (-near <= excess <= (0.0 if last else near) or (excess < 0.0 and bracket.width < _NARROW)):
            size = bracket.next_size(size, excess)
            continue
        bracket = bracket.restarted()
        guess = first_guess(found, lines, rule, tolerance, goal)
        optimum = settle(guess, lines, goal, rule, thorough=gap < _STAGES[0][1])
        if optimum is not None:
            return optimum
        if last:
            design = cleaned(found, lines, rule)
            if design.worst <= tolerance:
                return design
            aim *= tolerance / design.worst * (1.0 - _LESS)
        near, gap = next(stages, _STAGES[-1])
    raise DesignError(
        f"no design found in {_TRIALS} trials; the last, of {duration:.6g} periods of the lowest frequency, "
        f"leaves {found.worst:.6g}, at least {found.bound:.6g}, where {tolerance:g} is asked for"
    )
