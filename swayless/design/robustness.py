"""What impulses guarantee: the band held at a tolerance, the worst residual in a band, and what they cost.

Not for: the residual vibration itself (`residual`), nor for searching shapers.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.damping_range import worst_on_arc
from swayless.design.residual import residual_at, squared_residual_and_slope
from swayless.design.shaper import FloatArray, Guarantee, Impulses, Shaper
from swayless.errors import DesignError
from swayless.plant import Band, Mode, pendulum_rope_length_m

DEFAULT_TOLERANCE = 0.05
"""Residual vibration, as a ratio, at which bands are quoted when nothing else is asked for."""

TOUCH_SLACK = 1e-9
"""By how much of the tolerance a hump that is designed to touch it may stand above it, by rounding."""

WIDEST_RATIO = 16.0
"""A held band is cut at this many times the mode's frequency: on a damped mode it may have no upper end."""

# V^2 holds no oscillation over frequency faster than the duration. At this many samples per such period a
# cubic through values and slopes is off by at most (2 pi / 64)^4 / 384 = 2.5e-7 of the largest V^2.
_SAMPLES_PER_PERIOD = 64
_CUBIC_ERROR = 1e-6
_PEAK_ROUNDS = 3  # errors of a peak's place: 1e-5 by the cubic, then 1e-6, 1e-11; the value is flat there
_EDGE_ROUNDS = 60  # of safeguarded Newton; bisection alone would be at rounding by then
_EDGE_ACCURACY = 4e-15  # relative, of an edge's place


class _BareImpulses(NamedTuple):
    """Impulses before anything is known of what they hold."""

    times_s: FloatArray
    amplitudes: FloatArray


def held_band(impulses: Impulses, mode: Mode, *, tolerance: float = DEFAULT_TOLERANCE) -> Band:
    """Find the connected band around the mode's frequency in which the residual stays within the tolerance.

    The low edge is above 0, because at frequency 0 impulses that sum to 1 leave everything (V = 1). The
    high edge is cut at `WIDEST_RATIO` times the mode's frequency. Humps may touch the tolerance.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or anything else with times and amplitudes.
    mode : Mode
        Where the band is sought; its damping ratio holds over the whole band.
    tolerance : float
        Residual vibration as a ratio, 0 < tolerance < 1.

    Returns
    -------
    Band
        Edges right to about 1e-14 of their value.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or already exceeded at the mode itself.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> band = held_band(design_shaper("ei", Mode(1.0)), Mode(1.0), tolerance=0.05)
    >>> round(band.low_hz, 6), round(band.high_hz, 6)
    (0.800275, 1.199725)
    """
    return guarantee_of(impulses, mode, tolerance=tolerance).band


def worst_residual(impulses: Impulses, band: Band, *, damping_ratio: float = 0.0) -> float:
    """Largest residual vibration in a band, its maxima refined to rounding.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or anything else with times and amplitudes.
    band : Band
        Where to look, ends included.
    damping_ratio : float
        0 <= damping_ratio < 1, over the whole band.

    Returns
    -------
    float
        Ratio, right to about 1e-12.

    Raises
    ------
    DesignError
        If the damping ratio is out of range.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> ei = design_shaper("ei", Mode(1.0), tolerance=0.05)
    >>> round(worst_residual(ei, Band(0.85, 1.15)), 12)  # the hump at the mode
    0.05
    """
    count = 2 + _sample_count(impulses, band.high_hz - band.low_hz)
    samples_hz = np.linspace(band.low_hz, band.high_hz, count)
    _, ratio = _profile(impulses, samples_hz, damping_ratio, ceiling=None)
    return float(ratio.max())


def worst_residual_promised(impulses: Impulses, guarantee: Guarantee) -> float:
    """Largest residual vibration in all bands of a guarantee, at all its damping ratios.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or anything else with times and amplitudes.
    guarantee : Guarantee
        Where to look; its tolerance and its own worst residual are not read.

    Returns
    -------
    float
        Ratio.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> ei = design_shaper("ei", Mode(1.0), tolerance=0.05)
    >>> round(worst_residual_promised(ei, ei.guarantee), 9)
    0.05
    """
    ends = guarantee.damping_ratios
    worst = [
        worst_residual(impulses, band, damping_ratio=damping_ratio)
        for band in guarantee.bands
        for damping_ratio in dict.fromkeys(ends)
    ]
    if ends[0] < ends[1]:  # the worst of a range is on its border: see damping_range
        edges_hz = [edge_hz for band in guarantee.bands for edge_hz in (band.low_hz, band.high_hz)]
        worst += [worst_on_arc(impulses, edge_hz, ends).ratio for edge_hz in edges_hz]
    return max(worst)


