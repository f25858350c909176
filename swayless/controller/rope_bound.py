"""Residual bound at the rope length of now: upper bounds of each row's residual vibration over the rope.

Over each piece of the rope's range the bound is proven. The residual vibration is the size of G(f) = sum A_i
exp((z + j sqrt(1 - z^2)) w (t_i - t_n)). Between two samples G is no farther from their chord than M h^2 / 8,
with h their distance and M a bound of |G''|, and no point of a chord is larger than both its ends. Over a
range of damping ratios the worst is on the border (`design.damping_range`). Pieces begin and end where the
row's guarantee does. Not for: a rope that is not to be believed; then nothing is known, and the bound is 1.
Nor for the ropes of a driven trolley, whose modes are not those of a pendulum.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from swayless.controller.number import NumberType
from swayless.controller.phase_taps import PhaseTaps
from swayless.controller.rope import MM_PER_M, RopeSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.controller.taps import Bank, Row
from swayless.design.damping_range import worst_on_arc
from swayless.design.residual import NEGLIGIBLE_AMPLITUDE, residual_vibration
from swayless.design.shaper import FloatArray, Impulses
from swayless.errors import ControllerError
from swayless.plant import STANDARD_GRAVITY_M_S2, pendulum_frequency_hz

PIECES = 32
"""Pieces of the rope's range, equal in the pendulum's period; and one more for each end of a guarantee."""

CHORD_EXCESS = 1e-6
"""How far samples are from each other: so that a chord may be off by no more than this."""

ROUNDING = 1e-9
"""Added to every bound: more than the rounding of sums of thousands of terms of size 1."""

RESIDUAL_PPM = 1_000_000
"""In int32 bounds are in millionths."""


@dataclass(frozen=True)
class RopeBounds:
    """Upper bounds of the residual vibration of each row, constant between some rope lengths.

    Parameters
    ----------
    starts : tuple of tuple
        Of rows 1 to n: rope lengths at which the pieces begin, rising, in m, in int32 in mm. A length below
        the first counts as there.
    bounds : tuple of tuple
        Of rows 1 to n: bound of each piece, a ratio, in int32 in millionths; above 1 where negative
        amplitudes may do worse than none.

    Raises
    ------
    ControllerError
        If an invariant does not hold.
    """

    starts: tuple[tuple[Any, ...], ...]
    bounds: tuple[tuple[Any, ...], ...]

    def __post_init__(self) -> None:
        if [len(row) for row in self.starts] != [len(row) for row in self.bounds] or () in self.starts:
            raise ControllerError("residual bounds: each row needs as many starts as bounds, at least one")
        if any(low >= high for row in self.starts for low, high in pairwise(row)):
            raise ControllerError("residual bounds: pieces must start at increasing rope lengths")

    def at(self, row: int, length: Any) -> Any:
        """Bound of a row, from 1, at a rope length.

        Examples
        --------
        >>> bounds = RopeBounds(((3.0, 4.0, 6.0),), ((0.2, 0.05, 0.4),))
        >>> [bounds.at(1, length) for length in (2.0, 3.9, 4.0, 9.0)]
        [0.2, 0.2, 0.05, 0.4]
        """
        return self.bounds[row - 1][max(bisect_right(self.starts[row - 1], length) - 1, 0)]


def rope_bounds(bank: Bank, rope: RopeSettings) -> RopeBounds | None:
    """Bound every row over the range of a measured rope.

    Parameters
    ----------
    bank : Bank
        Rows with delays in ticks, or spaced by the rope.
    rope : RopeSettings
        The rope.

    Returns
    -------
    RopeBounds or None
        None under the phase clock: its rows hold their guarantee on every rope.

    Raises
    ------
    ControllerError
        If what is measured is no rope, or rows hold several modes.

    Notes
    -----
    In int32 each piece is bounded to a mm beyond its ends: a reading stands for what it is rounded from.
    """
    if isinstance(bank.rows[0].taps, PhaseTaps):
        return None
    if not rope.measured.is_length:
        raise ControllerError(f"bounds over a measured {rope.measured.title}: only those of a rope are known")
    for row in bank.rows:
        if row.taps.guarantee.further_bands:
            raise ControllerError(f'row "{row.name}": holds several modes; bounds are those of one pendulum')
    rows = [_bounded(row, rope, bank.number) for row in bank.rows]
    return RopeBounds(tuple(starts for starts, _ in rows), tuple(bounds for _, bounds in rows))


class _Span(NamedTuple):
    """Rope lengths, in m, on which the same impulses run."""

    low_m: float
    high_m: float
    impulses: Impulses


class _SpacedImpulses(NamedTuple):
    """Impulses as they are while the rope is still."""

    times_s: FloatArray
    amplitudes: FloatArray


def _bounded(row: Row, rope: RopeSettings, number: NumberType) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Find where the pieces of one row start, and their bounds."""
    starts = _starts(row, rope, number)
    bounds = [
        max(_worst(span, row) for span in _spans(row, low, high, number))
        for low, high in pairwise((*starts, rope.longest))
    ]
    return starts, tuple(_upward(bound, number) for bound in bounds)


