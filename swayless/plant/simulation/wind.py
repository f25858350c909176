"""Wind as a disturbance of a simulated load: gusts as speeds, and what they push with.

Not for: loads of norms on structures, nor for wind on the trolley.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from swayless.errors import PlantError
from swayless.plant.simulation.crane_ticks import check_tick
from swayless.plant.simulation.trajectory import FloatArray

AIR_DENSITY_KG_M3 = 1.225
"""Of the standard atmosphere at sea level (ISO 2533)."""


def drag_m_s2(
    wind_m_s: ArrayLike,
    *,
    area_m2: float,
    drag_coefficient: float,
    load_mass_kg: float,
    air_density_kg_m3: float = AIR_DENSITY_KG_M3,
) -> FloatArray:
    """Force of the wind on a load per load mass, rho c A v |v| / (2 m): the `wind_m_s2` of a simulation.

    Parameters
    ----------
    wind_m_s : array_like
        Speed of the wind along the travel, of either sign. The speed of the load itself is left out.
    area_m2 : float
        Of the load across the wind, > 0.
    drag_coefficient : float
        > 0; near 1.2 for a container.
    load_mass_kg, air_density_kg_m3 : float
        > 0.

    Raises
    ------
    PlantError
        If a value is not finite and positive.

    Examples
    --------
    >>> drag_m_s2([10.0, -20.0], area_m2=30.0, drag_coefficient=1.2, load_mass_kg=20e3).round(4)
    array([ 0.1102, -0.441 ])
    """
    given = {
        "area_m2": area_m2,
        "drag_coefficient": drag_coefficient,
        "load_mass_kg": load_mass_kg,
        "air_density_kg_m3": air_density_kg_m3,
    }
    _check_positive(given)
    wind = np.asarray(wind_m_s, dtype=np.float64)
    return np.asarray(0.5 * air_density_kg_m3 * drag_coefficient * area_m2 / load_mass_kg * wind * abs(wind))


def one_cosine_gust(
    ticks: int, *, tick_s: float, start_s: float, duration_s: float, peak_m_s: float
) -> FloatArray:
    """Speed of a single gust that rises and falls as (1 - cos) / 2, in the middle of each tick.

    Parameters
    ----------
    ticks : int
        How many, >= 1.
    tick_s, duration_s : float
        Duration of a tick and of the gust, > 0.
    start_s : float
        When the gust begins.
    peak_m_s : float
        Its largest speed, half way.

    Raises
    ------
    PlantError
        If a duration is not finite and positive.

    References
    ----------
    MIL-F-8785C (1980), discrete gust: its rise, here followed by the mirrored fall.

    Examples
    --------
    >>> one_cosine_gust(4, tick_s=1.0, start_s=0.0, duration_s=4.0, peak_m_s=10.0).round(3)
    array([1.464, 8.536, 8.536, 1.464])
    """
    _check_positive({"tick_s": tick_s, "duration_s": duration_s})
    phase = (tick_s * (np.arange(ticks) + 0.5) - start_s) / duration_s
    gust = 0.5 * peak_m_s * (1.0 - np.cos(2.0 * np.pi * phase))
    return np.where((phase > 0.0) & (phase < 1.0), gust, 0.0)


def dryden_gusts(
    ticks: int,
    *,
    tick_s: float,
    mean_m_s: float,
    deviation_m_s: float,
    length_m: float,
    seed: int,
) -> FloatArray:
    """Speed of a turbulent wind: its mean, and gusts along it with Dryden's spectrum.

    The spectrum deviation^2 2 T / (1 + (w T)^2), with T = length / mean, is that of a first-order process,
    whose values at the ticks are u_k+1 = exp(-tick / T) u_k + noise, exactly. It begins in the steady state.

    Parameters
    ----------
    ticks : int
        How many, >= 1.
    tick_s : float
        Duration of a tick, > 0.
    mean_m_s, deviation_m_s : float
        Mean, > 0, and standard deviation, >= 0, of the speed.
    length_m : float
        Length of the gusts, > 0; tens of metres near the ground.
    seed : int
        The same seed gives the same wind, with the same version of numpy.

    Raises
    ------
    PlantError
        If a value is out of range.

    References
    ----------
    MIL-F-8785C (1980), Dryden's spectrum of the longitudinal gust.

    Examples
    --------
    >>> wind = dryden_gusts(60000, tick_s=0.1, mean_m_s=12.0, deviation_m_s=2.0, length_m=50.0, seed=1)
    >>> wind.shape
    (60000,)
    """
    from scipy.signal import lfilter

    check_tick(tick_s)
    _check_positive({"mean_m_s": mean_m_s, "length_m": length_m})
    if not (math.isfinite(deviation_m_s) and deviation_m_s >= 0.0):
        raise PlantError(f"deviation_m_s = {deviation_m_s!r}: must be finite and >= 0")
    decay = tick_s * mean_m_s / length_m
    noise = deviation_m_s * np.random.default_rng(seed).standard_normal(ticks)
    noise[1:] *= math.sqrt(-math.expm1(-2.0 * decay))
    return np.asarray(mean_m_s + lfilter([1.0], [1.0, -math.exp(-decay)], noise))


def _check_positive(values: dict[str, float]) -> None:
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0.0):
            raise PlantError(f"{name} = {value!r}: must be finite and > 0")
