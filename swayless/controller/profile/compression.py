"""The smallest pieces for a table of values. Not for: playing them (`pieces`, `table`)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from swayless.controller.number import NumberType
from swayless.controller.profile.pieces import LARGEST_DEGREE, LARGEST_LENGTH, Pieces, dtype_of
from swayless.design.shaper import FloatArray

TOLERANCE_RATIO = {"double": 2.0**-40, "float": 2.0**-22}
"""How far pieces may be off, of the largest value: in double the twelfth decimal, in float two units of the
last place.
"""

TABLE_RATIOS = {"double": (TOLERANCE_RATIO["double"], 2.0**-36), "float": (TOLERANCE_RATIO["float"],)}
"""The same, of the table of a command, the finest first. A command is kept to twelve digits: where a value
begins with a 1, rounding is up to five of the twelfth decimal, and no polynomial comes nearer.
"""

_SAMPLES = 64
_POWERS = np.array(
    [
        np.append(chebyshev.cheb2poly(np.eye(degree + 1)[-1]), np.zeros(LARGEST_DEGREE - degree))
        for degree in range(LARGEST_DEGREE + 1)
    ]
)


def raw_pieces(values: FloatArray) -> Pieces:
    """Give the plain table: a piece for each tick."""
    return Pieces(np.ones(len(values), dtype=np.int64), values[:, np.newaxis])


def widest_tolerance(values: FloatArray, number: NumberType) -> float:
    """Give how far the pieces of a command may be off, in units of its values."""
    return float(TABLE_RATIOS[number.name][-1] * np.abs(values).max())


def compressed(
    values: FloatArray,
    number: NumberType,
    near_ratio: float,
    is_kept: Callable[[Pieces], bool] = lambda _: True,
) -> Pieces:
    """Find the smallest pieces that give all values within the tolerance.

    Parameters
    ----------
    values : ndarray, shape (n,) or (n, k)
        One, or a row, for each tick; numbers of the type.
    number : NumberType
        ``double`` or ``float``.
    near_ratio : float
        How far pieces may be off, of the largest value, such as `TOLERANCE_RATIO`.
    is_kept : callable
        Whether pieces keep what is promised, by the values that they give when played.

    Returns
    -------
    Pieces
        Of the degree, from 0 to 9, that takes the fewest bytes; the plain table where nothing is smaller.

    Examples
    --------
    A thousand ticks of switching, and as many of a cubic:

    >>> from swayless.controller.number import number_type
    >>> double = number_type("double")
    >>> compressed(np.repeat([1.0, -1.0], 500), double, 1e-12).lengths.tolist()
    [500, 500]
    >>> cubic = compressed(np.linspace(0.0, 1.0, 1000) ** 3, double, 1e-12)
    >>> cubic.lengths.tolist(), cubic.coefficients.round(12).tolist()
    ([1000], [[0.125, 0.375, 0.375, 0.125]])
    """
    near = near_ratio * float(np.abs(values).max())
    best = raw_pieces(values)
    # Switching first, it costs least to try; then the degrees that need the fewest pieces.
    for degree in (0, *range(LARGEST_DEGREE, 0, -1)):
        found = _greedy(values, degree, near, number, best.stored_bytes(number))
        if found is not None and is_kept(found):
            best = found
    return best


def _greedy(
    values: FloatArray, degree: int, near: float, number: NumberType, bytes_allowed: int
) -> Pieces | None:
    """Make each piece as long as it can be; None where that is not smaller than what is allowed."""
    ends = _ends(values, degree, near)
    piece_bytes = Pieces(np.array([2]), np.zeros((1, degree + 1, *values.shape[1:]))).stored_bytes(number)
    if _fewest(ends) * piece_bytes >= bytes_allowed:
        return None
    lengths: list[int] = []
    rows: list[FloatArray] = []
    begin = 0
    while begin < len(values):
        guess = lengths[-1] if lengths else len(values)
        row, length = _longest(values[begin : ends[begin]], degree, near, number, guess)
        rows.append(row)
        lengths.append(length)
        begin += length
        if len(rows) * piece_bytes >= bytes_allowed:
            return None
    return Pieces(np.array(lengths), np.array(rows))


def _ends(values: FloatArray, degree: int, near: float) -> NDArray[np.int64]:
    """Give where a piece that begins at each tick ends at the latest, shape (n,).

    Differences of order d + 1 vanish on a polynomial of degree d, and of what is `near` it have at most
    2**(d + 1) times that: where one is larger a piece must end.
    """
    order, size = degree + 1, len(values)
    bent = np.abs(np.diff(values, order, axis=0)) > 1.1 * 2.0**order * near
    bends = np.append(np.flatnonzero(bent.reshape(len(bent), values[:1].size).any(axis=1)), size)
    ticks = np.arange(size)
    latest = bends[np.searchsorted(bends, ticks)] + order
    return np.asarray(np.minimum(np.minimum(latest, size), ticks + LARGEST_LENGTH))


def _fewest(ends: NDArray[np.int64]) -> int:
    """Count pieces that are all as long as can be: there are no fewer."""
    count = begin = 0
    while begin < ends.size:
        begin = int(ends[begin])
        count += 1
    return count


def _longest(
    values: FloatArray, degree: int, near: float, number: NumberType, guess: int
) -> tuple[FloatArray, int]:
    """Fit the longest piece that begins at the first value, by doubling from a guess, and bisection."""
    best, longest, beyond = _with_zeros(values[:1], degree), 1, len(values) + 1
    length = min(guess, len(values))
    while beyond - longest > 1:
        row = _fitted(values[:length], degree, near, number)
        if row is None:
            beyond = length
        else:
            best, longest = row, length
        length = min(2 * longest, (longest + beyond) // 2)
    return best, longest


def _fitted(values: FloatArray, degree: int, near: float, number: NumberType) -> FloatArray | None:
    """Fit one piece; None where a value that it plays is not near enough."""
    row = _least_squares(values, degree) if degree else 0.5 * (values.min(0) + values.max(0))[np.newaxis]
    row = row.astype(dtype_of(number)).astype(np.float64)
    played = Pieces(np.array([len(values)]), row[np.newaxis]).values(number)
    return row if (np.abs(played - values) <= near).all() else None


def _least_squares(values: FloatArray, degree: int) -> FloatArray:
    """Fit a polynomial near the Chebyshev points, where least squares come close to the least error."""
    last = len(values) - 1
    angles = np.linspace(0.0, np.pi, _SAMPLES)
    at = np.unique(np.round(0.5 * last * (1.0 - np.cos(angles))).astype(np.int64))
    few = min(degree, last)
    rows = chebyshev.chebvander(at * (2.0 / max(last, 1)) - 1.0, few)
    powers = _POWERS[: few + 1, : few + 1].T @ np.linalg.lstsq(rows, values[at])[0]
    return _with_zeros(powers, degree)


def _with_zeros(row: FloatArray, degree: int) -> FloatArray:
    return np.concatenate([row, np.zeros((degree + 1 - len(row), *row.shape[1:]))])
