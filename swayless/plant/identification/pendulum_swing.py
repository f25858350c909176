"""Whether a swing may be that of a load on a rope, and its fit.

Not for: the wave itself (`waveform`), or whether it is one (`decision`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from swayless.errors import PlantError
from swayless.plant.identification.fitting import Fit, fit
from swayless.plant.identification.record import FloatArray, SwingRecord
from swayless.plant.identification.swing_model import COSINE, DECAY, FREQUENCY, SINE, SwingModel
from swayless.plant.identification.waveform import WAVEFORMS, Waveform, lag_s
from swayless.plant.pendulum import pendulum_frequency_hz

SHORTEST_ROPE_M = 0.1
"""An angle that swings faster than a load on such a rope is taken for that of an arm."""

LARGEST_SWING_RAD = 0.8
"""Cranes swing less. An angle that seems to swing more may be in another unit: it has to show its lag."""


def possible_waveform(single: Fit, record: SwingRecord, pendulum: bool | None) -> Waveform | None:
    """Say what the wave of a load on a rope does to such a record, where that may be what swings.

    Parameters
    ----------
    single : Fit
        One linear mode.
    record : SwingRecord
    pendulum : bool or None
        As for `identify_swing`.

    Returns
    -------
    Waveform or None
        None where the caller or physics rules it out.

    Raises
    ------
    PlantError
        If a pendulum is asked for that would swing beyond the horizontal.
    """
    waveform = WAVEFORMS.get(record.quantity)
    if waveform is None or pendulum is False:
        return None
    fastest_rad_s = 2.0 * np.pi * pendulum_frequency_hz(SHORTEST_ROPE_M)
    if pendulum is None and single.mode(0)[FREQUENCY] > fastest_rad_s:
        return None
    angle = waveform.angle_per_value(float(single.mode(0)[FREQUENCY])) * single.amplitude(0)
    if angle < np.pi / 2.0:
        return waveform
    if pendulum:
        raise PlantError(
            f"a load on a rope would swing {np.degrees(angle):.3g} deg: must be below 90: check the unit"
        )
    return None


def bent(model: SwingModel, parameters: FloatArray, waveform: Waveform) -> Fit:
    """Fit the bent wave, starting at the frequency whose lagging phase is nearest to the linear one.

    Parameters
    ----------
    model : SwingModel
        Of linear modes.
    parameters : ndarray, shape (model.parameter_count,)
        The first mode is that of the load on a rope.
    waveform : Waveform
    """
    start = parameters.copy()
    amplitude = float(np.hypot(start[COSINE], start[SINE]))
    angle = waveform.angle_per_value(float(start[FREQUENCY])) * amplitude
    lag, _, _ = lag_s(model.time_s, float(start[DECAY]), angle)
    weight = np.exp(-2.0 * max(0.0, float(start[DECAY])) * model.time_s)
    slope, late = np.polynomial.polynomial.polyfit(model.time_s, lag, 1, w=np.sqrt(weight))[::-1]
    start[FREQUENCY] /= 1.0 - slope
    turn = complex(start[COSINE], -start[SINE]) * np.exp(1j * start[FREQUENCY] * late)
    start[COSINE], start[SINE] = turn.real, -turn.imag
    return fit(replace(model, waveform=waveform), start)


def first_angle_rad(found: Fit) -> float:
    """Give the angle of the first swing of a load on a rope; 0 for a linear mode."""
    waveform = found.model.waveform
    return (
        0.0
        if waveform is None
        else waveform.angle_per_value(float(found.mode(0)[FREQUENCY])) * found.amplitude(0)
    )


def cut_off(found: Fit, damping_ratio: float) -> tuple[float, float]:
    """Give what the series of the wave leave out: standard deviations of relative frequency and of damping.

    The series end, and the action falls as it does on the average over a swing: to first order in damping.
    The factors cover the errors against integrated pendulums of up to 0.8 rad and a damping ratio of 0.1.
    """
    waveform = found.model.waveform
    if waveform is None:
        return 0.0, 0.0
    angle = first_angle_rad(found)
    averaged = waveform.averaging * (damping_ratio * angle) ** 2
    return 2e-4 * angle**8 + averaged, 2e-4 * damping_ratio * angle**4 + averaged / 4.0
