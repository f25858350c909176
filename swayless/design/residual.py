"""What impulses leave swinging: residual vibration over frequency and damping, in both definitions in use.

Not for: bands and maxima (`robustness`), nor for how a shaper is found (`families`).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.shaper import FloatArray, Impulses
from swayless.errors import DesignError

NEGLIGIBLE_AMPLITUDE = 1e-6
"""Impulses smaller than this do not count as the last one, at which the vibration is measured."""

_LARGEST_EXPONENT = 300.0  # exp(300) squared is finite: a ratio of 1e130 saturates instead of overflowing
_BLOCK_ELEMENTS = 1 << 15  # impulses times frequencies worked on at once: 256 KiB an array, inside the cache


def residual_vibration(
    impulses: Impulses, frequency_hz: ArrayLike, *, damping_ratio: ArrayLike = 0.0
) -> FloatArray:
    """Residual vibration: amplitude as the last impulse acts, against that after one impulse of size 1.

    V = exp(-z w t_n) |sum A_i exp(z w t_i + j w sqrt(1 - z^2) t_i)|, with w = 2 pi f, z the damping ratio
    and t_n the time of the last impulse of at least `NEGLIGIBLE_AMPLITUDE`.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or anything else with times and amplitudes.
    frequency_hz : array_like
        Undamped natural frequency, >= 0 and finite.
    damping_ratio : array_like
        0 <= damping_ratio < 1; broadcast against the frequency.

    Returns
    -------
    ndarray
        Ratio (1 is as much as without a shaper), of the shape of the broadcast. Always finite.

    Raises
    ------
    DesignError
        If a frequency or a damping ratio is out of range.

    References
    ----------
    Kriikku, Singer and Singhose (1997), eq 1.

    Examples
    --------
    A ZV shaper for 1 Hz holds 5 % only within about 3 % of its frequency:

    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> zv = design_shaper("zv", Mode(1.0))
    >>> residual_vibration(zv, [1.0, 1.03, 2.0]).round(4)
    array([0.    , 0.0471, 1.    ])
    """
    frequency, damping, shape = _broadcast(frequency_hz, damping_ratio)
    return _ratio(impulses, frequency, damping).reshape(shape)


def vibration_error(
    impulses: Impulses, frequency_hz: ArrayLike, *, damping_ratio: ArrayLike = 0.0
) -> FloatArray:
    """Residual vibration in Magee's sense: against one impulse of size 1 that acted at the shaper's time 0.

    exp(z w t_n) times `residual_vibration`: the decay during the shaper is not counted in its favour, so it
    may exceed 1 on a damped mode. Saturates near 1e130.

    Parameters
    ----------
    impulses, frequency_hz, damping_ratio
        As for `residual_vibration`.

    Returns
    -------
    ndarray
        Ratio, of the shape of the broadcast. Always finite.

    Raises
    ------
    DesignError
        If a frequency or a damping ratio is out of range.

    References
    ----------
    Magee and Book, eqs 24 and 25.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> zv = design_shaper("zv", Mode(1.0, 0.1))
    >>> float(vibration_error(zv, 2.0, damping_ratio=0.1)) > 1.0
    True
    """
    frequency, damping, shape = _broadcast(frequency_hz, damping_ratio)
    ratio = _ratio(impulses, frequency, damping)
    exponent = 2.0 * math.pi * _last_time_s(impulses) * damping * frequency
    return (ratio * np.exp(np.minimum(exponent, _LARGEST_EXPONENT))).reshape(shape)


def residual_vibration_and_slope(
    impulses: Impulses, frequency_hz: ArrayLike, *, damping_ratio: ArrayLike = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Residual vibration and its derivative with respect to frequency, for solvers.

    Parameters
    ----------
    impulses, frequency_hz, damping_ratio
        As for `residual_vibration`.

    Returns
    -------
    ratio : ndarray
        V, as `residual_vibration` gives it.
    slope_s : ndarray
        dV/df in 1/Hz. Where V is exactly 0 it has a corner, and 0 stands for the slope.

    Raises
    ------
    DesignError
        If a frequency or a damping ratio is out of range.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> ratio, slope_s = residual_vibration_and_slope(design_shaper("zv", Mode(1.0)), 1.5)
    >>> round(float(ratio), 12), round(float(slope_s), 9)  # |cos(pi f / 2)| at 1.5 Hz
    (0.707106781187, 1.110720735)
    """
    square, square_slope_s = squared_residual_and_slope(impulses, frequency_hz, damping_ratio=damping_ratio)
    ratio = np.sqrt(square)
    slope_s = np.zeros_like(ratio)
    np.divide(0.5 * square_slope_s, ratio, out=slope_s, where=ratio > 0.0)
    return ratio, slope_s


