"""A motor under a PI position loop that moves its load through a spring and a damper.

Not for: how it is commanded (`swayless.design.inversion`), torque limits, and loads that pull at the motor.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swayless.errors import PlantError
from swayless.plant.mode import Mode

FloatArray = NDArray[np.float64]

TUNED = ("motor_inertia", "motor_friction", "load_mass", "damping", "stiffness")
"""Parameters of the plant, in the paper's order: what a measured move may correct. The gains are known."""


class Ratio(NamedTuple):
    """A transfer function; coefficients fall in powers of s.

    Parameters
    ----------
    numerator, denominator : ndarray, shape (n,)
    """

    numerator: FloatArray
    denominator: FloatArray


def product(one: FloatArray, other: FloatArray) -> FloatArray:
    """Multiply two polynomials.

    Examples
    --------
    >>> product(np.array([1.0, 1.0]), np.array([1.0, -1.0])).tolist()
    [1.0, 0.0, -1.0]
    """
    return np.convolve(one, other).astype(np.float64)


@dataclass(frozen=True)
class ElasticDrive:
    """A motor, its PI position loop, and a load behind an elastic transmission.

    In any consistent units, with x the motor's position, y the load's and r the command:

        J x'' + D x' = K (e + (integral of e) / T),  e = r - x,     m y'' = c (x' - y') + k (x - y).

    Parameters
    ----------
    motor_inertia, motor_friction : float
        J and D, > 0; as at the load, such as kg and N s/m.
    gain : float
        K of the loop, > 0: torque for a difference of 1.
    integral_time_s : float
        T of the loop, > J / D, without which it is unstable.
    load_mass, stiffness : float
        m and k, > 0.
    damping : float
        c of the transmission, >= 0.

    Raises
    ------
    PlantError
        If a value is out of range, or the loop is unstable.

    References
    ----------
    Visioli and Piazzi (2008), eqs 1 to 5.

    Examples
    --------
    >>> drive = ElasticDrive(0.00011, 0.0034, 0.05, 0.5, 1.0, 0.22, 3.05)
    >>> round(drive.mode.frequency_hz, 4), round(drive.mode.damping_ratio, 4)
    (0.278, 0.063)
    """

    motor_inertia: float
    motor_friction: float
    gain: float
    integral_time_s: float
    load_mass: float
    damping: float
    stiffness: float

    def __post_init__(self) -> None:
        for field in fields(self):
            value, least = getattr(self, field.name), ">= 0" if field.name == "damping" else "> 0"
            if not (math.isfinite(value) and (value > 0.0 or (value == 0.0 and least == ">= 0"))):
                raise PlantError(f"{field.name} = {value!r}: must be finite and {least}")
        lag_s = self.motor_inertia / self.motor_friction
        if not self.integral_time_s > lag_s * (1.0 + 1e-9):
            raise PlantError(
                f"integral_time_s = {self.integral_time_s!r}: must be above motor_inertia / motor_friction ="
                f" {lag_s:.6g} s, or the position loop is unstable, whatever its gain"
            )

    @property
    def mode(self) -> Mode:
        """The load's swing against a motor that stands; its damping ratio at most just below 1."""
        root = math.sqrt(self.stiffness / self.load_mass)
        ratio = 0.5 * self.damping / math.sqrt(self.stiffness * self.load_mass)
        return Mode(root / (2.0 * math.pi), min(ratio, math.nextafter(1.0, 0.0)))

    @property
    def tuned(self) -> FloatArray:
        """Values of the parameters in `TUNED`, shape (5,)."""
        return np.array([getattr(self, name) for name in TUNED])

    @property
    def loop(self) -> Ratio:
        """T = C M / (1 + C M), from command to motor (eq 4)."""
        gain, time_s = self.gain, self.integral_time_s
        bottom = [time_s * self.motor_inertia, time_s * self.motor_friction, gain * time_s, gain]
        return Ratio(np.array([gain * time_s, gain]), np.array(bottom))

    @property
    def transmission(self) -> Ratio:
        """F, from motor to load (eq 3)."""
        return Ratio(
            np.trim_zeros(np.array([self.damping, self.stiffness]), "f"),
            np.array([self.load_mass, self.damping, self.stiffness]),
        )

    @property
    def transfer_function(self) -> Ratio:
        """H = T F, from command to load (eq 5)."""
        loop, transmission = self.loop, self.transmission
        return Ratio(
            product(loop.numerator, transmission.numerator),
            product(loop.denominator, transmission.denominator),
        )

    @property
    def sensitivities(self) -> tuple[Ratio, ...]:
        """Derivatives of ln H by each parameter of `TUNED`, in their order.

        Those by load mass, damping and stiffness, each times its parameter, sum to 0: only damping / mass and
        stiffness / mass can be seen in a motion.

        References
        ----------
        Visioli and Piazzi (2008), eqs 17 to 19, less their sign: P1 + P2 + P3 = - d ln H.

        Examples
        --------
        >>> drive = ElasticDrive(0.00011, 0.0034, 0.05, 0.5, 1.0, 0.22, 3.05)
        >>> each = [np.polyval(top, 2j) / np.polyval(bottom, 2j) for top, bottom in drive.sensitivities]
        >>> bool(abs(drive.tuned[2:] @ each[2:]) < 1e-15)
        True
        """
        loop, through, own = self.loop.denominator, self.transmission.numerator, self.transmission.denominator
        time_s, mass = self.integral_time_s, self.load_mass
        both = product(through, own)
        return (
            Ratio(np.array([-time_s, 0.0, 0.0, 0.0]), loop),
            Ratio(np.array([-time_s, 0.0, 0.0]), loop),
            Ratio(np.array([-1.0, 0.0, 0.0]), own),
            Ratio(np.array([mass, 0.0, 0.0, 0.0]), both),
            Ratio(np.array([mass, 0.0, 0.0]), both),
        )
