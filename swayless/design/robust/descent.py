"""Switch times that leave little, by descent from many starts at once: where `unity` starts from.

Impulses +1, -1, ..., +1 are not a convex program: each start leads to the local optimum of its valley. All
starts move together, as one array. Not for: exact optima, which `stationary` finds from here.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swayless.design.minimax.response import ComplexArray, IndexArray
from swayless.design.shaper import FloatArray

_POWERS = (6.0, 24.0, 96.0)  # of the norm: the last is within 5 % of the worst of a hundred frequencies
_STEPS = 12  # of Newton's method for each of them
_FURTHER = 6  # steps for trials that are near their optimum
_TO_MEETING = 0.7  # share of the way to the next impulse that one step may go
_LONGEST = 0.08  # first radius of steps, in periods of the highest frequency
_FLATTEST = 1e-3  # least curvature that is reckoned with, relative to the largest
_NOTHING = 1e-30  # stands for a vibration of exactly 0, of which there is no logarithm


@dataclass(frozen=True, eq=False)
class Trials:
    """Many sequences of switch times, each with the frequencies at which it is judged.

    Parameters
    ----------
    times : ndarray, shape (b, n)
        In durations: rising from 0 to 1; n is odd.
    frequency : ndarray, shape (b, k)
        Where the residual vibration of each is sampled, in cycles per duration.
    turn : ndarray of complex, shape (k,)
        `Line.turn` of the frequencies.
    """

    times: FloatArray
    frequency: FloatArray
    turn: ComplexArray

    def chosen(self, which: NDArray[np.bool_] | IndexArray) -> Trials:
        """Keep some of them, or put them in another order."""
        return replace(self, times=self.times[which], frequency=self.frequency[which])

    def terms(self) -> tuple[ComplexArray, ComplexArray]:
        """Rates frequency x turn, and what each impulse leaves at each of them, shape (b, k, n)."""
        rate: ComplexArray = self.frequency * self.turn
        lag = self.times - 1.0
        terms: ComplexArray = np.exp(rate[:, :, np.newaxis] * lag[:, np.newaxis])
        return rate, terms * alternating(lag.shape[1]).astype(np.complex128)

    def logarithms(self) -> FloatArray:
        """Logarithm of the residual vibration at each frequency, shape (b, k)."""
        size = np.abs(self.terms()[1].sum(axis=2))
        logarithms: FloatArray = np.log(np.maximum(size, _NOTHING))
        return logarithms

    def worst(self) -> FloatArray:
        """Largest sampled residual vibration of each, shape (b,)."""
        largest: FloatArray = np.exp(self.logarithms().max(axis=1))
        return largest

    def sensitivity(self, change: FloatArray) -> FloatArray:
        """Differentiate the logarithm of the worst, shape (b,), if the frequencies change at rates (b, k).

        The derivative is that of the norm which the descent has made least: of all peaks, in their shares.
        """
        _, terms = self.terms()
        value, weight = _weights(terms, _POWERS[-1])
        climb = ((terms * (self.times - 1.0)[:, np.newaxis]).sum(axis=2) * self.turn / value).real
        slope: FloatArray = (weight * climb * change).sum(axis=1)
        return slope


def alternating(count: int) -> FloatArray:
    """Amplitudes +1, -1, +1, ..."""
    return 1.0 - 2.0 * np.asarray(np.arange(count) % 2, dtype=np.float64)


def descended(trials: Trials, *, again: bool = False) -> Trials:
    """Let the inner impulses of all trials move until the worst residual of each is nearly least.

    What is minimised is a norm of the residual vibration over the frequencies, of rising power (the last
    two, if again), by Newton's method; where it curves downwards, the step goes down the slope all the same.
    """
    for power in _POWERS[-2:] if again else _POWERS:
        radius = _LONGEST / trials.frequency.max(axis=1)
        value = _norm(trials.logarithms(), power)
        for _ in range(_FURTHER if again else _STEPS):
            tried = replace(trials, times=_stepped(trials, power, radius))
            after = _norm(tried.logarithms(), power)
            better = after < value
            trials = replace(trials, times=np.where(better[:, np.newaxis], tried.times, trials.times))
            value = np.where(better, after, value)
            radius = radius * np.where(better, 2.0, 0.2)
    return trials


def _norm(logarithms: FloatArray, power: float) -> FloatArray:
    """Logarithm of the norm of each row."""
    top = logarithms.max(axis=1, keepdims=True)
    norm: FloatArray = top[:, 0] + np.log(np.exp(power * (logarithms - top)).sum(axis=1)) / power
    return norm


def _weights(terms: ComplexArray, power: float) -> tuple[ComplexArray, FloatArray]:
    """Residual vibration at each frequency, never 0, and its share of the norm."""
    value = terms.sum(axis=2)
    value[np.abs(value) < _NOTHING] = _NOTHING
    logarithm = np.log(np.abs(value))
    weight = np.exp(power * (logarithm - logarithm.max(axis=1, keepdims=True)))
    return value, weight / weight.sum(axis=1, keepdims=True)


def _stepped(trials: Trials, power: float, radius: FloatArray) -> FloatArray:
    """Take one step of Newton's method, none longer than the radius, none past a neighbour."""
    slope, curvature = _derivatives(trials, power)
    size, axes = np.linalg.eigh(curvature)
    size = np.abs(size)
    size = np.maximum(size, _FLATTEST * size.max(axis=1, keepdims=True) + _NOTHING)
    along = (axes.swapaxes(1, 2) @ slope[:, :, np.newaxis])[:, :, 0] / size
    step = np.zeros_like(trials.times)
    step[:, 1:-1] = -(axes @ along[:, :, np.newaxis])[:, :, 0]
    gap = np.maximum(np.diff(trials.times), _NOTHING)
    meeting = (-np.diff(step) / gap).max(axis=1) / _TO_MEETING
    longest = np.abs(step).max(axis=1) / radius
    stepped: FloatArray = trials.times + step / np.maximum(1.0, np.maximum(meeting, longest))[:, np.newaxis]
    return stepped


def _derivatives(trials: Trials, power: float) -> tuple[FloatArray, FloatArray]:
    """First and second derivatives of the norm in the times of the inner impulses.

    With G the vibration and L_i = (dG/dt_i) / G, those of log |G| are Re L_i, and Re(rate^2 term_i / G) on
    the diagonal less Re(L_i L_j).
    """
    rate, terms = trials.terms()
    value, weight = _weights(terms, power)
    climb = terms[:, :, 1:-1] * (rate / value)[:, :, np.newaxis]
    slope = (weight[:, np.newaxis] @ climb.real)[:, 0]
    bend = (weight[:, np.newaxis] @ (climb * rate[:, :, np.newaxis]).real)[:, 0]
    real, imaginary = (part * np.sqrt(weight)[:, :, np.newaxis] for part in (climb.real, climb.imag))
    curvature = (power - 1.0) * real.swapaxes(1, 2) @ real + imaginary.swapaxes(1, 2) @ imaginary
    curvature -= power * slope[:, :, np.newaxis] * slope[:, np.newaxis]
    inner = np.arange(slope.shape[1])
    curvature[:, inner, inner] += bend
    return slope, curvature
