"""Damping, and the period, from peak heights read off a video or a chart, swing by swing.

Heights h_k = h_0 exp(-d k) after k swings, d = 2 pi z / sqrt(1 - z^2) the logarithmic decrement, fitted by
least squares: reading errors are the same for high and low peaks, so logarithms would overrate the low ones.

Not for: sampled swings (`swing`).

References
----------
K. A. Kriikku, W. E. Singhose and N. C. Singer (1997), section IV: peak-to-peak heights over 40 cycles of a
gantry crane.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from swayless.errors import PlantError
from swayless.plant.identification.identified_mode import IdentifiedMode
from swayless.plant.identification.noise import student_ratio
from swayless.plant.identification.record import FloatArray

FEWEST_PEAKS = 4
_MOST_STEPS = 100
_STILL = 1e-13

_EXACT, _MISFIT = 0.1, 0.25
"""How far a gap may be from whole periods, in periods: where others fit too, and where none does."""

_ROUNDINGS = 4.0
"""Periods of so many steps of the clock, or fewer, are not told from its rounding."""

_MOST_PARTS = 4
"""Periods that the shortest gap may hold."""


class Decrement(NamedTuple):
    """How peaks fall.

    Parameters
    ----------
    per_swing, per_swing_std : float
        Logarithmic decrement, at least 0, and its standard deviation.
    first : float
        Height at swing 0, in the unit of the heights.
    reading_std : float
        Standard deviation of one height.
    peaks : int
        How many were read.
    swings : float
        From the first to the last.
    """

    per_swing: float
    per_swing_std: float
    first: float
    reading_std: float
    peaks: int
    swings: float

    @property
    def damping_ratio(self) -> float:
        """The damping ratio that makes this decrement."""
        return self.per_swing / float(np.hypot(2.0 * np.pi, self.per_swing))

    @property
    def damping_ratio_std(self) -> float:
        """Standard deviation of the damping ratio."""
        return self.per_swing_std * 4.0 * np.pi**2 / float(np.hypot(2.0 * np.pi, self.per_swing)) ** 3


def decrement(swing: FloatArray, height: FloatArray) -> Decrement:
    """Fit the logarithmic decrement of peak heights.

    Parameters
    ----------
    swing : ndarray, shape (n,)
        Swings since the first peak: 0, 1, 2, ... or halves where both sides were read.
    height : ndarray, shape (n,)
        Peak heights, or peak to peak, > 0, any unit.

    Raises
    ------
    PlantError
        If there are fewer than four peaks, or values out of range.

    Examples
    --------
    >>> swing = np.arange(41.0)
    >>> found = decrement(swing, 25.0 * np.exp(-0.0251 * swing))
    >>> round(found.damping_ratio, 4)
    0.004
    """
    if swing.ndim != 1 or swing.shape != height.shape or swing.size < FEWEST_PEAKS:
        raise PlantError(f"{swing.size} peaks: must be at least {FEWEST_PEAKS}, each with its height")
    if not (np.isfinite(swing).all() and np.ptp(swing) > 0.0):
        raise PlantError("swings must be finite and not all the same")
    if not (np.isfinite(height).all() and (height > 0.0).all()):
        raise PlantError("peak heights must be finite and > 0")
    slope = float(np.polynomial.polynomial.polyfit(swing, np.log(height), 1, w=height)[1])
    fall = _least_squares(swing, height, -slope)
    first, shape = _projected(swing, height, fall)
    residual = height - first * shape
    freedom = swing.size - 2
    reading_std = float(np.sqrt(residual @ residual / freedom))
    change = -swing * first * shape
    change -= shape * (shape @ change) / (shape @ shape)
    std = reading_std * student_ratio(freedom) / float(np.sqrt(change @ change))
    return Decrement(max(0.0, fall), std, first, reading_std, swing.size, float(np.ptp(swing)))


def _projected(swing: FloatArray, height: FloatArray, fall: float) -> tuple[float, FloatArray]:
    """Give the best first height for a decrement, and the shape it multiplies."""
    shape = np.exp(-fall * swing)
    return float(shape @ height / (shape @ shape)), shape


def _least_squares(swing: FloatArray, height: FloatArray, fall: float) -> float:
    """Find the decrement of least squares by Gauss and Newton's steps, the first height eliminated."""
    for _ in range(_MOST_STEPS):
        first, shape = _projected(swing, height, fall)
        change = -swing * first * shape
        change -= shape * (shape @ change) / (shape @ shape)
        step = float(change @ (height - first * shape) / (change @ change))
        fall += step
        if abs(step) * float(np.ptp(swing)) < _STILL:
            break
    return fall