def squared_residual_and_slope(
    impulses: Impulses, frequency_hz: ArrayLike, *, damping_ratio: ArrayLike = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Square of the residual vibration and its derivative: smooth also at the zeros, where V has corners.

    Parameters
    ----------
    impulses, frequency_hz, damping_ratio
        As for `residual_vibration`.

    Returns
    -------
    square : ndarray
        V^2.
    slope_s : ndarray
        dV^2/df in 1/Hz.

    Raises
    ------
    DesignError
        If a frequency or a damping ratio is out of range.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> square, slope_s = squared_residual_and_slope(design_shaper("zv", Mode(1.0)), 1.5)
    >>> round(float(square), 12), round(float(slope_s), 9)  # cos(pi f / 2)^2 at 1.5 Hz
    (0.5, 1.570796327)
    """
    frequency, damping, shape = _broadcast(frequency_hz, damping_ratio)
    lag_s = impulses.times_s - _last_time_s(impulses)
    weights = np.array((impulses.amplitudes, impulses.amplitudes * lag_s))
    (real, real_lag), (imag, imag_lag) = _transform(weights, lag_s, frequency, damping)
    oscillation = np.sqrt(1.0 - damping**2)  # dG/dw = (z + j sqrt(1 - z^2)) sum A_i lag_i exp(...)
    growth = damping * (real * real_lag + imag * imag_lag)
    growth += oscillation * (imag * real_lag - real * imag_lag)
    square = real * real + imag * imag
    return square.reshape(shape), (4.0 * np.pi * growth).reshape(shape)


def residual_at(impulses: Impulses, damping_ratio: float) -> Callable[[float], tuple[float, float]]:
    """Make a function from one frequency, in Hz, to residual vibration and slope: for solvers.

    The same as `residual_vibration_and_slope`, in plain floats: for a handful of impulses ten times as fast
    where frequencies come one by one. Nothing is checked.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> ratio, slope_s = residual_at(design_shaper("zv", Mode(1.0)), 0.0)(1.5)
    >>> round(ratio, 12), round(slope_s, 9)
    (0.707106781187, 1.110720735)
    """
    last_s = _last_time_s(impulses)
    oscillation = math.sqrt(1.0 - damping_ratio**2)
    pairs = [
        (a, t - last_s) for a, t in zip(impulses.amplitudes.tolist(), impulses.times_s.tolist(), strict=True)
    ]

    def residual(frequency_hz: float) -> tuple[float, float]:
        angular = 2.0 * math.pi * frequency_hz
        real = imag = real_lag = imag_lag = 0.0
        for amplitude, lag_s in pairs:
            size = amplitude * math.exp(min(damping_ratio * angular * lag_s, _LARGEST_EXPONENT))
            phase = oscillation * angular * lag_s
            cosine, sine = size * math.cos(phase), size * math.sin(phase)
            real += cosine
            imag += sine
            real_lag += lag_s * cosine
            imag_lag += lag_s * sine
        ratio = math.hypot(real, imag)
        growth = real * (damping_ratio * real_lag - oscillation * imag_lag)
        growth += imag * (damping_ratio * imag_lag + oscillation * real_lag)
        return ratio, 2.0 * math.pi * growth / ratio if ratio else 0.0

    return residual


def _ratio(impulses: Impulses, frequency_hz: FloatArray, damping_ratio: FloatArray) -> FloatArray:
    """V on flat arrays."""
    lag_s = impulses.times_s - _last_time_s(impulses)
    (real,), (imag,) = _transform(impulses.amplitudes[np.newaxis], lag_s, frequency_hz, damping_ratio)
    magnitude: FloatArray = np.sqrt(real * real + imag * imag)
    return magnitude


def _transform(
    weights: FloatArray, lag_s: FloatArray, frequency_hz: FloatArray, damping_ratio: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Sum weights[k, i] exp((z + j sqrt(1 - z^2)) w lag_i) for every frequency: real and imaginary part."""
    decay = 2.0 * np.pi * frequency_hz * damping_ratio
    half_turn = np.pi * frequency_hz * np.sqrt(1.0 - damping_ratio**2)
    damped = bool(np.any(damping_ratio))
    real = np.empty((weights.shape[0], half_turn.size))
    imag = np.empty_like(real)
    step = max(1, _BLOCK_ELEMENTS // lag_s.size)
    for start in range(0, half_turn.size, step):
        block = slice(start, start + step)
        # One tangent of the half angle gives cosine and sine, three times as fast and to the same rounding.
        sine = np.tan(np.multiply.outer(lag_s, half_turn[block]))
        cosine = 2.0 / (1.0 + sine * sine)
        sine *= cosine
        cosine -= 1.0
        if damped:
            envelope = np.exp(np.minimum(np.multiply.outer(lag_s, decay[block]), _LARGEST_EXPONENT))
            cosine *= envelope
            sine *= envelope
        real[:, block], imag[:, block] = weights @ cosine, weights @ sine
    return real, imag


def _last_time_s(impulses: Impulses) -> float:
    """Time of the last impulse that counts, in seconds."""
    counting = np.flatnonzero(np.abs(impulses.amplitudes) >= NEGLIGIBLE_AMPLITUDE)
    return float(impulses.times_s[counting[-1]])


def _broadcast(
    frequency_hz: ArrayLike, damping_ratio: ArrayLike
) -> tuple[FloatArray, FloatArray, tuple[int, ...]]:
    """Check both, and return them flat (one damping ratio stays one) with the shape of the result."""
    frequency = np.asarray(frequency_hz, dtype=np.float64)
    damping = np.asarray(damping_ratio, dtype=np.float64)
    _check_range("frequency_hz", frequency, math.inf, "must be finite and >= 0")
    _check_range("damping_ratio", damping, 1.0, "must be at least 0 and below 1")
    if damping.size == 1 and damping.ndim <= frequency.ndim:
        return frequency.ravel(), damping.ravel(), frequency.shape
    frequency, damping = np.broadcast_arrays(frequency, damping)
    return frequency.ravel(), damping.ravel(), frequency.shape


def _check_range(name: str, values: FloatArray, above: float, allowed: str) -> None:
    """Refuse the first value outside 0 <= value < above."""
    inside = (values >= 0.0) & (values < above)
    if not inside.all():
        raise DesignError(f"{name} = {float(values[~inside].flat[0])!r}: {allowed}")
