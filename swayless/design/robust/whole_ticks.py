"""Shapers of unity magnitude on whole ticks, for contactors: the reference is 0 or full, never between.

Amplitudes cannot give way here, so delays are searched: all whole delays within a window about the ideal
times are judged, the window moving until its best choice is inside. Not for: drives that can make levels
between (`grid`, `ticks`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swayless.design.grid_shaper import GridShaper, check_tick
from swayless.design.minimax.response import ComplexArray
from swayless.design.robust.descent import alternating
from swayless.design.robust.lines import turn_of
from swayless.design.robustness import TOUCH_SLACK, guarantee_of, worst_residual_promised
from swayless.design.shaper import FloatArray, Guarantee, Shaper
from swayless.errors import DesignError
from swayless.plant import Band

_EXTRA_TICKS = 8  # beyond the ideal duration; where these do not help, the tick is too coarse
_ON_TICK = 1e-9  # ticks by which an ideal duration may miss a whole number, by rounding
_SAMPLES_PER_RIPPLE = 16
_DAMPINGS = 5  # of a range, at which choices are judged; the best is proved on all
_MOVES = 50  # of the window; one to three are usual
_MOST_CHOICES = 250_000  # judged at once, about 0.3 s
_CUTS = 64  # bands tried where the band may be cut
_MOST_IMPULSES = 13  # 3^11 choices in the smallest window
_FAMILIES = ("um-zv", "um-zvd", "um-ei")

Delays = NDArray[np.int64]


class CoarseTickError(DesignError):
    """Whole ticks do not keep a promise.

    Parameters
    ----------
    message : str
        Which.
    worst : float
        The least that they leave, as a ratio.
    """

    def __init__(self, message: str, worst: float) -> None:
        super().__init__(message)
        self.worst = worst


@dataclass(frozen=True, eq=False)
class _Impulses:
    """Impulses whose guarantee is still to be proved."""

    times_s: FloatArray
    amplitudes: FloatArray


def whole_tick_taps(shaper: Shaper, tick_s: float) -> GridShaper:
    """Move a shaper of unity magnitude to whole ticks, its amplitudes exactly +1, -1, ..., +1.

    A shaper that was asked to hold bands (``"si"``, ``"fd"``) gets the fewest ticks, at most 8 more than its
    duration, on which the search finds delays that hold them. One of a named family gets the delays that
    leave least over the middle half of its band, and a guarantee of the band that they hold.

    Parameters
    ----------
    shaper : Shaper
        Of amplitudes +1, -1, ..., +1.
    tick_s : float
        Tick of the controller, > 0.

    Returns
    -------
    GridShaper

    Raises
    ------
    CoarseTickError
        If no delays found keep the tolerance; the message says what they leave.
    DesignError
        If the amplitudes are others.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> whole_tick_taps(design_shaper("um-zv", Mode(0.5)), 0.01).delays_ticks.tolist()
    [0, 34, 67]
    """
    _check(shaper, tick_s)
    promise = shaper.guarantee
    named = shaper.family in _FAMILIES
    ticks = shaper.times_s / tick_s
    sought = replace(shaper, guarantee=_middle(promise)) if named else shaper
    found = [_best(sought, tick_s, last) for last in _durations(float(ticks[-1]), named=named)]
    if named:
        delays, _ = min(found, key=lambda each: each[1])
        impulses = _impulses(delays, tick_s)
        guarantee = guarantee_of(impulses, promise.mode, tolerance=promise.tolerance)
        return GridShaper(delays, impulses.amplitudes, tick_s, guarantee)
    for delays, worst in found:
        if worst <= promise.tolerance * (1.0 + TOUCH_SLACK):
            return _kept(delays, tick_s, promise, worst)
    delays, worst = min(found, key=lambda each: each[1])
    raise CoarseTickError(
        f"{shaper.family}: on whole ticks of {tick_s:g} s {shaper.times_s.size} impulses leave "
        f"{100.0 * worst:.4g} % at best (delays {delays.tolist()}), and {100.0 * promise.tolerance:g} % is "
        "promised; a finer tick may do",
        worst,
    )


def whole_tick_fixed_duration(shaper: Shaper, tick_s: float) -> GridShaper:
    """Move a shaper to whole ticks within its own duration, its band cut at the top to what they hold.

    Parameters
    ----------
    shaper, tick_s
        As for `whole_tick_taps`; the guarantee of the shaper has one band.

    Returns
    -------
    GridShaper
        Its band starts where the shaper's does, and is the widest of 64 that delays were found for.

    Raises
    ------
    DesignError
        If the amplitudes are others, or the ticks do not even hold 1/64 of the band.
    """
    _check(shaper, tick_s)
    promise, last = shaper.guarantee, math.floor(shaper.duration_s / tick_s + _ON_TICK)
    low_hz = promise.band.low_hz
    for high_hz in np.geomspace(promise.band.high_hz, low_hz, _CUTS + 1)[:-1].tolist():
        mode = replace(promise.mode, frequency_hz=math.sqrt(low_hz * high_hz))
        cut = replace(promise, band=Band(low_hz, high_hz), mode=mode)
        delays, worst = _best(replace(shaper, guarantee=cut), tick_s, last)
        if worst <= promise.tolerance * (1.0 + TOUCH_SLACK):
            return _kept(delays, tick_s, cut, worst)
    raise DesignError(
        f"{shaper.family}: {last} whole ticks of {tick_s:g} s leave {100.0 * worst:.4g} % near {low_hz:g} Hz "
        f"at best, and {100.0 * promise.tolerance:g} % is promised; a finer tick or larger tolerance may do"
    )


def _middle(promise: Guarantee) -> Guarantee:
    """Narrow a band to its middle half: what is left there may be below the tolerance."""
    centre_hz = promise.mode.frequency_hz
    band = Band(0.5 * (promise.band.low_hz + centre_hz), 0.5 * (promise.band.high_hz + centre_hz))
    return replace(promise, band=band)


def _check(shaper: Shaper, tick_s: float) -> None:
    """Refuse what is not of unity magnitude, and ticks that leave no room."""
    check_tick(tick_s)
    count = shaper.amplitudes.size
    if count % 2 == 0 or not np.array_equal(shaper.amplitudes, alternating(count)):
        raise DesignError(
            f"{shaper.family}: amplitudes {shaper.amplitudes.tolist()} are not +1, -1, ..., +1, as "
            "a contactor needs"
        )
    if count > _MOST_IMPULSES:
        raise DesignError(
            f"{shaper.family}: {count} impulses are too many to search on whole ticks; must be at most "
            f"{_MOST_IMPULSES}"
        )
    if shaper.duration_s < (count - 1) * tick_s:
        raise DesignError(
            f"tick_s = {tick_s!r}: too coarse for {count} impulses within {shaper.duration_s:g} s; must be "
            f"at most {shaper.duration_s / (count - 1):.4g} s"
        )


def _durations(ideal_ticks: float, *, named: bool) -> range:
    """Whole durations that come into question: about the ideal one if named, from it on otherwise."""
    if named:
        return range(math.floor(ideal_ticks), math.floor(ideal_ticks) + 2)
    first = math.ceil(ideal_ticks - _ON_TICK)
    return range(first, first + _EXTRA_TICKS + 1)


def _best(shaper: Shaper, tick_s: float, last: int) -> tuple[Delays, float]:
    """Find the delays that leave least on a number of ticks; the window moves until they are inside it."""
    delays = np.rint(shaper.times_s * (last / shaper.duration_s)).astype(np.int64)
    rates = _rates(shaper.guarantee, last * tick_s) * tick_s
    inner = delays.size - 2
    reach = max(1, int((_MOST_CHOICES ** (1.0 / inner) - 1.0) / 2.0)) if inner > 3 else 4
    steps = np.stack(np.meshgrid(*[np.arange(-reach, reach + 1)] * inner, indexing="ij"), -1).reshape(
        -1, inner
    )
    for _ in range(_MOVES):
        choices = np.repeat(delays[np.newaxis], steps.shape[0], axis=0)
        choices[:, 1:-1] += steps
        choices = choices[(np.diff(choices) > 0).all(axis=1)]
        if not choices.size:
            raise DesignError(f"tick_s = {tick_s!r}: {last} ticks have no room for {delays.size} impulses")
        best = choices[_worst(choices, rates).argmin()]
        inside = bool((np.abs(best - delays) < reach).all())
        delays = best
        if inside:
            break
    impulses = _impulses(delays, tick_s)
    return delays, worst_residual_promised(impulses, shaper.guarantee)


def _rates(promise: Guarantee, duration_s: float) -> ComplexArray:
    """Sample the bands and damping ratios of a promise: 2 pi f (z + j sqrt(1 - z^2)), in 1/s."""
    lowest, highest = promise.damping_ratios
    dampings = [lowest] if lowest == highest else np.linspace(lowest, highest, _DAMPINGS).tolist()
    return np.concatenate(
        [
            np.linspace(
                band.low_hz,
                band.high_hz,
                9 + math.ceil(_SAMPLES_PER_RIPPLE * duration_s * (band.high_hz - band.low_hz)),
            )
            * turn_of(damping)
            for band in promise.bands
            for damping in dampings
        ]
    )


def _worst(choices: Delays, rates: ComplexArray) -> FloatArray:
    """Largest sampled residual vibration of each choice of delays."""
    signs = alternating(choices.shape[1])
    lags = choices - choices[:, -1:]
    lowest = int(lags.min())
    table = np.exp(np.multiply.outer(rates, np.arange(lowest, 1)))
    worst = np.zeros(choices.shape[0])
    for row in table:  # one frequency at a time: all choices and frequencies together would not fit the cache
        worst = np.maximum(worst, np.abs(row[lags - lowest] @ signs))
    return worst


def _impulses(delays: Delays, tick_s: float) -> _Impulses:
    """Give delays their unit and their amplitudes."""
    return _Impulses(delays.astype(np.float64) * tick_s, alternating(delays.size))


def _kept(delays: Delays, tick_s: float, promise: Guarantee, worst: float) -> GridShaper:
    """Make taps of the promise that they are proved to keep."""
    return GridShaper(delays, alternating(delays.size), tick_s, replace(promise, worst_residual_ratio=worst))