def identify_peaks(
    time_s: FloatArray, height: FloatArray, *, peaks_per_swing: int = 1
) -> tuple[IdentifiedMode, Decrement]:
    """Find frequency and damping from the times and heights of peaks.

    Parameters
    ----------
    time_s : ndarray, shape (n,)
        Rising; peaks that were missed leave gaps of whole swings.
    height : ndarray, shape (n,)
        Peak heights, > 0, any unit.
    peaks_per_swing : int
        2 where the peaks of both sides were read.

    Raises
    ------
    PlantError
        As for `decrement`, or if the times do not rise, or are no whole swings apart.

    Examples
    --------
    >>> swing = np.arange(20.0)
    >>> mode, _ = identify_peaks(5.0 * swing, 9.0 * np.exp(-0.1 * swing))
    >>> round(mode.frequency_hz, 5), round(mode.damping_ratio, 5)
    (0.20003, 0.01591)
    """
    if time_s.size < FEWEST_PEAKS or not (np.diff(time_s) > 0.0).all():
        raise PlantError(f"times of peaks must rise, and be at least {FEWEST_PEAKS}")
    swing = np.concatenate([[0.0], np.cumsum(_periods(np.diff(time_s), _grid_s(time_s)))]) / peaks_per_swing
    found = decrement(swing, height)
    centred = swing - swing.mean()
    period_s = float(centred @ time_s / (centred @ centred))
    residual = time_s - time_s.mean() - period_s * centred
    freedom = swing.size - 2
    spread = student_ratio(freedom) * float(np.sqrt(residual @ residual / freedom / (centred @ centred)))
    return mode_of_period(period_s, spread, found), found


def _periods(gap_s: FloatArray, grid_s: float) -> FloatArray:
    """Count the periods in each gap: of the longest period that all gaps hold whole times."""
    counted = [_counted(gap_s, float(gap_s.min()) / parts) for parts in range(1, _MOST_PARTS + 1)]
    count, misfit = counted[0]
    worst = int(np.argmax(misfit))
    if misfit[worst] < _EXACT:
        return count
    # Rounded times fit any period that is hardly longer than their last digit.
    exact = [
        each
        for each, off in counted[1:]
        if off.max() < _EXACT and gap_s.sum() > _ROUNDINGS * grid_s * each.sum()
    ]
    if exact and misfit[worst] >= _MISFIT:
        return exact[0]
    if not exact and misfit[worst] < _MISFIT:
        return count
    raise PlantError(
        f"peaks {worst + 1} and {worst + 2} are {gap_s[worst]:.5g} s apart, which is"
        f" {gap_s[worst] * count.sum() / gap_s.sum():.3g} times the usual gap: must be whole swings; read the"
        " times more exactly, or without missing a peak"
    )


def _grid_s(time_s: FloatArray) -> float:
    """Give the coarsest of 10, 5, 2, 1, 0.5, ... s that all times are multiples of; 0 if none is."""
    for decade in 10.0 ** np.arange(1, -6, -1):
        for step in (decade, decade / 2.0, decade / 5.0):
            if np.abs(time_s / step - np.round(time_s / step)).max() < _EXACT:
                return float(step)
    return 0.0


def _counted(gap_s: FloatArray, period_s: float) -> tuple[FloatArray, FloatArray]:
    """Count periods in gaps, and say how far each is from whole ones, in periods.

    Gaps of one period refine it first, then those of two, of four, ...: what the period is off never adds
    up to half of one.
    """
    reach = 1.0
    while True:
        count = np.maximum(1.0, np.round(gap_s / period_s))
        short = count <= reach
        period_s = float(gap_s[short].sum() / count[short].sum()) if short.any() else period_s
        if short.all():
            count = np.maximum(1.0, np.round(gap_s / period_s))
            return count, np.abs(gap_s / period_s - count)
        reach *= 2.0


def mode_of_period(period_s: float, period_s_std: float, found: Decrement | None) -> IdentifiedMode:
    """Give the mode of a measured (damped) period and a decrement.

    Parameters
    ----------
    period_s, period_s_std : float
        Period, > 0, and its standard deviation.
    found : Decrement or None
        None where no heights were read: the damping is not known, and taken for 0.
    """
    fall = 0.0 if found is None else found.per_swing
    frequency_hz = float(np.hypot(2.0 * np.pi, fall)) / (2.0 * np.pi * period_s)
    by_fall = (
        0.0 if found is None else found.per_swing_std * fall / (2.0 * np.pi * period_s) ** 2 / frequency_hz
    )
    return IdentifiedMode(
        frequency_hz=frequency_hz,
        damping_ratio=None if found is None else found.damping_ratio,
        frequency_hz_std=float(np.hypot(frequency_hz * period_s_std / period_s, by_fall)),
        damping_ratio_std=None if found is None else found.damping_ratio_std,
        amplitude=None if found is None else found.first,
    )
