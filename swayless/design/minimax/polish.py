"""Newton's method on the optimality conditions of a minimax design, from a linear program's optimum.

The program finds what is active (times, peaks, limits), but amplitudes only to the square root of its
tolerance. The conditions then fix them to machine precision, so that they do not depend on the path that a
solver took. Not for: finding what is active, which is `minimax`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from swayless.design.minimax.response import ComplexArray, IndexArray
from swayless.design.shaper import FloatArray

_LARGEST_EXPONENT = 300.0  # a step this far past frequency 0 leads nowhere, and exp would overflow
_STEPS = 12  # two or three are usual
_CONVERGED = 1e-13  # of the conditions, sums of at most a few dozen terms of order 1
_TIED = 1e-8  # what peaks leave in the conditions that tie to so much, but cannot all be of one height
_STILL = 1e-10  # last step of the amplitudes, of order 1, in that case
_FREE = 1e-13  # relative: directions that no condition fixes, such as weights that tie, stay where they are

REPEATED_EQUALITY = 1e-9
"""Relative size of what an equality adds to the others, below which it repeats them.

Times that lie on ticks to 1e-11 of themselves leave that much of a row that should be 0; neighbours on the
finest grid leave 1e-5.
"""


class Deciding(NamedTuple):
    """Peaks that hold an optimum up.

    Parameters
    ----------
    line : ndarray of int, shape (m,)
        Index of the line that a peak lies on.
    frequency : ndarray, shape (m,)
        Where it lies, in cycles per duration.
    weights : ndarray, shape (m,)
        Dual values, > 0.
    moving : ndarray, shape (m,)
        Whether the peak moves with the amplitudes (1) or stays at an end of its line (0).
    """

    line: IndexArray
    frequency: FloatArray
    weights: FloatArray
    moving: FloatArray


def polish(
    exponents: ComplexArray,
    equalities: FloatArray,
    targets: FloatArray,
    amplitudes: FloatArray,
    peaks: Deciding,
) -> FloatArray | None:
    """Solve the optimality conditions for the amplitudes.

    All of them say that one function is stationary: L = v + sum w_i (Re G(f_i) exp(-j phi_i) - v) + prices
    (equalities A - targets) in the amplitudes A, the worst ratio v, weights w, prices, phases phi and
    frequencies f.

    Parameters
    ----------
    exponents : ndarray of complex, shape (lines, n)
        `Response.exponents` of the n impulses in use, for every line.
    equalities : ndarray, shape (p, n)
        All that hold (the sum, the design's own, partial sums at a limit), orthonormal: see `independent`.
    targets : ndarray, shape (p,)
        Their right-hand sides.
    amplitudes : ndarray, shape (n,)
        Start.
    peaks : Deciding
        The peaks that decide.

    Returns
    -------
    ndarray or None
        The amplitudes, with the equalities met to rounding; None if Newton's method does not converge from
        here.

    Examples
    --------
    The EI shaper for 5 %: three impulses in one period, and three peaks of equal height, the middle one free.

    >>> exponents = 2j * np.pi * np.array([[-1.0, -0.5, 0.0]])
    >>> rows, targets = independent(np.ones((1, 3)), np.ones(1))
    >>> frequency, weights = np.array([0.80027462, 1.0, 1.19972538]), np.array([0.26, 0.48, 0.26])
    >>> peaks = Deciding(np.zeros(3, np.intp), frequency, weights, np.array([0.0, 1.0, 0.0]))
    >>> polish(exponents, rows, targets, np.array([0.26, 0.48, 0.26]), peaks).round(6)
    array([0.2625, 0.475 , 0.2625])
    """
    of_peaks = exponents[peaks.line]
    value = np.exp(peaks.frequency[:, np.newaxis] * of_peaks) @ amplitudes
    worst, prices = np.abs(value[:1]), np.zeros(targets.size)
    unknowns = [amplitudes, worst, peaks.weights, prices, np.angle(value), peaks.frequency]
    ends = np.cumsum([part.size for part in unknowns])[:-1]
    for _ in range(_STEPS):
        slope, curvature = _derivatives(unknowns, of_peaks, equalities, targets, peaks.moving)
        steps = np.split(np.linalg.lstsq(curvature, -slope, rcond=_FREE)[0], ends)
        unknowns = [part + step for part, step in zip(unknowns, steps, strict=True)]
        if (unknowns[-1][:, np.newaxis] * of_peaks.real).max() > _LARGEST_EXPONENT:
            return None
        rest = np.abs(slope).max()
        if rest < _CONVERGED or (rest < _TIED and np.abs(steps[0]).max() < _STILL):
            return meet(equalities, targets, unknowns[0])
    return None


def independent(equalities: FloatArray, targets: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Replace the equalities by orthonormal ones that say the same, without those that repeat others."""
    left, sizes, right = np.linalg.svd(equalities, full_matrices=False)
    kept = sizes > REPEATED_EQUALITY * sizes[0]
    return right[kept], (left.T @ targets)[kept] / sizes[kept]


def meet(equalities: FloatArray, targets: FloatArray, amplitudes: FloatArray) -> FloatArray:
    """Move the amplitudes as little as possible so that they meet orthonormal equalities to rounding."""
    moved: FloatArray = amplitudes + equalities.T @ (targets - equalities @ amplitudes)
    return moved


def _derivatives(
    unknowns: list[FloatArray],
    exponents: ComplexArray,
    equalities: FloatArray,
    targets: FloatArray,
    moving: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """First derivatives of L, which must vanish, and second ones, in the order of the unknowns."""
    amplitudes, worst, weights, prices, phase, frequency = unknowns
    columns = np.exp(frequency[:, np.newaxis] * exponents - 1j * phase[:, np.newaxis])
    sloped = columns * exponents
    value, slope, bend = (table @ amplitudes for table in (columns, sloped, sloped * exponents))
    first = [
        weights @ columns.real + prices @ equalities,
        1.0 - weights.sum(keepdims=True),
        value.real - worst,
        equalities @ amplitudes - targets,
        weights * value.imag,
        weights * moving * slope.real,
    ]
    n, m, p = amplitudes.size, weights.size, prices.size
    diagonal = np.diag
    half = np.block(
        [
            [
                np.zeros((n, n + 1)),
                columns.real.T,
                equalities.T,
                weights * columns.imag.T,
                weights * moving * sloped.real.T,
            ],
            [np.zeros((1, n + 1)), np.full((1, m), -1.0), np.zeros((1, p + 2 * m))],
            [np.zeros((m, n + 1 + m + p)), diagonal(value.imag), diagonal(moving * slope.real)],
            [np.zeros((p, n + 1 + m + p + 2 * m))],
            [
                np.zeros((m, n + 1 + m + p)),
                diagonal(-weights * value.real / 2),
                diagonal(weights * moving * slope.imag),
            ],
            [np.zeros((m, n + 1 + m + p + m)), diagonal(weights * moving * bend.real / 2)],
        ]
    )
    return np.concatenate(first), half + half.T
