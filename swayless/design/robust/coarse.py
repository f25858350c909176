"""Amplitudes on a grid of times that leave the least over a grid of frequencies: where an exact solve starts.

Not for: guarantees. Both grids are coarse; `search` finds the optimum that they stand for.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import ComplexArray
from swayless.design.robust.central_path import RealOrComplexArray, least_worst
from swayless.design.robust.lines import Line
from swayless.design.shaper import FloatArray

_TIMES_PER_CYCLE = 16  # of the highest frequency
_FREQUENCIES_PER_RIPPLE = 14  # |G|^2 ripples once per 1 / duration
_FEWEST = 24


@dataclass(frozen=True, eq=False)
class Coarse:
    """Optimum over two grids.

    Parameters
    ----------
    worst : float
        Least worst residual vibration, as a ratio.
    times, amplitudes : ndarray, shape (n,)
        All times of the grid, from 0 to the duration.
    frequency : ndarray, shape (k,)
        Frequencies of all lines, one line after the other.
    turn : ndarray of complex, shape (k,)
        `Line.turn` of each.
    weights : ndarray, shape (k,)
        Dual values: how much each frequency holds the optimum up.
    """

    worst: float
    times: FloatArray
    amplitudes: FloatArray
    frequency: FloatArray
    turn: ComplexArray
    weights: FloatArray


def coarse_optimum(
    lines: Sequence[Line], duration: float, rule: AmplitudeRule, *, tolerance: float, fineness: int = 1
) -> Coarse:
    """Find the amplitudes that leave the least over all lines within a duration.

    Without damping a shaper and its mirror image in time leave the same, so that the best one is symmetric:
    half the variables do, and the vibration seen from the middle is real.
    """
    highest = max(line.high for line in lines)
    half = max(_FEWEST, math.ceil(fineness * _TIMES_PER_CYCLE / 2.0 * highest * duration))
    times = np.linspace(0.0, duration, 2 * half + 1)
    spread = [_frequencies(line, duration, fineness) for line in lines]
    frequency = np.concatenate(spread)
    turn = np.repeat([line.turn for line in lines], [part.size for part in spread])
    symmetric = not np.any(turn.real)
    start, amplitudes_of = _variables(half, rule, symmetric=symmetric)
    columns: RealOrComplexArray
    if symmetric:
        columns = np.cos(np.multiply.outer(frequency * turn.imag, times - duration / 2.0))
    else:
        columns = np.exp(np.multiply.outer(frequency * turn, times - duration))
    positive = rule is AmplitudeRule.POSITIVE
    centre = least_worst(
        columns @ amplitudes_of, columns @ start, sum_to_one=positive, resolved=tolerance / 4.0
    )
    amplitudes = start + amplitudes_of @ centre.variables
    return Coarse(centre.worst, times, amplitudes, frequency, turn, centre.weights)


def _frequencies(line: Line, duration: float, fineness: int) -> FloatArray:
    """Spread frequencies over a line, its ends included."""
    count = math.ceil(_FREQUENCIES_PER_RIPPLE * duration * (line.high - line.low))
    return (
        np.linspace(line.low, line.high, fineness * max(_FEWEST, count))
        if line.high > line.low
        else np.array([line.low])
    )


def _variables(half: int, rule: AmplitudeRule, *, symmetric: bool) -> tuple[FloatArray, FloatArray]:
    """Amplitudes at 2 half + 1 times as start + table @ variables, every variable between 0 and 1.

    The variables are amplitudes (positive; of a pair of mirror images, if symmetric), or the levels that the
    reference takes between two times (bounded; if symmetric, a level and its mirror image sum to 1).
    """
    count = 2 * half + 1
    if rule is AmplitudeRule.POSITIVE:
        table = np.eye(count)
        return np.zeros(count), (table + table[::-1])[:, : half + 1] / 2.0 if symmetric else table
    levels, first = np.eye(2 * half), np.zeros(2 * half)
    if symmetric:
        levels, first = (levels - levels[::-1])[:, :half], np.repeat([0.0, 1.0], half)
    edges = np.zeros((1, levels.shape[1]))
    return np.diff(first, prepend=0.0, append=1.0), np.diff(np.vstack([edges, levels, edges]), axis=0)
