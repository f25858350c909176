"""A speed loop that drives a trolley, and the true mode of the load that pulls at it.

Not for: large swings (`simulation.driven_crane`), current loops and force limits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.errors import PlantError
from swayless.plant.mode import Mode
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2

_LEAST_TURN = 1e-7
"""Imaginary part, of a pole's size, below which it is a real double pole and rounding."""


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
    poles_rad_s = servo_drive_poles(drive, rope_length_m, damping_ratio)
    moduli, ratios = pole_figures(poles_rad_s[np.isfinite(poles_rad_s)])
    return tuple(
        Mode(modulus / (2.0 * math.pi), ratio)
        for modulus, ratio in zip(moduli.tolist(), ratios.tolist(), strict=True)
    )


def servo_drive_poles(
    drive: ServoDrive, rope_length_m: ArrayLike, damping_ratio: float = 0.0
) -> NDArray[np.complex128]:
    """Find the upper half of every vibration's conjugate pair of poles, on many ropes at once.

    Parameters
    ----------
    drive, damping_ratio
        As for `servo_drive_modes`.
    rope_length_m : array_like, shape (...)
        > 0.

    Returns
    -------
    ndarray of complex, shape (..., 2)
        In rad/s, the least damped first; nan where there is no such vibration.

    Raises
    ------
    PlantError
        If a value is out of range.

    Examples
    --------
    >>> drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
    >>> servo_drive_poles(drive, [4.0, 8.0])[:, 0].round(3)
    array([-0.092+1.567j, -0.046+1.107j])
    """
    lengths_m = np.asarray(rope_length_m, dtype=np.float64)
    good = np.isfinite(lengths_m) & (lengths_m > 0.0)
    if not good.all():
        raise PlantError(f"rope_length_m = {float(lengths_m[~good].flat[0])!r}: must be finite and > 0")
    ratio = Mode(1.0, damping_ratio).damping_ratio
    w_rad_s = np.sqrt(STANDARD_GRAVITY_M_S2 / lengths_m)
    # In s / w and per trolley mass, so that no coefficient is far from 1 that need not be.
    load = drive.load_mass_kg / drive.trolley_mass_kg
    gain = drive.gain_n_s_m / (drive.trolley_mass_kg * w_rad_s)
    integral = drive.integral_gain_n_m / (drive.trolley_mass_kg * w_rad_s**2)
    swing = 2.0 * ratio
    below = np.stack(
        np.broadcast_arrays(
            gain + swing * (1.0 + load),
            integral + swing * gain + 1.0 + load,
            swing * integral + gain,
            integral,
        ),
        axis=-1,
    )
    roots = _quartic_roots(below)
    vibrates = roots.imag > _LEAST_TURN * abs(roots)
    # Rounding may leave an undamped pair on the wrong side of the imaginary axis.
    settled = np.minimum(roots.real, 0.0) + 1j * roots.imag
    ratios = np.where(vibrates, pole_figures(settled)[1], np.inf)
    first = np.argsort(ratios, axis=-1, kind="stable")[..., :2]
    poles = np.where(vibrates, settled, np.nan) * w_rad_s[..., np.newaxis]
    return np.asarray(np.take_along_axis(poles, first, axis=-1))


def _quartic_roots(below: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Find the roots of s^4 + below[..., 0] s^3 + ... + below[..., 3], polished by Newton's method."""
    companion = np.zeros((*below.shape, 4))
    companion[..., [1, 2, 3], [0, 1, 2]] = 1.0
    companion[..., 0, :] = -below
    roots = np.linalg.eigvals(companion).astype(np.complex128)
    one = np.ones((*below.shape[:-1], 1))
    powers = np.concatenate([one, below], axis=-1)[..., np.newaxis, :]
    for _ in range(2):
        s = roots[..., np.newaxis]
        value = (powers * s ** np.arange(4, -1, -1)).sum(axis=-1)
        slope = (powers[..., :-1] * np.arange(4, 0, -1) * s ** np.arange(3, -1, -1)).sum(axis=-1)
        roots = roots - np.divide(value, slope, out=np.zeros_like(value), where=slope != 0.0)
    return roots


def pole_figures(poles_rad_s: NDArray[np.complex128]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Give the undamped angular frequency of poles and their damping ratio: |s| and -Re s / |s|."""
    moduli = np.asarray(abs(poles_rad_s), dtype=np.float64)
    ratios = np.zeros_like(moduli)
    np.divide(-poles_rad_s.real, moduli, out=ratios, where=moduli != 0.0)
    return moduli, ratios


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
