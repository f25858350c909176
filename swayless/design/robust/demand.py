"""What a robust design is asked to hold: bands, damping ratios and the sign rule, checked and free of units.

Not for: durations and tolerances, which are what a design finds (`specified`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust.lines import Line
from swayless.design.shaper import Guarantee
from swayless.errors import DesignError
from swayless.plant import Band, Mode

Amplitudes: TypeAlias = Literal["positive", "bounded", "unity-magnitude"]

RULES = {
    "positive": AmplitudeRule.POSITIVE,
    "bounded": AmplitudeRule.BOUNDED,
    "unity-magnitude": AmplitudeRule.BOUNDED,
}
TOLERANCES = (0.01, 0.2)
"""Smallest and largest tolerance that is designed for."""

WIDEST_RATIO = 8.0
"""Largest ratio of the ends of one band."""

WIDEST_SPAN = 24.0
"""Largest ratio of the highest frequency of several bands to the lowest."""

LARGEST_DAMPING_RATIO = 0.2
_FEWEST_IMPULSES = 3


class NotHeldError(DesignError):
    """So many impulses cannot hold what is asked for, whatever their duration."""


class FewerDoError(DesignError):
    """Fewer impulses than asked for are as good.

    Parameters
    ----------
    message : str
        Which number does.
    worst : float
        What they leave, as a ratio.
    """

    def __init__(self, message: str, worst: float) -> None:
        super().__init__(message)
        self.worst = worst


@dataclass(frozen=True)
class Demand:
    """What a design must hold.

    Parameters
    ----------
    bands : tuple of Band
        Rising and apart.
    damping_ratios : tuple of float
        Lowest and highest, 0 to 0.2.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule.
    impulses : int or None
        With "unity-magnitude": how many, odd and at least 3. None: as many as it takes.
    """

    bands: tuple[Band, ...]
    damping_ratios: tuple[float, float]
    amplitudes: Amplitudes
    impulses: int | None

    @classmethod
    def of(
        cls,
        bands: Band | Sequence[Band],
        damping_ratio: float | tuple[float, float],
        amplitudes: Amplitudes,
        impulses: int | None,
    ) -> Demand:
        """Check what is asked for; bands that meet or overlap become one.

        Raises
        ------
        DesignError
            If a value is out of range.

        Examples
        --------
        >>> demand = Demand.of([Band(0.3, 0.4), Band(0.2, 0.35)], 0.0, "positive", None)
        >>> demand.bands
        (Band(low_hz=0.2, high_hz=0.4),)
        """
        check_amplitudes(amplitudes, impulses)
        return cls(_merged(bands), damping_range(damping_ratio), amplitudes, impulses)

    @property
    def rule(self) -> AmplitudeRule:
        """Linear constraints of the sign rule; those of unity-magnitude shapers are the bounded ones'."""
        return RULES[self.amplitudes]

    @property
    def unit_hz(self) -> float:
        """Lowest frequency: the unit of the lines."""
        return self.bands[0].low_hz

    @property
    def lines(self) -> list[Line]:
        """Every band at the lowest and at the highest damping ratio."""
        return [
            Line(band.low_hz / self.unit_hz, band.high_hz / self.unit_hz, damping)
            for damping in dict.fromkeys(self.damping_ratios)
            for band in self.bands
        ]

    def promise(self, tolerance: float) -> Guarantee:
        """Guarantee that the bands are held at a tolerance."""
        (low, high), first = self.damping_ratios, self.bands[0]
        mode = Mode(math.sqrt(first.low_hz * first.high_hz), low)
        return Guarantee(tolerance, mode, first, tolerance, self.bands[1:], None if high == low else high)

    def __str__(self) -> str:
        low, high = self.damping_ratios
        what = " and ".join(f"{band.low_hz:g} to {band.high_hz:g} Hz" for band in self.bands)
        kind = self.amplitudes if self.impulses is None else f"{self.amplitudes} {self.impulses}-impulse"
        damping = f"damping ratio {low:g}" if low == high else f"damping ratios {low:g} to {high:g}"
        return f"{kind} shaper for {what}, {damping}"


def check_amplitudes(amplitudes: str, impulses: int | None) -> None:
    """Refuse a sign rule that is none, and a number of impulses that the rule does not have."""
    if amplitudes not in RULES:
        raise DesignError(f"amplitudes = {amplitudes!r}: must be one of {', '.join(RULES)}")
    if impulses is None:
        return
    if amplitudes != "unity-magnitude":
        raise DesignError(f"impulses = {impulses!r}: only with amplitudes = 'unity-magnitude'")
    check_impulses(impulses)


def check_impulses(impulses: int) -> None:
    """Refuse a number of impulses +1, -1, ..., +1 that there cannot be."""
    if impulses < _FEWEST_IMPULSES or impulses % 2 == 0:
        raise DesignError(f"impulses = {impulses!r}: must be odd and at least {_FEWEST_IMPULSES}")


def check_tolerance(tolerance: float) -> None:
    """Refuse a tolerance that is not designed for."""
    lowest, highest = TOLERANCES
    if not lowest <= tolerance <= highest:
        raise DesignError(f"tolerance = {tolerance!r}: must be {lowest:g} to {highest:g}")


def check_duration(duration_s: float) -> None:
    """Refuse a duration that is none."""
    if not (math.isfinite(duration_s) and duration_s > 0.0):
        raise DesignError(f"duration_s = {duration_s!r}: must be finite and > 0")


def damping_range(damping_ratio: float | tuple[float, float]) -> tuple[float, float]:
    """Lowest and highest damping ratio, checked."""
    low, high = damping_ratio if isinstance(damping_ratio, tuple) else (damping_ratio, damping_ratio)
    if not 0.0 <= low <= high <= LARGEST_DAMPING_RATIO:
        raise DesignError(
            f"damping_ratio = {damping_ratio!r}: must be 0 to {LARGEST_DAMPING_RATIO:g}, lowest first"
        )
    return low, high


def _merged(bands: Band | Sequence[Band]) -> tuple[Band, ...]:
    """Bands by rising frequency, those that meet or overlap as one, checked."""
    merged: list[Band] = []
    for band in sorted([bands] if isinstance(bands, Band) else bands, key=lambda band: band.low_hz):
        if merged and band.low_hz <= merged[-1].high_hz:
            merged[-1] = Band(merged[-1].low_hz, max(band.high_hz, merged[-1].high_hz))
        else:
            merged.append(band)
    if not merged:
        raise DesignError("bands = []: must be at least one")
    for band in merged:
        _check_ratio(band, WIDEST_RATIO, "split it into rows of a bank")
    _check_ratio(Band(merged[0].low_hz, merged[-1].high_hz), WIDEST_SPAN, "shape one of the modes by itself")
    return tuple(merged)


def _check_ratio(band: Band, most: float, advice: str) -> None:
    """Refuse frequencies too far apart."""
    ratio = band.high_hz / band.low_hz
    if ratio > most:
        what = f"band {band.low_hz:g} to {band.high_hz:g} Hz"
        raise DesignError(f"{what}: the ratio {ratio:g} must be at most {most:g}; {advice}")
