"""What amplitudes at fixed times must hold: bands, each at one damping ratio, seen as one.

Not for: a single band, which is a `Response`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.design.minimax.response import ComplexArray, IndexArray, Response
from swayless.design.shaper import FloatArray


@dataclass(frozen=True, eq=False)
class HeldPeaks:
    """Local maxima of the residual vibration on all lines, one line after the other.

    Parameters
    ----------
    line : ndarray of int, shape (m,)
        Index of the line that a peak lies on.
    frequency : ndarray, shape (m,)
        Where it lies, in cycles per duration.
    value : ndarray of complex, shape (m,)
        Residual vibration there.
    """

    line: IndexArray
    frequency: FloatArray
    value: ComplexArray

    @property
    def worst(self) -> float:
        """Largest residual vibration on any line, as a ratio."""
        return float(np.abs(self.value).max())


@dataclass(frozen=True, eq=False)
class Held:
    """Lines of frequencies, each at one damping ratio, and what unit impulses at n times leave on them.

    Parameters
    ----------
    exponents : ndarray of complex, shape (lines, n)
        `Response.exponents` of each line.
    low, high : ndarray, shape (lines,)
        Ends of each line, in cycles per duration.
    """

    exponents: ComplexArray
    low: FloatArray
    high: FloatArray

    def of(self, taps: IndexArray) -> Held:
        """Keep only the impulses `taps`."""
        return Held(self.exponents[:, taps], self.low, self.high)

    def spread(self, count: int) -> tuple[IndexArray, FloatArray]:
        """Spread frequencies evenly over every line: index of the line, and frequency."""
        lines = [
            np.unique(np.linspace(low, high, count)) for low, high in zip(self.low, self.high, strict=True)
        ]
        sizes = [line.size for line in lines]
        return np.repeat(np.arange(len(lines), dtype=np.intp), sizes), np.concatenate(lines)

    def peaks(self, amplitudes: FloatArray) -> HeldPeaks:
        """Find every local maximum on every line, the ends included."""
        found = [
            Response(exponents).peaks(amplitudes, low, high)
            for exponents, low, high in zip(self.exponents, self.low, self.high, strict=True)
        ]
        sizes = [peaks.frequency.size for peaks in found]
        return HeldPeaks(
            np.repeat(np.arange(len(found), dtype=np.intp), sizes),
            np.concatenate([peaks.frequency for peaks in found]),
            np.concatenate([peaks.value for peaks in found]),
        )

    def inside(self, peaks: HeldPeaks) -> FloatArray:
        """Tell peaks inside their lines (1), which move with the amplitudes, from those at an end (0)."""
        low, high = self.low[peaks.line], self.high[peaks.line]
        return ((peaks.frequency > low) & (peaks.frequency < high)).astype(np.float64)
