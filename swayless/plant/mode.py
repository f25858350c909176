"""One vibration of a machine, and a band of frequencies. Not for: what excites or cancels it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from swayless.errors import PlantError


@dataclass(frozen=True)
class Mode:
    """One lightly damped vibration.

    Parameters
    ----------
    frequency_hz : float
        Undamped natural frequency, > 0 and finite.
    damping_ratio : float
        0 <= damping_ratio < 1.

    Raises
    ------
    PlantError
        If either value is out of range.

    Examples
    --------
    >>> Mode(0.5, 0.1).damped_period_s
    2.010075630518424
    """

    frequency_hz: float
    damping_ratio: float = 0.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.frequency_hz) and self.frequency_hz > 0.0):
            raise PlantError(f"frequency_hz = {self.frequency_hz!r}: must be finite and > 0")
        if not 0.0 <= self.damping_ratio < 1.0:
            raise PlantError(f"damping_ratio = {self.damping_ratio!r}: must be at least 0 and below 1")

    @classmethod
    def from_damped_period(cls, period_s: float, damping_ratio: float = 0.0) -> Mode:
        """Make the mode whose measured (damped) period is `period_s`, in seconds, > 0."""
        if not (math.isfinite(period_s) and period_s > 0.0):
            raise PlantError(f"period_s = {period_s!r}: must be finite and > 0")
        undamped = cls(1.0 / period_s, damping_ratio)
        return cls(undamped.frequency_hz / math.sqrt(1.0 - damping_ratio**2), damping_ratio)

    @property
    def angular_frequency_rad_s(self) -> float:
        """Undamped angular frequency, 2 pi f."""
        return 2.0 * math.pi * self.frequency_hz

    @property
    def damped_period_s(self) -> float:
        """Period of the free vibration, 1 / (f sqrt(1 - damping_ratio^2))."""
        return 1.0 / (self.frequency_hz * math.sqrt(1.0 - self.damping_ratio**2))


@dataclass(frozen=True)
class Band:
    """A closed interval of undamped natural frequencies.

    Parameters
    ----------
    low_hz, high_hz : float
        0 < low_hz <= high_hz, finite.

    Raises
    ------
    PlantError
        If the ends are out of range or in the wrong order.

    Examples
    --------
    >>> Band(0.17, 0.30).contains(0.2)
    True
    """

    low_hz: float
    high_hz: float

    def __post_init__(self) -> None:
        if not (0.0 < self.low_hz <= self.high_hz and math.isfinite(self.high_hz)):
            raise PlantError(
                f"band {self.low_hz!r} to {self.high_hz!r} Hz: must be finite, > 0 and in rising order"
            )

    def contains(self, frequency_hz: float) -> bool:
        """Whether the frequency lies in the band, ends included."""
        return self.low_hz <= frequency_hz <= self.high_hz
