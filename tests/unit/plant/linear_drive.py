"""The linear equations of trolley, load and speed loop as a matrix, for comparison."""

from __future__ import annotations

import math

import numpy as np

from swayless.plant.servo_drive import ServoDrive

GRAVITY_M_S2 = 9.80665


def state_matrix(drive: ServoDrive, rope_m: float, damping_ratio: float) -> np.ndarray:
    """Rates of (trolley speed, integral of the error, swing, its rate) per state, the reference being 0."""
    mass, load, gain = drive.trolley_mass_kg, drive.load_mass_kg, drive.gain_n_s_m
    damping = 2.0 * damping_ratio * math.sqrt(GRAVITY_M_S2 * rope_m)
    trolley = np.array(
        [-gain / mass, drive.integral_gain_n_m / mass, load / mass * GRAVITY_M_S2, load / mass * damping]
    )
    swing = -(np.array([0.0, 0.0, GRAVITY_M_S2, damping]) + trolley) / rope_m
    return np.array([trolley, [-1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], swing])
