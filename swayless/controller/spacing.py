"""How many ticks the impulses of a shaper are apart, over a position: a table of whole numbers.

The natural frequency of a crane depends on its rope length, that of an arm on its joint angle. Impulses half
a damped period apart are as many whole ticks apart as fit in. Not for: the taps (`spaced_taps`).
"""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.controller.number import NumberType, as_written
from swayless.controller.rope import MM_PER_M
from swayless.errors import ControllerError
from swayless.plant import STANDARD_GRAVITY_M_S2

MOST_SPACING_TICKS = 1 << 15
"""Widest spacing: the longest delay of eight impulses fits a ring that a controller has room for."""


@dataclass(frozen=True)
class Spacing:
    """Whole ticks between impulses over a position, constant between the positions where they change.

    Parameters
    ----------
    starts : tuple of float or int
        Where each piece begins, increasing, in the number type; a position before the first counts as there.
    ticks : tuple of int
        Spacing of each piece, 1 to `MOST_SPACING_TICKS`.

    Raises
    ------
    ControllerError
        If an invariant does not hold.
    """

    starts: tuple[Any, ...]
    ticks: tuple[int, ...]

    def __post_init__(self) -> None:
        if not 0 < len(self.starts) == len(self.ticks):
            raise ControllerError("spacing: at least one piece, as many starts as spacings")
        if any(low >= high for low, high in pairwise(self.starts)):
            raise ControllerError("spacing: pieces must start at increasing positions")
        check_spacings(self.least, self.most)

    def at(self, position: Any) -> int:
        """Spacing at a position.

        Examples
        --------
        >>> spacing = Spacing((3.0, 4.5, 7.0), (4, 5, 6))
        >>> spacing.at(4.4), spacing.at(4.5), spacing.at(99.0), spacing.at(0.0)
        (4, 5, 6, 4)
        """
        return self.ticks[max(bisect_right(self.starts, position) - 1, 0)]

    @property
    def least(self) -> int:
        """Narrowest spacing."""
        return min(self.ticks)

    @property
    def most(self) -> int:
        """Widest spacing."""
        return max(self.ticks)


def check_spacings(least_ticks: float, most_ticks: float) -> None:
    """Refuse spacings that are shorter than a tick or too long.

    Raises
    ------
    ControllerError
        If one is.
    """
    if not 1 <= least_ticks <= most_ticks < MOST_SPACING_TICKS + 1:
        raise ControllerError(
            f"spacing of {least_ticks:.6g} to {most_ticks:.6g} ticks: allowed are 1 to {MOST_SPACING_TICKS}; "
            "the tick is too coarse or too fine for the vibration"
        )


def rope_spacing(
    rope_length_m: tuple[float, float], damping_ratio: float, *, tick_s: float, number: NumberType
) -> Spacing:
    """Spacing over the rope length of a pendulum.

    Parameters
    ----------
    rope_length_m : tuple of float
        Shortest and longest.
    damping_ratio : float
        The same on every rope, 0 <= damping_ratio < 1.
    tick_s : float
        Length of a tick.
    number : NumberType
        Type of the positions; in int32 they are in mm.

    Raises
    ------
    ControllerError
        If half a period is shorter than a tick, or too long.

    References
    ----------
    Magee and Book, eqs 26 and 27.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> spacing = rope_spacing((3.0, 9.0), 0.0, tick_s=0.1, number=number_type("double"))
    >>> spacing.least, spacing.at(4.0), spacing.most  # pi sqrt(L / g) is 1.74, 2.01 and 3.01 s
    (17, 20, 30)
    """
    damped = math.sqrt(1.0 - damping_ratio**2)
    ends = np.pi * np.sqrt(np.array(rope_length_m) / STANDARD_GRAVITY_M_S2) / damped / tick_s
    check_spacings(*ends.tolist())
    ticks = np.arange(math.floor(ends[0]), math.floor(ends[1]) + 1)
    starts_m = STANDARD_GRAVITY_M_S2 * (ticks * (tick_s * damped / np.pi)) ** 2
    starts_m[0] = rope_length_m[0]
    return Spacing(_in_type(starts_m, number), tuple(ticks.tolist()))


def sampled_spacing(
    positions: ArrayLike,
    frequency_hz: ArrayLike,
    damping_ratio: float,
    *,
    tick_s: float,
    number: NumberType,
) -> Spacing:
    """Spacing over any position, from frequencies at some of them; straight between.

    Parameters
    ----------
    positions : array_like, shape (n,)
        Increasing, in m, or in rad for a joint; in int32 they become thousandths.
    frequency_hz : array_like, shape (n,)
        Undamped natural frequencies, > 0.
    damping_ratio : float
        The same everywhere, 0 <= damping_ratio < 1.
    tick_s : float
        Length of a tick.
    number : NumberType
        Type of the positions.

    Raises
    ------
    ControllerError
        If the positions do not increase, a frequency is not positive, or a spacing is out of range.

    References
    ----------
    Magee and Book, eqs 26 and 27.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> double = number_type("double")
    >>> arm = sampled_spacing([0.0, 1.0], [3.7, 5.5], 0.0, tick_s=0.02, number=double)
    >>> arm.ticks, [round(start, 4) for start in arm.starts]
    ((6, 5, 4), [0.0, 0.2593, 0.7222])
    """
    places, hertz = np.asarray(positions, dtype=np.float64), np.asarray(frequency_hz, dtype=np.float64)
    if places.ndim != 1 or places.shape != hertz.shape or places.size < 2 or np.any(np.diff(places) <= 0):
        raise ControllerError("positions: at least two, increasing, as many as frequencies")
    if not hertz.min() > 0.0:
        raise ControllerError(f"frequency_hz = {float(hertz.min())!r}: must be > 0")
    per_hertz = 1.0 / (2.0 * math.sqrt(1.0 - damping_ratio**2) * tick_s)
    with np.errstate(over="ignore"):
        check_spacings(float(per_hertz / hertz.max()), float(per_hertz / hertz.min()))
    bounds = per_hertz / np.arange(math.floor(per_hertz / hertz.max()), per_hertz / hertz.min() + 1.0)[1:]
    rises = np.diff(hertz)
    rises[rises == 0.0] = np.nan
    shares = (bounds[:, np.newaxis] - hertz[:-1]) / rises
    crossings = (places[:-1] + shares * np.diff(places))[(shares >= 0.0) & (shares < 1.0)]
    starts = np.unique(np.concatenate([places[:1], crossings]))
    middles = 0.5 * (starts + np.append(starts[1:], places[-1]))
    ticks = np.floor(per_hertz / np.interp(middles, places, hertz)).astype(int)
    changes = np.concatenate([[True], ticks[1:] != ticks[:-1]])
    return Spacing(_in_type(starts[changes], number), tuple(ticks[changes].tolist()))


def _in_type(starts: NDArray[np.float64], number: NumberType) -> tuple[Any, ...]:
    """Bring positions into a number type; a whole number belongs to the piece that has begun."""
    if number.is_integer:
        return tuple(math.ceil(as_written(start) * MM_PER_M) for start in starts.tolist())
    return tuple(number.scalar(start) for start in starts.tolist())
