"""What a simulated crane did: trolley, load and swing at every tick, and what is left of the swing.

Not for: figures and files of it, nor for what was asked of the crane.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.errors import PlantError
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Trajectory(ABC):
    """A simulated move of a crane, whatever hangs on its rope.

    Everything is given at rest and at the end of every tick, before the next reference acts. Shapes are
    (ticks + 1,), or (cases, ticks + 1) when many cases were simulated.

    Parameters
    ----------
    time_s : ndarray, shape (ticks + 1,)
    trolley_m, trolley_m_s : ndarray
        Position and speed of the trolley; it starts at 0.
    rope_length_m : ndarray
    """

    time_s: FloatArray
    trolley_m: FloatArray
    trolley_m_s: FloatArray
    rope_length_m: FloatArray

    @property
    @abstractmethod
    def sway_m(self) -> FloatArray:
        """How far the load is ahead of the trolley."""

    @property
    @abstractmethod
    def amplitude_m(self) -> FloatArray:
        """How far the load will sway if trolley speed and rope length stay."""

    @abstractmethod
    def residual_ratio(self, speed_m_s: float) -> FloatArray:
        """Amplitude at the end, against that after one step of the speed by `speed_m_s`."""

    @property
    def load_m(self) -> FloatArray:
        """Horizontal position of the load."""
        return np.asarray(self.trolley_m + self.sway_m)

    @property
    def peak_sway_m(self) -> FloatArray:
        """Largest sway at any tick, to either side: shape () or (cases,)."""
        return np.asarray(abs(self.sway_m).max(axis=-1))


@dataclass(frozen=True, eq=False)
class CraneTrajectory(Trajectory):
    """A simulated move of a crane with one swinging load.

    Parameters
    ----------
    time_s, trolley_m, trolley_m_s, rope_length_m : ndarray
        As for `Trajectory`.
    swing_rad, swing_rad_s : ndarray
        Angle of the rope from the vertical, positive when the load is ahead, and its rate.

    Raises
    ------
    PlantError
        If the swing would carry the rope to the horizontal, where ropes fall slack.
    """

    swing_rad: FloatArray
    swing_rad_s: FloatArray

    def __post_init__(self) -> None:
        check_taut(self.time_s, self._rise_ratio() < 0.5)

    @property
    def sway_m(self) -> FloatArray:
        """How far the load is ahead of the trolley."""
        return self.rope_length_m * np.sin(self.swing_rad)

    @property
    def amplitude_rad(self) -> FloatArray:
        """Angle the swing would reach if the trolley kept its speed and the hoist stood.

        From the nonlinear energy: sin^2(amplitude / 2) = sin^2(swing / 2) + L swing'^2 / (4 g).
        """
        return 2.0 * np.arcsin(np.sqrt(self._rise_ratio()))

    @property
    def amplitude_m(self) -> FloatArray:
        """How far ahead of the trolley a swing of `amplitude_rad` carries the load."""
        return self.rope_length_m * np.sin(self.amplitude_rad)

    def residual_ratio(self, speed_m_s: float) -> FloatArray:
        """Amplitude at the end, against v / sqrt(g L): the small swing after one step of the speed by v.

        Parameters
        ----------
        speed_m_s : float
            The step to compare with, v, > 0: the full speed of the move.
        """
        check_speed(speed_m_s)
        unshaped_rad = speed_m_s / np.sqrt(STANDARD_GRAVITY_M_S2 * self.rope_length_m[..., -1])
        return np.asarray(self.amplitude_rad[..., -1] / unshaped_rad)

    def _rise_ratio(self) -> FloatArray:
        """Height to which the energy of the swing lifts the load, over two rope lengths."""
        kinetic = self.rope_length_m * self.swing_rad_s**2 / (4.0 * STANDARD_GRAVITY_M_S2)
        return np.asarray(np.sin(0.5 * self.swing_rad) ** 2 + kinetic)


def check_speed(speed_m_s: float) -> None:
    """Refuse a speed to compare with that is not finite and positive."""
    if not (math.isfinite(speed_m_s) and speed_m_s > 0.0):
        raise PlantError(f"speed_m_s = {speed_m_s!r}: must be finite and > 0")


def check_taut(time_s: FloatArray, taut: NDArray[np.bool_]) -> None:
    """Refuse a simulation in which a rope may fall slack: where `taut` is False at some tick of some case."""
    slack = ~taut.reshape(-1, time_s.size).all(axis=0)
    if slack.any():
        raise PlantError(
            f"the swing carries the rope to the horizontal at {float(time_s[slack][0]):g} s: it must stay"
            " below 90 degrees, where ropes fall slack"
        )
