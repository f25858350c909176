"""The stop: inputs, linear in the state in which an abort finds the plant, that bring it to rest.

What is least is a sum of squares: of the input's distance from the one that holds at the end, as a share of
the limits' width, and, where the rate is limited, of its changes, as shares of that limit. By itself the
input would return so to the one that holds, at once where the rate has no limit; the stop adds the least that
brings the plant to rest, and rests where that is least.

Not for: moves to a target.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from swayless.design.playing.shape_model import ShapeModel
from swayless.design.shaper import FloatArray

_STRIDE = 16  # of the aborts by which lengths are rejected, before all are tried
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
    """

    gains: FloatArray
    rest: FloatArray

    def of(self, known: FloatArray) -> FloatArray:
        """Give inputs, shape (m, k), of stops from v, shape (states + 1, k)."""
        return np.asarray(self.gains @ known)


def shortest_stop(model: ShapeModel, shape: FloatArray, limits: ShapeLimits) -> Stop | None:
    """Find the length of a stop at which it keeps the limits wherever the move itself would last longer.

    After an abort with no more ticks left than a stop has, the move goes on to its end: it rests no later.

    Parameters
    ----------
    model : ShapeModel
    shape : ndarray, shape (n,)
        Input of a move by 1 from rest, within the limits.
    limits : ShapeLimits

    Returns
    -------
    Stop or None
        Of m ticks, where one of m - 1 would break a limit, or have fewer ticks than there are conditions of
        rest. None where nothing is gained: after the first tick the move is over as soon as a stop would be.

    Examples
    --------
    A mass is pushed for three ticks and braked for three. After an abort at tick 1 or 2 it is stopped in
    three; from tick 3 on the move itself is over in three:

    >>> from swayless.design.optimal import LinearPlant
    >>> from swayless.design.playing.shape_model import shape_model
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> shape = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    >>> stop = shortest_stop(shape_model(mass, 1.0), shape, ShapeLimits(-1.1, 1.1))
    >>> stop.gains.round(12) + 0.0
    array([[ 0.        , -0.33333333,  0.        ],
           [ 0.        , -0.33333333,  0.        ],
           [ 0.        , -0.33333333,  0.        ]])
    """
    known = np.vstack([model.states(shape)[1:-1].T, shape[:-1]])
    below, ticks = model.final.size - 1, model.final.size
    found, beyond = None, known.shape[1]
    while ticks < beyond and (found := _keeping(model, known, limits, ticks)) is None:
        below, ticks = ticks, 2 * ticks
    ticks = min(ticks, beyond)
    while ticks - below > 1:
        middle = (below + ticks) // 2
        tried = _keeping(model, known, limits, middle)
        if tried is None:
            below = middle
        else:
            ticks, found = middle, tried
    return found


def _keeping(model: ShapeModel, known: FloatArray, limits: ShapeLimits, ticks: int) -> Stop | None:
    """Give the stop of a length if it keeps the limits after every abort that has more ticks left."""
    try:
        stop = _stop_of(model, limits, ticks)
    except np.linalg.LinAlgError:
        return None  # so short that conditions cannot be told apart
    early = known[:, : stops_needed(known.shape[1] + 1, ticks)]
    # Of aborts a few first: most lengths that are too short are found so.
    for aborts in (early[:, ::_STRIDE], early):
        for begin, end in blocks(aborts.shape[1], ticks):
            if not (_shares(stop, aborts[:, begin:end], model, limits) <= 1.0).all():
                return None
    return stop


def stops_needed(move_ticks: int, stop_ticks: int) -> int:
    """Count the ticks 1, 2, ... at which an abort begins a stop, as the move would last longer.

    Examples
    --------
    A move of 6 ticks has 5 left at tick 1:

    >>> stops_needed(6, 3), stops_needed(6, 5)
    (2, 0)
    """
    return max(0, move_ticks - 1 - stop_ticks)


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
    return Stop(held * rest + np.outer(itself, last - held * rest) + added @ prices, rest)


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
