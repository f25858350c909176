"""Residual vibration in both definitions, against the sums written out and against each other."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import (
    design_shaper,
    residual_vibration,
    residual_vibration_and_slope,
    vibration_error,
)
from swayless.design.residual import residual_at
from swayless.errors import DesignError
from swayless.plant import Mode

SETTINGS = settings(derandomize=True, deadline=None, max_examples=50)


@st.composite
def impulses(draw):
    """Up to six impulses within 3 s, of either sign, that sum to 1."""
    gaps_s = draw(st.lists(st.floats(0.01, 0.5), min_size=1, max_size=5))
    amplitudes = np.array(draw(st.lists(st.floats(-1.0, 1.0), min_size=len(gaps_s), max_size=len(gaps_s))))
    amplitudes = np.append(amplitudes, 1.0 - amplitudes.sum())
    amplitudes[-1] = amplitudes[-1] or 1.0
    return SimpleNamespace(times_s=np.concatenate([[0.0], np.cumsum(gaps_s)]), amplitudes=amplitudes)


def kriikku_equation_1(shape, frequency_hz, damping_ratio):
    """V as printed, one frequency at a time, in plain floats."""
    angular = 2.0 * math.pi * frequency_hz
    turn = angular * math.sqrt(1.0 - damping_ratio**2)
    pairs = list(zip(shape.amplitudes.tolist(), shape.times_s.tolist(), strict=True))
    last_s = [time_s for amplitude, time_s in pairs if abs(amplitude) >= 1e-6][-1]
    cosines = sum(a * math.exp(damping_ratio * angular * t) * math.cos(turn * t) for a, t in pairs)
    sines = sum(a * math.exp(damping_ratio * angular * t) * math.sin(turn * t) for a, t in pairs)
    return math.exp(-damping_ratio * angular * last_s) * math.hypot(cosines, sines)


@SETTINGS
@given(shape=impulses(), frequency_hz=st.floats(0.0, 20.0), damping_ratio=st.floats(0.0, 0.9))
def test_residual_vibration_is_kriikku_eq_1_as_printed(shape, frequency_hz, damping_ratio):
    ratio = residual_vibration(shape, frequency_hz, damping_ratio=damping_ratio)
    # Phases up to 400 rad are right to 1e-13, and the exponentials to as much.
    assert float(ratio) == pytest.approx(
        kriikku_equation_1(shape, frequency_hz, damping_ratio), rel=1e-11, abs=1e-12
    )


@SETTINGS
@given(shape=impulses(), frequency_hz=st.floats(0.0, 20.0), damping_ratio=st.floats(0.0, 0.9))
def test_vibration_error_is_residual_vibration_without_the_decay_during_the_shaper(
    shape, frequency_hz, damping_ratio
):
    last_s = shape.times_s[np.abs(shape.amplitudes) >= 1e-6][-1]
    growth = math.exp(min(300.0, 2.0 * math.pi * damping_ratio * frequency_hz * last_s))
    ratio = float(residual_vibration(shape, frequency_hz, damping_ratio=damping_ratio))
    error = float(vibration_error(shape, frequency_hz, damping_ratio=damping_ratio))
    assert error == pytest.approx(growth * ratio, rel=1e-13)


@SETTINGS
@given(shape=impulses(), frequency_hz=st.floats(0.01, 20.0), damping_ratio=st.floats(0.0, 0.9))
def test_the_slope_is_the_derivative_of_the_square_over_frequency(shape, frequency_hz, damping_ratio):
    step_hz = 1e-5
    ratio, slope_s = residual_vibration_and_slope(shape, frequency_hz, damping_ratio=damping_ratio)
    around = residual_vibration(
        shape, [frequency_hz - step_hz, frequency_hz + step_hz], damping_ratio=damping_ratio
    )
    difference = float(np.diff(around**2)[0]) / (2.0 * step_hz)
    # Central difference: (2 pi 3 s)^3 step^2 of V^2 <= 36, plus rounding 1e-16 / step.
    assert 2.0 * float(ratio * slope_s) == pytest.approx(difference, abs=1e-4)


@SETTINGS
@given(shape=impulses(), frequency_hz=st.floats(0.0, 20.0), damping_ratio=st.floats(0.0, 0.9))
def test_the_plain_float_form_agrees_with_the_array_form(shape, frequency_hz, damping_ratio):
    ratio, slope_s = residual_at(shape, damping_ratio)(frequency_hz)
    ratios, slopes_s = residual_vibration_and_slope(shape, frequency_hz, damping_ratio=damping_ratio)
    assert ratio == pytest.approx(float(ratios), rel=1e-9, abs=1e-13)
    assert slope_s * ratio == pytest.approx(float(slopes_s * ratios), rel=1e-9, abs=1e-11)


def test_frequencies_and_damping_ratios_broadcast_and_long_inputs_are_worked_on_in_blocks():
    shaper = design_shaper("ei3", Mode(1.0, 0.1))
    frequency_hz, damping_ratio = np.linspace(0.0, 3.0, 20_001), np.array([0.0, 0.1, 0.3])
    table = residual_vibration(shaper, frequency_hz[:, np.newaxis], damping_ratio=damping_ratio)
    assert table.shape == (20_001, 3)
    for place in (0, 6_553, 6_554, 13_107, 20_000):  # ends, and both sides of block borders
        for column, damping in enumerate(damping_ratio):
            expected = kriikku_equation_1(shaper, frequency_hz[place], damping)
            assert table[place, column] == pytest.approx(expected, abs=1e-14)


def test_one_frequency_gives_an_array_without_axes():
    assert residual_vibration(design_shaper("zv", Mode(1.0)), 1.2).shape == ()
    assert residual_vibration(design_shaper("zv", Mode(1.0)), 1.2, damping_ratio=[0.1]).shape == (1,)


def test_no_frequencies_give_no_values():
    assert residual_vibration(design_shaper("zv", Mode(1.0)), []).shape == (0,)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.5, 0.99])
def test_values_stay_finite_at_extreme_frequencies(damping_ratio):
    shape = SimpleNamespace(times_s=np.array([0.0, 1.0, 2.0]), amplitudes=np.array([0.5, 0.5 - 1e-9, 1e-9]))
    frequency_hz = np.geomspace(1e-12, 1e9, 50)
    for function in (residual_vibration, vibration_error):
        assert np.isfinite(function(shape, frequency_hz, damping_ratio=damping_ratio)).all()
    ratio, slope_s = residual_vibration_and_slope(shape, frequency_hz, damping_ratio=damping_ratio)
    assert np.isfinite(ratio).all()
    assert np.isfinite(slope_s).all()


def test_an_impulse_below_a_millionth_does_not_move_the_instant_of_reading():
    with_speck = SimpleNamespace(times_s=np.array([0.0, 1.0, 5.0]), amplitudes=np.array([0.5, 0.5, 9e-7]))
    without = SimpleNamespace(times_s=np.array([0.0, 1.0]), amplitudes=np.array([0.5, 0.5]))
    ratios = [float(residual_vibration(each, 0.3, damping_ratio=0.2)) for each in (with_speck, without)]
    # The speck itself weighs 9e-7 exp(0.2 * 2 pi * 0.3 * 4) = 4e-6.
    assert ratios[0] == pytest.approx(ratios[1], abs=5e-6)


@pytest.mark.parametrize("frequency_hz", [-0.1, math.inf, math.nan])
def test_frequencies_out_of_range_are_refused(frequency_hz):
    with pytest.raises(DesignError, match=r"frequency_hz = .*: must be finite and >= 0"):
        residual_vibration(design_shaper("zv", Mode(1.0)), [0.5, frequency_hz])


@pytest.mark.parametrize("damping_ratio", [-0.1, 1.0, math.nan])
def test_damping_ratios_out_of_range_are_refused(damping_ratio):
    with pytest.raises(DesignError, match=r"damping_ratio = .*: must be at least 0 and below 1"):
        vibration_error(design_shaper("zv", Mode(1.0)), 0.5, damping_ratio=damping_ratio)
