"""Banks of a given number of rows that are over soonest, from one frontier.

Not for: banks of a given duration (`swayless.design.robust.bank`).
"""

from __future__ import annotations

from bisect import bisect_left

import numpy as np
from numpy.typing import NDArray

from swayless.design.shaper import FloatArray
from swayless.design.tradeoff.frontier import Frontier
from swayless.errors import DesignError

STEPS = 48
"""Equal steps of the logarithm of the frequency between which rows may switch."""

_ON_TIME = 1e-9  # relative: what differs this little is the same, by rounding


def range_steps(ratio: float) -> FloatArray:
    """Frequencies where rows may begin and end, over the lowest: shape (`STEPS` + 1,), 1 to `ratio`."""
    return np.geomspace(1.0, ratio, STEPS + 1)


def shortest_split(number: int, steps: FloatArray, front: Frontier) -> FloatArray:
    """Split a range among a number of rows so that the longest row is as short as the steps allow.

    A row that starts at k times the lowest frequency lasts 1 / k times as long as one of the same ratio that
    starts there: one frontier tells all durations. For a longest duration the rows that reach farthest are
    the best, and the shortest such duration is one of those that rows can have.

    Parameters
    ----------
    number : int
        Number of rows.
    steps : ndarray, shape (n,)
        Where rows may begin and end, over the lowest frequency: a geometric progression from 1.
    front : Frontier
        Of these ratios, the first left out; one that is missing is served by the next.

    Returns
    -------
    ndarray, shape (number + 1,)
        Ends of the rows over the lowest frequency, from 1 up.

    Raises
    ------
    DesignError
        If fewer rows are over as soon.

    Examples
    --------
    >>> from swayless.design.tradeoff.frontier import frontier
    >>> steps = range_steps(2.0)
    >>> shortest_split(2, steps, frontier(0.5, steps[1:])).round(2)
    array([1.  , 1.19, 2.  ])
    """
    serves = np.searchsorted(front.ratios, steps[1:] * (1.0 - _ON_TIME))
    durations = front.durations_s[serves] * front.low_hz
    relative, starts = np.maximum.accumulate(durations), steps[:-1]  # level over stretches, to rounding
    possible: list[float] = np.unique(np.divide.outer(relative, starts)).tolist()
    least = bisect_left(
        range(len(possible) - 1),
        True,
        key=lambda index: _row_starts(possible[index], relative, starts).size <= number,
    )
    chosen = _row_starts(possible[least], relative, starts)
    if chosen.size < number:
        raise DesignError(f"{number} rows: {chosen.size} are over as soon")
    return np.append(starts[chosen], steps[-1])


def _row_starts(longest: float, relative: FloatArray, starts: FloatArray) -> NDArray[np.intp]:
    """Find the steps at which rows begin that reach as far as a longest duration allows."""
    reach = np.searchsorted(relative, longest * starts * (1.0 + _ON_TIME), side="right")
    begins = [0]
    while (end := begins[-1] + reach[begins[-1]]) < starts.size:
        if end == begins[-1]:
            return np.arange(starts.size + 1)  # too short for a single step: more rows than there are
        begins.append(end)
    return np.array(begins)
