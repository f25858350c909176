"""Designs that hold a tolerance at every damping ratio of a range, not at its ends alone.

What lies between the ends is worst at the edges of the bands (`damping_range`): points there are added to
what is asked for until none is above the tolerance. Not for: single damping ratios.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from swayless.design.damping_range import worst_on_arc
from swayless.design.robust.lines import Line
from swayless.design.robust.stationary import Optimum
from swayless.design.shaper import FloatArray

_ROUNDS = 6  # two are usual: a point that is added too far off is off by little
_TOUCH = 1e-8  # relative


class _Impulses(NamedTuple):
    """Impulses whose times are in periods of the lowest frequency, as frequencies are in its units."""

    times_s: FloatArray
    amplitudes: FloatArray


def with_points_between(
    lines: Sequence[Line], solve: Callable[[Sequence[Line]], Optimum]
) -> tuple[Optimum, list[Line]]:
    """Solve for lines at the ends of a damping range, and for as many points between as it takes.

    Parameters
    ----------
    lines : sequence of Line
        Every band at the lowest and at the highest damping ratio.
    solve : callable
        From lines to the optimum for them.

    Returns
    -------
    Optimum
        The last one; it may stand above its worst between the lines by next to nothing, which its owner has
        to look at.
    list of Line
        What it holds: a design that leaves no more on these lines is one of no more than the range.
    """
    ends = min(line.damping_ratio for line in lines), max(line.damping_ratio for line in lines)
    edges = {edge for line in lines for edge in (line.low, line.high)} if ends[0] < ends[1] else set()
    held, optimum = list(lines), solve(lines)
    for _ in range(_ROUNDS):
        impulses = _Impulses(optimum.times, optimum.amplitudes)
        peaks = [(edge, worst_on_arc(impulses, edge, ends)) for edge in sorted(edges)]
        over = [(edge, peak) for edge, peak in peaks if peak.ratio > optimum.worst * (1.0 + _TOUCH)]
        if not over:
            break
        held += [Line(edge, edge, peak.damping_ratio) for edge, peak in over]
        optimum = solve(held)
    return optimum, held
