"""Free swings with a known truth, and the bound that Cramer and Rao set to any estimate of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.plant.identification import Quantity, SwingRecord
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2


@dataclass(frozen=True)
class Truth:
    """One decaying mode in white noise."""

    frequency_hz: float
    damping_ratio: float = 0.0
    amplitude: float = 1.0
    phase_rad: float = 0.3

    def swing(self, time_s):
        w = 2.0 * np.pi * self.frequency_hz
        damped = w * np.sqrt(1.0 - self.damping_ratio**2)
        return (
            self.amplitude
            * np.exp(-self.damping_ratio * w * time_s)
            * np.cos(damped * time_s + self.phase_rad)
        )

    def bounds(self, time_s, noise):
        """Cramer and Rao's bounds of frequency and damping; amplitude, phase and offset are unknown too."""
        names = ("frequency_hz", "damping_ratio", "amplitude", "phase_rad")
        columns = [np.ones(time_s.size)]
        for name in names:
            # Differences in the complex plane, exact to rounding.
            moved = Truth(**{**self.__dict__, name: getattr(self, name) + 1e-30j})
            columns.insert(len(columns) - 1, moved.swing(time_s).imag / 1e-30)
        jacobian = np.stack(columns, axis=1)
        size = np.linalg.norm(jacobian, axis=0)
        covariance = np.linalg.inv((jacobian / size).T @ (jacobian / size))
        return noise * np.sqrt(np.diag(covariance))[:2] / size[:2]


def random_record(rng):
    """One record of the acceptance test: its truth, the record, and the bounds."""
    damping = rng.choice([0.0, 10.0 ** rng.uniform(-4.0, -1.0), rng.uniform(0.0, 0.1)])
    truth = Truth(
        10.0 ** rng.uniform(-1.0, np.log10(20.0)), damping, 10.0 ** rng.uniform(-2, 1), rng.uniform(0, 6)
    )
    count = int(10.0 ** rng.uniform(np.log10(8.0), np.log10(80.0)) * (swings := rng.uniform(5.0, 60.0)))
    time_s = np.linspace(0.0, swings / truth.frequency_hz, count)
    noise = truth.amplitude * rng.choice([0.002, 0.2, rng.uniform(0.0, 0.2)])
    drift = truth.amplitude * (rng.normal() + 0.5 * rng.normal() * time_s / time_s[-1])
    value = truth.swing(time_s) + drift + noise * rng.normal(size=count)
    kept = rng.random(count) > rng.choice([0.0, 0.2])
    kept[:4] = True
    return truth, SwingRecord(time_s[kept], value[kept]), truth.bounds(time_s[kept], noise)


def pendulum_swing(time_s, frequency_hz, damping_ratio, angle_rad, quantity=Quantity.angle):
    """A load on a rope, integrated: its angle, position or horizontal acceleration."""
    from scipy.integrate import solve_ivp

    w = 2.0 * np.pi * frequency_hz
    length_m = STANDARD_GRAVITY_M_S2 / w**2
    solved = solve_ivp(
        lambda _, state: [state[1], -(w**2) * np.sin(state[0]) - 2.0 * damping_ratio * w * state[1]],
        (0.0, time_s[-1]),
        [0.8 * angle_rad, 0.6 * angle_rad * w],
        t_eval=time_s,
        method="DOP853",
        rtol=1e-10,
        atol=1e-12,
    )
    angle, rate = solved.y
    if quantity is Quantity.angle:
        return angle
    if quantity is Quantity.position:
        return length_m * np.sin(angle)
    turning = -(w**2) * np.sin(angle) - 2.0 * damping_ratio * w * rate
    return length_m * (np.cos(angle) * turning - np.sin(angle) * rate**2)
