"""What a residual is drawn over: frequency, or the rope length that has it. Not for: drawing."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import STANDARD_GRAVITY_M_S2, Band
from swayless.report.plotted import PlottedShaper
from swayless.report.ranges import Range
from swayless.report.sampling import point_count

Over = Literal["frequency", "rope_length"]

_MARGIN_RATIO = 0.25  # of the width of the held bands, on both sides of them
_HIGHEST_RATIO = 2.0  # of the highest mode: a band may have no upper end


@dataclass(frozen=True)
class Abscissa:
    """An axis that stands for the frequency of the mode.

    Parameters
    ----------
    title : str
        What it is, for the axis.
    unit : str
        Its unit.
    from_frequency_hz, to_frequency_hz : callable
        To and from the frequency, elementwise, strictly monotonic.

    Examples
    --------
    >>> low, high = ABSCISSAE["rope_length"].interval(Band(0.25, 0.5))
    >>> round(low, 4), round(high, 4)
    (0.9936, 3.9745)
    """

    title: str
    unit: str
    from_frequency_hz: Callable[[ArrayLike], FloatArray]
    to_frequency_hz: Callable[[ArrayLike], FloatArray]

    @property
    def label(self) -> str:
        """Title and unit."""
        return f"{self.title} ({self.unit})"

    def interval(self, band: Band) -> Range:
        """Where a band lies on this axis, rising."""
        low, high = np.sort(self.from_frequency_hz([band.low_hz, band.high_hz])).tolist()
        return low, high

    def position(self, frequency_hz: float) -> float:
        """Where a frequency lies on this axis."""
        return float(self.from_frequency_hz(frequency_hz))

    def span(self, shapers: Sequence[PlottedShaper]) -> Range:
        """Choose a range that shows every mode and held band with a margin beside them."""
        bands = [band for shaper in shapers for band in shaper.guarantee.bands]
        modes_hz = [shaper.guarantee.mode.frequency_hz for shaper in shapers]
        # Bands of further modes were asked for and have ends: they are shown whole.
        further_hz = [band.high_hz for shaper in shapers for band in shaper.guarantee.further_bands]
        top_hz = max(_HIGHEST_RATIO * max(modes_hz), *further_hz, 0.0)
        band = Band(min(one.low_hz for one in bands), min(max(one.high_hz for one in bands), top_hz))
        low, high = self.interval(band)
        margin = _MARGIN_RATIO * (high - low)
        return max(low - margin, low / 2.0), high + margin

    def samples(self, span: Range, shapers: Sequence[PlottedShaper]) -> FloatArray:
        """Points across a range, close enough for every shaper, with each mode and band end among them.

        Raises
        ------
        DesignError
            If the range is not finite, not positive or does not rise, or is too wide to be drawn.
        """
        low, high = span
        what = f"{self.title.lower()} from {low!r} to {high!r} {self.unit}"
        if not 0.0 < low < high < math.inf:
            raise DesignError(f"{what}: must be finite, > 0 and rise")
        first_hz, last_hz = self.to_frequency_hz(span).tolist()
        longest_s = max(shaper.duration_s for shaper in shapers)
        count = point_count(abs(last_hz - first_hz) * longest_s, what)
        # Even in both: even in the frequency follows the oscillation, even on the axis follows the eye.
        even = np.linspace(low, high, count)
        even_in_frequency = self.from_frequency_hz(np.linspace(first_hz, last_hz, count))
        guarantees = [shaper.guarantee for shaper in shapers]
        modes_hz = [guarantee.mode.frequency_hz for guarantee in guarantees]
        ends_hz = [end for g in guarantees for band in g.bands for end in (band.low_hz, band.high_hz)]
        marks = self.from_frequency_hz(modes_hz + ends_hz)
        points = np.unique(np.concatenate([even, even_in_frequency, marks]))
        return points[(points >= low) & (points <= high)]


def _same(values: ArrayLike) -> FloatArray:
    return np.asarray(values, dtype=np.float64)


def _rope_length_m(frequency_hz: ArrayLike) -> FloatArray:
    return STANDARD_GRAVITY_M_S2 / (2.0 * np.pi * _same(frequency_hz)) ** 2


def _frequency_hz(rope_length_m: ArrayLike) -> FloatArray:
    return np.sqrt(STANDARD_GRAVITY_M_S2 / _same(rope_length_m)) / (2.0 * np.pi)


ABSCISSAE: Mapping[Over, Abscissa] = MappingProxyType(
    {
        "frequency": Abscissa("Frequency", "Hz", _same, _same),
        "rope_length": Abscissa("Rope length", "m", _rope_length_m, _frequency_hz),
    }
)