def guarantee_of(impulses: Impulses, mode: Mode, *, tolerance: float = DEFAULT_TOLERANCE) -> Guarantee:
    """Prove what impulses hold around a mode: `held_band` and the worst residual in it.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or already exceeded at the mode itself.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> guarantee = guarantee_of(design_shaper("zvd", Mode(1.0)), Mode(1.0), tolerance=0.05)
    >>> round(guarantee.band.high_hz, 4), round(guarantee.worst_residual_ratio, 4)
    (1.1436, 0.05)
    """
    if not 0.0 < tolerance < 1.0:
        raise DesignError(f"tolerance = {tolerance!r}: must be above 0 and below 1")
    ceiling = tolerance * (1.0 + TOUCH_SLACK)
    frequency_hz, ratio = _profile_beyond_band(impulses, mode, ceiling)
    middle = int(np.searchsorted(frequency_hz, mode.frequency_hz))
    if ratio[middle] > ceiling:
        raise DesignError(
            f"the impulses leave {ratio[middle]:.6g} at the mode ({mode.frequency_hz:.6g} Hz, damping_ratio "
            f"{mode.damping_ratio:.6g}): more than the tolerance {tolerance!r}, so they hold no band"
        )
    outside = np.concatenate([[-1], np.flatnonzero(ratio > ceiling), [ratio.size]])
    gap = int(np.searchsorted(outside, middle))
    below, beyond = int(outside[gap - 1]), int(outside[gap])
    low_hz = _edge(impulses, mode, tolerance, frequency_hz[below + 1], frequency_hz[below])
    high_hz = float(frequency_hz[-1])
    if beyond < ratio.size:
        high_hz = _edge(impulses, mode, tolerance, frequency_hz[beyond - 1], frequency_hz[beyond])
    worst = max(tolerance, float(ratio[below + 1 : beyond].max()))  # the low edge is at the tolerance
    return Guarantee(tolerance, mode, Band(low_hz, high_hz), worst)


def proven_shaper(
    times_s: ArrayLike, amplitudes: ArrayLike, mode: Mode, *, tolerance: float, family: str, source: str
) -> Shaper:
    """Make a shaper whose guarantee is what its impulses are proved to hold around a mode.

    Raises
    ------
    DesignError
        If the impulses hold no band at the tolerance, or are no shaper.

    Examples
    --------
    >>> shaper = proven_shaper(
    ...     [0.0, 0.5], [0.5, 0.5], Mode(1.0), tolerance=0.05, family="posicast", source="Smith (1957)"
    ... )
    >>> round(shaper.guarantee.band.high_hz, 4)
    1.0318
    """
    impulses = _BareImpulses(np.asarray(times_s, dtype=np.float64), np.asarray(amplitudes, dtype=np.float64))
    guarantee = guarantee_of(impulses, mode, tolerance=tolerance)
    return Shaper(impulses.times_s, impulses.amplitudes, family, guarantee, source)


def insensitivity_width(impulses: Impulses, mode: Mode, *, tolerance: float = DEFAULT_TOLERANCE) -> float:
    """Width of the held band as a ratio of the mode's frequency: the insensitivity of the literature.

    Raises
    ------
    DesignError
        If the tolerance is out of range, or already exceeded at the mode itself.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> round(insensitivity_width(design_shaper("ei", Mode(1.0)), Mode(1.0)), 6)
    0.399451
    """
    band = held_band(impulses, mode, tolerance=tolerance)
    return (band.high_hz - band.low_hz) / mode.frequency_hz


def overtravel_s(impulses: Impulses) -> float:
    """Distance a released command still travels, per unit of speed: sum A_i t_i, in seconds."""
    return float(impulses.amplitudes @ impulses.times_s)


def peak_factor(impulses: Impulses) -> float:
    """Return how far arbitrary commands of size 1 could drive the reference: sum |A_i|, at least 1."""
    return float(np.abs(impulses.amplitudes).sum())


def partial_sums(impulses: Impulses) -> FloatArray:
    """Levels that the reference takes after a unit step, one after each impulse, shape (n,)."""
    return np.cumsum(impulses.amplitudes)


def rope_length_interval_m(band: Band) -> tuple[float, float]:
    """Rope lengths of the pendulums whose frequencies are the band, shortest first, in metres.

    Examples
    --------
    >>> [round(length_m, 3) for length_m in rope_length_interval_m(Band(0.25, 0.5))]
    [0.994, 3.974]
    """
    return pendulum_rope_length_m(band.high_hz), pendulum_rope_length_m(band.low_hz)


def _sample_count(impulses: Impulses, width_hz: float) -> int:
    """Count the samples that resolve V^2 over a width of frequency."""
    return math.ceil(_SAMPLES_PER_PERIOD * float(impulses.times_s[-1] - impulses.times_s[0]) * width_hz)


