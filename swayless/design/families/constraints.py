"""The constraint equations of the solved families, with their exact derivatives.

Not for: solving them (`continuation`), nor for where a solution starts (`insensitive`, `unity_magnitude`).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.design.shaper import FloatArray

ComplexArray: TypeAlias = NDArray[np.complex128]


class AtMode(Enum):
    """What the residual vibration does at the mode itself."""

    ZERO = "vanishes"
    DOUBLE_ZERO = "vanishes with its slope"
    HUMP = "is at the tolerance, and flat"


@dataclass(frozen=True)
class Constraints:
    """Equations in amplitudes, times, and the frequencies of zeros and humps.

    With times in damped periods and r = f / f_mode, G(r) = sum A_i exp(c r (t_i - t_n)), c = 2 pi (d + j),
    d = z / sqrt(1 - z^2), is the residual vibration as a phasor. A zero is G = 0; a hump is |G| = V with
    d|G|/dr = 0.

    An unknown vector holds log A_1 .. log A_n (unless the amplitudes are fixed), t_2 .. t_n, 1 / r of the
    free zeros, 1 / r of the free humps. So amplitudes stay positive and shrink evenly as the damping grows,
    and a zero may move off to infinity without ado.

    Parameters
    ----------
    impulses : int
        Number of impulses n.
    at_mode : AtMode
        What is asked at r = 1.
    zeros, humps : int
        Numbers of further zeros and humps, at frequencies that the solution chooses.
    fixed_amplitudes : tuple of float, optional
        Amplitudes that sum to 1; none to solve for them.
    """

    impulses: int
    at_mode: AtMode
    zeros: int = 0
    humps: int = 0
    fixed_amplitudes: tuple[float, ...] | None = None

    @cached_property
    def _layout(self) -> _Layout:
        """Where things stand in an unknown vector, and which frequencies move."""
        time = 0 if self.fixed_amplitudes else self.impulses
        period = time + self.impulses - 1
        zeros = self.zeros + (self.at_mode is not AtMode.HUMP)
        flat = self.zeros + (self.at_mode is AtMode.DOUBLE_ZERO)
        moving = np.delete(np.arange(self.zeros + 1 + self.humps), self.zeros)
        return _Layout(time, period, zeros, flat, moving, period + np.arange(moving.size))

    def amplitudes(self, unknowns: FloatArray) -> FloatArray:
        """Pick the amplitudes of an unknown vector, shape (n,)."""
        if self.fixed_amplitudes:
            return np.array(self.fixed_amplitudes)
        return np.exp(unknowns[: self.impulses])

    def times(self, unknowns: FloatArray) -> FloatArray:
        """Pick the times of an unknown vector, in damped periods, the first 0, shape (n,)."""
        return np.concatenate(([0.0], unknowns[self._layout.time : self._layout.period]))

    def holds_order(self, unknowns: FloatArray) -> bool:
        """Whether times rise and frequencies are positive, as they do in a shaper."""
        times = [0.0, *unknowns[self._layout.time : self._layout.period].tolist()]
        rising = all(earlier < later for earlier, later in pairwise(times))
        return rising and all(period > 0.0 for period in unknowns[self._layout.period :].tolist())

    def linearise(
        self, unknowns: FloatArray, decay: float, tolerance: float
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Evaluate the equations and their derivatives.

        Parameters
        ----------
        unknowns : ndarray, shape (m,)
            Unknown vector.
        decay : float
            d = z / sqrt(1 - z^2), >= 0.
        tolerance : float
            V of the humps.

        Returns
        -------
        residuals : ndarray, shape (m,)
        jacobian : ndarray, shape (m, m)
        decay_slope : ndarray, shape (m,)
            Derivative of the residuals with respect to the decay.
        """
        amplitudes = self.amplitudes(unknowns)
        (phasor, slope), (phasor_rows, slope_rows) = self._phasors(unknowns, amplitudes, decay)
        zeros, flat = slice(self._layout.zeros), slice(self.zeros, self._layout.flat)
        hump = slice(self._layout.zeros, None)
        size, towards = np.abs(phasor[hump]), phasor[hump].conj()
        hump_rows = towards[:, np.newaxis] * phasor_rows[hump]
        bend_rows = slope[hump, np.newaxis] * phasor_rows[hump].conj()
        bend_rows += towards[:, np.newaxis] * slope_rows[hump]
        total_row = np.zeros((1, unknowns.size + 1))
        total_row[0, : self._layout.time] = amplitudes[: self._layout.time]
        values = (
            *_parts(phasor[zeros]),
            *_parts(slope[flat]),
            size - tolerance,
            (towards * slope[hump]).real,
            [amplitudes.sum() - 1.0],
        )
        rows = (
            *_parts(phasor_rows[zeros]),
            *_parts(slope_rows[flat]),
            hump_rows.real / size[:, np.newaxis],
            bend_rows.real,
            total_row,
        )
        # Fixed amplitudes sum to 1 already: their last equation is none.
        count = unknowns.size
        table = np.concatenate(rows)[:count]
        return np.concatenate(values)[:count], table[:, :-1], table[:, -1]

    def _phasors(
        self, unknowns: FloatArray, amplitudes: FloatArray, decay: float
    ) -> tuple[ComplexArray, ComplexArray]:
        """Evaluate G and dG/dr at the free zeros, at the mode and at the free humps, in this order.

        Returns
        -------
        values : ndarray, shape (2, k)
            G and dG/dr at each of the k frequencies.
        rows : ndarray, shape (2, k, m + 1)
            Their derivatives by the unknowns and, last, by the decay.
        """
        at = self._layout
        turn = 2.0 * np.pi * complex(decay, 1.0)
        lag = self.times(unknowns)
        lag -= lag[-1]
        free = unknowns[at.period :]
        ratio = 1.0 / np.concatenate((free[: self.zeros], [1.0], free[self.zeros :]))
        turn_ratio, turn_lag = (turn * ratio)[:, np.newaxis], turn * lag
        terms = amplitudes * np.exp(turn_ratio * lag)
        by_amplitude = np.array((terms, terms * turn_lag))
        by_lag = turn_ratio * by_amplitude
        by_lag[1] += turn * terms
        rows = np.zeros((2, ratio.size, unknowns.size + 1), dtype=np.complex128)
        rows[..., : at.time] = by_amplitude[..., : at.time]
        rows[..., at.time : at.period - 1] = by_lag[..., 1:-1]
        rows[..., at.period - 1] = -by_lag[..., :-1].sum(axis=2)  # the last time enters all lags but its own
        by_period = (by_amplitude @ turn_lag) * -(ratio**2)
        rows[:, at.moving, at.column] = by_period[:, at.moving]
        rows[..., -1] = (2.0 * np.pi / turn) * (by_lag @ lag)
        return by_amplitude.sum(axis=2), rows


@dataclass(frozen=True)
class _Layout:
    """Where times and periods begin in an unknown vector, how many zeros there are, what moves where."""

    time: int
    period: int
    zeros: int
    flat: int
    moving: NDArray[np.intp]
    column: NDArray[np.intp]


def _parts(values: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Split into real and imaginary part: a complex equation is two real ones."""
    return values.real, values.imag
