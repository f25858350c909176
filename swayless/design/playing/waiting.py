"""Ranges of ticks in which a stop may begin, and how long an abort takes that waits for one of them.

Not for: which ticks those are (`stopping`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

LEAST_CHANGE_RATIO = 0.01
"""Of the move: ranges without which no abort takes longer by more are left out."""


def ranges_of(ticks: ArrayLike) -> NDArray[np.int64]:
    """Give first and last tick of each run of ticks, shape (r, 2).

    Parameters
    ----------
    ticks : array_like of int, shape (k,)
        Rising.

    Examples
    --------
    >>> ranges_of([1, 2, 3, 7, 9, 10]).tolist()
    [[1, 3], [7, 7], [9, 10]]
    """
    rising = np.asarray(ticks, dtype=np.int64)
    first = np.diff(rising, prepend=-1) > 1
    return np.column_stack([rising[first], rising[np.roll(first, -1)]])


def ticks_of(ranges: NDArray[np.int64]) -> NDArray[np.int64]:
    """Give every tick of some ranges, shape (k,).

    Examples
    --------
    >>> ticks_of(ranges_of([1, 2, 3, 7, 9, 10])).tolist()
    [1, 2, 3, 7, 9, 10]
    """
    lengths = ranges[:, 1] - ranges[:, 0] + 1
    before = np.cumsum(lengths) - lengths
    return np.asarray(np.repeat(ranges[:, 0] - before, lengths) + np.arange(lengths.sum()))


def ticks_to_rest(ranges: NDArray[np.int64], stop_ticks: int, move_ticks: int) -> NDArray[np.int64]:
    """Give how long an abort at each of the ticks 1 .. n - 1 takes, shape (n - 1,).

    The move goes on to the next tick in which a stop may begin, or to its end where that is sooner.

    Parameters
    ----------
    ranges : ndarray of int, shape (r, 2)
        First and last tick of each, rising; none where there are no stops.
    stop_ticks : int
        Length of a stop, m.
    move_ticks : int
        Length of the move, n.

    Examples
    --------
    A move of 9 ticks, and stops of 2 that may begin at ticks 1 and 4:

    >>> ticks_to_rest(ranges_of([1, 4]), 2, 9).tolist()
    [2, 4, 3, 2, 4, 3, 2, 1]
    """
    aborts = np.arange(1, move_ticks)
    next_range = np.searchsorted(ranges[:, 1], aborts)
    begins = np.maximum(np.append(ranges[:, 0], move_ticks)[next_range], aborts)
    return np.asarray(np.minimum(move_ticks, begins + stop_ticks) - aborts)


def fewer_ranges(ranges: NDArray[np.int64], stop_ticks: int, move_ticks: int) -> NDArray[np.int64]:
    """Leave out ranges, the shortest first, without which no abort takes much longer, nor the worst one.

    Much is `LEAST_CHANGE_RATIO` of the move.

    Parameters
    ----------
    ranges : ndarray of int, shape (r, 2)
    stop_ticks, move_ticks : int
        As of `ticks_to_rest`.

    Examples
    --------
    An abort at tick 18 need not wait for tick 20; without stops from there on it takes two ticks longer:

    >>> fewer_ranges(ranges_of([*range(1, 18), 20, *range(22, 60)]), 90, 200).tolist()
    [[1, 17], [22, 59]]
    """
    now = ticks_to_rest(ranges, stop_ticks, move_ticks)
    longest = np.minimum(now + int(LEAST_CHANGE_RATIO * move_ticks), now.max(initial=0))
    for each in ranges[np.argsort(ranges[:, 1] - ranges[:, 0], kind="stable")]:
        without = ranges[ranges[:, 0] != each[0]]
        if (ticks_to_rest(without, stop_ticks, move_ticks) <= longest).all():
            ranges = without
    return ranges
