"""What a bank leaves open: intervals and the gaps between them. Not for: what is held inside them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from swayless.errors import DesignError

Range = tuple[float, float]

TOUCHING_RATIO = 1e-9
"""Ranges closer to each other than this ratio of the whole touch: designs are stored to 12 digits."""


def uncovered(ranges: Iterable[Range], whole: Range) -> list[Range]:
    """Find the gaps: the parts of `whole` that no range covers, in rising order.

    Parameters
    ----------
    ranges : iterable of (low, high)
        In any order; they may overlap, touch, and reach beyond the whole.
    whole : (low, high)
        What should be covered, low < high.

    Returns
    -------
    list of (low, high)
        Gaps, each wider than `TOUCHING_RATIO` of the whole.

    Raises
    ------
    DesignError
        If a range or the whole is not finite or falls.

    Examples
    --------
    >>> uncovered([(7.0, 12.0), (1.0, 3.0), (2.0, 4.0)], (0.0, 10.0))
    [(0.0, 1.0), (4.0, 7.0)]
    """
    low, high = whole
    pairs = np.array([whole, *ranges])
    wrong = ~(np.isfinite(pairs).all(axis=1) & (pairs[:, 0] <= pairs[:, 1]))
    if wrong.any() or not low < high:
        raise DesignError(f"range {tuple(pairs[wrong.argmax()].tolist())}: must be finite and rise")
    pairs = pairs[1:][np.argsort(pairs[1:, 0])]
    starts = np.concatenate([[low], np.maximum.accumulate(pairs[:, 1])]).clip(low, high)
    ends = np.append(pairs[:, 0], high).clip(low, high)
    open_gaps = ends - starts > TOUCHING_RATIO * (high - low)
    return list(zip(starts[open_gaps].tolist(), ends[open_gaps].tolist(), strict=True))
