"""What a simulated crane with a heavy hook did, and what is left in each of its two vibrations.

Not for: how it came about (`hook_and_load`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2
from swayless.plant.simulation.trajectory import FloatArray, Trajectory, check_speed, check_taut


@dataclass(frozen=True, eq=False)
class HookAndLoadTrajectory(Trajectory):
    """A simulated move of a crane with a hook and, below it, a load.

    Parameters
    ----------
    time_s, trolley_m, trolley_m_s, rope_length_m : ndarray
        As for `Trajectory`; the rope goes to the hook.
    sling_length_m, load_share_ratio : float
        From the hook to the load, and the load's share of the mass of both.
    angles_rad, angles_rad_s : ndarray, shape (2, ...)
        Angles of rope and sling from the vertical, and their rates.

    Raises
    ------
    PlantError
        If rope or sling swings to the horizontal, where it falls slack.
    """

    sling_length_m: float
    load_share_ratio: float
    angles_rad: FloatArray
    angles_rad_s: FloatArray

    def __post_init__(self) -> None:
        check_taut(self.time_s, abs(self.angles_rad).max(axis=0) < 0.5 * np.pi)

    @property
    def hook_sway_m(self) -> FloatArray:
        """How far the hook is ahead of the trolley."""
        return np.asarray(self.rope_length_m * np.sin(self.angles_rad[0]))

    @property
    def sway_m(self) -> FloatArray:
        """How far the load is ahead of the trolley."""
        return np.asarray(self.hook_sway_m + self.sling_length_m * np.sin(self.angles_rad[1]))

    @property
    def mode_frequencies_rad_s(self) -> FloatArray:
        """Angular frequency of each small vibration on the present rope, the slower first: (2, ...)."""
        hook_share = 1.0 - self.load_share_ratio
        per_m = STANDARD_GRAVITY_M_S2 / hook_share
        trace = per_m * (1.0 / self.rope_length_m + 1.0 / self.sling_length_m)
        determinant = per_m**2 * hook_share / (self.rope_length_m * self.sling_length_m)
        fast = 0.5 * trace + np.sqrt(0.25 * trace**2 - determinant)
        return np.asarray(np.sqrt([determinant / fast, fast]))

    @property
    def mode_amplitudes_m(self) -> FloatArray:
        """How far the load sways in each small vibration if trolley speed and rope stay: shape (2, ...).

        The sway y = L a + S b has y'' = -g b, as the sling alone pulls at the load. With y = y1 + y2 and
        g b = w1^2 y1 + w2^2 y2 each part follows from y and b, and its rate from theirs.
        """
        slow, fast = self.mode_frequencies_rad_s**2
        parts = []
        for hook, sling in (self.angles_rad, self.angles_rad_s):
            sway, pull = (
                self.rope_length_m * hook + self.sling_length_m * sling,
                STANDARD_GRAVITY_M_S2 * sling,
            )
            parts.append(np.array([fast * sway - pull, pull - slow * sway]) / (fast - slow))
        displacement, rate = parts
        return np.asarray(np.hypot(displacement, rate / np.sqrt([slow, fast])))

    @property
    def amplitude_m(self) -> FloatArray:
        """How far the load will sway when both small vibrations meet, if trolley speed and rope stay."""
        return np.asarray(self.mode_amplitudes_m.sum(axis=0))

    def residual_ratio(self, speed_m_s: float) -> FloatArray:
        """Amplitude at the end, against that after one step of the speed by v, in a crane that hung still.

        The load follows the trolley through w1^2 w2^2 / ((s^2 + w1^2)(s^2 + w2^2)), so a step leaves
        v (w1^3 + w2^3) / (w1 w2 (w2^2 - w1^2)) of sway in both vibrations together.

        Parameters
        ----------
        speed_m_s : float
            The step to compare with, v, > 0: the full speed of the move.
        """
        check_speed(speed_m_s)
        slow, fast = self.mode_frequencies_rad_s[..., -1]
        unshaped_m = speed_m_s * (slow**3 + fast**3) / (slow * fast * (fast**2 - slow**2))
        return np.asarray(self.amplitude_m[..., -1] / unshaped_m)
