"""Frequency from a stopwatch. Not for: damping, which a stopwatch does not show."""

from __future__ import annotations

import math

import numpy as np

from swayless.errors import PlantError
from swayless.plant.identification.identified_mode import IdentifiedMode
from swayless.plant.identification.noise import student_ratio
from swayless.plant.identification.peaks import mode_of_period
from swayless.plant.identification.record import FloatArray

REACTION_S = 0.15
"""Standard deviation of one reading, start and stop by hand, where a single one does not tell."""

_SAME_COUNT = 0.5
"""Readings that differ by more, in swings, hold different numbers of them."""

LARGEST_ANGLE_RAD = math.pi / 2.0


def identify_periods(
    reading_s: FloatArray, *, swings: int = 1, resolution_s: float = 0.0, amplitude_rad: float = 0.0
) -> IdentifiedMode:
    """Find the frequency from readings of a stopwatch.

    Parameters
    ----------
    reading_s : ndarray, shape (n,)
        Readings, > 0. Of a single one the uncertainty is that of a hand.
    swings : int
        Whole swings that each reading lasts: ten make it ten times as exact.
    resolution_s : float
        Smallest difference that the readings can show: equal ones are exact to its rounding only.
    amplitude_rad : float
        Mean amplitude of a load on a rope, below a right angle: large swings are slower.

    Raises
    ------
    PlantError
        If a value is out of range, or the readings differ by more than half a swing.

    References
    ----------
    L. D. Landau and E. M. Lifshitz, *Mechanics*, 3rd ed. (1976), section 11, problem 1: the period as a
    complete elliptic integral, here as an arithmetic-geometric mean.

    Examples
    --------
    >>> mode = identify_periods(np.array([6.1, 6.0, 6.2]))
    >>> round(mode.frequency_hz, 5), round(mode.frequency_hz_std, 5)
    (0.16393, 0.00351)
    """
    _check(reading_s, swings, amplitude_rad)
    count = reading_s.size
    rounding_s = resolution_s / math.sqrt(12.0)
    one_std = REACTION_S if count == 1 else float(np.std(reading_s, ddof=1)) * student_ratio(count - 1)
    period_s = float(reading_s.mean()) / swings
    std_s = math.hypot(one_std / math.sqrt(count), rounding_s) / swings
    slower = 1.0 / _mean(1.0, math.cos(amplitude_rad / 2.0))
    return mode_of_period(period_s / slower, std_s / slower, None)


def _check(reading_s: FloatArray, swings: int, amplitude_rad: float) -> None:
    """Refuse values that are out of range."""
    if reading_s.ndim != 1 or not (
        reading_s.size and np.isfinite(reading_s).all() and (reading_s > 0.0).all()
    ):
        raise PlantError("periods must be one or more finite times > 0")
    if swings < 1:
        raise PlantError(f"swings = {swings}: must be at least 1")
    if not 0.0 <= amplitude_rad < LARGEST_ANGLE_RAD:
        raise PlantError(f"amplitude_rad = {amplitude_rad!r}: must be at least 0 and below a right angle")
    if np.ptp(reading_s) > _SAME_COUNT * reading_s.min() / swings:
        raise PlantError(
            f"readings from {reading_s.min():g} to {reading_s.max():g} s differ by more than half a swing:"
            " must be the same number of swings each"
        )


def _mean(larger: float, smaller: float) -> float:
    """Give the arithmetic-geometric mean."""
    while larger - smaller > 1e-15 * larger:
        larger, smaller = (larger + smaller) / 2.0, math.sqrt(larger * smaller)
    return larger
