"""What a design is: impulses in continuous time, and what they guarantee. Not for: ticks or cranes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.errors import DesignError
from swayless.plant import Band, Mode

FloatArray: TypeAlias = NDArray[np.float64]

AMPLITUDE_SUM_TOLERANCE = 1e-12
"""How far the amplitudes of a shaper may sum from 1: rounding of a handful of doubles, no more."""


@dataclass(frozen=True)
class Guarantee:
    """What impulses hold: at most `tolerance` residual vibration anywhere in the bands, at every damping.

    Parameters
    ----------
    tolerance : float
        Largest residual vibration promised, as a ratio of the unshaped one (0.05 is 5 %).
    mode : Mode
        The mode the impulses were designed for; `mode.damping_ratio` holds over all bands.
    band : Band
        The connected band around the mode's frequency in which the residual stays at or below `tolerance`.
    worst_residual_ratio : float
        Largest residual vibration that occurs in the bands, as a ratio.
    further_bands : tuple of Band
        Bands of further modes, by rising frequency, above `band` and apart from it.
    highest_damping_ratio : float or None
        The tolerance holds from `mode.damping_ratio` up to here; None stands for that one value.

    Raises
    ------
    DesignError
        If the bands do not rise, or the highest damping ratio is below the mode's or not below 1.
    """

    tolerance: float
    mode: Mode
    band: Band
    worst_residual_ratio: float
    further_bands: tuple[Band, ...] = ()
    highest_damping_ratio: float | None = None

    def __post_init__(self) -> None:
        for lower, upper in pairwise(self.bands):
            if not lower.high_hz < upper.low_hz:
                raise DesignError(f"bands must rise and be apart, got {lower} before {upper}")
        lowest, highest = self.damping_ratios
        if not lowest <= highest < 1.0:
            raise DesignError(f"damping ratios {lowest!r} to {highest!r}: must rise and be below 1")

    @property
    def bands(self) -> tuple[Band, ...]:
        """All bands, by rising frequency."""
        return (self.band, *self.further_bands)

    @property
    def damping_ratios(self) -> tuple[float, float]:
        """Lowest and highest damping ratio held."""
        lowest = self.mode.damping_ratio
        return lowest, lowest if self.highest_damping_ratio is None else self.highest_damping_ratio


class Impulses(Protocol):
    """Anything made of impulses: a `Shaper`, or taps on a tick grid."""

    @property
    def times_s(self) -> FloatArray:
        """Times of the impulses, shape (n,), in seconds, rising."""

    @property
    def amplitudes(self) -> FloatArray:
        """Amplitudes of the impulses, shape (n,)."""


@dataclass(frozen=True, eq=False)
class Shaper:
    """A sequence of impulses in continuous time with which a command is convolved.

    Parameters
    ----------
    times_s : ndarray, shape (n,)
        Times of the impulses, the first 0, strictly increasing.
    amplitudes : ndarray, shape (n,)
        Amplitudes, summing to 1 within 1e-12. Negative ones are allowed.
    family : str
        Name of the family, such as ``"zvd"``.
    guarantee : Guarantee
        What the impulses hold.
    source : str
        Where the constraint equations come from: author, year, equation.

    Raises
    ------
    DesignError
        If an invariant does not hold.
    """

    times_s: FloatArray
    amplitudes: FloatArray
    family: str
    guarantee: Guarantee
    source: str

    def __post_init__(self) -> None:
        times_s = np.array(self.times_s, dtype=np.float64)
        amplitudes = np.array(self.amplitudes, dtype=np.float64)
        if times_s.ndim != 1 or times_s.shape != amplitudes.shape or times_s.size == 0:
            raise DesignError(f"{self.family}: times and amplitudes must be non-empty and of one length")
        if not (np.isfinite(times_s).all() and np.isfinite(amplitudes).all()):
            raise DesignError(f"{self.family}: times and amplitudes must be finite")
        if times_s[0] != 0.0 or np.any(np.diff(times_s) <= 0.0):
            raise DesignError(f"{self.family}: times must start at 0 and increase, got {times_s.tolist()}")
        if abs(float(amplitudes.sum()) - 1.0) > AMPLITUDE_SUM_TOLERANCE:
            raise DesignError(f"{self.family}: amplitudes sum to {amplitudes.sum()!r}, not to 1")
        times_s.flags.writeable = amplitudes.flags.writeable = False
        object.__setattr__(self, "times_s", times_s)
        object.__setattr__(self, "amplitudes", amplitudes)

    @property
    def duration_s(self) -> float:
        """Time of the last impulse, in seconds."""
        return float(self.times_s[-1])
