"""The small-angle double pendulum: a load on a sling below a hook on a rope.

Not for: large angles or hoisting.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from swayless.errors import PlantError
from swayless.plant.mode import Mode
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2


class Participation(NamedTuple):
    """Shares of the lower and the upper mode in the swing that a step of the trolley's velocity makes.

    After a jump of v (m/s) a body swings about its hanging place with the velocity -v (share_1 cos w_1 t +
    share_2 cos w_2 t), relative to the trolley: each mode sways by |share_i| v / w_i (m). The two shares of
    a body sum to 1; opposite signs start in opposite directions.

    Parameters
    ----------
    hook_ratio, load_ratio : tuple of float
        Shares of the (lower, upper) mode.
    """

    hook_ratio: tuple[float, float]
    load_ratio: tuple[float, float]


def double_pendulum_modes(
    rope_length_m: float,
    sling_length_m: float,
    hook_mass_kg: float,
    load_mass_kg: float,
    damping_ratio: float = 0.0,
) -> tuple[Mode, Mode]:
    """Make the two sway modes of a load on a sling below a hook on a rope.

    w^2 = g/2 ((1 + R)(1/L1 + 1/L2) -+ sqrt(((1 + R)(1/L1 + 1/L2))^2 - 4 (1 + R)/(L1 L2))), with L1 the rope,
    L2 the sling, R = load / hook. Both bodies are points, rope and sling have no mass.

    Parameters
    ----------
    rope_length_m : float
        From the suspension point to the hook's centre of gravity, > 0.
    sling_length_m : float
        From there to the load's centre of gravity, > 0.
    hook_mass_kg : float
        Mass of hook block and hook, > 0.
    load_mass_kg : float
        Mass of the load, > 0. Without a load there is one pendulum: `pendulum_mode`.
    damping_ratio : float
        Of both modes, 0 <= damping_ratio < 1.

    Returns
    -------
    tuple of Mode
        The lower mode first. Right to about 1e-15 for any ratio of masses and lengths.

    Raises
    ------
    PlantError
        If a value is not finite and positive, or the damping ratio is out of range.

    References
    ----------
    Blevins (1979), Formulas for Natural Frequency and Mode Shape, double pendulum. Singhose, Kim and Kenison
    (2008), Input shaping control of double-pendulum bridge crane oscillations, the two frequencies.

    Examples
    --------
    A hook of 300 kg on 6 m of rope, and 1.5 t on a sling of 3 m:

    >>> lower, upper = double_pendulum_modes(6.0, 3.0, 300.0, 1500.0)
    >>> round(lower.frequency_hz, 4), round(upper.frequency_hz, 4)
    (0.1694, 0.8465)
    """
    lower, upper, _ = _squared_frequencies(rope_length_m, sling_length_m, hook_mass_kg, load_mass_kg)
    return (
        Mode(math.sqrt(lower) / (2.0 * math.pi), damping_ratio),
        Mode(math.sqrt(upper) / (2.0 * math.pi), damping_ratio),
    )


def double_pendulum_participation(
    rope_length_m: float, sling_length_m: float, hook_mass_kg: float, load_mass_kg: float
) -> Participation:
    """Find how much of each mode a step of the trolley's velocity excites.

    The load follows the trolley through w_1^2 w_2^2 / ((s^2 + w_1^2)(s^2 + w_2^2)), which has no zeros: its
    shares are w_2^2 / (w_2^2 - w_1^2) and -w_1^2 / (w_2^2 - w_1^2), so its upper mode sways (f_1 / f_2)^3
    times as far as its lower one. The hook's share in a mode is the load's times 1 - w^2 L2 / g.

    Parameters
    ----------
    rope_length_m, sling_length_m, hook_mass_kg, load_mass_kg : float
        As for `double_pendulum_modes`.

    Returns
    -------
    Participation
        Shares of both modes, for the hook and for the load.

    Raises
    ------
    PlantError
        If a value is not finite and positive.

    Examples
    --------
    A heavy load barely shows the upper mode; under a sling that is longer than the rope a light one does:

    >>> heavy = double_pendulum_participation(6.0, 3.0, 300.0, 1500.0)
    >>> light = double_pendulum_participation(3.0, 6.0, 300.0, 60.0)
    >>> [round(share, 3) for share in (*heavy.load_ratio, *light.load_ratio)]
    [1.042, -0.042, 1.482, -0.482]
    """
    lower, upper, split = _squared_frequencies(rope_length_m, sling_length_m, hook_mass_kg, load_mass_kg)
    load = (upper / split, -lower / split)
    sling = sling_length_m / STANDARD_GRAVITY_M_S2
    return Participation((load[0] * (1.0 - lower * sling), load[1] * (1.0 - upper * sling)), load)


def _squared_frequencies(
    rope_length_m: float, sling_length_m: float, hook_mass_kg: float, load_mass_kg: float
) -> tuple[float, float, float]:
    """Squares of both angular frequencies and their difference, (rad/s)^2, without cancellation."""
    for name, value in locals().items():
        if not (math.isfinite(value) and value > 0.0):
            raise PlantError(f"{name} = {value!r}: must be finite and > 0")
    ratio = load_mass_kg / hook_mass_kg
    masses = 1.0 + ratio
    rope, sling = 1.0 / rope_length_m, 1.0 / sling_length_m
    # The discriminant as a sum of squares, the lower root from the product of both: nothing cancels.
    split = math.sqrt(masses * ((rope - sling) ** 2 + ratio * (rope + sling) ** 2))
    upper = 0.5 * (masses * (rope + sling) + split)
    lower = masses * rope * sling / upper
    gravity = STANDARD_GRAVITY_M_S2
    return gravity * lower, gravity * upper, gravity * split
