"""Plants whose modes have another frequency than was thought. Not for: what a command leaves there."""

from __future__ import annotations

import math

import numpy as np

from swayless.design.optimal.linear_plant import ComplexArray, LinearPlant, check_apart, mode_vectors
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError


def detuned(plant: LinearPlant, frequency_ratio: float) -> LinearPlant:
    """Give the plant with the frequencies of all its ringing modes off.

    Of each factor w^2 / (s^2 + 2 d w s + w^2) of the transfer function only w changes. Damping ratios, other
    poles, zeros, and what the plant does at rest, or as a rigid body, are as before.

    Parameters
    ----------
    plant : LinearPlant
        The nominal one.
    frequency_ratio : float
        Actual frequencies, of the nominal ones; > 0.

    Raises
    ------
    DesignError
        If the ratio is out of range, or two ringing poles cannot be told apart.

    References
    ----------
    Kailath (1980), "Linear systems", section 3.2: state feedback moves poles and no zeros.

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> off = detuned(plant, 1.1)
    >>> abs(off.poles_rad_s).round(9).tolist(), round(off.equilibrium(1.0)[1], 9)
    ([11.0, 11.0], 1.0)
    """
    if not (math.isfinite(frequency_ratio) and frequency_ratio > 0.0):
        raise DesignError(f"frequency_ratio = {frequency_ratio!r}: must be finite and > 0")
    if frequency_ratio == 1.0:
        return plant
    check_apart(plant)
    plant = plant.balanced
    above = plant.ringing_poles_rad_s
    poles = np.concatenate([above, above.conj()])
    gains = _gains(plant, poles, frequency_ratio)
    quicker = frequency_ratio**poles.size
    return LinearPlant(
        plant.a - np.outer(plant.b, gains), plant.b * quicker, plant.c - plant.d * gains, plant.d * quicker
    )


def _gains(plant: LinearPlant, poles: ComplexArray, frequency_ratio: float) -> FloatArray:
    """Give the feedback that moves some poles and no others, shape (n,), as a sum of left eigenvectors."""
    if poles.size == 0:
        return np.zeros(plant.order)
    between = poles[:, np.newaxis] - poles
    np.fill_diagonal(between, 1.0)
    shares = (poles[:, np.newaxis] - frequency_ratio * poles).prod(axis=1) / between.prod(axis=1)
    befores = np.array([mode_vectors(plant, complex(pole))[1] for pole in poles])
    return np.asarray(((shares / (befores @ plant.b)) @ befores).real)
