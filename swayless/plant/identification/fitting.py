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

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swayless.plant.identification.record import FloatArray
from swayless.plant.identification.swing_model import (
    COSINE,
    DECAY,
    FREQUENCY,
    PER_MODE,
    SINE,
    SwingModel,
    solve,
)

_MOST_STEPS = 40
_STILL = 1e-11
"""A step is no step any more if it moves the phase, or the decay, over the whole record by less."""

_STILL_STD = 1e-4
"""Or by less than this part of a standard deviation."""

_FIRST_DAMPING, _LARGEST_DAMPING = 1e-4, 1e8
_MANY, _FEW = 20_000, 8_000
"""Of more samples some find the way to the optimum, all of them the optimum itself."""

_UNEVEN = (math.sqrt(5.0) - 1.0) / 2.0

_FASTEST_GROWTH = 4.0
"""Over the record, in the exponent: noise may make a swing seem to grow, but no free swing grows more."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A model with its best parameters.

    Parameters
    ----------
    model : SwingModel
    parameters : ndarray, shape (model.parameter_count,)
    residual : ndarray, shape (n,)
        Record less model.
    normal : ndarray, shape (model.parameter_count, model.parameter_count)
        J' J of the Jacobian J: Fisher's information for noise of variance 1.
    """

    model: SwingModel
    parameters: FloatArray
    residual: FloatArray
    normal: FloatArray

    @property
    def squares(self) -> float:
        """Sum of the squares of the residual."""
        return float(self.residual @ self.residual)

    @property
    def freedom(self) -> int:
        """Samples less parameters."""
        return self.residual.size - self.model.parameter_count

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
    residual: FloatArray
    squares: float
    normal: FloatArray
    gradient: FloatArray


def fit(model: SwingModel, value: FloatArray, start: FloatArray, *, held: tuple[int, ...] = ()) -> Fit:
    """Find the parameters of least squares.

    Parameters
    ----------
    model : SwingModel
        With fewer parameters than the record has samples.
    value : ndarray, shape (n,)
        The record.
    start : ndarray
        Parameters to start from; of the linear ones only a bent wave's count.
    held : tuple of int
        Parameters that stay as they are: frequencies or decays.
    """
    free = np.setdiff1d(np.arange(model.parameter_count), held)
    state, damping = _at(model, value, model.settle(start, value)[0]), _FIRST_DAMPING
    if value.size > _MANY:
        part, chosen = _part(model)
        near = _tried(model, value, fit(part, value[chosen], start, held=held).parameters)
        state = near if near is not None and near.squares < state.squares else state
    for _ in range(_MOST_STEPS):
        normal = state.normal[np.ix_(free, free)]
        step = np.zeros(model.parameter_count)
        while True:
            step[free] = solve(normal, state.gradient[free], damping)
            tried = _tried(model, value, state.parameters + step)
            if tried is not None and tried.squares <= state.squares:
                break
            damping *= 10.0
            if damping > _LARGEST_DAMPING:
                return Fit(model, state.parameters, state.residual, state.normal)
        done = _is_still(model, step, state)
        state, damping = tried, max(damping / 30.0, 1e-14)
        if done:
            break
    return Fit(model, state.parameters, state.residual, state.normal)


def best_fit(model: SwingModel, value: FloatArray, starts: Sequence[FloatArray]) -> Fit | None:
    """Fit from each of several starts and give the best; of many samples some say which one that is.

    Parameters
    ----------
    model, value
        As for `fit`.
    starts : sequence of ndarray
        None is found from none.
    """
    part, chosen = _part(model) if value.size > _MANY and len(starts) > 1 else (model, slice(None))
    fits = [fit(part, value[chosen], start) for start in starts]
    best = min(fits, key=lambda each: each.squares, default=None)
    return best if best is None or part is model else fit(model, value, best.parameters)


def _part(model: SwingModel) -> tuple[SwingModel, NDArray[np.int64]]:
    """Take some thousand samples with both ends of the record, at uneven steps: even ones would alias."""
    rank = np.arange(_FEW)
    chosen = ((rank + np.modf(_UNEVEN * rank)[0]) * (model.time_s.size - 1) / _FEW).astype(np.int64)
    chosen = np.append(chosen, model.time_s.size - 1)
    return replace(model, time_s=model.time_s[chosen], sampled_rad_s=model.highest_rad_s), chosen


def _at(model: SwingModel, value: FloatArray, parameters: FloatArray) -> _State:
    """Solve for the linear parameters, and linearise; those of a bent wave take steps like others."""
    if model.waveform is None:
        parameters, residual, jacobian = model.settle(parameters, value)
    else:
        predicted, jacobian = model.evaluate(parameters)
        residual = value - predicted
    normal, gradient = jacobian.T @ jacobian, jacobian.T @ residual
    return _State(parameters, residual, float(residual @ residual), normal, gradient)


def _tried(model: SwingModel, value: FloatArray, parameters: FloatArray) -> _State | None:
    """Go to parameters, and solve for the linear ones, if they are a swing's."""
    end_s = model.time_s[-1]
    frequency, decay = (parameters[which : PER_MODE * model.modes : PER_MODE] for which in (FREQUENCY, DECAY))
    swings = (frequency * end_s > np.pi) & (frequency <= model.highest_rad_s)
    swings &= (decay * end_s > -_FASTEST_GROWTH) & (decay < frequency)
    return _at(model, value, parameters) if swings.all() else None


def _is_still(model: SwingModel, step: FloatArray, state: _State) -> bool:
    """Whether frequency and decay no longer move."""
    nonlinear = [mode * PER_MODE + which for mode in range(model.modes) for which in (FREQUENCY, DECAY)]
    moved = np.abs(step[nonlinear])
    variance = state.squares / max(1, model.time_s.size - step.size)
    # Against the standard deviation of each parameter with the others known, which is not the larger one.
    weighed = moved * np.sqrt(np.diag(state.normal)[nonlinear])
    return bool(
        np.max(moved) * model.time_s[-1] < _STILL or np.max(weighed) <= _STILL_STD * np.sqrt(variance)
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
