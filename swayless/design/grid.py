"""Shapers on the tick grid of a controller: amplitudes solved again for whole ticks, never rounded.

Rounding the times of a shaper to ticks breaks its promise. Here the amplitudes are solved anew on whole ticks
near the ideal times, so that the taps hold at least the band that the ideal shaper promises, and what is
reported is proved on the very numbers that a design file stores.
Not for: number types narrower than double (the controller's taps), or drives that cannot make levels between.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.design.families import FAMILIES, design_shaper
from swayless.design.grid_shaper import GridShaper, check_tick, decimal_amplitudes
from swayless.design.minimax import AmplitudeRule, minimax_amplitudes, zero_equalities
from swayless.design.minimax.response import IndexArray
from swayless.design.residual import NEGLIGIBLE_AMPLITUDE
from swayless.design.robustness import guarantee_of, worst_residual
from swayless.design.shaper import FloatArray, Guarantee, Shaper
from swayless.errors import DesignError
from swayless.plant import Band

EXTRA_TICKS = 2
"""How many ticks longer than the ideal duration, rounded up, the taps may be."""

LARGEST_DURATION_TICKS = 20_000
"""Longest shaper on the grid: more cells are beyond any controller, and mean a tick in the wrong unit."""

SMALLEST_LAST_AMPLITUDE = 1e-5
"""Smallest last impulse of a shaper for the grid: a tenth of it still counts as the last one (1e-6)."""

_ON_TICK = 1e-11  # relative: an ideal time this near a whole tick lies on it, as numbers of 12 digits show it
_SLACK = 1e-9  # of the residual: more than times moved by _ON_TICK, or amplitudes put on the lattice, can add
_LEAST_LAST = 1.001 * NEGLIGIBLE_AMPLITUDE  # the last tap counts as the last impulse, however it is rounded
_DECADES = 5  # of ticks tried for the message of an error


def solve_on_grid(shaper: Shaper, tick_s: float) -> GridShaper:
    """Solve a shaper's amplitudes again for whole ticks, so that the taps keep its promise.

    The taps have the fewest ticks, at most `EXTRA_TICKS` more than the ideal duration rounded up, on which
    amplitudes of the family's kind exist that (1) cancel the mode exactly, with the derivatives that the
    family cancels, and (2) leave at most the tolerance over the whole band that the ideal shaper holds; of
    these, the amplitudes that leave least. Positive families keep positive amplitudes. Families with negative
    ones keep every partial sum in 0 .. 1, so their taps may include levels that last a tick. The ideal
    duration, rounded up, must have room for the ideal impulses. Families with a free delay move it to the
    nearest whole tick (at least one) and hold the band that this gives.

    Parameters
    ----------
    shaper : Shaper
        Of one of the families of `FAMILIES`.
    tick_s : float
        Tick of the controller, > 0, at least the duration / 20000.

    Returns
    -------
    GridShaper
        Taps with the band that they hold, which contains the band of the ideal shaper.

    Raises
    ------
    DesignError
        If the tick is out of range or too coarse to keep the promise; the message names a tick that does.

    References
    ----------
    Kriikku, Singer and Singhose (1997), eq 1: the residual vibration that is bounded.

    Examples
    --------
    >>> from swayless.design.families import design_shaper
    >>> from swayless.plant import Mode
    >>> taps = solve_on_grid(design_shaper("zv", Mode(0.98)), 0.05)
    >>> taps.delays_ticks.tolist(), taps.amplitudes.tolist()
    ([0, 10, 11], [0.498065102014, 0.398733159942, 0.103201738044])
    """
    check_tick(tick_s)
    _check_shaper(shaper, tick_s)
    try:
        return _solve(shaper, tick_s)
    except DesignError as error:
        where = f"{shaper.family} at {shaper.guarantee.mode.frequency_hz:g} Hz, tick_s = {tick_s:.12g}"
        raise DesignError(f"{where}: {error}{_suggestion(shaper, tick_s)}") from None


@dataclass(frozen=True, eq=False)
class _Impulses:
    """Impulses whose guarantee is still to be proved."""

    times_s: FloatArray
    amplitudes: FloatArray


def _check_shaper(shaper: Shaper, tick_s: float) -> None:
    """Refuse what no tick, or no tick as fine as this one, can hold."""
    if shaper.family not in FAMILIES:
        raise DesignError(
            f"family {shaper.family!r}: on the tick grid it must be one of {', '.join(FAMILIES)}; "
            "the factors of a convolution are solved one by one"
        )
    if shaper.duration_s > LARGEST_DURATION_TICKS * tick_s:
        raise DesignError(
            f"tick_s = {tick_s:.12g}: {shaper.family} lasts {shaper.duration_s:g} s, more than "
            f"{LARGEST_DURATION_TICKS} ticks; must be at least {shaper.duration_s / LARGEST_DURATION_TICKS:g}"
        )
    if abs(float(shaper.amplitudes[-1])) < SMALLEST_LAST_AMPLITUDE:
        raise DesignError(
            f"{shaper.family}: its last impulse is {shaper.amplitudes[-1]:.3g}, too small to split between "
            f"ticks; must be at least {SMALLEST_LAST_AMPLITUDE:g}"
        )


def _solve(shaper: Shaper, tick_s: float) -> GridShaper:
    """Find the shortest taps for the shaper, or say why the longest ones allowed are not enough."""
    if "delay_s" in FAMILIES[shaper.family].parameters:
        return _with_whole_delay(shaper, tick_s)
    ideal_ticks = shaper.times_s / tick_s
    below, above = np.floor(ideal_ticks * (1.0 + _ON_TICK)), np.ceil(ideal_ticks * (1.0 - _ON_TICK))
    near, last = np.union1d(below, above).astype(np.intp), int(above[-1])
    if last + 1 < ideal_ticks.size:  # other impulses might do, but they would be another family's, and longer
        raise DesignError(f"no room for {ideal_ticks.size} impulses in a duration of {last} x {tick_s:g} s")
    for extra_ticks in range(EXTRA_TICKS):
        try:
            return _solve_within(shaper, tick_s, near, last + extra_ticks)
        except DesignError:  # a tick more may do
            continue
    return _solve_within(shaper, tick_s, near, last + EXTRA_TICKS)


def _solve_within(shaper: Shaper, tick_s: float, near: IndexArray, last: int) -> GridShaper:
    """Find taps on the ticks 0 .. `last` that use both, preferring the ticks `near` the ideal times."""
    family, mode, tolerance = FAMILIES[shaper.family], shaper.guarantee.mode, shaper.guarantee.tolerance
    times_s = np.arange(last + 1, dtype=np.float64) * tick_s
    orders = shaper.times_s.size - 2 if "order" in family.parameters else family.zero_orders
    zeros = None if orders is None else zero_equalities(times_s, mode, derivatives=orders)
    best = minimax_amplitudes(
        times_s,
        shaper.guarantee.band,
        damping_ratio=mode.damping_ratio,
        rule=AmplitudeRule.BOUNDED if family.negative else AmplitudeRule.POSITIVE,
        equalities=zeros,
        start=np.union1d(near, np.arange(near[-1], last + 1)),
        target_ratio=tolerance + _SLACK,
        least_last=_LEAST_LAST,
    )
    if math.isinf(best.worst_residual_ratio):
        raise DesignError(f"no amplitudes within {last} ticks cancel the mode")
    if best.lower_bound_ratio > tolerance:
        least = f"no amplitudes within {last} ticks leave less than {100 * best.lower_bound_ratio:.4g} %"
        raise DesignError(f"{least}, and {100 * tolerance:g} % is promised")
    return _proved(best.taps - best.taps[0], best.amplitudes, tick_s, shaper.guarantee)


def _with_whole_delay(shaper: Shaper, tick_s: float) -> GridShaper:
    """Design the shaper again for the whole number of ticks nearest to its delay."""
    mode, tolerance = shaper.guarantee.mode, shaper.guarantee.tolerance
    delay_ticks = max(1, round(float(shaper.times_s[1]) / tick_s))
    moved = design_shaper(shaper.family, mode, tolerance=tolerance, delay_s=delay_ticks * tick_s)
    return _proved(delay_ticks * np.arange(moved.times_s.size), moved.amplitudes, tick_s, moved.guarantee)


def _proved(
    delays_ticks: NDArray[np.int64], amplitudes: FloatArray, tick_s: float, promise: Guarantee
) -> GridShaper:
    """Put the amplitudes on the decimal lattice and prove on these numbers that they keep the promise."""
    times_s: FloatArray = delays_ticks.astype(np.float64) * tick_s
    impulses = _Impulses(times_s, decimal_amplitudes(amplitudes))
    mode, tolerance = promise.mode, promise.tolerance
    worst = worst_residual(impulses, promise.band, damping_ratio=mode.damping_ratio)
    if worst > tolerance + 2.0 * _SLACK:
        raise DesignError(
            f"{delays_ticks[-1]} ticks leave {100 * worst:.10g} %, and {100 * tolerance:g} % is promised"
        )
    # A hump that touches the tolerance may stand above it by rounding: the band is then read at its height.
    held = guarantee_of(impulses, mode, tolerance=max(tolerance, worst))
    band = Band(min(held.band.low_hz, promise.band.low_hz), max(held.band.high_hz, promise.band.high_hz))
    guarantee = Guarantee(tolerance, mode, band, max(worst, held.worst_residual_ratio))
    return GridShaper(delays_ticks, impulses.amplitudes, tick_s, guarantee)


def _suggestion(shaper: Shaper, tick_s: float) -> str:
    """Name the largest tidy tick below `tick_s` on which the shaper can be solved, found by solving."""
    for finer_s in _tidy_ticks_s(min(tick_s, shaper.duration_s)):
        try:
            _solve(shaper, finer_s)
        except DesignError:
            continue
        return f"; a tick of {finer_s:g} s does"
    return ""


def _tidy_ticks_s(below_s: float) -> Iterator[float]:
    """Ticks of 1, 2 or 5 times a power of ten below `below_s`, falling over five decades."""
    exponent = math.floor(math.log10(below_s))
    ticks_s = (float(f"{digit}e{exponent - decade}") for decade in range(_DECADES) for digit in (5, 2, 1))
    return (tick_s for tick_s in ticks_s if tick_s < below_s)
