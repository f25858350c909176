"""Plain ramps: what a linear ramp leaves by itself, and the shortest one that needs no shaper.

Not for: ramps in front of a shaper (`swayless.controller`), nor for ramps that are not straight.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.robustness import TOUCH_SLACK
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import Band

_SAMPLES_PER_CYCLE = 64
"""Points in which turns of the residual are looked for: it has one hump and one dip to a cycle."""

_MOST_CYCLES = 1e6  # stands for no end

LARGEST_JOG = 2.0
"""Largest swing of any press of a button, in full-speed steps: a start and a stop that add up."""


def ramp_residual(duration_s: float, frequency_hz: ArrayLike, *, damping_ratio: float = 0.0) -> FloatArray:
    """Swing that a ramp to full speed leaves when it ends, as a ratio of what a step of that speed leaves.

    With p = w T (-z + j sqrt(1 - z^2)), w = 2 pi f and z the damping ratio it is |(exp(p) - 1) / p|; undamped
    that is |sin(w T / 2) / (w T / 2)|. It holds for moves that reach full speed; see `jog_residual`.

    Parameters
    ----------
    duration_s : float
        Time T of the ramp, in seconds, >= 0; 0 is a step.
    frequency_hz : array_like
        Undamped natural frequencies, >= 0.
    damping_ratio : float
        0 <= damping_ratio < 1.

    Returns
    -------
    ndarray
        Ratio, of the shape of `frequency_hz`.

    Raises
    ------
    DesignError
        If a value is out of range.

    References
    ----------
    Duhamel's integral of a constant acceleration over the response of a damped oscillator.

    Examples
    --------
    >>> ramp_residual(2.0, [0.25, 0.5]).round(9)  # half a period, and a whole one
    array([0.63661977, 0.        ])
    """
    frequency = np.asarray(frequency_hz, dtype=np.float64)
    if not (math.isfinite(duration_s) and duration_s >= 0.0):
        raise DesignError(f"duration_s = {duration_s!r}: must be finite and >= 0")
    if not (np.isfinite(frequency).all() and np.all(frequency >= 0.0)):
        raise DesignError(f"frequency_hz = {frequency_hz!r}: must be finite and >= 0")
    return np.sqrt(_square_and_slope(duration_s * frequency, damping_ratio)[0])


def worst_ramp_residual(duration_s: float, band: Band, *, damping_ratio: float = 0.0) -> float:
    """Largest `ramp_residual` in a band, its humps found to rounding.

    Examples
    --------
    >>> round(worst_ramp_residual(2.0, Band(0.5, 1.0)), 4)  # the first side hump
    0.2172
    """
    turns = _turns(duration_s * band.low_hz, duration_s * band.high_hz, damping_ratio)
    ends_hz = np.array([band.low_hz, band.high_hz])
    at_ends = ramp_residual(duration_s, ends_hz, damping_ratio=damping_ratio)
    return float(max(at_ends.max(), np.sqrt(_square_and_slope(turns, damping_ratio)[0]).max(initial=0.0)))


def held_by_ramp(duration_s: float, *, tolerance: float, damping_ratio: float = 0.0) -> tuple[Band, ...]:
    """Bands in which a ramp to full speed leaves at most the tolerance, by rising frequency.

    Parameters
    ----------
    duration_s : float
        Time of the ramp, in seconds, > 0.
    tolerance : float
        Ratio, above 0 and below 1.
    damping_ratio : float
        0 <= damping_ratio < 1.

    Returns
    -------
    tuple of Band
        The last one has no upper end: it is cut at a million cycles of the ramp.

    Raises
    ------
    DesignError
        If the tolerance or the damping ratio is out of range.

    Examples
    --------
    >>> held = held_by_ramp(2.0, tolerance=0.05)
    >>> round(held[0].low_hz, 4), round(held[0].high_hz, 4)
    (0.4761, 0.5264)
    """
    cycles = _held_cycles(tolerance, damping_ratio)
    return tuple(Band(low / duration_s, min(high, _MOST_CYCLES) / duration_s) for low, high in cycles)


def shortest_ramp_s(
    band: Band, *, tolerance: float, damping_ratio: float = 0.0, at_least_s: float = 0.0
) -> float:
    """Duration of the shortest ramp to full speed that leaves at most the tolerance over a band, in seconds.

    Parameters
    ----------
    band : Band
        Undamped natural frequencies.
    tolerance, damping_ratio : float
        As for `held_by_ramp`.
    at_least_s : float
        Ramps shorter than this are beyond the drive.

    Raises
    ------
    DesignError
        If the tolerance is not between 0 and 1, or the damping ratio is out of range.

    Examples
    --------
    One period serves a narrow band, and no ramp shorter than some six periods a wide one:

    >>> round(shortest_ramp_s(Band(0.97, 1.02), tolerance=0.05), 4)
    0.9817
    >>> round(shortest_ramp_s(Band(1.0, 2.0), tolerance=0.05), 4)
    5.6522
    """
    ratio = band.high_hz / band.low_hz
    starts = [
        (max(low, at_least_s * band.low_hz), high) for low, high in _held_cycles(tolerance, damping_ratio)
    ]
    return next(start / band.low_hz for start, high in starts if high >= ratio * start)


def jog_residual(band: Band, ramp_up_s: float, ramp_down_s: float) -> float:
    """Bound what a press of any length leaves behind plain ramps, in swings of a full-speed step.

    A jog shorter than the ramp never reaches full speed. Each of its two ramps leaves at most 2 / (w T), so
    both leave at most (2 / w) (1 / T_up + 1 / T_down), with w = 2 pi f at the lowest frequency. Undamped and
    with equal ramps, the jog of half a period leaves exactly that. No press leaves more than 2.

    Parameters
    ----------
    band : Band
        Undamped natural frequencies.
    ramp_up_s, ramp_down_s : float
        Times from rest to full speed and back, in seconds, >= 0.

    Examples
    --------
    A ramp of one period leaves nothing of a long move, and most of the swing of a short jog:

    >>> round(jog_residual(Band(0.2, 0.2), 5.0, 5.0), 4)  # 2 / pi
    0.6366
    """
    if min(ramp_up_s, ramp_down_s) <= 0.0:
        return LARGEST_JOG
    angular_rad_s = 2.0 * math.pi * band.low_hz
    return min(LARGEST_JOG, 2.0 / angular_rad_s * (1.0 / ramp_up_s + 1.0 / ramp_down_s))


def _square_and_slope(cycles: FloatArray, damping_ratio: float) -> tuple[FloatArray, FloatArray]:
    """Square of the residual, and its derivative, over the cycles f T that fit into the ramp."""
    if not 0.0 <= damping_ratio < 1.0:
        raise DesignError(f"damping_ratio = {damping_ratio!r}: must be at least 0 and below 1")
    pole = 2.0 * math.pi * complex(-damping_ratio, math.sqrt(1.0 - damping_ratio**2))
    phase = pole * np.where(cycles == 0.0, 1.0, cycles)
    ratio = np.expm1(phase) / phase
    slope = (np.exp(phase) - ratio) / phase * pole
    square = np.where(cycles == 0.0, 1.0, np.abs(ratio) ** 2)
    return square, np.where(cycles == 0.0, pole.real, 2.0 * (ratio.conj() * slope).real)


def _turns(first: float, last: float, damping_ratio: float) -> FloatArray:
    """Cycles between two ends at which the residual turns."""
    from scipy.optimize import brentq

    points = np.linspace(first, last, 2 + math.ceil(_SAMPLES_PER_CYCLE * (last - first)))
    rising = _square_and_slope(points, damping_ratio)[1] > 0.0
    at = np.flatnonzero(rising[1:] != rising[:-1])

    def slope(cycles: float) -> float:
        return float(_square_and_slope(np.array(cycles), damping_ratio)[1])

    return np.array([brentq(slope, points[i], points[i + 1]) for i in at])


def _held_cycles(tolerance: float, damping_ratio: float) -> list[tuple[float, float]]:
    """Intervals of f T in which at most the tolerance is left, rising; the last one has no end."""
    from scipy.optimize import brentq

    if not 0.0 < tolerance < 1.0:
        raise DesignError(f"tolerance = {tolerance!r}: must be above 0 and below 1")
    end = 1.0 / (math.pi * tolerance) + 1.0  # |exp(p) - 1| <= 2 and |p| = 2 pi f T
    turns = np.concatenate([[0.0], _turns(0.0, end, damping_ratio), [end]])
    ceiling = (tolerance * (1.0 + TOUCH_SLACK)) ** 2

    def excess(cycles: float) -> float:
        return float(_square_and_slope(np.array(cycles), damping_ratio)[0]) - ceiling

    above = _square_and_slope(turns, damping_ratio)[0] > ceiling
    at = np.flatnonzero(above[1:] != above[:-1])
    ends = [float(brentq(excess, turns[i], turns[i + 1])) for i in at] + [math.inf]
    return list(zip(ends[::2], ends[1::2], strict=True))
