"""Taps whose delays are phases of the pendulum: constants of the phase clock. Not for: running them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType, amplitudes_on_lattice
from swayless.controller.phase_clock import PhaseClock
from swayless.controller.rope import MM_PER_M
from swayless.design.grid import LARGEST_DURATION_TICKS
from swayless.design.shaper import FloatArray, Guarantee
from swayless.errors import ControllerError
from swayless.plant import STANDARD_GRAVITY_M_S2

_PLACES_PER_CELL = 8  # rope lengths per cell of the table at which a still rope is checked


@dataclass(frozen=True, eq=False)
class PhaseTaps:
    """Impulses at phases of the pendulum, exactly as a controller runs them.

    Parameters
    ----------
    lags : ndarray of int64, shape (n,)
        Phases in quanta of the clock, the first 0, strictly increasing.
    amplitudes : ndarray, shape (n,)
        Positive multiples of ``2**-number.amplitude_bits`` that sum to exactly 1.
    tick_s : float
        Length of a tick.
    guarantee : Guarantee
        What these very taps hold while the rope is still.
    number : NumberType
        Type the controller calculates in.
    clock : PhaseClock
        What a quantum is, and how many a tick has.

    Raises
    ------
    ControllerError
        If an invariant does not hold.
    """

    lags: NDArray[np.int64]
    amplitudes: FloatArray
    tick_s: float
    guarantee: Guarantee
    number: NumberType
    clock: PhaseClock

    def __post_init__(self) -> None:
        lags = np.array(self.lags, dtype=np.int64)
        amplitudes = np.array(self.amplitudes, dtype=np.float64)
        scaled = amplitudes * 2.0**self.number.amplitude_bits
        if lags.ndim != 1 or lags.shape != amplitudes.shape or lags.size < 2:
            raise ControllerError("phase taps: at least two, as many phases as amplitudes")
        if amplitudes.min() <= 0.0:
            raise ControllerError(
                "law = 'phase' takes positive amplitudes only: commands of negative ones wait for rest"
            )
        if np.any(scaled != np.round(scaled)) or math.fsum(amplitudes.tolist()) != 1.0:
            raise ControllerError(f"phase taps: amplitudes do not sum to exactly 1 in {self.number.name}")
        shortest = int(np.diff(lags, prepend=0)[1:].min())
        if lags[0] != 0 or shortest <= self.clock.most_quanta:
            phase_rad = shortest * self.clock.quantum_rad
            raise ControllerError(
                f"tick_s = {self.tick_s!r}: on the shortest rope a tick is longer than the "
                f"{phase_rad:.3g} rad between two taps; a finer tick, or a longer shortest rope, does"
            )
        if lags[-1] > LARGEST_DURATION_TICKS * self.clock.fewest_quanta:
            raise ControllerError(
                f"tick_s = {self.tick_s!r}: on the longest rope the taps last more than "
                f"{LARGEST_DURATION_TICKS} ticks; a coarser tick does"
            )
        lags.flags.writeable = amplitudes.flags.writeable = False
        object.__setattr__(self, "lags", lags)
        object.__setattr__(self, "amplitudes", amplitudes)

    @property
    def times_s(self) -> FloatArray:
        """Times of the taps on the longest rope, in seconds, shape (n,)."""
        return self.lags.astype(np.float64) * (self.tick_s / self.clock.fewest_quanta)

    @property
    def duration_s(self) -> float:
        """Time of the last tap on the longest rope, in seconds."""
        return float(self.times_s[-1])

    @property
    def longest_delay_ticks(self) -> int:
        """Ticks after which the last tap has passed, on the longest rope."""
        return -(-int(self.lags[-1]) // self.clock.fewest_quanta)

    @property
    def has_negative(self) -> bool:
        """Whether an amplitude is negative: never."""
        return False

    @property
    def numerators(self) -> tuple[int, ...]:
        """Amplitudes as whole multiples of ``2**-number.amplitude_bits``."""
        one = 1 << self.number.amplitude_bits
        return tuple(int(a * one) for a in self.amplitudes.tolist())


def phase_taps(
    phases_rad: FloatArray, amplitudes: FloatArray, *, tick_s: float, guarantee: Guarantee, clock: PhaseClock
) -> PhaseTaps:
    """Bring taps at phases into a number type.

    Parameters
    ----------
    phases_rad, amplitudes : ndarray, shape (n,)
        Phases w t_i of the impulses, and their amplitudes, in sum 1.
    tick_s : float
        Length of a tick.
    guarantee : Guarantee
        What they promise.
    clock : PhaseClock
        The clock, which has the number type.

    Raises
    ------
    ControllerError
        If an amplitude is negative, or two taps are less than a tick apart.
    """
    number = clock.number
    one = 1 << number.amplitude_bits
    numerators = np.array(amplitudes_on_lattice(amplitudes, number.amplitude_bits))
    lags = np.rint(np.asarray(phases_rad) / clock.quantum_rad).astype(np.int64)
    taps = PhaseTaps(lags, numerators / one, tick_s, guarantee, number, clock)
    worst = worst_still_residual(taps)
    if worst > guarantee.tolerance:
        raise ControllerError(
            f"on ticks of {tick_s:g} s the taps leave {100 * worst:.4g} % on a still rope, more than the "
            f"{100 * guarantee.tolerance:g} % promised; a finer tick does"
        )
    return taps


def worst_still_residual(taps: PhaseTaps) -> float:
    """Largest residual vibration on any rope of the range that is held still, in the linear model.

    What runs is counted: phases in quanta, the table's interpolation, and each tap split linearly between two
    ticks.

    Parameters
    ----------
    taps : PhaseTaps
        The taps.
    """
    clock, damping_ratio = taps.clock, taps.guarantee.mode.damping_ratio
    per_unit = MM_PER_M if clock.number.is_integer else 1
    cells = len(clock.nodes) - 1
    span = float(cells) / float(clock.cells_per_unit) * (2.0**32 if clock.number.is_integer else 1.0)
    places = np.linspace(0.0, cells, cells * _PLACES_PER_CELL + 1)
    nodes = np.array(clock.nodes, dtype=np.float64)
    quanta = np.rint(np.interp(places, np.arange(cells + 1), nodes))
    lengths_m = (float(clock.shortest) + places / cells * span) / per_unit
    turn = np.sqrt(STANDARD_GRAVITY_M_S2 / lengths_m) * taps.tick_s
    pole = complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2)) * turn
    whole, rest = np.divmod(taps.lags[:, np.newaxis], quanta)
    early = np.exp(pole * whole)
    vibration = taps.amplitudes @ (early * (1.0 + rest / quanta * (np.exp(pole) - 1.0)))
    left = np.abs(vibration) * np.exp(-pole.real * taps.lags[-1] / quanta)
    return float(left.max())
