"""How a load on a rope departs from a sine when it swings far: a slower phase and a bent wave.

The angle obeys theta'' + 2 s theta' + w^2 sin(theta) = 0. Damping makes the action J of the pendulum fall as
exp(-2 s t), averaged over a swing. So with u = sqrt(2 J / w), which falls as exp(-s t), the phase runs at
w (1 - u^2 / 16 - 3 u^4 / 1024 - 5 u^6 / 16384 - ...), and the angle is
u (1 + u^2 / 32 + ...) cos(phase) - u^3 / 192 (1 + ...) cos(3 phase) + ...: series that Lindstedt's method
gives as exact fractions, cut after u^5 (u^6 in the phase).

Not for: fitting it to a record.

References
----------
A. H. Nayfeh and D. T. Mook, *Nonlinear Oscillations* (1979), section 2.3 (Lindstedt and Poincare) and 3.3
(damping by averaging).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.plant.identification.record import FloatArray, Quantity
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2

ComplexArray: TypeAlias = NDArray[np.complex128]

_FLAT = 1e-4
"""Below this decay over the record, differences of exponentials are series: their digits would cancel."""

SLOWING = ((2, 1 / 16), (4, 3 / 1024), (6, 5 / 16384))
"""Powers of u, and by how much each slows the phase."""


@dataclass(frozen=True)
class Waveform:
    """What large swings of a load on a rope do to one measured quantity.

    In units of u, a record is the sum of coefficient * u^(harmonic + 2 * order) * cos(harmonic * phase).

    Parameters
    ----------
    coefficients : mapping
        By harmonic and order.
    quantity : Quantity
        Angle, position or acceleration of the load.
    averaging : float
        What averaging over a swing leaves of the relative frequency, at most, in (damping ratio * u)^2.
    """

    coefficients: Mapping[tuple[int, int], float]
    quantity: Quantity
    averaging: float

    @property
    def harmonics(self) -> int:
        """Number of the highest harmonic."""
        return max(harmonic for harmonic, _ in self.coefficients)

    def angle_per_value(self, frequency_rad_s: float) -> float:
        """Give the angle in rad for one unit of the record: L = g / w^2 hangs below the suspension."""
        if self.quantity is Quantity.position:
            return frequency_rad_s**2 / STANDARD_GRAVITY_M_S2
        return 1.0 / STANDARD_GRAVITY_M_S2 if self.quantity is Quantity.acceleration else 1.0

    def weigh(
        self, wave: ComplexArray, scale: float
    ) -> tuple[FloatArray, ComplexArray, FloatArray, FloatArray]:
        """Give the record for a plain wave, and what its derivatives are made of.

        Parameters
        ----------
        wave : ndarray of complex, shape (n,)
            The fundamental to first order, in the unit of the record.
        scale : float
            Of `angle_per_value`.

        Returns
        -------
        value, turned, grown, scaled : ndarray
            The record; for a change d of the logarithm of the wave it changes by Re(turned d) + grown Re(d),
            and for a change of the logarithm of the scale by `scaled` times that.
        """
        square = (scale * np.abs(wave)) ** 2
        value, turned, grown, scaled = np.zeros(wave.size), np.zeros_like(wave), *np.zeros((2, wave.size))
        for harmonic in range(1, self.harmonics + 1, 2):
            orders = {order: each for (of, order), each in self.coefficients.items() if of == harmonic}
            size = np.polynomial.polynomial.polyval(square, [orders.get(order, 0.0) for order in range(3)])
            growth = np.polynomial.polynomial.polyval(
                square, [2.0 * order * orders.get(order, 0.0) for order in range(3)]
            )
            overtone = wave if harmonic == 1 else wave * (scale * wave) ** (harmonic - 1)
            value += overtone.real * size
            turned += overtone * (harmonic * size)
            grown += overtone.real * growth
            scaled += overtone.real * ((harmonic - 1) * size + growth)
        return value, turned, grown, scaled

    @property
    def angle_exponent(self) -> int:
        """Power of the frequency in `angle_per_value`."""
        return 2 if self.quantity is Quantity.position else 0


_TERMS = ((1, 0), (1, 1), (1, 2), (3, 0), (3, 1), (5, 0))

# Of theta, of sin(theta), and of -(sin(theta))'' / w^2: an acceleration of g for each.
_COEFFICIENTS = {
    Quantity.angle: (1.0, 1 / 32, 23 / 8192, -1 / 192, -3 / 4096, 1 / 20480),
    Quantity.position: (1.0, -3 / 32, -25 / 8192, -3 / 64, -3 / 4096, 5 / 4096),
    Quantity.acceleration: (1.0, -7 / 32, 55 / 8192, -27 / 64, 189 / 4096, 125 / 4096),
}

# An acceleration holds the damping force itself, which these coefficients leave out.
_AVERAGING = (0.04, 0.04, 1.0)

WAVEFORMS: Mapping[Quantity, Waveform] = MappingProxyType(
    {
        quantity: Waveform(
            MappingProxyType(dict(zip(_TERMS, coefficients, strict=True))), quantity, averaging
        )
        for (quantity, coefficients), averaging in zip(_COEFFICIENTS.items(), _AVERAGING, strict=True)
    }
)


def lag_s(time_s: FloatArray, decay_rad_s: float, amplitude_rad: float) -> tuple[FloatArray, ...]:
    """Give the time by which the phase of a large swing lags behind that of a small one, and derivatives.

    Parameters
    ----------
    time_s : ndarray
        Since the swing had the amplitude.
    decay_rad_s : float
        Rate at which the amplitude falls.
    amplitude_rad : float
        The amplitude u at time 0.

    Returns
    -------
    lag, by_decay, by_log_amplitude : ndarray
        The lag, and its derivatives by decay and by the logarithm of the amplitude.

    Examples
    --------
    >>> lag, _, _ = lag_s(np.array([100.0]), 0.0, 0.2)
    >>> round(float(lag[0]), 4)  # 100 s (0.2^2 / 16 + 3 0.2^4 / 1024 + ...)
    0.2505
    """
    lag, by_decay, by_log_amplitude = np.zeros((3, time_s.size))
    for power, slowing in SLOWING:
        integral, integral_by_decay = _accumulated(time_s, power, decay_rad_s)
        factor = slowing * amplitude_rad**power
        lag += factor * integral
        by_decay += factor * integral_by_decay
        by_log_amplitude += power * factor * integral
    return lag, by_decay, by_log_amplitude


def _accumulated(time_s: FloatArray, power: int, decay_rad_s: float) -> tuple[FloatArray, FloatArray]:
    """Integrate exp(-power decay t) from 0, and differentiate that by the decay."""
    exponent = power * decay_rad_s * time_s
    if np.max(np.abs(exponent)) < _FLAT:
        return (
            time_s * (1.0 - exponent / 2.0 + exponent**2 / 6.0),
            -power * time_s**2 * (0.5 - exponent / 3.0 + exponent**2 / 8.0),
        )
    integral = -np.expm1(-exponent) / (power * decay_rad_s)
    return integral, (time_s * np.exp(-exponent) - integral) / decay_rad_s
