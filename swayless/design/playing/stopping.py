"""The stop: inputs, linear in the state in which an abort finds the plant, that bring it to rest.

What is least is a sum of squares: of the input's distance from the one that holds at the end, as a share of
the limits' width, and, where the rate is limited, of its changes, as shares of that limit. By itself the
input would return so to the one that holds, at once where the rate has no limit; the stop adds the least that
brings the plant to rest, and rests where that is least.

Not for: moves to a target.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swayless.design.playing.shape_model import ShapeModel
from swayless.design.playing.waiting import fewer_ranges, ranges_of, ticks_to_rest
from swayless.design.shaper import FloatArray

_TRIED_ABORTS = 2000  # at most, while lengths are compared; of the best one all are
_RUNGS = 96  # of a ladder of lengths
_BLOCK = 1 << 22  # inputs of stops that are held in memory at once


@dataclass(frozen=True)
class ShapeLimits:
    """Limits of the input of a move by 1.

    Parameters
    ----------
    low, high : float
        Of the input less the one before the move; low <= 0 <= high, not both 0.
    change : float
        Largest change from tick to tick, > 0; infinite where the rate has no limit.
    """

    low: float
    high: float
    change: float = math.inf


@dataclass(frozen=True, eq=False)
class Stop:
    """Inputs linear in v: the states when the stop begins, and the input of the tick before.

    Parameters
    ----------
    gains : ndarray, shape (m, states + 1)
        Input of each tick.
    rest : ndarray, shape (states + 1,)
        Position of rest.
    ranges : ndarray of int, shape (r, 2)
        First and last tick of the move of each range in which it may begin, rising. From others a limit would
        break, it would rest beyond the target, or the move is over as soon.
    """

    gains: FloatArray
    rest: FloatArray
    ranges: NDArray[np.int64]

    @property
    def ticks(self) -> int:
        """Ticks that it lasts."""
        return len(self.gains)

    def of(self, known: FloatArray) -> FloatArray:
        """Give inputs, shape (m, k), of stops from v, shape (states + 1, k)."""
        return np.asarray(self.gains @ known)

    def rests(self, move_ticks: int) -> NDArray[np.int64]:
        """Give how long an abort at each tick of a move takes, as `ticks_to_rest`."""
        return ticks_to_rest(self.ranges, self.ticks, move_ticks)


def quickest_stop(model: ShapeModel, shape: FloatArray, limits: ShapeLimits) -> Stop | None:
    """Find the stop after which, and after waiting for which, aborts take least.

    An abort lets the move go on to the next tick from which the stop keeps the limits and rests between
    start and target, or to the end of the move where that is sooner. Least is the time that the worst abort
    takes to rest, and among equals the average one: a short stop may begin in few ticks, a long one takes its
    time from each.

    Parameters
    ----------
    model : ShapeModel
    shape : ndarray, shape (n,)
        Input of a move by 1 from rest, within the limits.
    limits : ShapeLimits

    Returns
    -------
    Stop or None
        None where every abort may as well go on to the end of the move.

    Examples
    --------
    A mass is pushed for three ticks and braked for three. After an abort at tick 1 or 2 it is stopped in
    two; from tick 3 on that would take more than the force that there is, and the move is over in three:

    >>> from swayless.design.optimal import LinearPlant
    >>> from swayless.design.playing.shape_model import shape_model
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> shape = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0]) / 9.0
    >>> stop = quickest_stop(shape_model(mass, 1.0), shape, ShapeLimits(-0.13, 0.13))
    >>> stop.gains.round(12) + 0.0
    array([[ 0. , -0.5,  0. ],
           [ 0. , -0.5,  0. ]])
    >>> stop.ranges.tolist(), stop.rests(6).tolist()
    ([[1, 2]], [2, 2, 3, 2, 1])
    """
    ticks = shape.size
    known = np.vstack([model.states(shape)[1:-1].T, shape[:-1]])
    every = -(-ticks // _TRIED_ABORTS)

    def cost(length: int) -> tuple[int, float]:
        stop = _keeping(model, known, limits, length, every)
        rests = np.arange(ticks - 1, 0, -1) if stop is None else stop.rests(ticks)
        return int(rests.max(initial=0)), float(rests.mean()) if rests.size else 0.0

    length = _least(cost, model.final.size, ticks - 2)
    found = None if length is None else _keeping(model, known, limits, length, 1)
    if found is None:
        return None
    fewer = fewer_ranges(found.ranges, found.ticks, ticks)
    return replace(found, ranges=fewer) if fewer.size else None


def _least(cost: Callable[[int], tuple[int, float]], low: int, high: int) -> int | None:
    """Find where a cost is least: on a ladder, then on finer ones between the neighbours of the best rung."""
    rungs = np.unique(np.geomspace(low, max(low, high), _RUNGS).astype(np.int64))[: max(0, high - low + 1)]
    costs: dict[int, tuple[int, float]] = {}
    best = None
    while not set(rungs.tolist()) <= costs.keys():
        costs.update({rung: cost(rung) for rung in rungs.tolist() if rung not in costs})
        tried = sorted(costs)
        best = min(tried, key=lambda rung: costs[rung])
        place = tried.index(best)
        around = tried[max(place - 1, 0)], tried[min(place + 1, len(tried) - 1)]
        rungs = np.unique(np.linspace(*around, _RUNGS).astype(np.int64))
    return best


def _keeping(
    model: ShapeModel, known: FloatArray, limits: ShapeLimits, length: int, every: int
) -> Stop | None:
    """Give the stop of a length, with the ticks from which it keeps the limits, of which some are tried."""
    try:
        stop = _stop_of(model, limits, length)
    except np.linalg.LinAlgError:
        return None  # so short that conditions cannot be told apart
    ticks = np.arange(1, known.shape[1] + 1 - length, every)
    kept = [
        ticks[begin:end][_is_kept(stop, known[:, ticks[begin:end] - 1], model, limits)]
        for begin, end in blocks(ticks.size, length)
    ]
    found = np.concatenate(kept) if kept else ticks
    return replace(stop, ranges=ranges_of(found)) if found.size else None


def _stop_of(model: ShapeModel, limits: ShapeLimits, ticks: int) -> Stop:
    """Solve for the stop of a length: the conditions of rest as constraints, in orthonormal form.

    Inputs are a = h q + (s - h q) f + x: q the position of rest, s the input before, f the return by itself.
    The conditions R x = C v - q e have orthonormal rows; the sum of squares has a tridiagonal matrix in x.

    References
    ----------
    Nocedal and Wright (2006), "Numerical optimization", section 16.2: the Schur-complement method.
    """
    from scipy.linalg import cholesky, qr, solveh_banded

    held, last = model.hold_ratio, np.eye(model.order + 1)[-1]
    width, changed = (limits.high - limits.low) ** -2.0, limits.change**-2.0
    bands = np.full((2, ticks), -changed)
    bands[1] = width + 2.0 * changed
    bands = bands[-min(2, ticks) :]  # of a single tick there is no neighbour
    itself = solveh_banded(bands, changed * np.eye(ticks, 1)[:, 0])
    through: FloatArray = model.kept @ model.system.reach(ticks)
    rows, triangle = qr(through.T, mode="economic")
    added = solveh_banded(bands, rows)
    half = cholesky(rows.T @ added, lower=True)
    moved = np.column_stack([-model.kept @ np.linalg.matrix_power(model.system.a, ticks), -through @ itself])
    moved = np.column_stack([moved, through @ (held * (1.0 - itself)) - model.final])
    # Both sides in the metric of the least sum of squares, so that the best q is a projection.
    whole: FloatArray = np.linalg.solve(triangle.T, moved)
    both = np.linalg.solve(half, whole)
    wanted, per_rest = both[:, :-1], both[:, -1]
    rest = per_rest @ wanted / (per_rest @ per_rest)
    prices = np.linalg.solve(half.T, wanted - np.outer(per_rest, rest))
    gains = held * rest + np.outer(itself, last - held * rest) + added @ prices
    return Stop(gains, rest, np.zeros((0, 2), dtype=np.int64))


def _is_kept(stop: Stop, known: FloatArray, model: ShapeModel, limits: ShapeLimits) -> NDArray[np.bool_]:
    """Whether each stop keeps the limits, and rests between start and target."""
    rests = stop.rest @ known
    return np.asarray((_shares(stop, known, model, limits) <= 1.0) & (rests >= 0.0) & (rests <= 1.0))


def _shares(stop: Stop, known: FloatArray, model: ShapeModel, limits: ShapeLimits) -> FloatArray:
    """Largest share of a limit that each stop takes, shape (k,); of inputs, from the middle of the limits."""
    inputs, held = stop.of(known), model.hold_ratio * (stop.rest @ known)
    middle, half = 0.5 * (limits.high + limits.low), 0.5 * (limits.high - limits.low)
    highest, lowest = np.maximum(inputs.max(axis=0), held), np.minimum(inputs.min(axis=0), held)
    shares = np.maximum(highest - middle, middle - lowest) / half
    if math.isfinite(limits.change):
        changes = np.abs(np.diff(np.vstack([known[-1], inputs, held]), axis=0)).max(axis=0)
        shares = np.maximum(shares, changes / limits.change)
    return np.asarray(shares)


def blocks(count: int, ticks: int) -> Iterator[tuple[int, int]]:
    """Give begin and end of ranges of aborts whose stops of so many ticks are small enough to hold."""
    size = max(1, _BLOCK // max(ticks, 1))
    for begin in range(0, count, size):
        yield begin, min(count, begin + size)
