"""Amplitudes at fixed times that leave the least residual vibration over bands, with proof of optimality.

The worst residual vibration over bands is convex in the amplitudes, so the optimum found is the global one.
It is found by exchange: a small linear program over a few times and a few half-planes (a frequency and a
phase each) is solved; half-planes are added where its amplitudes break the bound inside a band, and times
are added where its dual values say that they would help.
Not for: times that move continuously (`families`), or for choosing how long a design is (`grid`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from swayless.design.minimax.exchange import Exchange, Minimax
from swayless.design.minimax.held import Held
from swayless.design.minimax.program import AmplitudeRule
from swayless.design.minimax.response import IndexArray, Response
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import Band, Mode


class HeldLine(NamedTuple):
    """A band to hold at one damping ratio.

    Parameters
    ----------
    band : Band
        Undamped natural frequencies; low_hz may equal high_hz.
    damping_ratio : float
        At least 0 and below 1.
    """

    band: Band
    damping_ratio: float


def minimax_amplitudes(
    times_s: FloatArray,
    band: Band | Sequence[HeldLine],
    *,
    damping_ratio: float = 0.0,
    rule: AmplitudeRule = AmplitudeRule.POSITIVE,
    equalities: FloatArray | None = None,
    start: IndexArray | None = None,
    target_ratio: float = 0.0,
    least_last: float = 0.0,
) -> Minimax:
    """Find amplitudes at the times offered that minimise the worst residual vibration over bands.

    Parameters
    ----------
    times_s : ndarray, shape (n,)
        Times offered, rising, at least 2. The vibration is read at the last of them, used or not.
    band : Band or sequence of HeldLine
        Undamped natural frequencies to hold, or several bands, each at its own damping ratio.
    damping_ratio : float
        Of the mode, over a single band; at least 0 and below 1.
    rule : AmplitudeRule
        Sign rule of the amplitudes.
    equalities : ndarray, shape (p, n), optional
        Rows of order 1 whose product with the amplitudes must be 0, such as `zero_equalities`. Sum 1 always
        holds.
    start : ndarray of int, optional
        Indices of the times preferred; others come in only where the dual values call for them. By default a
        dozen, evenly spread.
    target_ratio : float
        Residual vibration that is enough. Once it can be met no further times are tried and the optimum over
        those in use is returned; once it is proved out of reach the search ends. 0: the optimum over all
        times.
    least_last : float
        Smallest amplitude at the last time. 0: the last time need not be used.

    Returns
    -------
    Minimax
        Amplitudes and proof. The bound holds for these times only: it says nothing about times between them.

    Raises
    ------
    DesignError
        If the times or a damping ratio are out of range, or HiGHS fails.

    References
    ----------
    Kriikku, Singer and Singhose (1997), eq 1: the residual vibration.

    Examples
    --------
    On eleven ticks a period, nothing that lasts one period leaves less than 5.28 % over the band in which the
    continuous EI shaper leaves 5 %:

    >>> best = minimax_amplitudes(np.arange(12) / 11, Band(0.80027, 1.19973))
    >>> best.taps, round(best.worst_residual_ratio, 4), round(best.lower_bound_ratio, 4)
    (array([ 0,  5,  6, 11]), 0.0528, 0.0528)
    """
    if times_s.size < 2 or np.any(np.diff(times_s) <= 0.0):
        raise DesignError(f"times_s = {times_s.tolist()}: must be at least two, rising")
    lines = [HeldLine(band, damping_ratio)] if isinstance(band, Band) else band
    for line in lines:
        if not 0.0 <= line.damping_ratio < 1.0:
            raise DesignError(f"damping_ratio = {line.damping_ratio!r}: must be at least 0 and below 1")
    taps = np.unique(np.linspace(0, times_s.size - 1, 12).astype(np.intp)) if start is None else start
    if least_last > 0.0:
        taps = np.union1d(taps, times_s.size - 1)
    duration_s = float(times_s[-1] - times_s[0])
    exchange = Exchange(
        held=Held(
            exponents=np.stack([Response.of_times(times_s, line.damping_ratio).exponents for line in lines]),
            low=np.array([line.band.low_hz * duration_s for line in lines]),
            high=np.array([line.band.high_hz * duration_s for line in lines]),
        ),
        rule=rule,
        equalities=np.empty((0, times_s.size)) if equalities is None else equalities,
        target_ratio=target_ratio,
        least_last=least_last,
        taps=taps,
    )
    return exchange.run()


def zero_equalities(times_s: FloatArray, mode: Mode, *, derivatives: int = 0) -> FloatArray:
    """Rows that say: at the mode the residual vibration and its first derivatives in frequency are 0.

    Parameters
    ----------
    times_s : ndarray, shape (n,)
        Rising, at least 2.
    mode : Mode
        Where the zero lies.
    derivatives : int
        How many derivatives vanish with it, >= 0: 0 for ZV, 1 for ZVD.

    Returns
    -------
    ndarray, shape (2 * derivatives + 2, n)
        Real and imaginary parts of sum A_i T_m(x_i) exp(z w t_i + j w sqrt(1 - z^2) t_i), m = 0, 1, ...; x is
        the time scaled to -1 .. 1, and the Chebyshev polynomials T_m keep rows of high order apart where
        powers would not.

    References
    ----------
    Magee and Book, eqs 13 to 16: the zeros of an m-th order shaper.

    Examples
    --------
    >>> rows = zero_equalities(np.array([0.0, 0.5]), Mode(1.0))
    >>> bool(np.abs(rows @ [0.5, 0.5]).max() < 1e-15)
    True
    """
    duration_s = times_s[-1] - times_s[0]
    vibration = Response.of_times(times_s, mode.damping_ratio).columns(
        np.array([mode.frequency_hz * duration_s])
    )
    scaled = 2.0 * (times_s - times_s[0]) / duration_s - 1.0
    moments = np.polynomial.chebyshev.chebvander(scaled, derivatives).T * vibration
    return np.concatenate([moments.real, moments.imag])


__all__ = ["AmplitudeRule", "HeldLine", "Minimax", "minimax_amplitudes", "zero_equalities"]
