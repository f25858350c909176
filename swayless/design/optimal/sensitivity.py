"""What a command leaves swinging where the plant is not what it was designed for. Not for: designing it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.optimal.command import Command
from swayless.design.optimal.linear_plant import ComplexArray, LinearPlant, check_apart, mode_vectors
from swayless.design.residual import residual_vibration
from swayless.design.shaper import FloatArray
from swayless.plant import Mode


def residual_amplitude(command: Command, frequency_hz: ArrayLike, damping_ratio: float = 0.0) -> FloatArray:
    """Give the amplitude with which a mode of gain 1 still swings when the command ends.

    The mode is w^2 / (s^2 + 2 d w s + w^2), w = 2 pi f; of a command that changes by 1 the amplitude is a
    ratio of the move, as in the sensitivity curve of a shaper.

    Parameters
    ----------
    command : Command
        Zero-order, from rest.
    frequency_hz : array_like
        Actual undamped frequencies, > 0.
    damping_ratio : float
        0 <= damping_ratio < 1.

    Returns
    -------
    ndarray
        In units of the command, of the shape of `frequency_hz`.

    References
    ----------
    Xu and Meckl (2005), fig 10.

    Examples
    --------
    A step of 1 in two halves, half a period apart, leaves nothing; 20 % off, a third of the step:

    >>> command = Command(0.5, [0.5], 1.0)
    >>> residual_amplitude(command, [1.0, 1.2]).round(4)
    array([0.   , 0.309])
    """
    return residual_vibration(command.increments, frequency_hz, damping_ratio=damping_ratio)


def swing_left(plant: LinearPlant, command: Command, frequency_ratio: ArrayLike) -> FloatArray:
    """Give the amplitude with which each ringing mode still moves the output when the command ends.

    One mode at a time is off in frequency, as in `detuned`: its damping ratio, and what the plant does at
    rest, are as before.

    Parameters
    ----------
    plant : LinearPlant
        The nominal one.
    command : Command
        Zero-order.
    frequency_ratio : array_like, shape (n,)
        Actual frequencies, of the nominal ones; > 0.

    Returns
    -------
    ndarray, shape (modes, n)
        In units of the output; modes in the order of `LinearPlant.ringing_poles_rad_s`.

    Raises
    ------
    DesignError
        If two of them cannot be told apart.

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> swing_left(plant, Command(np.pi / 10.0, [0.5], 1.0), [1.0, 1.2]).round(4)
    array([[0.   , 0.309]])
    """
    check_apart(plant)
    plant, increments = plant.balanced, command.increments
    ratios = np.asarray(frequency_ratio, dtype=np.float64)
    since_s = command.duration_s - increments.times_s
    rows = []
    for pole in plant.ringing_poles_rad_s:
        actual = pole * ratios
        swings = np.exp(actual[:, np.newaxis] * since_s) @ increments.amplitudes
        rows.append(2.0 * np.abs(_residues(plant, complex(pole), ratios) / actual * swings))
    return np.array(rows).reshape(len(rows), ratios.size)


def _residues(plant: LinearPlant, pole: complex, ratios: FloatArray) -> ComplexArray:
    """Give the residue of the detuned plant at its pole r p, shape (n,).

    Moved from p to q = r p, the mode has the residue r^2 (q - p) G(q) (q - p*) / (q - q*). Of (q - p) G(q)
    the mode's own part is its residue at p; for the rest p is taken out of A, where it would divide by 0.
    """
    after, before = mode_vectors(plant, pole)
    own = np.outer(after, before)
    actual = pole * ratios
    others = actual[:, np.newaxis, np.newaxis] * np.eye(plant.order) - plant.a + abs(pole) * own
    answers = np.linalg.solve(others, (plant.b - own @ plant.b)[:, np.newaxis])[..., 0]
    near = plant.c @ own @ plant.b + (actual - pole) * (answers @ plant.c + plant.d)
    return np.asarray(ratios**2 * near * (actual - pole.conjugate()) / (2j * actual.imag))


def transform_derivatives(command: Command, pole_rad_s: complex, order: int) -> ComplexArray:
    """Give s U(s) and its derivatives at a pole, U the transform of the command less its initial value.

    Where they vanish, so do those of U: the residual vibration of the pole and its derivatives in it.

    Parameters
    ----------
    command : Command
        Zero-order.
    pole_rad_s : complex
        Where to look; not 0.
    order : int
        Highest derivative, >= 0.

    Returns
    -------
    ndarray of complex, shape (order + 1,)
        Sum of increments (-|p| t)^j exp(-p t), in units of the command: derivatives in s / |p|.

    References
    ----------
    Xu and Meckl (2005), eqs 12, 25-33.

    Examples
    --------
    >>> abs(transform_derivatives(Command(0.5, [0.5], 1.0), 2j * np.pi, 1)).round(9)
    array([0.        , 1.57079633])
    """
    increments = command.increments
    decayed = increments.amplitudes * np.exp(-pole_rad_s * increments.times_s)
    powers = np.vander(-abs(pole_rad_s) * increments.times_s, order + 1, increasing=True)
    return np.asarray(decayed @ powers)


def mode_of(pole_rad_s: complex) -> Mode:
    """Give the mode of a pole that rings, one that is unstable by rounding taken as undamped.

    Examples
    --------
    >>> mode_of(-0.5 + 10.0j).damping_ratio.__round__(6)
    0.049938
    """
    size = abs(pole_rad_s)
    return Mode(size / (2.0 * np.pi), max(0.0, -pole_rad_s.real / size))