def _profile_beyond_band(impulses: Impulses, mode: Mode, ceiling: float) -> tuple[FloatArray, FloatArray]:
    """Profile from frequency 0 through the mode until V is past the ceiling again, or to `WIDEST_RATIO`."""
    per_frequency = 2 + _sample_count(impulses, mode.frequency_hz)
    upper_ratio = 2.0
    while True:
        samples_hz = mode.frequency_hz * (np.arange(upper_ratio * per_frequency + 1.0) / per_frequency)
        frequency_hz, ratio = _profile(impulses, samples_hz, mode.damping_ratio, ceiling)
        if upper_ratio >= WIDEST_RATIO or np.any(ratio[frequency_hz >= mode.frequency_hz] > ceiling):
            return frequency_hz, ratio
        upper_ratio *= 2.0


def _profile(
    impulses: Impulses, samples_hz: FloatArray, damping_ratio: float, ceiling: float | None
) -> tuple[FloatArray, FloatArray]:
    """Evaluate V at samples, and at maxima between them that may exceed the ceiling (None: the samples)."""
    square, slope_s = squared_residual_and_slope(impulses, samples_hz, damping_ratio=damping_ratio)
    knots = np.array((samples_hz, square, slope_s))  # columns are samples
    ratio = np.sqrt(square)
    level = ratio.max() if ceiling is None else ceiling
    crest, height = _cubic_maximum(knots[:, :-1], knots[:, 1:])
    found = (crest > 0.0) & (crest < 1.0) & (height > level**2 - _CUBIC_ERROR * knots[1].max())
    slots = 1 + np.flatnonzero(found & (ratio[:-1] <= level) & (ratio[1:] <= level))
    if slots.size == 0:
        return samples_hz, ratio
    residual = residual_at(impulses, damping_ratio)
    left_hz, right_hz, left_slope = samples_hz[slots - 1], samples_hz[slots], knots[2, slots - 1]
    place_hz = left_hz + crest[slots - 1] * (right_hz - left_hz)
    climbs = zip(place_hz.tolist(), left_hz.tolist(), right_hz.tolist(), left_slope.tolist(), strict=True)
    peaks, peaks_hz = zip(*(_climb(residual, *climb) for climb in climbs), strict=True)
    return np.insert(samples_hz, slots, peaks_hz), np.insert(ratio, slots, peaks)


def _climb(
    residual: Callable[[float], tuple[float, float]],
    place_hz: float,
    left_hz: float,
    right_hz: float,
    left_slope: float,
) -> tuple[float, float]:
    """Refine a maximum between two places by secants of the slope of V^2: its value and place."""
    peak, earlier_hz, earlier_slope = (0.0, place_hz), left_hz, left_slope
    for _ in range(_PEAK_ROUNDS):
        ratio, slope_s = residual(place_hz)
        peak, slope = max(peak, (ratio, place_hz)), 2.0 * ratio * slope_s
        if slope == earlier_slope:
            break
        step_hz = slope * (place_hz - earlier_hz) / (slope - earlier_slope)
        earlier_hz, earlier_slope = place_hz, slope
        place_hz = min(max(place_hz - step_hz, left_hz), right_hz)
    return peak


def _cubic_maximum(left: FloatArray, right: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find the maximum of the cubic through two knots: place, 0 (left) to 1 (right) or -1, and height."""
    width = right[0] - left[0]
    rise, start, end = right[1] - left[1], left[2] * width, right[2] * width
    square = 3.0 * rise - 2.0 * start - end
    cube = start + end - 2.0 * rise
    discriminant = square**2 - 3.0 * cube * start
    denominator = np.sqrt(np.maximum(discriminant, 0.0)) - square
    exists = (discriminant >= 0.0) & (np.abs(denominator) > np.abs(start))
    place: FloatArray = np.full_like(start, -1.0)
    np.divide(start, denominator, out=place, where=exists)
    return place, left[1] + place * (start + place * (square + place * cube))


def _edge(impulses: Impulses, mode: Mode, tolerance: float, inside_hz: float, outside_hz: float) -> float:
    """Where V crosses the tolerance between a place within it and one beyond: Newton, kept in between."""
    residual = residual_at(impulses, mode.damping_ratio)
    low_hz, high_hz = float(inside_hz), float(outside_hz)
    place_hz = 0.5 * (low_hz + high_hz)
    for _ in range(_EDGE_ROUNDS):
        ratio, slope_s = residual(place_hz)
        if ratio <= tolerance:
            low_hz = place_hz
        else:
            high_hz = place_hz
        step_hz = (tolerance - ratio) / slope_s if slope_s else math.inf
        if abs(step_hz) <= _EDGE_ACCURACY * place_hz:
            break
        between = (place_hz + step_hz - low_hz) * (place_hz + step_hz - high_hz) < 0.0
        place_hz = place_hz + step_hz if between else 0.5 * (low_hz + high_hz)
    return place_hz + math.copysign(_EDGE_ACCURACY * place_hz, inside_hz - outside_hz)
