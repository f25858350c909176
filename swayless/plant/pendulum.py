"""The small-angle pendulum: a load on a rope. Not for: large angles or hoisting."""

from __future__ import annotations

import math

from swayless.errors import PlantError
from swayless.plant.mode import Mode

STANDARD_GRAVITY_M_S2 = 9.80665
"""Standard gravity, exact by definition (CGPM 1901)."""


def pendulum_frequency_hz(rope_length_m: float) -> float:
    """Frequency of a load on a rope, sqrt(g / L) / (2 pi).

    Parameters
    ----------
    rope_length_m : float
        From the suspension point to the load's centre of gravity, > 0.

    Raises
    ------
    PlantError
        If the length is not finite and positive.

    Examples
    --------
    >>> round(pendulum_frequency_hz(8.8392), 6)  # 29 ft
    0.167639
    """
    if not (math.isfinite(rope_length_m) and rope_length_m > 0.0):
        raise PlantError(f"rope_length_m = {rope_length_m!r}: must be finite and > 0")
    return math.sqrt(STANDARD_GRAVITY_M_S2 / rope_length_m) / (2.0 * math.pi)


def pendulum_rope_length_m(frequency_hz: float) -> float:
    """Rope length whose small-angle frequency is `frequency_hz`: the inverse of `pendulum_frequency_hz`.

    Raises
    ------
    PlantError
        If the frequency is not finite and positive.

    Examples
    --------
    >>> round(pendulum_rope_length_m(0.25), 4)
    3.9745
    """
    if not (math.isfinite(frequency_hz) and frequency_hz > 0.0):
        raise PlantError(f"frequency_hz = {frequency_hz!r}: must be finite and > 0")
    return STANDARD_GRAVITY_M_S2 / (2.0 * math.pi * frequency_hz) ** 2


def pendulum_mode(rope_length_m: float, damping_ratio: float = 0.0) -> Mode:
    """Make the sway mode of a load on a rope of `rope_length_m` metres.

    Examples
    --------
    >>> pendulum_mode(4.0).damped_period_s
    4.012818585178081
    """
    return Mode(pendulum_frequency_hz(rope_length_m), damping_ratio)
