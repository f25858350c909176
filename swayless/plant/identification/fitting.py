"""Least squares for the model of a swing: Gauss and Newton's steps, shortened after Levenberg and Marquardt.

In white noise the least squares are the maximum of the likelihood. After each step the linear parameters are
solved for (variable projection), so the steps are those of frequency and decay alone.

Not for: where to start, or what the noise is like.

References
----------
G. Golub and V. Pereyra, "Separable nonlinear least squares: the variable projection method and its
applications", *Inverse Problems* 19 (2003), R1-R26, section 3; the Jacobian after Kaufman (1975).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from swayless.plant.identification.record import FloatArray
from swayless.plant.identification.sums import inner_products, sum_of_squares
from swayless.plant.identification.swing_model import (
    COSINE,
    DECAY,
    FREQUENCY,
    PER_MODE,
    SINE,
    SwingModel,
    solve,
)

_MOST_STEPS = 80
_STILL = 1e-11
"""A step is no step any more if it moves the phase, or the decay, over the whole record by less."""

_STILL_STD = 1e-4
"""Or by less than this part of a standard deviation."""

_FIRST_DAMPING, _LARGEST_DAMPING = 1e-4, 1e8
_ROOM = 1.25
"""How far a fit may go from where it starts, in frequency."""

_FASTEST_GROWTH = 4.0
"""Over the record, in the exponent: noise may make a swing seem to grow, but no free swing grows more."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A model with its best parameters.

    Parameters
    ----------
    model : SwingModel
        For the samples of a record.
    parameters : ndarray, shape (model.parameter_count,)
    squares : float
        Sum of the squares of the residual.
    normal : ndarray, shape (model.parameter_count, model.parameter_count)
        J' J of the Jacobian J: Fisher's information for noise of variance 1.
    """

    model: SwingModel
    parameters: FloatArray
    squares: float
    normal: FloatArray

    @cached_property
    def residual(self) -> FloatArray:
        """Record less model, shape (n,)."""
        return self.model.samples.value - self.values(self.model.time_s)

    @property
    def parameter_count(self) -> int:
        """How many parameters were fitted."""
        return self.model.parameter_count

    @property
    def freedom(self) -> int:
        """Samples less parameters."""
        return self.model.time_s.size - self.parameter_count

    @property
    def variance(self) -> float:
        """Variance of the noise, were it white."""
        return self.squares / self.freedom

    def mode(self, index: int) -> FloatArray:
        """Parameters of one mode: frequency and decay in rad/s, cosine and sine amplitude."""
        return self.parameters[PER_MODE * index : PER_MODE * (index + 1)]

    def amplitude(self, index: int) -> float:
        """Amplitude of one mode at the start of the record."""
        mode = self.mode(index)
        return float(np.hypot(mode[COSINE], mode[SINE]))

    def envelope(self, time_s: FloatArray) -> FloatArray:
        """Amplitude of the first mode, at times from the start of the record."""
        return np.asarray(self.amplitude(0) * np.exp(-self.mode(0)[DECAY] * time_s))

    def values(self, time_s: FloatArray) -> FloatArray:
        """Values of the fit, at times from the start of the record."""
        return self.model.at(time_s).evaluate(self.parameters)[0]

    def covariance(self) -> FloatArray:
        """Covariance of all parameters, for noise of variance 1."""
        size = np.sqrt(np.diag(self.normal))
        size[size == 0.0] = 1.0
        return np.asarray(
            np.linalg.pinv(self.normal / np.outer(size, size), hermitian=True) / np.outer(size, size)
        )


class _State(NamedTuple):
    """Where a fit is: parameters, what they leave, and the normal equations there."""

    parameters: FloatArray
    squares: float
    normal: FloatArray
    gradient: FloatArray


def fit(model: SwingModel, start: FloatArray, *, held: tuple[int, ...] = ()) -> Fit:
    """Find the parameters of least squares.

    Parameters
    ----------
    model : SwingModel
        With fewer parameters than the record has samples.
    start : ndarray
        Parameters to start from; of the linear ones only a bent wave's count.
    held : tuple of int
        Parameters that stay as they are: frequencies or decays.
    """
    fewer = _with_fewer_equations(model, start)
    free = np.setdiff1d(np.arange(model.parameter_count), held)
    state, damping = _at(fewer, fewer.settle(start)[0]), _FIRST_DAMPING
    for _ in range(_MOST_STEPS):
        step = np.zeros(model.parameter_count)
        step[free] = solve(state.normal[np.ix_(free, free)], state.gradient[free], damping)
        tried, still = _tried(fewer, state.parameters + step), _is_still(model, step, state)
        if tried is not None and tried.squares <= state.squares:
            state, damping = tried, max(damping / 30.0, 1e-14)
        else:
            # At the optimum rounding decides whether a step gains; elsewhere a shorter one does.
            still = still and damping < 1.0
            damping *= 10.0
        if still or damping > _LARGEST_DAMPING:
            break
    return Fit(model, state.parameters, state.squares, state.normal)


def best_fit(model: SwingModel, starts: Iterable[FloatArray]) -> Fit | None:
    """Fit from each of several starts and give the best; None from none."""
    return min((fit(model, start) for start in starts), key=lambda each: each.squares, default=None)


def _with_fewer_equations(model: SwingModel, start: FloatArray) -> SwingModel:
    """Let as few equations stand for the samples as the waves allow."""
    fastest = float(np.max(start[FREQUENCY : PER_MODE * model.modes : PER_MODE]))
    harmonics = 1 if model.waveform is None else model.waveform.harmonics
    samples = model.samples.for_waves(_ROOM * fastest, harmonics=harmonics)
    return model if samples is model.samples else replace(model, samples=samples)


def _at(model: SwingModel, parameters: FloatArray) -> _State:
    """Solve for the linear parameters, and linearise; those of a bent wave take steps like others."""
    if model.waveform is None:
        parameters, residual, jacobian = model.settle(parameters)
    else:
        residual, jacobian = model.linearise(parameters)
    squares = model.samples.rest + sum_of_squares(residual)
    normal, gradient = inner_products(jacobian, jacobian), inner_products(jacobian, residual)
    return _State(parameters, squares, normal, gradient)


def _tried(model: SwingModel, parameters: FloatArray) -> _State | None:
    """Go to parameters, and solve for the linear ones, if they are a swing's."""
    end_s = model.duration_s
    frequency, decay = (parameters[which : PER_MODE * model.modes : PER_MODE] for which in (FREQUENCY, DECAY))
    swings = (frequency * end_s > np.pi) & (frequency <= model.samples.highest_rad_s)
    swings &= (decay * end_s > -_FASTEST_GROWTH) & (decay < frequency)
    return _at(model, parameters) if swings.all() else None


