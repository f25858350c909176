"""A shaper on whole ticks as data, and the decimal lattice that its amplitudes lie on.

Not for: finding the amplitudes (`grid`), or for running them (the controller's taps).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.design.shaper import FloatArray, Guarantee
from swayless.errors import DesignError

_UNITS = 10**12  # amplitudes are whole multiples of 1 / _UNITS, so that 12 decimals store them exactly


@dataclass(frozen=True, eq=False)
class GridShaper:
    """A shaper whose impulses lie on whole ticks, and what these very numbers hold.

    Parameters
    ----------
    delays_ticks : ndarray of int64, shape (n,)
        Delays of the taps, the first 0, strictly increasing.
    amplitudes : ndarray, shape (n,)
        Doubles nearest to multiples of 1e-12 whose decimal sum is exactly 1.
    tick_s : float
        Tick of the controller, > 0.
    guarantee : Guarantee
        What the taps hold.

    Raises
    ------
    DesignError
        If an invariant does not hold.
    """

    delays_ticks: NDArray[np.int64]
    amplitudes: FloatArray
    tick_s: float
    guarantee: Guarantee

    def __post_init__(self) -> None:
        delays = np.array(self.delays_ticks, dtype=np.int64)
        amplitudes = np.array(self.amplitudes, dtype=np.float64)
        check_tick(self.tick_s)
        if delays.ndim != 1 or delays.shape != amplitudes.shape or delays.size == 0:
            raise DesignError("taps: delays and amplitudes must be non-empty and of one length")
        if delays[0] != 0 or np.any(np.diff(delays) <= 0) or np.any(delays != self.delays_ticks):
            given = np.asarray(self.delays_ticks).tolist()
            raise DesignError(f"taps: delays must be whole ticks from 0 and increase, got {given}")
        units = np.rint(amplitudes * _UNITS)
        if units.sum() != _UNITS or np.any(amplitudes != units / _UNITS):
            raise DesignError(
                f"taps: amplitudes must be multiples of 1e-12 with sum 1, got {amplitudes.tolist()}"
            )
        delays.flags.writeable = amplitudes.flags.writeable = False
        object.__setattr__(self, "delays_ticks", delays)
        object.__setattr__(self, "amplitudes", amplitudes)

    @property
    def times_s(self) -> FloatArray:
        """Times of the taps, in seconds."""
        return self.delays_ticks.astype(np.float64) * self.tick_s

    @property
    def duration_s(self) -> float:
        """Time of the last tap, in seconds."""
        return float(self.delays_ticks[-1] * self.tick_s)


def decimal_amplitudes(amplitudes: FloatArray) -> FloatArray:
    """Move amplitudes to multiples of 1e-12 whose decimal sum is exactly 1.

    The partial sums are rounded, not the amplitudes: then the sum is exact, partial sums in 0 .. 1 stay
    there, positive amplitudes stay positive or 0, and symmetric ones stay symmetric. No amplitude moves by
    more than 1e-12.

    Parameters
    ----------
    amplitudes : ndarray, shape (n,)
        In sum 1 to rounding.

    Returns
    -------
    ndarray, shape (n,)
        The doubles that 12 decimals write and read back.

    Examples
    --------
    >>> decimal_amplitudes(np.array([1.0, 1.0, 1.0]) / 3.0).tolist()
    [0.333333333333, 0.333333333334, 0.333333333333]
    """
    levels = np.rint(np.cumsum(amplitudes) * _UNITS)
    levels[-1] = _UNITS
    rounded: FloatArray = np.diff(levels, prepend=0.0) / _UNITS
    return rounded


def check_tick(tick_s: float) -> None:
    """Refuse a tick that is not a time: it must be finite and > 0."""
    if not (math.isfinite(tick_s) and tick_s > 0.0):
        raise DesignError(f"tick_s = {tick_s!r}: must be finite and > 0")
