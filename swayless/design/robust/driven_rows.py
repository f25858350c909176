"""Rows of a bank for a crane whose damping changes with the rope: each is designed for that of its middle.

What they hold at the damping of every rope is still to be found (`swayless.design.along_ropes`).
Not for: plants with one damping ratio (`rows`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from swayless.design.robust.rows import ContinuousRows, TickRows
from swayless.design.robust.specified import RobustDesign
from swayless.design.robust.ticks import RobustTaps
from swayless.plant import Band, DrivenRopes


@dataclass(frozen=True, kw_only=True)
class DrivenContinuousRows(ContinuousRows):
    """Rows in continuous time, each at a damping ratio of its own.

    Parameters
    ----------
    amplitudes, impulses, damping_ratio
        As for `ContinuousRows`; the damping ratio only tells whether a duration is too long for any row.
    ropes : DrivenRopes
        Where the damping ratios come from.

    Examples
    --------
    >>> from swayless.plant import ServoDrive
    >>> ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 6000.0, 0.1), (3.0, 12.0))
    >>> row = DrivenContinuousRows(ropes=ropes).widest(6.0, 0.15, 0.05)
    >>> round(row.shaper.guarantee.mode.damping_ratio, 3)
    0.046
    """

    ropes: DrivenRopes

    def widest(self, duration_s: float, low_hz: float, tolerance: float) -> RobustDesign:
        """Design for the damping at the start, then for that in the middle of what is held."""
        first = self._near(low_hz).widest(duration_s, low_hz, tolerance)
        high_hz = first.shaper.guarantee.band.high_hz
        return self._near(math.sqrt(low_hz * high_hz)).widest(duration_s, low_hz, tolerance)

    def shortest(self, band: Band, tolerance: float) -> RobustDesign:
        """Design for the damping in the middle of the band."""
        return self._near(math.sqrt(band.low_hz * band.high_hz)).shortest(band, tolerance)

    def least(self, duration_s: float, band: Band) -> RobustDesign:
        """Design for the damping in the middle of the band."""
        return self._near(math.sqrt(band.low_hz * band.high_hz)).least(duration_s, band)

    def _near(self, frequency_hz: float) -> ContinuousRows:
        return ContinuousRows(self.amplitudes, self.impulses, self.ropes.damping_near(frequency_hz))


@dataclass(frozen=True, kw_only=True)
class DrivenTickRows(TickRows):
    """Rows on whole ticks, each at a damping ratio of its own.

    Parameters
    ----------
    tick_s, amplitudes, impulses, damping_ratio
        As for `TickRows`.
    ropes : DrivenRopes
        Where the damping ratios come from.
    """

    ropes: DrivenRopes

    @property
    def ideal(self) -> DrivenContinuousRows:
        """The same rows in continuous time."""
        return DrivenContinuousRows(
            amplitudes=self.amplitudes,
            impulses=self.impulses,
            damping_ratio=self.damping_ratio,
            ropes=self.ropes,
        )

    def widest(self, duration_s: float, low_hz: float, tolerance: float) -> RobustTaps:
        """Design for the damping at the start, then for that in the middle of what is held."""
        first = self.ideal.widest(duration_s, low_hz, tolerance)
        high_hz = first.shaper.guarantee.band.high_hz
        return self._near(math.sqrt(low_hz * high_hz)).widest(duration_s, low_hz, tolerance)

    def shortest(self, band: Band, tolerance: float) -> RobustTaps:
        """Design for the damping in the middle of the band."""
        return self._near(math.sqrt(band.low_hz * band.high_hz)).shortest(band, tolerance)

    def least(self, duration_s: float, band: Band) -> RobustTaps:
        """Design for the damping in the middle of the band."""
        return self._near(math.sqrt(band.low_hz * band.high_hz)).least(duration_s, band)

    def _near(self, frequency_hz: float) -> TickRows:
        near = self.ropes.damping_near(frequency_hz)
        return TickRows(self.tick_s, self.amplitudes, self.impulses, near)
