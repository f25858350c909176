"""Whether a swing is that of a load on a rope or a linear one: decided on all modes that either one shows.

A strong second mode hides, in fits of one mode, which of the two it is. So each is fitted to its own end.

Not for: the fits (`fitting`), or how many modes there are (`order`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.plant.identification.falling import FallingFit, falling_fit
from swayless.plant.identification.fitting import Fit
from swayless.plant.identification.order import may_be_an_envelope, second_mode
from swayless.plant.identification.pendulum_swing import (
    LARGEST_SWING_RAD,
    bent,
    first_angle_rad,
    possible_waveform,
)
from swayless.plant.identification.record import FloatArray, Quantity, SwingRecord
from swayless.plant.identification.swing_model import PER_MODE
from swayless.plant.identification.waveform import Waveform

DECISIVE = 4.0
"""Difference of log likelihoods at which the record decides: odds of 55 to 1."""

_AGAINST_THE_USUAL = 8.0
"""The same for taking an angle, most of which are those of loads on ropes, for a linear swing: 3000 to 1."""

_ALIKE = 0.5
"""A mode of at least so much of another one's amplitude may be that of the load."""

_NEARLY_ALL, _HARDLY_MORE = 0.98, 1.25
"""Friction acts within a swing too, which no amplitude shows: in a record with little noise that is seen."""

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
    falling : FallingFit or None
        With one that friction or drag ends, where that explains the record better than what else there is.
    """

    single: Fit
    double: Fit | None
    falling: FallingFit | None = None

    @property
    def fit(self) -> Fit:
        """The fit with as many modes as there are."""
        return self.falling or self.double or self.single


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
    best = max(evidence(each.fit) for each in all_of_them)
    usual = record.quantity is Quantity.angle and first_angle_rad(swung[0].fit) < LARGEST_SWING_RAD
    left = [
        each
        for each in all_of_them
        if evidence(each.fit) > best - (_AGAINST_THE_USUAL if usual and each is not linear else DECISIVE)
    ]
    likelier = evidence(left[0].fit) > evidence(linear.fit)
    taken = linear if linear in left and not usual and not likelier else left[0]
    return taken, tuple(each for each in left if each is not taken)


def _swung(linear: Hypothesis, waveform: Waveform, modes: int | None) -> list[Hypothesis]:
    """Fit a load on a rope, the likeliest first; of two modes of like size either may be it."""
    single = bent(linear.single.model, linear.single.parameters, waveform)
    first = _hypothesis(single, modes)
    if first.double is None or linear.double is None or first.falling is not None:
        return [first]
    # Fits of one mode may lead to another optimum than those of two.
    double, size = linear.double, [linear.double.amplitude(index) for index in range(2)]
    near = [
        Hypothesis(single, bent(double.model, _led_by(double, index), waveform))
        for index in range(2)
        if size[index] >= _ALIKE * size[1 - index]
    ]
    return sorted([first, *near], key=lambda each: -evidence(each.fit))


def _led_by(double: Fit, index: int) -> FloatArray:
    """Give the parameters with one of the modes in front."""
    count = 2 * PER_MODE
    return np.concatenate([np.roll(double.parameters[:count], -PER_MODE * index), double.parameters[count:]])


def _hypothesis(single: Fit, modes: int | None) -> Hypothesis:
    """Fit as many modes as there are; what seems to be two beside each other may be one with friction."""
    double = None if modes == 1 else second_mode(single, certain=modes is not None)
    if modes != 1 and (modes is not None or double is None or not may_be_an_envelope(double)):
        return Hypothesis(single, double)
    falling = falling_fit(single)
    if double is None:
        is_taken = evidence(falling) > evidence(single) + DECISIVE
    else:
        is_taken = evidence(falling) > evidence(double) or _explains_all(single, double, falling)
    return Hypothesis(single, double, falling if is_taken else None)


def _explains_all(single: Fit, double: Fit, falling: FallingFit) -> bool:
    """Whether a falling amplitude explains what a second mode does, but for what averaging leaves of it."""
    gained, of = single.squares - falling.squares, single.squares - double.squares
    return gained > _NEARLY_ALL * of and falling.squares < _HARDLY_MORE * double.squares


def evidence(found: Fit) -> float:
    """Give the log likelihood, less what more parameters gain by chance (Schwarz 1978)."""
    return log_likelihood(found) - 0.5 * found.parameter_count * float(np.log(found.model.time_s.size))


def log_likelihood(found: Fit) -> float:
    """Give the logarithm of the likelihood in white noise, but for a constant of the record."""
    return -0.5 * found.model.time_s.size * float(np.log(max(found.squares, _TINY)))
