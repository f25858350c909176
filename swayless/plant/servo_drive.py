"""A speed loop that drives a trolley, and the true mode of the load that pulls at it.

Not for: large swings (`simulation.driven_crane`), current loops and force limits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from swayless.errors import PlantError
from swayless.plant.mode import Mode
from swayless.plant.pendulum import pendulum_mode


@dataclass(frozen=True)
class ServoDrive:
    """A trolley, its load, and a speed loop with proportional and integral gain.

    The force on the trolley is K (e + (integral of e) / T), with e the reference less the trolley speed.

    Parameters
    ----------
    trolley_mass_kg, load_mass_kg : float
        > 0; the trolley's includes what turns with it, as a mass at its wheels.
    gain_n_s_m : float
        K, in newtons per m/s, > 0.
    integral_time_s : float
        T, > 0; infinite (the default) for a loop without integral.

    Raises
    ------
    PlantError
        If a value is out of range.

    Examples
    --------
    >>> drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
    >>> drive.gain_n_s_m, drive.lag_s
    (80000.0, 0.1)
    """

    trolley_mass_kg: float
    load_mass_kg: float
    gain_n_s_m: float
    integral_time_s: float = math.inf

    def __post_init__(self) -> None:
        for name in ("trolley_mass_kg", "load_mass_kg", "gain_n_s_m"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise PlantError(f"{name} = {value!r}: must be finite and > 0")
        if not self.integral_time_s > 0.0:
            raise PlantError(f"integral_time_s = {self.integral_time_s!r}: must be > 0")

    @classmethod
    def from_lag(
        cls,
        trolley_mass_kg: float,
        load_mass_kg: float,
        lag_s: float,
        integral_time_s: float = math.inf,
    ) -> ServoDrive:
        """Make the drive whose proportional loop, moving both masses, lags by `lag_s` seconds, > 0."""
        if not (math.isfinite(lag_s) and lag_s > 0.0):
            raise PlantError(f"lag_s = {lag_s!r}: must be finite and > 0")
        mass_kg = trolley_mass_kg + load_mass_kg
        return cls(trolley_mass_kg, load_mass_kg, mass_kg / lag_s, integral_time_s)

    @property
    def lag_s(self) -> float:
        """Time constant (M + m) / K with which trolley and load together follow the proportional loop."""
        return (self.trolley_mass_kg + self.load_mass_kg) / self.gain_n_s_m

    @property
    def integral_gain_n_m(self) -> float:
        """K / T: newtons per metre that the trolley has fallen behind."""
        return self.gain_n_s_m / self.integral_time_s


def servo_drive_modes(
    drive: ServoDrive, rope_length_m: float, damping_ratio: float = 0.0
) -> tuple[Mode, ...]:
    """Find all vibrations of trolley, load and speed loop for small swings, the least damped first.

    They are the conjugate pairs among the eigenvalues of

        M v' = K (r - v) + (K / T) q + m (g a + 2 d w L a'),    q' = r - v,
        L a'' = -g a - 2 d w L a' - v',                         w = sqrt(g / L),

    with trolley speed v, reference r, swing a and the rope's own damping ratio d: the roots of
    (M s^2 + K s + K / T)(s^2 + 2 d w s + w^2) + m s^2 (2 d w s + w^2).

    Parameters
    ----------
    drive : ServoDrive
        The trolley, its load and its speed loop.
    rope_length_m : float
        > 0.
    damping_ratio : float
        Of the small swing below a trolley that stands, 0 <= damping_ratio < 1.

    Returns
    -------
    tuple of Mode
        One or two: a loop with integral may vibrate too. None is unstable, as trolley, load and speed loop
        are all passive.

    Raises
    ------
    PlantError
        If a value is out of range.

    References
    ----------
    Lagrange's equations of trolley and load, linear in the swing; see `simulation.DrivenCrane`.

    Examples
    --------
    A lag of 0.1 s damps the swing of a load of three times the trolley's mass by 6 %:

    >>> drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
    >>> [round(mode.damping_ratio, 4) for mode in servo_drive_modes(drive, 4.0)]
    [0.0588]
    """
    import numpy as np

    pendulum = pendulum_mode(rope_length_m, damping_ratio)
    w_rad_s = pendulum.angular_frequency_rad_s
    trolley_kg = drive.trolley_mass_kg
    # In s / w and per trolley mass, so that no coefficient is far from 1 that need not be.
    loop = [
        1.0,
        drive.gain_n_s_m / (trolley_kg * w_rad_s),
        drive.integral_gain_n_m / (trolley_kg * w_rad_s**2),
    ]
    swing = [1.0, 2.0 * damping_ratio, 1.0]
    pull = drive.load_mass_kg / trolley_kg * np.array([2.0 * damping_ratio, 1.0, 0.0, 0.0])
    roots = np.roots(np.polyadd(np.polymul(loop, swing), pull))
    pairs = roots[roots.imag > 0.0]
    # Rounding may leave an undamped pair on the wrong side of the imaginary axis.
    moduli, ratios = abs(pairs), np.maximum(-pairs.real / abs(pairs), 0.0)
    order = np.argsort(ratios)
    return tuple(Mode(float(moduli[i]) * pendulum.frequency_hz, float(ratios[i])) for i in order)


def servo_drive_mode(drive: ServoDrive, rope_length_m: float, damping_ratio: float = 0.0) -> Mode:
    """Find the mode in which the load swings: the least damped of `servo_drive_modes`.

    For a stiff proportional loop its damping ratio exceeds the rope's by m / (M + m) w tau / 2, with tau the
    lag (M + m) / K.

    Parameters are those of `servo_drive_modes`.

    Raises
    ------
    PlantError
        If a value is out of range, or nothing vibrates: with a soft loop and a load of over 8 trolley masses.

    Examples
    --------
    >>> drive = ServoDrive.from_lag(2000.0, 6000.0, 0.01)
    >>> round(servo_drive_mode(drive, 4.0).damping_ratio, 5), round(0.75 * 1.5658 * 0.01 / 2.0, 5)
    (0.00587, 0.00587)
    """
    modes = servo_drive_modes(drive, rope_length_m, damping_ratio)
    if not modes:
        raise PlantError(
            f"gain_n_s_m = {drive.gain_n_s_m!r}: damps the load on {rope_length_m!r} m of rope so well that"
            " nothing vibrates; a mode needs a stiffer speed loop"
        )
    return modes[0]
