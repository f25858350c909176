"""The command of an inverted motion written out: a polynomial, and an exponential for each zero.

Not for: computing with it; `response` keeps its digits where this formula loses them.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial

import numpy as np

from swayless.design.inversion.motion import PolynomialMotion
from swayless.design.inversion.response import ComplexArray
from swayless.design.shaper import FloatArray


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """What a command is, less its initial value; t from the start of the motion, T its duration.

    Parameters
    ----------
    polynomial : ndarray, shape (n,)
        Until T: coefficients of t^0, t^1, ...
    rates : ndarray of complex, shape (m,)
        The zeros, in rad/s.
    during : ndarray of complex, shape (m,)
        Until T: amplitudes of exp(rate t), whose real parts add to the polynomial.
    final : float
        From T on.
    after : ndarray of complex, shape (m,)
        From T on: amplitudes of exp(rate (t - T)), whose real parts add to it.
    """

    polynomial: FloatArray
    rates: ComplexArray
    during: ComplexArray
    final: float
    after: ComplexArray

    def at(self, times_s: FloatArray, motion: PolynomialMotion) -> FloatArray:
        """Give the command less its initial value at times >= 0."""
        early = np.minimum(times_s, motion.duration_s)
        late = np.maximum(times_s - motion.duration_s, 0.0)
        moving = np.polynomial.polynomial.polyval(early, self.polynomial)
        moving = moving + (np.exp(np.multiply.outer(early, self.rates)) @ self.during).real
        ended = self.final + (np.exp(np.multiply.outer(late, self.rates)) @ self.after).real
        return np.where(times_s <= motion.duration_s, moving, ended).astype(np.float64)


def closed_form(numerator: FloatArray, denominator: FloatArray, motion: PolynomialMotion) -> ClosedForm:
    """Write out the command under which a plant moves as a polynomial, by partial fractions.

    Parameters
    ----------
    numerator, denominator : ndarray
        Transfer function of the plant, falling powers of s; the zeros differ from each other and from 0.
    motion : PolynomialMotion

    References
    ----------
    Piazzi and Visioli (2005), "Using stable input-output inversion for minimum-time feedforward constrained
    regulation of scalar systems", section 3.

    Examples
    --------
    >>> form = closed_form(np.array([1.0]), np.array([1.0, 0.0, 4.0]), PolynomialMotion(1.0, 1.0, order=5))
    >>> form.polynomial.tolist(), form.final
    ([0.0, 60.0, -180.0, 160.0, -60.0, 24.0], 4.0)
    """
    top, bottom = np.trim_zeros(denominator, "f"), np.trim_zeros(numerator, "f")
    whole, rest = np.polydiv(top, bottom)
    zeros = np.roots(bottom).astype(np.complex128)
    shares = np.polyval(rest, zeros) / np.polyval(np.polyder(bottom), zeros)
    derivatives = _derivatives(motion)
    inverse = zeros[:, np.newaxis] ** -np.arange(1.0, motion.order + 2)
    # A lag's particular solution is minus the sum of y^(j) / z^(j + 1).
    polynomial = -(shares @ inverse).real @ derivatives
    polynomial = polynomial + whole[::-1] @ derivatives[: whole.size]
    begin = inverse @ derivatives[:, 0]
    end = inverse[:, 1:] @ (derivatives @ motion.duration_s ** np.arange(motion.order + 1.0))[1:]
    after = (shares * (begin * np.exp(zeros * motion.duration_s) - end)).astype(np.complex128)
    final = motion.travel * float(top[-1] / bottom[-1])
    return ClosedForm(polynomial, zeros, (shares * begin).astype(np.complex128), final, after)


def _derivatives(motion: PolynomialMotion) -> FloatArray:
    """Give the coefficients of the motion's derivatives, j-th in row j, rising powers of time."""
    own = np.array([float(each) for each in motion.coefficients])
    own = motion.travel * own / motion.duration_s ** np.arange(own.size)
    rows = np.zeros((own.size, own.size))
    for j in range(own.size):
        powers = np.arange(j, own.size)
        falling = np.array([factorial(i) / factorial(i - j) for i in powers.tolist()])
        rows[j, : powers.size] = own[powers] * falling
    return rows
