"""Taps at multiples of a spacing that follows a position: constants of Magee and Book's two laws.

Not for: running them (`spacing_filter`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType, amplitudes_on_lattice
from swayless.controller.spacing import Spacing
from swayless.design.shaper import FloatArray, Guarantee, Shaper
from swayless.errors import ControllerError

SpacingLaw: TypeAlias = Literal["original", "modified"]
"""Scatter each sample by the spacing of its tick; or give every tick just one sample of each tap."""

EQUALLY_SPACED = 1e-9
"""Relative error of a half period from which on impulses are not half a period apart."""

_SHARES = np.linspace(0.0, 1.0, 257)  # of a tick that truncation takes away


@dataclass(frozen=True, eq=False)
class SpacedTaps:
    """Impulses at multiples of a spacing, exactly as a controller runs them.

    Parameters
    ----------
    amplitudes : ndarray, shape (n,)
        Positive multiples of ``2**-number.amplitude_bits`` that sum to exactly 1, n >= 2.
    spacing : Spacing
        Ticks between impulses, over the position.
    law : "original" or "modified"
        What happens when the spacing changes.
    tick_s : float
        Length of a tick.
    guarantee : Guarantee
        What these taps hold while the position is still.
    number : NumberType
        Type the controller calculates in.

    Raises
    ------
    ControllerError
        If an invariant does not hold.
    """

    amplitudes: FloatArray
    spacing: Spacing
    law: SpacingLaw
    tick_s: float
    guarantee: Guarantee
    number: NumberType

    def __post_init__(self) -> None:
        amplitudes = np.array(self.amplitudes, dtype=np.float64)
        scaled = amplitudes * 2.0**self.number.amplitude_bits
        if self.law not in get_args(SpacingLaw):
            raise ControllerError(f"law = {self.law!r}: must be one of {', '.join(get_args(SpacingLaw))}")
        if amplitudes.ndim != 1 or amplitudes.size < 2:
            raise ControllerError("spaced taps: at least two")
        if amplitudes.min() <= 0.0:
            raise ControllerError(
                f"law = {self.law!r} takes positive amplitudes only: commands of negative ones wait for rest"
            )
        if np.any(scaled != np.round(scaled)) or math.fsum(amplitudes.tolist()) != 1.0:
            raise ControllerError(f"spaced taps: amplitudes do not sum to exactly 1 in {self.number.name}")
        amplitudes.flags.writeable = False
        object.__setattr__(self, "amplitudes", amplitudes)

    @property
    def lags(self) -> NDArray[np.int64]:
        """Delays at the widest spacing, in ticks, shape (n,): once they have passed, a tap has released."""
        return np.arange(self.amplitudes.size, dtype=np.int64) * self.spacing.most

    @property
    def times_s(self) -> FloatArray:
        """Times of the taps at the widest spacing, in seconds, shape (n,)."""
        return self.lags.astype(np.float64) * self.tick_s

    @property
    def longest_delay_ticks(self) -> int:
        """Delay of the last tap at the widest spacing."""
        return int(self.lags[-1])

    @property
    def duration_s(self) -> float:
        """Delay of the last tap at the widest spacing, in seconds."""
        return self.longest_delay_ticks * self.tick_s

    @property
    def has_negative(self) -> bool:
        """Whether an amplitude is negative: never."""
        return False

    @property
    def numerators(self) -> tuple[int, ...]:
        """Amplitudes as whole multiples of ``2**-number.amplitude_bits``."""
        one = 1 << self.number.amplitude_bits
        return tuple(int(a * one) for a in self.amplitudes.tolist())


def spaced_taps(
    shaper: Shaper,
    spacing: Spacing,
    law: SpacingLaw,
    *,
    tick_s: float,
    guarantee: Guarantee,
    number: NumberType,
) -> SpacedTaps:
    """Bring a shaper whose impulses are half a damped period apart into a number type.

    Parameters
    ----------
    shaper : Shaper
        As designed for the guarantee's mode: zv, zvd, zvdd, ... or, undamped, ei, ei2, ei3.
    spacing : Spacing
        Half the damped period in ticks, over the position.
    law : "original" or "modified"
        What happens when the spacing changes.
    tick_s : float
        Length of a tick.
    guarantee : Guarantee
        What they promise while the position is still.
    number : NumberType
        Target type.

    Raises
    ------
    ControllerError
        If impulses are not half a period apart, an amplitude is negative, or truncation to whole ticks leaves
        more than is promised.
    """
    mode = guarantee.mode
    half_s = 0.5 / (mode.frequency_hz * math.sqrt(1.0 - mode.damping_ratio**2))
    expected_s = half_s * np.arange(shaper.times_s.size)
    if np.abs(shaper.times_s - expected_s).max() > EQUALLY_SPACED * half_s * shaper.times_s.size:
        raise ControllerError(
            f"law = {law!r} takes impulses half a damped period apart, and those of family = "
            f"{shaper.family!r} are not; zv, zvd, zvdd and zvddd do"
        )
    numerators = np.array(amplitudes_on_lattice(shaper.amplitudes, number.amplitude_bits))
    taps = SpacedTaps(numerators / (1 << number.amplitude_bits), spacing, law, tick_s, guarantee, number)
    worst = worst_truncated_residual(taps)
    if worst > guarantee.tolerance:
        raise ControllerError(
            f"whole ticks of {tick_s:g} s leave {100 * worst:.4g} % at a spacing of {spacing.least} ticks, "
            f"more than the {100 * guarantee.tolerance:g} % promised; a finer tick does"
        )
    return taps


def worst_truncated_residual(taps: SpacedTaps) -> float:
    """Largest residual vibration on any position that is held, in the linear model.

    A spacing of D ticks stands for half periods of D up to D + 1 ticks, and any of them may be the true one:
    of the narrowest spacing they are the farthest off, and those of the others are among them.

    Parameters
    ----------
    taps : SpacedTaps
        The taps.
    """
    damping_ratio = taps.guarantee.mode.damping_ratio
    half_turns = taps.spacing.least / (taps.spacing.least + _SHARES)
    pole = complex(damping_ratio / math.sqrt(1.0 - damping_ratio**2), 1.0) * np.pi * half_turns
    order = np.arange(taps.amplitudes.size)
    vibration = np.abs(np.exp(pole[..., np.newaxis] * order) @ taps.amplitudes)
    return float((vibration * np.exp(-pole.real * order[-1])).max())
