"""What a linear system makes of a polynomial motion: polynomials plus exponentials, exactly.

The equation a(d/dt) w = b(d/dt) y is solved as a cascade of one lag for each root of a, driven by the
polynomial b(d/dt) y / a(0). Lags and Taylor coefficients of the motion are together one autonomous linear
system, x' = G x. Its matrix exponential holds the polynomials and exponentials of the closed form, without
the differences of large numbers of partial fractions whose roots are slow, fast, or near each other.

Not for: which system (`inverse` for commands, `tuning` for sensitivities).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import factorial

import numpy as np
from numpy.typing import NDArray

from swayless.design.inversion.motion import PolynomialMotion
from swayless.design.shaper import FloatArray

ComplexArray = NDArray[np.complex128]

_TERMS = 18
"""Of the series: 0.5^19 / 19! is below rounding."""

_PLACES = (Fraction(0), Fraction(1, 2), Fraction(1))


@dataclass(frozen=True, eq=False)
class MotionResponse:
    """The response to a motion, less that to its start, in units of the motion's duration and travel.

    Parameters
    ----------
    motion : PolynomialMotion
    generator : ndarray of complex, shape (n, n)
        G; the first `order` states are the lags, the others the motion's Taylor coefficients.
    output : ndarray, shape (n,)
    starts : ndarray of complex, shape (3, n)
        States just after the motion's start, its middle, and its end.
    order : int
        Number of lags.
    """

    motion: PolynomialMotion
    generator: ComplexArray
    output: FloatArray
    starts: ComplexArray
    order: int

    def on_grid(self, first_s: float, step_s: float, count: int) -> FloatArray:
        """Give the response at times first, first + step, ...; shape (count,)."""
        return self._read(self.output, self._states(first_s, step_s, count))

    def averages(self, step_s: float, count: int) -> FloatArray:
        """Give its mean over each of `count` steps from 0 on; the motion has to end between two steps."""
        size = self.generator.shape[0]
        block = np.zeros((2 * size, 2 * size), dtype=np.complex128)
        share = step_s / self.motion.duration_s
        block[:size, :size], block[:size, size:] = self.generator * share, np.eye(size)
        mean = self.output @ _expm(block)[:size, size:]
        return self._read(mean, self._states(0.0, step_s, count))

    def _read(self, row: ComplexArray | FloatArray, states: ComplexArray) -> FloatArray:
        """Give an output of states."""
        return np.asarray(self.motion.travel * np.einsum("i,ik->k", row, states).real)

    def lags(self, step_s: float, count: int) -> ComplexArray:
        """Give the lags from the end of the motion on, less where they go; shape (order, count)."""
        own = self.generator[: self.order, : self.order]
        rest = -np.linalg.solve(own, self.generator[: self.order, self.order]) if self.order else 0.0
        start = self.starts[-1, : self.order] - rest
        return self.motion.travel * _walk(own * step_s / self.motion.duration_s, start, count)

    def _states(self, first_s: float, step_s: float, count: int) -> ComplexArray:
        """Give all states on a grid, shape (n, count); 0 before the motion."""
        duration_s = self.motion.duration_s
        # A grid that meets an end but for rounding is on it.
        places = [float(each) * duration_s for each in _PLACES]
        bounds = [int(np.clip(np.ceil((each - first_s) / step_s - 1e-6), 0, count)) for each in places]
        states = np.zeros((self.generator.shape[0], count), dtype=np.complex128)
        for start, place, begin, end in zip(self.starts, places, bounds, [*bounds[1:], count], strict=True):
            if end > begin:
                late = (first_s + begin * step_s - place) / duration_s
                state = _expm(self.generator * late) @ start
                states[:, begin:end] = _walk(self.generator * step_s / duration_s, state, end - begin)
        return states


def motion_response(
    numerator: FloatArray, denominator: FloatArray, motion: PolynomialMotion
) -> MotionResponse:
    """Give the response of a transfer function to a motion, from rest.

    Parameters
    ----------
    numerator, denominator : ndarray
        Falling powers of s. The denominator has no root at 0. The numerator may have the higher power, by as
        much as the motion is smooth.
    motion : PolynomialMotion

    Examples
    --------
    Speed, position, and the position behind a lag of 1 s, in the middle of a motion of 1 in 2 s:

    >>> motion = PolynomialMotion(2.0, 1.0, order=3)
    >>> one, lag = np.array([1.0]), np.array([1.0, 1.0])
    >>> ways = [(np.array([1.0, 0.0]), one), (one, one), (one, lag)]
    >>> [motion_response(*way, motion).on_grid(1.0, 1.0, 1).round(6).tolist() for way in ways]
    [[0.75], [0.5], [0.146362]]
    """
    top, bottom = (_in_units_of(each, motion.duration_s) for each in (numerator, denominator))
    roots = np.roots(bottom).astype(np.complex128)
    roots = roots[np.argsort(-np.abs(roots), kind="stable")]
    order, size = roots.size, motion.order + 1
    generator = np.zeros((order + size, order + size), dtype=np.complex128)
    generator[order:, order:] = np.diag(np.arange(1.0, size), 1)
    drive = np.zeros(size)
    reached = min(size, top.size)
    drive[:reached] = (top[::-1] / bottom[-1])[:reached] * [float(factorial(j)) for j in range(reached)]
    generator[:order, :order] = np.diag(roots) - np.diag(roots[1:], -1)
    output = np.zeros(order + size)
    if order:
        generator[0, order:] = -roots[0] * drive
        output[order - 1] = 1.0
    else:
        output[:] = drive
    return MotionResponse(motion, generator, output, _starts(generator, top, bottom, roots, motion), order)


def _starts(
    generator: ComplexArray,
    top: FloatArray,
    bottom: FloatArray,
    roots: ComplexArray,
    motion: PolynomialMotion,
) -> ComplexArray:
    """Give all states at the beginning of each piece: lags jump where derivatives of the motion do."""
    order, size = roots.size, motion.order + 1
    starts = np.zeros((3, order + size), dtype=np.complex128)
    starts[0, order:], starts[1, order:] = motion.taylor(_PLACES[0]), motion.taylor(_PLACES[1])
    starts[2, order] = 1.0
    begins = starts[0, order:].real * [float(factorial(j)) for j in range(size)]
    # The motion is the same from both ends, turned round: its j-th derivative ends with -(-1)^j of the first.
    ends = begins * [(-1.0) ** j for j in range(size)]
    half = _expm(0.5 * generator)
    expansion = np.polydiv(np.append(top, np.zeros(2 * order + bottom.size)), bottom)[0].astype(np.float64)
    excess = top.size - bottom.size
    starts[0, :order] = _jumps(begins, expansion, excess, roots)
    starts[1, :order] = (half @ starts[0])[:order]
    starts[2, :order] = (half @ starts[1])[:order] + _jumps(ends, expansion, excess, roots)
    return starts


def _jumps(derivatives: FloatArray, expansion: FloatArray, excess: int, roots: ComplexArray) -> ComplexArray:
    """Give by how much each lag jumps where derivatives of the motion jump.

    With b / a = g_p s^p + g_(p-1) s^(p-1) + ..., the l-th derivative of the response jumps by the sum of g_i
    times the jump of the motion's (i + l)-th; a lag's input is the lag less its derivative over its root.
    """
    order = roots.size
    jumps = np.zeros(order, dtype=np.complex128)
    for level in range(order):
        powers = np.arange(min(excess + level, derivatives.size - 1), 0, -1)
        jumps[level] = expansion[excess + level - powers] @ derivatives[powers]
    lags = np.zeros(order, dtype=np.complex128)
    for place in range(order - 1, -1, -1):
        lags[place] = jumps[0]
        jumps = jumps[:-1] - jumps[1:] / roots[place]
    return lags


def _walk(generator: ComplexArray, state: ComplexArray, count: int) -> ComplexArray:
    """Give a state and what a generator makes of it in 1, 2, ... steps, shape (n, count), by doubling."""
    states, power = state[:, np.newaxis], _expm(generator)
    while states.shape[1] < count:
        states, power = np.hstack([states, np.einsum("ij,jk->ik", power, states)]), power @ power
    return states[:, :count]


def _in_units_of(polynomial: FloatArray, duration_s: float) -> FloatArray:
    """Give a polynomial in s for times in units of a duration, without zeros before it."""
    trimmed = np.trim_zeros(np.asarray(polynomial, dtype=np.float64), "f")
    return np.asarray(trimmed / duration_s ** np.arange(trimmed.size - 1, -1, -1, dtype=np.float64))


def _expm(matrix: ComplexArray) -> ComplexArray:
    """Give the exponential of a small matrix, by the series of a 2^k-th of it, squared k times.

    Not scipy's: it starts threads, as large products here do, which takes far longer than the work itself
    where other programs run too.

    References
    ----------
    Moler and Van Loan (2003), "Nineteen dubious ways to compute the exponential of a matrix", method 3.
    """
    norm = float(np.abs(matrix).sum(axis=0).max(initial=0.0))
    halvings = max(0, int(np.ceil(np.log2(max(norm, 1e-300)))) + 1)
    scaled = matrix / 2.0**halvings
    unit = np.eye(matrix.shape[0], dtype=np.complex128)
    total = unit
    for power in range(_TERMS, 0, -1):
        total = unit + scaled @ total / power
    for _ in range(halvings):
        total = total @ total
    return total
