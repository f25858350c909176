"""What to add to the rope lengths that a crane shows, from its frequencies at several of them.

A hoist encoder counts from somewhere; the load's centre of gravity hangs below the hook. The period squared
over the length shown is a straight line, T^2 = 4 pi^2 / g (L + offset), of known slope.

Not for: finding the frequencies.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swayless.errors import PlantError
from swayless.plant.identification.identified_mode import IdentifiedMode
from swayless.plant.identification.noise import student_ratio
from swayless.plant.identification.record import FloatArray
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2

FEWEST_ROPES = 2
_CHANCE = 0.01


@dataclass(frozen=True, eq=False)
class RopeOffset:
    """Offset from the rope length that is shown to that of the pendulum.

    Parameters
    ----------
    offset_m, offset_m_std : float
        What to add, and its standard deviation.
    slope, slope_std : float or None
        Metres of pendulum for each metre shown, 1 if scale and gravity are right; None for two ropes, which
        leave no doubt to measure.
    rope_length_m, pendulum_m, pendulum_m_std : ndarray, shape (n,)
        What was shown, what the frequencies say, and its standard deviation.
    is_consistent : bool
        Whether the ropes agree on the offset; otherwise its uncertainty is widened until they do.
    """

    offset_m: float
    offset_m_std: float
    slope: float | None
    slope_std: float | None
    rope_length_m: FloatArray
    pendulum_m: FloatArray
    pendulum_m_std: FloatArray
    is_consistent: bool

    @property
    def scale_is_doubtful(self) -> bool:
        """Whether the slope is more than three standard deviations from 1."""
        return self.slope is not None and abs(self.slope - 1.0) > 3.0 * (self.slope_std or 0.0)


def fit_rope_offset(rope_length_m: FloatArray, modes: Sequence[IdentifiedMode]) -> RopeOffset:
    """Fit the offset.

    Parameters
    ----------
    rope_length_m : ndarray, shape (n,)
        Lengths as the crane shows them, > 0, two different ones at least.
    modes : sequence of IdentifiedMode
        The swing on each.

    Raises
    ------
    PlantError
        If there are fewer than two lengths, or other values out of range.

    Examples
    --------
    >>> from swayless.plant import pendulum_frequency_hz
    >>> shown = np.array([3.0, 6.0, 9.0])
    >>> modes = [IdentifiedMode(pendulum_frequency_hz(length + 0.4), 0.0, 1e-5, 1e-3) for length in shown]
    >>> found = fit_rope_offset(shown, modes)
    >>> round(found.offset_m, 6), round(found.slope, 6), found.is_consistent
    (0.4, 1.0, True)
    """
    if rope_length_m.size != len(modes) or np.unique(rope_length_m).size < FEWEST_ROPES:
        raise PlantError("an offset needs two different rope lengths at least, and one swing for each")
    if not (np.isfinite(rope_length_m).all() and (rope_length_m > 0.0).all()):
        raise PlantError("rope lengths must be finite and > 0")
    frequency_hz = np.array([mode.frequency_hz for mode in modes])
    relative_std = np.array([mode.frequency_hz_std for mode in modes]) / frequency_hz
    pendulum_m = STANDARD_GRAVITY_M_S2 / (2.0 * np.pi * frequency_hz) ** 2
    std_m = np.maximum(2.0 * pendulum_m * relative_std, 1e-12 * pendulum_m)
    weight = std_m**-2.0
    offsets = pendulum_m - rope_length_m
    offset_m = float(weight @ offsets / weight.sum())
    excess, consistent = _excess((offsets - offset_m) / std_m, offsets.size - 1)
    slope, slope_std = _slope(rope_length_m, pendulum_m, weight)
    return RopeOffset(
        offset_m=offset_m,
        offset_m_std=excess / float(np.sqrt(weight.sum())),
        slope=slope,
        slope_std=slope_std,
        rope_length_m=rope_length_m,
        pendulum_m=pendulum_m,
        pendulum_m_std=std_m,
        is_consistent=consistent,
    )


def _excess(scatter: FloatArray, freedom: int) -> tuple[float, bool]:
    """Give the factor (of Birge) by which scatter exceeds its standard deviations, if it is beyond chance."""
    from scipy.special import chdtrc

    squares = float(scatter @ scatter)
    if float(chdtrc(freedom, squares)) > _CHANCE:
        return 1.0, True
    return float(np.sqrt(squares / freedom)) * student_ratio(freedom), False


def _slope(
    rope_length_m: FloatArray, pendulum_m: FloatArray, weight: FloatArray
) -> tuple[float | None, float | None]:
    """Fit the slope with its own uncertainty, for three lengths or more."""
    if np.unique(rope_length_m).size <= FEWEST_ROPES:
        return None, None
    centred = rope_length_m - weight @ rope_length_m / weight.sum()
    moment = float(weight @ centred**2)
    slope = float((weight * centred) @ pendulum_m) / moment
    level = float(weight @ pendulum_m / weight.sum())
    excess, _ = _excess((pendulum_m - level - slope * centred) * np.sqrt(weight), rope_length_m.size - 2)
    return slope, excess / float(np.sqrt(moment))