def _is_still(model: SwingModel, step: FloatArray, state: _State) -> bool:
    """Whether frequency and decay no longer move."""
    nonlinear = [mode * PER_MODE + which for mode in range(model.modes) for which in (FREQUENCY, DECAY)]
    moved = np.abs(step[nonlinear])
    variance = state.squares / max(1, model.time_s.size - step.size)
    # Against the standard deviation of each parameter with the others known, which is not the larger one.
    weighed = moved * np.sqrt(np.diag(state.normal)[nonlinear])
    return bool(
        np.max(moved) * model.duration_s < _STILL or np.max(weighed) <= _STILL_STD * np.sqrt(variance)
    )


def with_parameters(model: SwingModel, *modes: tuple[float, float]) -> FloatArray:
    """Give parameters with frequencies and decays, the linear ones 0."""
    parameters = np.zeros(model.parameter_count)
    for index, (frequency_rad_s, decay_rad_s) in enumerate(modes):
        parameters[PER_MODE * index + FREQUENCY] = frequency_rad_s
        parameters[PER_MODE * index + DECAY] = decay_rad_s
    return parameters


def with_drift(fit_: Fit, degree: int) -> tuple[SwingModel, FloatArray]:
    """Give the model of a fit with a drift of another degree, and the parameters to start from."""
    first = PER_MODE * fit_.model.modes
    model = replace(fit_.model, drift_degree=degree)
    kept = fit_.parameters[: first + degree + 1]
    return model, np.concatenate([kept, np.zeros(model.parameter_count - kept.size)])
