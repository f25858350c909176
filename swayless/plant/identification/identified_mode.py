"""A mode as a record tells it: frequency and damping with their uncertainty. Not for: how they were found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.plant.mode import Band, Mode

HELD_DEVIATIONS = 2.0
"""A design holds the band of so many standard deviations to either side: 95 % of what the truth may be."""


@dataclass(frozen=True)
class IdentifiedMode:
    """One mode with its uncertainty.

    Parameters
    ----------
    frequency_hz : float
        Undamped natural frequency, of small swings.
    damping_ratio : float or None
        At least 0; None where the measurement does not show it.
    frequency_hz_std, damping_ratio_std : float
        Standard deviations; twice them covers 95 %. The one of the damping is None with it.
    amplitude : float or None
        At the first sample, in the unit of the record.

    Examples
    --------
    >>> mode = IdentifiedMode(0.2, 0.004, 0.001, 0.0005)
    >>> band = mode.band()
    >>> round(band.low_hz, 6), round(band.high_hz, 6), mode.damping_range()
    (0.198, 0.202, (0.003, 0.005))
    """

    frequency_hz: float
    damping_ratio: float | None
    frequency_hz_std: float
    damping_ratio_std: float | None
    amplitude: float | None = None

    @property
    def mode(self) -> Mode:
        """The mode itself; undamped where the damping is not known."""
        return Mode(self.frequency_hz, self.damping_ratio or 0.0)

    @property
    def damping_is_below_resolution(self) -> bool:
        """Whether the damping may as well be 0."""
        return (
            self.damping_ratio is not None
            and self.damping_ratio_std is not None
            and self.damping_ratio < HELD_DEVIATIONS * self.damping_ratio_std
        )

    def band(self, deviations: float = HELD_DEVIATIONS) -> Band:
        """Give the frequencies within so many standard deviations: what a design has to hold."""
        reach = min(deviations * self.frequency_hz_std, 0.99 * self.frequency_hz)
        return Band(self.frequency_hz - reach, self.frequency_hz + reach)

    def damping_range(self, deviations: float = HELD_DEVIATIONS) -> tuple[float, float]:
        """Give the damping ratios within so many standard deviations, at least 0 and below 1."""
        ratio, reach = self.damping_ratio or 0.0, deviations * (self.damping_ratio_std or 0.0)
        return max(0.0, ratio - reach), min(float(np.nextafter(1.0, 0.0)), ratio + reach)
