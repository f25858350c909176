"""Residual vibration as a linear function of amplitudes at fixed times, and where over a band it peaks.

Everything is free of units: times in durations, frequencies in cycles per duration, so that one scale fits
every crane. Not for: designs whose times move (`families`), nor the proof of a finished design
(`robustness`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.design.shaper import FloatArray

ComplexArray: TypeAlias = NDArray[np.complex128]
IndexArray: TypeAlias = NDArray[np.intp]

_POINTS_PER_CYCLE = 32  # |G|^2 holds no faster ripple than one per cycle: no peak hides between 32 points
_REFINEMENTS = 6  # Newton doubles the digits each time, from a start within 1/32 of a cycle


@dataclass(frozen=True, eq=False)
class Peaks:
    """Local maxima of the residual vibration over a band, its ends included.

    Parameters
    ----------
    frequency : ndarray, shape (m,)
        Where they lie, rising, in cycles per duration.
    value : ndarray of complex, shape (m,)
        Residual vibration there: its magnitude is the ratio V, its angle the phase of what is left.
    """

    frequency: FloatArray
    value: ComplexArray

    @property
    def worst(self) -> float:
        """Largest residual vibration over the band, as a ratio."""
        return float(np.abs(self.value).max())


@dataclass(frozen=True, eq=False)
class Response:
    """What unit impulses at fixed times leave swinging when the last of them acts.

    Parameters
    ----------
    exponents : ndarray of complex, shape (n,)
        2 pi (z + j sqrt(1 - z^2)) (t_i - t_n) / t_n with z the damping ratio: the residual vibration of
        amplitudes A at frequency f is |sum A_i exp(f exponents_i)|.
    """

    exponents: ComplexArray

    @classmethod
    def of_times(cls, times: FloatArray, damping_ratio: float) -> Response:
        """Response of impulses at rising `times`, of any unit; the vibration is read at the last of them."""
        turn = 2.0 * math.pi * complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2))
        return cls(turn * (times - times[-1]) / (times[-1] - times[0]))

    def of(self, taps: IndexArray) -> Response:
        """Keep only the impulses `taps`; the vibration is still read at the same moment."""
        return Response(self.exponents[taps])

    def columns(self, frequency: FloatArray) -> ComplexArray:
        """Residual vibration of each unit impulse, shape (frequencies, impulses)."""
        columns: ComplexArray = np.exp(np.multiply.outer(frequency, self.exponents))
        return columns

    def peaks(self, amplitudes: FloatArray, low: float, high: float) -> Peaks:
        """Find every local maximum from `low` to `high` cycles per duration; a single frequency is one."""
        points = math.ceil(_POINTS_PER_CYCLE * (high - low)) + 9 if high > low else 1
        grid, step = np.linspace(low, high, points), (high - low) / max(points - 1, 1)
        ratio = np.abs(self.columns(grid) @ amplitudes)
        top = np.flatnonzero((ratio >= np.append(-1.0, ratio[:-1])) & (ratio >= np.append(ratio[1:], -1.0)))
        left, right = np.maximum(grid[top] - step, low), np.minimum(grid[top] + step, high)
        frequency = self._climb(amplitudes, grid[top], left, right)
        value = self.columns(frequency) @ amplitudes
        return Peaks(frequency, value)

    def _climb(
        self, amplitudes: FloatArray, frequency: FloatArray, left: FloatArray, right: FloatArray
    ) -> FloatArray:
        """Newton's method for the slope of |G|^2 to be 0, held between `left` and `right`."""
        weights = amplitudes * self.exponents ** np.arange(3)[:, np.newaxis]
        for _ in range(_REFINEMENTS):
            value, slope, curve = weights @ self.columns(frequency).T
            first = (value.conj() * slope).real
            second = np.abs(slope) ** 2 + (value.conj() * curve).real
            # Where it curves upwards the peak is at the end that the slope points to.
            newton = first / np.where(second < 0.0, -second, np.inf)
            step = np.where(second < 0.0, newton, np.sign(first) * (right - left))
            frequency = np.clip(frequency + step, left, right)
        return frequency
