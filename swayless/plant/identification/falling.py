"""A swing that friction or air drag ends: one frequency, an amplitude that does not fall exponentially.

The amplitude a obeys a' = -s a - c (dry friction, as far as it has not stopped) or a' = -s a - c a^2 (air
drag), each beside viscous damping s. With E = (1 - exp(-s t)) / s these are a = a0 exp(-s t) - c E,
and a = a0 exp(-s t) / (1 + c a0 E). Neither moves the frequency of small swings, to first order.

Not for: exponential decays (`fitting`).

References
----------
A. H. Nayfeh and D. T. Mook, *Nonlinear Oscillations* (1979), section 3.3 (damping by averaging).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from swayless.plant.identification.fitting import Fit
from swayless.plant.identification.record import FloatArray
from swayless.plant.identification.sums import inner_products, sum_of_squares
from swayless.plant.identification.swing_model import COSINE, DECAY, FREQUENCY, PER_MODE, SINE, SwingModel
from swayless.plant.identification.waveform import SLOWING

FRICTION, DRAG = 1, -1

_LAW = 3
"""Phase, viscous rate and further rate, before the linear parameters."""

_STEPS = 60
_STANDS = 1e-6
"""Part of the first amplitude below which nothing swings any more."""


class Fall(NamedTuple):
    """How an amplitude falls, in units of the first one: 1 (friction) or -1 (drag), and s and c in 1/s."""

    exponent: int
    viscous: float
    further: float

    def amplitude(self, time_s: FloatArray) -> FloatArray:
        """Give the amplitude, 1 at time 0.

        Examples
        --------
        >>> Fall(FRICTION, 0.0, 0.5).amplitude(np.array([0.0, 1.0, 4.0]))
        array([1. , 0.5, 0. ])
        """
        viscous = np.exp(-self.viscous * time_s)
        integral = time_s if self.viscous == 0.0 else -np.expm1(-self.viscous * time_s) / self.viscous
        if self.exponent == FRICTION:
            return np.asarray(np.maximum(0.0, viscous - self.further * integral))
        return np.asarray(viscous / (1.0 + self.further * integral))

    def rate(self, amplitude: FloatArray) -> FloatArray:
        """Give the decay in 1/s at amplitudes above 0."""
        return np.asarray(self.viscous + self.further * amplitude**-self.exponent)


@dataclass(frozen=True, eq=False)
class FallingFit(Fit):
    """A fit of one mode whose amplitude falls by another law; its decay is the viscous one.

    Parameters
    ----------
    model, parameters, squares, normal
        As of a `Fit`.
    fall : Fall
    """

    fall: Fall

    @property
    def parameter_count(self) -> int:
        """One more than the mode alone has."""
        return self.model.parameter_count + 1

    @cached_property
    def residual(self) -> FloatArray:
        """Record less fit, shape (n,)."""
        return self.model.samples.value - self.values(self.model.time_s)

    def envelope(self, time_s: FloatArray) -> FloatArray:
        """Amplitude of the mode, at times from the start of the record."""
        return self.amplitude(0) * self.fall.amplitude(time_s)

    def values(self, time_s: FloatArray) -> FloatArray:
        """Values of the fit, at times from the start of the record."""
        return _values(self.model.at(time_s), self.parameters, self.fall)

    def average_decay(self) -> tuple[float, float]:
        """Give the decay in 1/s, on the average over the energy of the record, and its standard deviation."""
        amplitude = self.fall.amplitude(self.model.time_s)
        moving = amplitude > _STANDS
        rate, weight = self.fall.rate(amplitude[moving]), amplitude[moving] ** 2
        mean = float(np.average(rate, weights=weight))
        return mean, float(np.sqrt(np.average((rate - mean) ** 2, weights=weight)))


def falling_fit(single: Fit) -> FallingFit:
    """Fit a mode that friction or air drag ends, whichever explains more.

    Parameters
    ----------
    single : Fit
        One mode, with its exponential decay.

    Examples
    --------
    >>> from swayless.plant.identification.order import single_mode
    >>> time_s = np.linspace(0.0, 40.0, 801)
    >>> found = falling_fit(single_mode(time_s, (1.0 - 0.02 * time_s) * np.cos(2.0 * time_s)))
    >>> round(found.fall.exponent), round(found.fall.further, 6), round(float(found.mode(0)[0]), 6)
    (1, 0.02, 2.0)
    """
    return min((_fitted(single, exponent) for exponent in (FRICTION, DRAG)), key=lambda each: each.squares)


def _fitted(single: Fit, exponent: int) -> FallingFit:
    """Fit one law; all numbers of the search are about 1: phases, logarithms and parts of the amplitude."""
    from scipy.optimize import least_squares

    model, end_s, size = single.model, single.model.duration_s, single.amplitude(0)
    harmonics = 1 if model.waveform is None else model.waveform.harmonics
    samples = model.samples.for_waves(float(single.mode(0)[FREQUENCY]), harmonics=harmonics)
    of_samples = SwingModel(samples, 1, model.drift_degree, model.waveform)

    def split(point: FloatArray) -> tuple[FloatArray, Fall]:
        fall = Fall(exponent, float(point[1]) / end_s, float(point[2]) / end_s)
        frequency = single.mode(0)[FREQUENCY] + point[0] / end_s
        return np.concatenate([[frequency, 0.0], size * point[_LAW:]]), fall

    def left(point: FloatArray) -> FloatArray:
        return (samples.left_sides(_values(of_samples, *split(point))) - samples.value) / size

    exponents = max(0.1, float(single.mode(0)[DECAY]) * end_s)
    start = np.concatenate([[0.0, exponents / 2.0, exponents / 2.0], single.parameters[COSINE:] / size])
    low = np.full(start.size, -np.inf)
    low[1:_LAW] = 0.0
    found = least_squares(left, start, bounds=(low, np.inf), xtol=1e-12, ftol=1e-12, max_nfev=_STEPS)
    parameters, fall = split(found.x)
    parameters[DECAY] = fall.viscous
    # What the search found, without the further rate: its covariance there is that of all together.
    to_natural = np.array([1.0 / end_s, 1.0 / end_s, *np.full(start.size - _LAW, size)])
    jacobian = np.asarray(found.jac, dtype=np.float64)
    covariance = np.linalg.pinv(inner_products(jacobian, jacobian))
    normal = np.linalg.pinv(np.delete(np.delete(covariance, 2, axis=0), 2, axis=1)) / np.outer(
        to_natural / size, to_natural / size
    )
    squares = samples.rest + size**2 * sum_of_squares(found.fun)
    return FallingFit(model, parameters, squares, normal, fall)


def _values(model: SwingModel, parameters: FloatArray, fall: Fall) -> FloatArray:
    """Give a swing whose amplitude falls, with the lag and the bend of a load on a rope."""
    mode, time_s, waveform = parameters[:PER_MODE], model.time_s, model.waveform
    frequency, amplitude = float(mode[FREQUENCY]), complex(mode[COSINE], -mode[SINE])
    falling = amplitude * fall.amplitude(time_s)
    drift = model.drift @ parameters[PER_MODE:]
    if waveform is None:
        return np.asarray((falling * np.exp(1j * frequency * time_s)).real + drift)
    scale = waveform.angle_per_value(frequency)
    slower = sum(part * (scale * np.abs(falling)) ** power for power, part in SLOWING)
    steps = np.diff(time_s, prepend=0.0) * (slower + np.concatenate([slower[:1], slower[:-1]])) / 2.0
    wave = falling * np.exp(1j * frequency * (time_s - np.cumsum(steps)))
    return np.asarray(waveform.weigh(wave, scale)[0] + drift)
