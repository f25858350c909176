"""Lagrange's equations of trolley, hook and load put together by numerical derivatives, for comparison.

Nothing of the plants' algebra is used: only where the bodies are. All coordinates (trolley, rope angle, sling
angle, rope length) take part; those that are told have given accelerations and jumps, the others are solved.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY_M_S2 = 9.80665
TROLLEY, ROPE, SLING, LENGTH = range(4)


@dataclass(frozen=True)
class Mechanism:
    """Masses of trolley, hook and load, the sling, and which coordinates are free."""

    masses_kg: tuple[float, float, float]
    sling_m: float
    free: tuple[int, ...]
    force_n: Callable[[np.ndarray, np.ndarray, float, float], np.ndarray] = lambda *_: np.zeros(4)
    """Generalised forces (4,) of drive and damping, from coordinates, rates, reference and its integral."""
    drag: Callable[[np.ndarray, np.ndarray], np.ndarray] = lambda *_: np.zeros(4)
    """Accelerations (4,) that damping takes away."""

    def jacobian(self, y: np.ndarray) -> np.ndarray:
        """Velocities of the three bodies per rate of each coordinate, shape (3, 2, 4)."""
        trolley, angles, length = np.array([[1, 0, 0, 0], [0, 0, 0, 0]]), y[1:3], y[LENGTH]
        (sa, sb), (ca, cb) = np.sin(angles), np.cos(angles)
        hook = trolley + np.array([[0, length * ca, 0, sa], [0, length * sa, 0, -ca]])
        load = hook + self.sling_m * np.array([[0, 0, cb, 0], [0, 0, sb, 0]])
        return np.array([trolley, hook, load])

    def solve(self, y: np.ndarray, told: np.ndarray, forces: np.ndarray) -> np.ndarray:
        """All four accelerations (or jumps), those of the free coordinates from the others and the forces."""
        jacobian = self.jacobian(y)
        mass = np.einsum("b,bik,bil->kl", self.masses_kg, jacobian, jacobian)
        free = list(self.free)
        answer = np.array(told, dtype=float)
        answer[free] = 0.0
        answer[free] = np.linalg.solve(mass[np.ix_(free, free)], (forces - mass @ answer)[free])
        return answer

    def accelerations(
        self, y: np.ndarray, rates: np.ndarray, reference: tuple[float, float], slope: float, wind_n: float
    ) -> np.ndarray:
        step = 1e-30  # complex step: exact to rounding
        turning = (self.jacobian(y + 1j * step * rates).imag / step) @ rates
        pushes = np.array([[0.0, 0.0], [0.0, 0.0], [wind_n, 0.0]])
        pushes[:, 1] = -GRAVITY_M_S2 * np.array(self.masses_kg)
        net = pushes - np.array(self.masses_kg)[:, np.newaxis] * turning
        forces = np.einsum("bik,bi->k", self.jacobian(y), net) + self.force_n(y, rates, *reference)
        return self.solve(y, np.array([slope, 0.0, 0.0, 0.0]), forces) - self.drag(y, rates)

    def run(self, start: np.ndarray, ticks: np.ndarray, tick_s: float) -> np.ndarray:
        """Coordinates after each tick, from rows (jump, reference, slope, hoist speed, wind in N)."""
        y, rates, found = np.array(start, dtype=float), np.zeros(4), [np.array(start, dtype=float)]
        travel = 0.0
        for jump, reference, slope, hoist, wind in ticks:
            rates = rates + self.solve(y, np.array([jump, 0.0, 0.0, hoist - rates[LENGTH]]), np.zeros(4))
            rates[LENGTH] = hoist

            def motion(t, state, begins=(reference, travel), slope=slope, wind=wind):
                now = (begins[0] + slope * t, begins[1] + begins[0] * t + 0.5 * slope * t * t)
                return np.concatenate([state[4:], self.accelerations(state[:4], state[4:], now, slope, wind)])

            solved = solve_ivp(
                motion, (0.0, tick_s), np.concatenate([y, rates]), method="DOP853", rtol=1e-9, atol=1e-11
            )
            y, rates = solved.y[:4, -1], solved.y[4:, -1]
            travel += tick_s * (reference + 0.5 * slope * tick_s)
            found.append(y)
        return np.array(found).T
