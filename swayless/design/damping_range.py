"""The worst residual vibration over a range of damping ratios, found on the edge of the range alone.

With s = 2 pi f (z + j sqrt(1 - z^2)) the residual vibration is the size of g(s) = sum A_i exp(s (t_i - t_n)),
which is analytic. A band and a range of damping ratios are a piece of a ring in the plane of s, and by the
maximum principle |g| is largest on its border: on the rays of the lowest and of the highest damping ratio
(`worst_residual`), or on the arcs at the ends of the band, which are searched here. Nothing between needs
to be sampled. Not for: the rays.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from swayless.design.residual import NEGLIGIBLE_AMPLITUDE
from swayless.design.shaper import FloatArray, Impulses

_SAMPLES_PER_CYCLE = 64  # |g|^2 ripples along an arc no faster than the phase of the first impulse turns
_FEWEST = 33
_REFINEMENTS = 6  # of Newton's method, which doubles the digits each time


class ArcPeak(NamedTuple):
    """Where on an arc the residual vibration is largest.

    Parameters
    ----------
    ratio : float
        Residual vibration.
    damping_ratio : float
        Where.
    """

    ratio: float
    damping_ratio: float


def worst_on_arc(impulses: Impulses, frequency_hz: float, damping_ratios: tuple[float, float]) -> ArcPeak:
    """Largest residual vibration at one frequency over a range of damping ratios.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or anything else with times and amplitudes.
    frequency_hz : float
        Undamped natural frequency, > 0.
    damping_ratios : tuple of float
        Lowest and highest, at least 0 and below 1.

    Returns
    -------
    ArcPeak

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> peak = worst_on_arc(design_shaper("zv", Mode(1.0, 0.1)), 1.0, (0.05, 0.12))
    >>> round(peak.ratio, 4), peak.damping_ratio
    (0.0723, 0.05)
    """
    arc = _Arc(impulses, frequency_hz)
    low, high = (math.asin(ratio) for ratio in damping_ratios)
    samples = max(_FEWEST, math.ceil(_SAMPLES_PER_CYCLE * arc.cycles_per_rad * (high - low)))
    angles_rad, step_rad = np.linspace(low, high, samples, retstep=True)
    square = arc.square(angles_rad)[0]
    top = (square >= np.append(-1.0, square[:-1])) & (square >= np.append(square[1:], -1.0))
    left, right = np.maximum(angles_rad[top] - step_rad, low), np.minimum(angles_rad[top] + step_rad, high)
    peaks_rad = angles_rad[top]
    for _ in range(_REFINEMENTS):
        _, slope, bend = arc.square(peaks_rad)
        towards = np.where(
            bend < 0.0, -slope / np.where(bend < 0.0, bend, -1.0), np.copysign(step_rad, slope)
        )
        peaks_rad = np.clip(peaks_rad + towards, left, right)
    squares = arc.square(peaks_rad)[0]
    best = int(squares.argmax())
    return ArcPeak(math.sqrt(squares[best]), math.sin(peaks_rad[best]))


class _Arc:
    """|g|^2 along an arc s = 2 pi f j exp(-j angle), on which the damping ratio is sin(angle)."""

    def __init__(self, impulses: Impulses, frequency_hz: float) -> None:
        last_s = impulses.times_s[np.flatnonzero(np.abs(impulses.amplitudes) >= NEGLIGIBLE_AMPLITUDE)[-1]]
        lags_s = impulses.times_s - last_s
        self.powers = impulses.amplitudes * lags_s ** np.arange(3)[:, np.newaxis]
        self.lags_s = lags_s
        self.size = 2.0 * math.pi * frequency_hz
        self.cycles_per_rad = frequency_hz * float(lags_s[-1] - lags_s[0])

    def square(self, angle_rad: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Evaluate |g|^2 and its first two derivatives."""
        pole = self.size * 1j * np.exp(-1j * angle_rad)
        value, first, second = self.powers @ np.exp(np.multiply.outer(self.lags_s, pole))
        slope, bend = -1j * pole * first, -(pole * first + pole**2 * second)
        steepness: FloatArray = 2.0 * (value.conj() * slope).real
        curvature: FloatArray = 2.0 * (np.abs(slope) ** 2 + (value.conj() * bend).real)
        return np.abs(value) ** 2, steepness, curvature
