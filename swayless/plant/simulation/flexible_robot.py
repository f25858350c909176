"""A gantry robot with a flexible link, like the test bed of Rhim and Book: its base follows a speed.

Not for: the robot's joint control, which is taken as ideal, nor for more than one vibration.
"""

from __future__ import annotations

import cmath
import math

from swayless.errors import PlantError
from swayless.plant.mode import Mode


class FlexibleRobot:
    """The tip of a flexible link on a base that follows a speed, held over each tick.

    Relative to the base the tip obeys y'' + 2 d w y' + w^2 y = -v', v the speed of the base: a step of the
    speed is an impulse. The response from tick to tick is exact. What an accelerometer on the tip measures is
    v' + y'' = -(w^2 y + 2 d w y').

    Parameters
    ----------
    mode : Mode
        Vibration of the tip.
    tick_s : float
        Length of a tick, > 0.

    Raises
    ------
    PlantError
        If the tick is out of range.

    References
    ----------
    S. Rhim, W. J. Book, Adaptive command shaping using adaptive filter approach in time domain, eqs 1-3 for
    one elastic mode.

    Examples
    --------
    A step of 1 m/s excites 2 pi f m/s2:

    >>> robot = FlexibleRobot(Mode(16.0), 1e-3)
    >>> record = [robot.step(1.0) for _ in range(100)]
    >>> round(max(record) / (2 * 3.141592653589793 * 16.0), 3)
    1.0
    """

    def __init__(self, mode: Mode, tick_s: float) -> None:
        if not (math.isfinite(tick_s) and tick_s > 0.0):
            raise PlantError(f"tick_s = {tick_s!r}: must be finite and > 0")
        self._tick_s = tick_s
        self._speed_m_s = 0.0
        self._swing = 0j
        self._take(mode)

    def _take(self, mode: Mode) -> None:
        angular = mode.angular_frequency_rad_s
        self._pole = angular * complex(-mode.damping_ratio, math.sqrt(1.0 - mode.damping_ratio**2))
        self._turn = cmath.exp(self._pole * self._tick_s)
        self._to_acceleration = self._pole * self._pole / self._pole.imag

    def load(self, mode: Mode) -> None:
        """Take another payload: another vibration, with the tip where it is and as fast as it is."""
        tip_m = -self._swing.imag / self._pole.imag
        tip_m_s = -(self._pole * self._swing).imag / self._pole.imag
        self._take(mode)
        imag = -tip_m * self._pole.imag
        self._swing = complex(-tip_m_s - self._pole.real * imag / self._pole.imag, imag)

    def step(self, speed_m_s: float) -> float:
        """Run one tick at a speed of the base, in m/s.

        Returns
        -------
        float
            Acceleration of the tip at the end of the tick, in m/s2.
        """
        self._swing = (self._swing + (speed_m_s - self._speed_m_s)) * self._turn
        self._speed_m_s = speed_m_s
        return -(self._to_acceleration * self._swing).imag
