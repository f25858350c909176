"""How many points a curve needs, and when it is no figure any more. Not for: what is drawn."""

from __future__ import annotations

import math

from swayless.errors import DesignError

FEWEST_POINTS = 801
MOST_POINTS = 200_000
"""More points than this are no figure any more: what asks for them is refused."""

_POINTS_PER_CYCLE = 64


def point_count(cycles: float, what: str) -> int:
    """Points that a curve of so many oscillations needs to look smooth.

    Raises
    ------
    DesignError
        If that is more than `MOST_POINTS`; `what` names in the message what is too wide.

    Examples
    --------
    >>> point_count(100.0, "a move of 400 s")
    6400
    """
    most = MOST_POINTS // _POINTS_PER_CYCLE
    if not cycles <= most:
        raise DesignError(f"{what} holds {cycles:.6g} oscillations: a figure shows at most {most}")
    return max(FEWEST_POINTS, math.ceil(cycles * _POINTS_PER_CYCLE))
