"""A measured free swing: times, values, and what the values are. Not for: reading files."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.errors import PlantError

FloatArray: TypeAlias = NDArray[np.float64]

FEWEST_SAMPLES = 8
"""A mode has four unknowns, offset and drift are two; two samples more tell the noise."""

LARGEST, SMALLEST = 1e100, 1e-100
"""Sizes whose squares, summed, are numbers; no unit of a measurement needs others."""


class Quantity(StrEnum):
    """What was measured of the swing."""

    value = "value"
    angle = "angle"
    position = "position"
    acceleration = "acceleration"


@dataclass(frozen=True, eq=False)
class SwingRecord:
    """A free swing, sampled evenly or not.

    Parameters
    ----------
    time_s : ndarray, shape (n,)
        Finite and rising; gaps are samples that are missing, and do no harm.
    value : ndarray, shape (n,)
        Finite: rad, m or m/s2 for an angle, a position or an acceleration; any unit for a `value`.
    quantity : Quantity
        What the values are.

    Raises
    ------
    PlantError
        If times or values are not finite, times do not rise, there are fewer than eight samples, or the
        largest value is beyond 1e100 or, unless all are 0, below 1e-100.

    Examples
    --------
    >>> SwingRecord(np.linspace(0.0, 20.0, 201), np.zeros(201)).duration_s
    20.0
    """

    time_s: FloatArray
    value: FloatArray
    quantity: Quantity = Quantity.value

    def __post_init__(self) -> None:
        if self.time_s.ndim != 1 or self.time_s.shape != self.value.shape:
            raise PlantError(
                f"times of shape {self.time_s.shape}, values of shape {self.value.shape}:"
                " must be two arrays of the same length"
            )
        if self.time_s.size < FEWEST_SAMPLES:
            raise PlantError(f"{self.time_s.size} samples: must be at least {FEWEST_SAMPLES}")
        if not (np.isfinite(self.time_s).all() and np.isfinite(self.value).all()):
            raise PlantError("times and values must be finite: leave missing samples out")
        if not (np.diff(self.time_s) > 0.0).all():
            raise PlantError("times must rise from sample to sample")
        largest = float(np.max(np.abs(self.value)))
        if largest != 0.0 and not SMALLEST <= largest <= LARGEST:
            raise PlantError(
                f"the largest value is {largest:.3g}: must be from {SMALLEST:g} to {LARGEST:g}; record it in"
                " another unit"
            )

    @property
    def duration_s(self) -> float:
        """From the first sample to the last."""
        return float(self.time_s[-1] - self.time_s[0])

    @property
    def interval_s(self) -> float:
        """Usual time between samples: the median."""
        return float(np.median(np.diff(self.time_s)))
