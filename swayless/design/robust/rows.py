"""Who designs the rows of a bank: in continuous time, or on the controller's own ticks.

Not for: how many rows there are and where they meet, which is `bank`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, TypeVar

from swayless.design.robust.demand import FewerDoError
from swayless.design.robust.specified import (
    Amplitudes,
    RobustDesign,
    fixed_duration,
    least_residual,
    specified_insensitivity,
)
from swayless.design.robust.ticks import (
    RobustTaps,
    fixed_duration_on_ticks,
    last_tick,
    least_residual_on_ticks,
    specified_insensitivity_on_ticks,
    taps_after,
)
from swayless.design.shaper import Guarantee
from swayless.plant import Band

Row = TypeVar("Row")


class RowDesigner(Protocol[Row]):
    """Designs one row at a time; every method raises `DesignError` where there is no such row."""

    @property
    def ideal(self) -> ContinuousRows:
        """The same rows in continuous time, which no others can beat."""

    def widest(self, duration_s: float, low_hz: float, tolerance: float) -> Row:
        """Hold the tolerance from `low_hz` as far up as a duration allows."""

    def shortest(self, band: Band, tolerance: float) -> Row:
        """Hold the tolerance over a band in the shortest time."""

    def least(self, duration_s: float, band: Band) -> Row:
        """Leave the least over a band in a given time."""

    def follow(self, design: RobustDesign) -> Row:
        """Make the row that leaves least of all that a design in continuous time holds, as long as it."""

    def usable_s(self, duration_s: float) -> float:
        """Tell how much of a duration a row can use."""

    def promise_of(self, row: Row) -> Guarantee:
        """Tell what a row was designed to hold."""

    def duration_s_of(self, row: Row) -> float:
        """Tell how long a row lasts, in seconds."""


@dataclass(frozen=True)
class ContinuousRows:
    """Rows in continuous time.

    Parameters
    ----------
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule, as for `specified_insensitivity`.
    impulses : int or None
        With "unity-magnitude": how many, odd and at least 3. None: as many as the best row takes.
    damping_ratio : float
        Of the mode, at all frequencies: 0 to 0.2.

    Examples
    --------
    >>> row = ContinuousRows("bounded").widest(1.2, 0.5, 0.05)
    >>> round(row.shaper.guarantee.band.high_hz, 3)
    0.721
    """

    amplitudes: Amplitudes = "positive"
    impulses: int | None = None
    damping_ratio: float = 0.0

    @property
    def ideal(self) -> ContinuousRows:
        """These rows themselves."""
        return self

    def widest(self, duration_s: float, low_hz: float, tolerance: float) -> RobustDesign:
        """Design with `fixed_duration`."""
        return fixed_duration(
            duration_s,
            low_hz,
            tolerance=tolerance,
            damping_ratio=self.damping_ratio,
            amplitudes=self.amplitudes,
            impulses=self.impulses,
        )

    def shortest(self, band: Band, tolerance: float) -> RobustDesign:
        """Design with `specified_insensitivity`."""
        return specified_insensitivity(
            band,
            tolerance=tolerance,
            damping_ratio=self.damping_ratio,
            amplitudes=self.amplitudes,
            impulses=self.impulses,
        )

    def least(self, duration_s: float, band: Band) -> RobustDesign:
        """Design with `least_residual`."""
        return least_residual(
            duration_s,
            band,
            damping_ratio=self.damping_ratio,
            amplitudes=self.amplitudes,
            impulses=self.impulses,
        )

    def excess(self, duration_s: float, band: Band, tolerance: float) -> float:
        """Tell how far a row of a duration is from holding a band, as a logarithm: it does if at most 0.

        Of the duration that it needs, or, of so many impulses, which may hold it in less time but not in
        more, of what they leave.
        """
        if self.impulses is None:
            return math.log(self.shortest(band, tolerance).shaper.duration_s / duration_s)
        try:
            left = self.least(duration_s, band).shaper.guarantee.tolerance
        except FewerDoError as fewer:
            left = fewer.worst
        return math.log(left / tolerance)

    def follow(self, design: RobustDesign) -> RobustDesign:
        """Return the design itself."""
        return design

    def usable_s(self, duration_s: float) -> float:
        """Return all of it."""
        return duration_s

    def promise_of(self, row: RobustDesign) -> Guarantee:
        """Guarantee of the shaper."""
        return row.shaper.guarantee

    def duration_s_of(self, row: RobustDesign) -> float:
        """Duration of the shaper."""
        return row.shaper.duration_s


@dataclass(frozen=True)
class TickRows:
    """Rows on whole ticks: what they promise is what their taps hold.

    Parameters
    ----------
    tick_s : float
        Tick of the controller, > 0.
    amplitudes, impulses, damping_ratio
        As for `ContinuousRows`. Rows of unity magnitude switch on whole ticks alone, as contactors must.

    Examples
    --------
    >>> row = TickRows(0.01, "bounded").widest(1.2, 0.5, 0.05)
    >>> row.taps.delays_ticks.tolist()[-1], round(row.taps.guarantee.band.high_hz, 3)
    (120, 0.721)
    """

    tick_s: float
    amplitudes: Amplitudes = "positive"
    impulses: int | None = None
    damping_ratio: float = 0.0

    @property
    def ideal(self) -> ContinuousRows:
        """The same rows in continuous time."""
        return ContinuousRows(self.amplitudes, self.impulses, self.damping_ratio)

    def widest(self, duration_s: float, low_hz: float, tolerance: float) -> RobustTaps:
        """Design with `fixed_duration_on_ticks`."""
        return fixed_duration_on_ticks(
            duration_s,
            low_hz,
            self.tick_s,
            tolerance=tolerance,
            damping_ratio=self.damping_ratio,
            amplitudes=self.amplitudes,
            impulses=self.impulses,
        )

    def shortest(self, band: Band, tolerance: float) -> RobustTaps:
        """Design with `specified_insensitivity_on_ticks`."""
        return specified_insensitivity_on_ticks(
            band,
            self.tick_s,
            tolerance=tolerance,
            damping_ratio=self.damping_ratio,
            amplitudes=self.amplitudes,
            impulses=self.impulses,
        )

    def least(self, duration_s: float, band: Band) -> RobustTaps:
        """Design with `least_residual_on_ticks`."""
        return least_residual_on_ticks(
            duration_s,
            band,
            self.tick_s,
            damping_ratio=self.damping_ratio,
            amplitudes=self.amplitudes,
            impulses=self.impulses,
        )

    def follow(self, design: RobustDesign) -> RobustTaps:
        """Design with `taps_after`."""
        return taps_after(design, self.tick_s, self.amplitudes)

    def usable_s(self, duration_s: float) -> float:
        """Return its whole ticks."""
        return last_tick(duration_s, self.tick_s) * self.tick_s

    def promise_of(self, row: RobustTaps) -> Guarantee:
        """Guarantee of the taps."""
        return row.taps.guarantee

    def duration_s_of(self, row: RobustTaps) -> float:
        """Duration of the taps."""
        return row.taps.duration_s
