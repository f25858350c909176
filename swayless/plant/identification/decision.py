"""Whether a swing is that of a load on a rope or a linear one: decided on all modes that either one shows.

A strong second mode hides, in fits of one mode, which of the two it is. So each is fitted to its own end.

Not for: the fits (`fitting`), or how many modes there are (`order`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.plant.identification.fitting import Fit
from swayless.plant.identification.order import second_mode
from swayless.plant.identification.pendulum_swing import (
    LARGEST_SWING_RAD,
    bent,
    first_angle_rad,
    possible_waveform,
)
from swayless.plant.identification.record import FloatArray, Quantity, SwingRecord
from swayless.plant.identification.swing_model import PER_MODE
from swayless.plant.identification.waveform import Waveform

_DECISIVE = 4.0
"""Difference of log likelihoods at which the record decides: odds of 55 to 1."""

_ALIKE = 0.5
"""A mode of at least so much of another one's amplitude may be that of the load."""

_TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """What the record would be if the first mode were linear, or if it were a load on a rope.

    Parameters
    ----------
    single : Fit
        With one mode.
    double : Fit or None
        With two; None if the record shows no second one.
    """

    single: Fit
    double: Fit | None

    @property
    def fit(self) -> Fit:
        """The fit with as many modes as there are."""
        return self.double or self.single


def decided(
    single: Fit, record: SwingRecord, *, pendulum: bool | None, modes: int | None
) -> tuple[Hypothesis, tuple[Hypothesis, ...]]:
    """Fit a linear swing and those of a load on a rope, and take what the record says.

    Parameters
    ----------
    single : Fit
        One linear mode.
    record : SwingRecord
    pendulum, modes
        As for `identify_swing`.

    Returns
    -------
    taken, others : Hypothesis, tuple of Hypothesis
        What to take, and what nobody has ruled out: neither the caller, nor the record, nor physics.

    Raises
    ------
    PlantError
        If a pendulum is asked for that would swing beyond the horizontal.
    """
    waveform = possible_waveform(single, record, pendulum)
    linear = _hypothesis(single, modes)
    if waveform is None:
        return linear, ()
    swung = _swung(linear, waveform, modes)
    all_of_them = swung if pendulum else [*swung, linear]
    best = max(_evidence(each.fit) for each in all_of_them)
    left = [each for each in all_of_them if _evidence(each.fit) > best - _DECISIVE]
    usual = record.quantity is Quantity.angle and first_angle_rad(left[0].fit) < LARGEST_SWING_RAD
    likelier = _evidence(left[0].fit) > _evidence(linear.fit)
    taken = linear if linear in left and not usual and not likelier else left[0]
    return taken, tuple(each for each in left if each is not taken)


def _swung(linear: Hypothesis, waveform: Waveform, modes: int | None) -> list[Hypothesis]:
    """Fit a load on a rope, the likeliest first; of two modes of like size either may be it."""
    single = bent(linear.single.model, linear.single.parameters, waveform)
    first = _hypothesis(single, modes)
    if first.double is None or linear.double is None:
        return [first]
    # Fits of one mode may lead to another optimum than those of two.
    double, size = linear.double, [linear.double.amplitude(index) for index in range(2)]
    near = [
        Hypothesis(single, bent(double.model, _led_by(double, index), waveform))
        for index in range(2)
        if size[index] >= _ALIKE * size[1 - index]
    ]
    return sorted([first, *near], key=lambda each: -_evidence(each.fit))


def _led_by(double: Fit, index: int) -> FloatArray:
    """Give the parameters with one of the modes in front."""
    count = 2 * PER_MODE
    return np.concatenate([np.roll(double.parameters[:count], -PER_MODE * index), double.parameters[count:]])


def _hypothesis(single: Fit, modes: int | None) -> Hypothesis:
    return Hypothesis(single, None if modes == 1 else second_mode(single, certain=modes is not None))


def _evidence(found: Fit) -> float:
    """Give the log likelihood, less what more parameters gain by chance (Schwarz 1978)."""
    count = found.model.time_s.size
    return -0.5 * (
        count * float(np.log(max(found.squares, _TINY))) + found.model.parameter_count * float(np.log(count))
    )