def _starts(row: Row, rope: RopeSettings, number: NumberType) -> tuple[Any, ...]:
    """Where pieces begin: equal steps of the period, and the ends of what the row guarantees."""
    roots = np.linspace(math.sqrt(rope.shortest), math.sqrt(rope.longest), PIECES + 1)[1:-1]
    lengths = (roots**2).tolist()
    per_m = MM_PER_M if number.is_integer else 1
    band = row.taps.guarantee.band
    for frequency_hz, towards in ((band.high_hz, math.inf), (band.low_hz, -math.inf)):
        end = STANDARD_GRAVITY_M_S2 / (2.0 * math.pi * frequency_hz) ** 2 * per_m
        lengths.append(_inward(end, towards, number))
    found = {math.ceil(each) if number.is_integer else number.scalar(each) for each in lengths}
    return (rope.shortest, *sorted(each for each in found if rope.shortest < each < rope.longest))


def _inward(end: float, towards: float, number: NumberType) -> Any:
    """Bring the end of a guarantee into the type, a unit or two inside, so that the piece is within it."""
    if number.is_integer:
        return math.ceil(end) + 1 if towards > 0 else math.floor(end) - 1
    relative = 2.0 ** (3 - number.significand_bits)
    return number.scalar(end * (1.0 + math.copysign(relative, towards)))


def _spans(row: Row, low: Any, high: Any, number: NumberType) -> Iterator[_Span]:
    """Cut a piece where its impulses change: only a spacing does."""
    taps = row.taps
    assert not isinstance(taps, PhaseTaps)  # noqa: S101 - a bank follows one clock
    if not isinstance(taps, SpacedTaps):
        yield _span(low, high, taps, number)
        return
    begins = low
    for ticks, next_start in zip(taps.spacing.ticks, (*taps.spacing.starts[1:], high), strict=True):
        ends = min(next_start, high)
        if begins < ends:
            times_s = np.arange(taps.amplitudes.size, dtype=np.float64) * (ticks * taps.tick_s)
            yield _span(begins, ends, _SpacedImpulses(times_s, taps.amplitudes), number)
            begins = ends


def _span(low: Any, high: Any, impulses: Impulses, number: NumberType) -> _Span:
    """Bring the ends of a span to m; in int32 to a mm beyond them."""
    if number.is_integer:
        return _Span((low - 1) / MM_PER_M, (high + 1) / MM_PER_M, impulses)
    return _Span(float(low), float(high), impulses)


def _worst(span: _Span, row: Row) -> float:
    """Upper bound of the residual vibration on a span, at every damping ratio of the guarantee."""
    low_hz, high_hz = pendulum_frequency_hz(span.high_m), pendulum_frequency_hz(span.low_m)
    dampings = row.taps.guarantee.damping_ratios
    found = [_worst_on_ray(span.impulses, low_hz, high_hz, damping) for damping in dict.fromkeys(dampings)]
    if dampings[0] < dampings[1]:
        found += [worst_on_arc(span.impulses, edge_hz, dampings).ratio for edge_hz in (low_hz, high_hz)]
    return max(found) + ROUNDING


def _worst_on_ray(impulses: Impulses, low_hz: float, high_hz: float, damping_ratio: float) -> float:
    """Bound V between two frequencies at one damping ratio by samples and what chords may miss."""
    sizes, times_s = np.abs(impulses.amplitudes), impulses.times_s
    last_s = times_s[np.flatnonzero(sizes >= NEGLIGIBLE_AMPLITUDE)[-1]]
    growth = math.exp(2.0 * math.pi * high_hz * damping_ratio * float(times_s[-1] - last_s))
    curvature = growth * float(sizes @ (2.0 * math.pi * (times_s - last_s)) ** 2)
    samples = 2 + math.ceil((high_hz - low_hz) * math.sqrt(curvature / (8.0 * CHORD_EXCESS)))
    at_hz, step_hz = np.linspace(low_hz, high_hz, samples, retstep=True)
    ratio = residual_vibration(impulses, at_hz, damping_ratio=damping_ratio)
    return float(ratio.max()) + curvature * float(step_hz) ** 2 / 8.0


def _upward(bound: float, number: NumberType) -> Any:
    """Bring a bound into the type, never below it."""
    if number.is_integer:
        return math.ceil(bound * RESIDUAL_PPM)
    rounded = number.scalar(bound)
    return rounded if float(rounded) >= bound else np.nextafter(rounded, number.scalar(math.inf))
