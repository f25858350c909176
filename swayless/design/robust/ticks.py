"""Specified insensitivity on the controller's own ticks: the guarantee is on what runs.

Not for: shapers of named families (`grid`), nor for number types (the controller's taps).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from swayless.design.grid_shaper import GridShaper, check_tick, decimal_amplitudes
from swayless.design.minimax import minimax_amplitudes
from swayless.design.residual import NEGLIGIBLE_AMPLITUDE
from swayless.design.robust.specified import RULES, Amplitudes, RobustDesign, specified_insensitivity
from swayless.design.robustness import worst_residual
from swayless.design.shaper import FloatArray, Guarantee
from swayless.errors import DesignError
from swayless.plant import Band, Mode

_SLACK = 1e-9  # of the residual: more than amplitudes put on the decimal lattice can add
_MOST_EXTRA = 8  # ticks beyond the ideal duration; where these do not help, the tick is too coarse


@dataclass(frozen=True, eq=False)
class RobustTaps:
    """Taps that hold a band on whole ticks, beside the ideal shaper that they follow.

    Parameters
    ----------
    taps : GridShaper
        With the fewest ticks that hold the tolerance over the band.
    ideal : RobustDesign
        The shortest shaper in continuous time, whose lower bound holds for the taps too.
    """

    taps: GridShaper
    ideal: RobustDesign


@dataclass(frozen=True, eq=False)
class _Impulses:
    """Impulses whose guarantee is still to be proved."""

    times_s: FloatArray
    amplitudes: FloatArray


def specified_insensitivity_on_ticks(
    band: Band,
    tick_s: float,
    *,
    tolerance: float = 0.05,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
) -> RobustTaps:
    """Design taps on the fewest ticks that leave at most the tolerance over a band.

    Fewer ticks than the ideal shaper's proved bound cannot hold the band; from there on each number of ticks
    is solved as a linear program until one does. Bounded taps may have levels between 0 and 1.

    Parameters
    ----------
    band : Band
        Undamped natural frequencies, high_hz / low_hz at most 8.
    tick_s : float
        Tick of the controller, > 0.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float
        Over the whole band, 0 to 0.2.
    amplitudes : {"positive", "bounded"}
        Sign rule. "unity-magnitude" cannot be kept on ticks and is refused.

    Returns
    -------
    RobustTaps

    Raises
    ------
    DesignError
        If a value is out of range, or the tick is too coarse.

    Examples
    --------
    >>> design = specified_insensitivity_on_ticks(Band(0.85, 1.15), 0.05)
    >>> design.taps.delays_ticks.tolist(), round(design.ideal.shaper.duration_s, 3)
    ([0, 9, 10, 19], 0.941)
    """
    check_tick(tick_s)
    if amplitudes == "unity-magnitude":
        raise DesignError("amplitudes = 'unity-magnitude': whole ticks need levels between; use 'bounded'")
    ideal = specified_insensitivity(
        band, tolerance=tolerance, damping_ratio=damping_ratio, amplitudes=amplitudes
    )
    fewest = max(1, math.ceil(ideal.lower_bound_s / tick_s))
    for last in range(fewest, fewest + _MOST_EXTRA + 1):
        taps = _within(last, tick_s, ideal, amplitudes)
        if taps is not None:
            return RobustTaps(taps, ideal)
    what = f"{band.low_hz:g} to {band.high_hz:g} Hz at {100 * tolerance:g} %"
    raise DesignError(
        f"tick_s = {tick_s!r}: {fewest + _MOST_EXTRA} ticks do not hold {what}; a finer tick does "
        f"(the ideal shaper lasts {ideal.shaper.duration_s:.6g} s)"
    )


def _within(last: int, tick_s: float, ideal: RobustDesign, amplitudes: Amplitudes) -> GridShaper | None:
    """Find taps on the ticks 0 .. `last` that hold the band, or prove that there are none."""
    promise = ideal.shaper.guarantee
    damping_ratio = promise.mode.damping_ratio
    times_s = np.arange(last + 1, dtype=np.float64) * tick_s
    near = ideal.shaper.times_s * (last / ideal.shaper.duration_s)
    start = np.union1d(np.floor(near), np.ceil(near)).astype(np.intp)
    best = minimax_amplitudes(
        times_s,
        promise.band,
        damping_ratio=damping_ratio,
        rule=RULES[amplitudes],
        start=np.union1d(start[start <= last], last),
        target_ratio=promise.tolerance - _SLACK,
        least_last=2.0 * NEGLIGIBLE_AMPLITUDE,  # so that the last tap counts
    )
    if best.worst_residual_ratio > promise.tolerance:
        return None
    delays = (best.taps - best.taps[0]).astype(np.int64)
    lattice = decimal_amplitudes(best.amplitudes)
    impulses = _Impulses(delays * tick_s, lattice)
    worst = worst_residual(impulses, promise.band, damping_ratio=damping_ratio)
    if worst > promise.tolerance:
        return None
    mode = Mode(promise.mode.frequency_hz, damping_ratio)
    return GridShaper(delays, lattice, tick_s, Guarantee(promise.tolerance, mode, promise.band, worst))
