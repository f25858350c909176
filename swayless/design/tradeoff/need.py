"""What a machine needs of its shapers: a range, a tolerance, and how far it may go on once released.

Not for: what could serve it (`candidates`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from swayless.design.robustness import DEFAULT_TOLERANCE
from swayless.errors import DesignError
from swayless.plant import Band, pendulum_rope_length_m

WHOLE = 1.0 - 1e-9
"""Share of a range from which on it counts as whole: edges are found to rounding."""


@dataclass(frozen=True)
class Need:
    """A range of modes, and what may be left of their vibration at which price.

    Parameters
    ----------
    band : Band
        Undamped natural frequencies of the machine, in Hz.
    tolerance : float
        Residual vibration as a ratio, above 0 and below 1.
    damping_ratio : float
        0 <= damping_ratio < 1, over the whole range.
    on_rope : bool
        Whether a load hangs on a rope: then ranges are measured in rope length, otherwise in frequency.
    speed_m_s : float
        Full speed, > 0.
    ramp_up_s, ramp_down_s : float
        Times of the machine's own ramps between rest and full speed, >= 0.
    longest_overtravel_m : float or None
        How far the machine may go on from full speed once it is released, > 0; None: any distance.

    Raises
    ------
    DesignError
        If a value is out of range.

    Examples
    --------
    >>> need = Need(Band(0.2, 0.4), speed_m_s=0.5, ramp_down_s=1.0)
    >>> need.overtravel_m(2.0)  # 2 m per m/s for the shaper, half a second for the ramp
    1.25
    """

    band: Band
    tolerance: float = DEFAULT_TOLERANCE
    damping_ratio: float = 0.0
    on_rope: bool = True
    speed_m_s: float = 1.0
    ramp_up_s: float = 0.0
    ramp_down_s: float = 0.0
    longest_overtravel_m: float | None = None

    def __post_init__(self) -> None:
        for name in ("ramp_up_s", "ramp_down_s"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise DesignError(f"{name} = {getattr(self, name)!r}: must be finite and >= 0")
        for name in ("speed_m_s", "longest_overtravel_m"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise DesignError(f"{name} = {value!r}: must be finite and > 0")
        if not 0.0 < self.tolerance < 1.0:
            raise DesignError(f"tolerance = {self.tolerance!r}: must be above 0 and below 1")
        if not 0.0 <= self.damping_ratio < 1.0:
            raise DesignError(f"damping_ratio = {self.damping_ratio!r}: must be at least 0 and below 1")

    @property
    def ratio(self) -> float:
        """Highest frequency over the lowest, at least 1."""
        return self.band.high_hz / self.band.low_hz

    def overtravel_m(self, shaping_s: float) -> float:
        """Way from full speed to rest, in m: of the shaping, given per unit of speed, and of the ramp."""
        return self.speed_m_s * (shaping_s + self.ramp_down_s / 2.0)

    def within(self, bands: Sequence[Band]) -> tuple[Band, ...]:
        """Parts of bands that lie in the range."""
        low_hz, high_hz = self.band.low_hz, self.band.high_hz
        clipped = [(max(band.low_hz, low_hz), min(band.high_hz, high_hz)) for band in bands]
        return tuple(Band(low, high) for low, high in clipped if low <= high)

    def share_of_frequencies(self, held: Sequence[Band]) -> float:
        """Part of the range, measured in Hz, that bands within it make up: 0 to 1."""
        return _share([_ends_hz(band) for band in held], _ends_hz(self.band))

    def share_of_ropes(self, held: Sequence[Band]) -> float:
        """Part of the range, measured in metres of rope, that bands within it make up: 0 to 1."""
        return _share([_ends_m(band) for band in held], _ends_m(self.band))

    def share(self, held: Sequence[Band]) -> float:
        """Part of the range in the measure of the machine."""
        return self.share_of_ropes(held) if self.on_rope else self.share_of_frequencies(held)


def _share(parts: Sequence[tuple[float, float]], whole: tuple[float, float]) -> float:
    """Length of intervals over that of the whole; a whole that is a point is held or not."""
    if whole[0] == whole[1]:
        return float(bool(parts))
    return math.fsum(high - low for low, high in parts) / (whole[1] - whole[0])


def _ends_hz(band: Band) -> tuple[float, float]:
    return band.low_hz, band.high_hz


def _ends_m(band: Band) -> tuple[float, float]:
    return pendulum_rope_length_m(band.high_hz), pendulum_rope_length_m(band.low_hz)
