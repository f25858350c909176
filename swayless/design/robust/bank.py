"""Rows that share a range of frequencies: as few as a tolerance allows, or as exact as their number allows.

Who designs a row, in continuous time or on ticks, is a `RowDesigner`; where rows must overlap is one mapping.
Not for: rope lengths, knobs and hysteresis (`swayless.machine`), nor for single rows (`rows`).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from swayless.design.robust.chain import Chain, Walk, is_too_long, next_start, same
from swayless.design.robust.crossing import crossing
from swayless.design.robust.demand import TOLERANCES, WIDEST_RATIO, NotHeldError
from swayless.design.robust.rows import ContinuousRows, Row, RowDesigner, TickRows
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import Band

__all__ = ["MOST_ROWS", "ContinuousRows", "RowDesigner", "TickRows", "cover", "cover_with"]

MOST_ROWS = 8
"""Positions of a knob, which no bank exceeds."""

_ON_TIME = 1e-9  # relative: a row this little longer, or looser, than allowed is so by rounding
_EQUAL = 1e-9  # of the last row's excess: the rest of it is not used
_APART = 1e-4  # relative, of tolerances between which the bank jumps to another one, as labels do
_STEEPNESS = 0.5  # a usual d log(duration) / d log(tolerance), of the first steps
_UNBALANCED = 1e-6  # relative: rows on ticks are balanced until they leave the same to this
_BALANCING_ROUNDS = 3
_JUMPED = 1e-5  # of the last row's excess: more of it shows a jump, which nothing balances
_LONGER = (1.03, 1.1, 1.2, 1.4, 1.8, 2.6, 4.0, 7.0, 12.0, 20.0)
"""How many times as long a duration is tried for a message."""


def ignore(_: int) -> None:
    """Report nothing."""


def cover(
    low_hz: float,
    high_hz: float,
    rows: RowDesigner[Row],
    *,
    tolerance: float = 0.05,
    duration_s: float | None = None,
    longest_duration_s: float | None = None,
    next_start_hz: Callable[[float], float] = same,
    on_row: Callable[[int], None] = ignore,
) -> tuple[Row, ...]:
    """Cover a range of frequencies with the fewest rows that hold a tolerance.

    Each row starts where the one before lets it, and reaches as far as any can. No bank has fewer rows: a row
    that starts lower reaches no farther.

    Parameters
    ----------
    low_hz, high_hz : float
        The range, 0 < low_hz <= high_hz.
    rows : RowDesigner
        `ContinuousRows` or `TickRows`.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    duration_s : float, optional
        Duration of all rows, > 0. The last row, which need not reach so far, leaves the least instead, down
        to 1 %; if it can leave even that, it reaches beyond the range.
    longest_duration_s : float, optional
        Duration of all rows but the last, which is as short as what is left allows. Give one of the two.
    next_start_hz : callable
        Where a row must start, of where the one before ends: lower, if rows must overlap. It must not fall.
    on_row : callable
        Called with the number of rows whenever one is done.

    Returns
    -------
    tuple
        Rows by rising frequency.

    Raises
    ------
    DesignError
        If a value is out of range, the duration does not suit, or more than 8 rows were needed.

    References
    ----------
    Kriikku, Singer and Singhose (1997), section III, steps 1 to 5.

    Examples
    --------
    >>> rows = cover(0.5, 1.0, ContinuousRows("bounded"), duration_s=1.2)
    >>> [round(row.shaper.guarantee.band.high_hz, 3) for row in rows]
    [0.721, 1.0]
    """
    given_s = longest_duration_s if duration_s is None else duration_s
    if given_s is None or (duration_s is not None and longest_duration_s is not None):
        raise DesignError("a bank needs either duration_s or longest_duration_s")
    design_rest = _shortest_rest if duration_s is None else _least_rest
    allowed_s, start_hz, made = rows.usable_s(given_s), Band(low_hz, high_hz).low_hz, list[Row]()
    while True:
        rest = design_rest(rows, Band(start_hz, high_hz), tolerance, allowed_s)
        made.append(rows.widest(allowed_s, start_hz, tolerance) if rest is None else rest)
        on_row(len(made))
        end_hz = rows.promise_of(made[-1]).band.high_hz
        if rest is not None or end_hz >= high_hz:
            return tuple(made)
        if len(made) == MOST_ROWS:
            chain = Chain(rows.ideal, low_hz, high_hz, next_start_hz)
            raise DesignError(_too_many(chain, tolerance, allowed_s))
        start_hz = next_start(next_start_hz, start_hz, end_hz)


def cover_with(
    number: int,
    low_hz: float,
    high_hz: float,
    rows: RowDesigner[Row],
    *,
    duration_s: float,
    next_start_hz: Callable[[float], float] = same,
    on_row: Callable[[int], None] = ignore,
) -> tuple[Row, ...]:
    """Cover a range of frequencies with a number of rows at the smallest equal tolerance.

    Parameters
    ----------
    number : int
        Of rows, 1 to 8.
    low_hz, high_hz : float
        The range, 0 < low_hz <= high_hz.
    rows : RowDesigner
        `ContinuousRows`, or `TickRows`: then the rows are balanced by what their taps leave.
    duration_s : float
        Duration of all rows, > 0.
    next_start_hz, on_row
        As for `cover`.

    Returns
    -------
    tuple
        Rows by rising frequency. The tolerance of the bank is the largest of theirs.

    Raises
    ------
    DesignError
        If a value is out of range, or the smallest tolerance is not between 0.01 and 0.2.

    Examples
    --------
    >>> rows = cover_with(2, 0.5, 1.0, ContinuousRows("bounded"), duration_s=1.1)
    >>> [round(row.shaper.guarantee.tolerance, 4) for row in rows]
    [0.0769, 0.0769]
    """
    if not 1 <= number <= MOST_ROWS:
        raise DesignError(f"rows = {number!r}: must be 1 to {MOST_ROWS}")
    chain, allowed_s = (
        Chain(rows.ideal, Band(low_hz, high_hz).low_hz, high_hz, next_start_hz),
        rows.usable_s(duration_s),
    )
    handicap = np.zeros(number)  # log of what the taps of a row leave, over what the ideal row does
    banks: list[tuple[float, tuple[Row, ...]]] = []
    size, near = math.log(TOLERANCES[0]), _EQUAL
    for _ in range(_BALANCING_ROUNDS):
        size, (designs, rest, excess) = _least_tolerance(chain, handicap, allowed_s, size, near)
        made = list[Row]()
        for design in designs:
            made.append(rows.follow(design))
            on_row(len(made))
        made.append(_least_rest(rows, rest, TOLERANCES[1], allowed_s) or rows.least(allowed_s, rest))
        on_row(number)
        sizes = np.log([rows.promise_of(row).tolerance for row in made])
        banks.append((float(sizes.max()), tuple(made)))
        if np.ptp(sizes) < _UNBALANCED or excess < -_JUMPED:
            break
        handicap += sizes - size
        size, near = min(size, 2.0 * float(sizes.min()) - size), max(_EQUAL, 0.01 * float(np.ptp(sizes)))
    return min(banks, key=lambda bank: bank[0])[1]


def _least_tolerance(
    chain: Chain, handicap: FloatArray, duration_s: float, start: float, near: float
) -> tuple[float, Walk]:
    """Log of the smallest tolerance, from a start, at which so many rows cover the range; and these rows."""
    walks: dict[float, Walk] = {}

    def excess(size: float) -> float:
        walks[size] = chain.walk(np.exp(size - handicap).tolist(), duration_s)
        return walks[size].excess

    highest = TOLERANCES[1]
    size = crossing(excess, start, math.log(highest), steepness=_STEEPNESS, near=near, apart=_APART)
    what = f"rows = {handicap.size}: {duration_s:g} s hold {chain.low_hz:g} to {chain.high_hz:g} Hz"
    if size is None:
        raise DesignError(f"{what} not even at {highest:g}; more rows or a longer duration do")
    if walks[size].excess == -math.inf:
        raise DesignError(f"{what} at {math.exp(size):.4g} already; fewer rows or a shorter duration do")
    return size, walks[size]


def _fits(rows: RowDesigner[Row], rest: Band, tolerance: float, duration_s: float) -> bool:
    """Whether one row of a duration, in continuous time, holds all that is left."""
    narrow = rest.high_hz <= WIDEST_RATIO * rest.low_hz
    return narrow and rows.ideal.excess(duration_s, rest, tolerance) <= _ON_TIME


def _shortest_rest(
    rows: RowDesigner[Row], rest: Band, tolerance: float, longest_duration_s: float
) -> Row | None:
    """Design the shortest row for all that is left, if it is short enough."""
    if rest.high_hz > WIDEST_RATIO * rest.low_hz:
        return None
    try:
        ideal_s = rows.ideal.shortest(rest, tolerance).shaper.duration_s
    except NotHeldError:  # by so many impulses
        return None
    if ideal_s > longest_duration_s * (1.0 + _ON_TIME):
        return None
    row = rows.shortest(rest, tolerance)
    return row if rows.duration_s_of(row) <= longest_duration_s * (1.0 + _ON_TIME) else None


def _least_rest(rows: RowDesigner[Row], rest: Band, tolerance: float, duration_s: float) -> Row | None:
    """Design the row that leaves the least over all that is left, if that is little enough.

    Where it could leave less than the smallest tolerance it reaches farther instead.
    """
    if not _fits(rows, rest, tolerance, duration_s):
        return None
    if _fits(rows, rest, TOLERANCES[0], duration_s):
        if is_too_long(rows.ideal, rest.low_hz, TOLERANCES[0], duration_s):
            raise DesignError(
                f"duration_s = {duration_s:g}: a row from {rest.low_hz:g} Hz holds {WIDEST_RATIO:g} times "
                f"that at {TOLERANCES[0]:g} in less; a shorter duration does, or a longest one instead of a "
                "fixed one"
            )
        row = rows.widest(duration_s, rest.low_hz, TOLERANCES[0])
        if rows.promise_of(row).band.high_hz >= rest.high_hz:
            return row
    row = rows.least(duration_s, rest)
    return row if rows.promise_of(row).tolerance <= tolerance * (1.0 + _ON_TIME) else None


def _too_many(chain: Chain, tolerance: float, duration_s: float) -> str:
    """Say what would do where a knob has too few positions: the first of a few longer durations that does."""
    what = f"{chain.low_hz:g} to {chain.high_hz:g} Hz at {tolerance:g}: more than {MOST_ROWS} rows of "
    for longer in _LONGER:
        digit = 10.0 ** (math.floor(math.log10(longer * duration_s)) - 1)
        enough_s = math.ceil(longer * duration_s / digit) * digit
        if chain.walk([tolerance] * MOST_ROWS, enough_s).excess <= 0.0:
            break
    else:
        return f"{what}{duration_s:g} s; a longer duration or a larger tolerance needs fewer"
    return f"{what}{duration_s:g} s; {MOST_ROWS} rows of {enough_s:g} s do, or a larger tolerance"
