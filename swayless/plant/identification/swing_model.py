"""The model of a free swing: decaying modes, offset and drift, with its exact Jacobian.

Parameters stand in one array: for each mode its (damped) angular frequency, its decay, and the cosine and
sine amplitudes at time 0; then the coefficients of the drift, a polynomial.

Not for: finding the parameters.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from swayless.plant.identification.record import FloatArray
from swayless.plant.identification.samples import Samples
from swayless.plant.identification.sums import inner_products
from swayless.plant.identification.waveform import Waveform, lag_s

PER_MODE = 4
FREQUENCY, DECAY, COSINE, SINE = range(PER_MODE)


@dataclass(frozen=True, eq=False)
class SwingModel:
    """Modes, offset and drift for the samples of a record, or for the equations that stand for them.

    Parameters
    ----------
    samples : Samples
    modes : int
        How many.
    drift_degree : int
        Degree of the polynomial; 1 for an offset and a straight drift.
    waveform : Waveform or None
        What large swings do to the first mode; None for a linear one.
    """

    samples: Samples
    modes: int = 1
    drift_degree: int = 1
    waveform: Waveform | None = None

    @property
    def time_s(self) -> FloatArray:
        """Where the model has its values, from 0 on."""
        return self.samples.time_s

    @property
    def duration_s(self) -> float:
        """Of the record."""
        return self.samples.duration_s

    @property
    def parameter_count(self) -> int:
        """How many parameters there are."""
        return PER_MODE * self.modes + self.drift_degree + 1

    @cached_property
    def drift(self) -> FloatArray:
        """Legendre polynomials over the record, shape (n, drift_degree + 1)."""
        inside = 2.0 * self.time_s / self.duration_s - 1.0
        return np.asarray(np.polynomial.legendre.legvander(inside, self.drift_degree))

    def at(self, time_s: FloatArray) -> SwingModel:
        """Give the model at other times, for its values there."""
        return replace(self, samples=replace(self.samples, time_s=time_s))

    def evaluate(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the model's values, shape (n,), and their derivatives, shape (n, parameter_count)."""
        jacobian = np.empty((self.time_s.size, self.parameter_count), order="F")
        jacobian[:, PER_MODE * self.modes :] = self.drift
        for mode in range(self.modes):
            columns = slice(PER_MODE * mode, PER_MODE * (mode + 1))
            if mode > 0 or self.waveform is None:
                wave = _wave(self.time_s, parameters[columns])
                jacobian[:, columns][:, COSINE], jacobian[:, columns][:, SINE] = wave.real, wave.imag
        return self._weigh(parameters, jacobian), jacobian

    def settle(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Solve for the linear parameters, amplitudes and drift: variable projection.

        Of a bent wave the lag and the bend are those of the amplitudes given.

        Returns
        -------
        parameters, residual, jacobian : ndarray
            There: all parameters, what they leave of the samples or equations, and the derivatives of those.
        """
        predicted, jacobian = self.evaluate(parameters)
        linear = np.ones(self.parameter_count, dtype=bool)
        for nonlinear in (FREQUENCY, DECAY):
            linear[nonlinear : PER_MODE * self.modes : PER_MODE] = False
        columns = self.samples.left_sides(jacobian[:, linear])
        settled = parameters.copy()
        right = inner_products(columns, self._left(predicted))
        settled[linear] += solve(inner_products(columns, columns), right)
        residual = self._left(self._weigh(settled, jacobian))
        of_equations = np.empty_like(jacobian)
        of_equations[:, linear], of_equations[:, ~linear] = (
            columns,
            self.samples.left_sides(jacobian[:, ~linear]),
        )
        return settled, residual, of_equations

    def linearise(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what the model leaves of the samples or equations, and the derivatives of those."""
        predicted, jacobian = self.evaluate(parameters)
        return self._left(predicted), self.samples.left_sides(jacobian)

    def _left(self, predicted: FloatArray) -> FloatArray:
        return self.samples.value - self.samples.left_sides(predicted)

    def _weigh(self, parameters: FloatArray, jacobian: FloatArray) -> FloatArray:
        """Give the values for amplitudes, and fill in the derivatives that depend on them."""
        first = PER_MODE * self.modes
        value = self.drift @ parameters[first:]
        for mode in range(self.modes):
            columns = slice(PER_MODE * mode, PER_MODE * (mode + 1))
            bent = mode == 0 and self.waveform is not None
            weigh = self._weigh_bent if bent else self._weigh_linear
            value += weigh(parameters[columns], jacobian[:, columns])
        return value

    def _weigh_linear(self, mode: FloatArray, jacobian: FloatArray) -> FloatArray:
        """Weigh the cosine and sine waves that stand in the Jacobian."""
        cosine, sine = jacobian[:, COSINE], jacobian[:, SINE]
        value = mode[COSINE] * cosine + mode[SINE] * sine
        jacobian[:, FREQUENCY] = self.time_s * (mode[SINE] * cosine - mode[COSINE] * sine)
        jacobian[:, DECAY] = -self.time_s * value
        return np.asarray(value)

    def _weigh_bent(self, mode: FloatArray, jacobian: FloatArray) -> FloatArray:
        """Give the values of a load that swings far, and fill in their derivatives (see `waveform`)."""
        waveform, time_s = self.waveform, self.time_s
        assert waveform is not None  # noqa: S101 - for the type checker
        amplitude, frequency = complex(mode[COSINE], -mode[SINE]), float(mode[FREQUENCY])
        scale = waveform.angle_per_value(frequency)
        of_scale = waveform.angle_exponent / frequency
        lag, lag_by_decay, lag_by_log = lag_s(time_s, float(mode[DECAY]), scale * abs(amplitude))
        wave = amplitude * _wave(time_s, mode, lag)
        value, turned, grown, scaled = waveform.weigh(wave, scale)
        slip = frequency * lag_by_log
        # Derivatives of the logarithm of the wave, its size and its phase; an amplitude acts on the lag too.
        inward, across = (1.0 / amplitude), (-1j / amplitude)
        logarithms: dict[int, tuple[FloatArray | float, FloatArray]] = {
            FREQUENCY: (0.0, time_s - lag - of_scale * slip),
            DECAY: (-time_s, -frequency * lag_by_decay),
            COSINE: (inward.real, inward.imag - inward.real * slip),
            SINE: (across.real, across.imag - across.real * slip),
        }
        for column, (size, phase) in logarithms.items():
            jacobian[:, column] = (turned.real + grown) * size - turned.imag * phase
        jacobian[:, FREQUENCY] += of_scale * scaled
        return value


def _wave(time_s: FloatArray, mode: FloatArray, lag: FloatArray | float = 0.0) -> NDArray[np.complex128]:
    """Give exp(-decay t) exp(j frequency (t - lag))."""
    phase = mode[FREQUENCY] * (time_s - lag)
    wave = np.empty(time_s.size, dtype=np.complex128)
    wave.real, wave.imag = np.cos(phase), np.sin(phase)
    return np.asarray(wave * np.exp(-mode[DECAY] * time_s))


def solve(normal: FloatArray, right: FloatArray, damping: float = 0.0) -> FloatArray:
    """Solve normal equations, scaled to a diagonal of ones; directions that the data do not show stay put."""
    size = np.sqrt(np.diag(normal))
    size[size == 0.0] = 1.0
    scaled = normal / np.outer(size, size) + damping * np.eye(size.size)
    return np.asarray(np.linalg.lstsq(scaled, right / size, rcond=1e-14)[0] / size)
