"""Rhim and Book, adaptive command shaping: the optimal arbitrary time-delay filter, eqs 4-6."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import design_shaper, residual_vibration
from swayless.plant import Mode

SETTINGS = settings(derandomize=True, deadline=None, max_examples=100)
DELAYS = st.floats(0.02, 4.0).filter(lambda periods: abs(periods - round(periods)) > 0.01)


def transfer(shaper, s):
    """Laplace transform of the impulses."""
    return np.exp(-np.multiply.outer(s, shaper.times_s)) @ shaper.amplitudes


@pytest.mark.parametrize("damping_ratio", [0.0, 0.02, 0.2])
@pytest.mark.parametrize("delay_s", [0.025, 0.07, 0.31])
def test_eq_4_gives_the_three_impulses(delay_s, damping_ratio):
    mode = Mode(1.0 / 0.9, damping_ratio)
    shaper = design_shaper("oatf", mode, delay_s=delay_s)
    angular = mode.angular_frequency_rad_s
    decay = math.exp(-damping_ratio * angular * delay_s)
    cosine = math.cos(angular * math.sqrt(1.0 - damping_ratio**2) * delay_s)
    m = 1.0 - 2.0 * cosine * decay + decay**2
    assert shaper.times_s == pytest.approx([0.0, delay_s, 2.0 * delay_s], rel=1e-15)
    # Small delays divide by a small m, which carries the rounding of 1: 1e-16 / m.
    assert shaper.amplitudes == pytest.approx(
        [1.0 / m, -2.0 * cosine * decay / m, decay**2 / m], rel=1e-14 / m
    )


@SETTINGS
@given(periods=DELAYS, damping_ratio=st.floats(0.0, 0.3))
def test_eq_4_cancels_the_mode_for_any_delay(periods, damping_ratio):
    mode = Mode(16.0, damping_ratio)
    shaper = design_shaper("oatf", mode, delay_s=periods * mode.damped_period_s)
    residual = float(residual_vibration(shaper, 16.0, damping_ratio=damping_ratio))
    assert residual < 1e-14 * np.abs(shaper.amplitudes).sum()  # rounding of phases up to 50 rad


@SETTINGS
@given(periods=DELAYS, damping_ratio=st.floats(0.0, 0.3), n=st.integers(-5, 5), upper=st.booleans())
def test_eq_5_gives_the_zeros(periods, damping_ratio, n, upper):
    mode = Mode(1.0, damping_ratio)
    delay_s = periods * mode.damped_period_s
    shaper = design_shaper("oatf", mode, delay_s=delay_s)
    damped = 2.0 * math.pi / mode.damped_period_s
    turn = damped + 2.0 * math.pi * n / delay_s
    zero = complex(-damping_ratio * mode.angular_frequency_rad_s, turn if upper else -turn)
    size = np.abs(shaper.amplitudes * np.exp(-zero.real * shaper.times_s)).sum()
    assert abs(transfer(shaper, zero)) < 1e-13 * size  # phases up to 100 rad are right to 1e-14


def test_eq_6_on_a_whole_number_of_samples_is_the_same_filter():
    mode, sample_s, samples = Mode(16.0, 0.01), 0.001, 25  # the test bed: one mode near 16 Hz, 1 kHz, 25 ms
    shaper = design_shaper("oatf", mode, delay_s=samples * sample_s)
    coefficients = np.zeros(2 * samples + 1)
    coefficients[::samples] = shaper.amplitudes
    pole = mode.angular_frequency_rad_s * complex(-0.01, math.sqrt(1.0 - 0.01**2))
    z = np.exp(pole * sample_s)
    assert abs(np.polyval(coefficients[::-1], 1.0 / z)) < 1e-14
    assert coefficients.sum() == pytest.approx(1.0, abs=1e-15)  # unit gain for a constant command


def test_half_a_period_of_delay_is_the_zvd_shaper():
    mode = Mode(16.0, 0.05)
    oatf, zvd = design_shaper("oatf", mode, delay_s=0.5 * mode.damped_period_s), design_shaper("zvd", mode)
    assert oatf.amplitudes == pytest.approx(zvd.amplitudes, rel=1e-14)
    assert oatf.times_s == pytest.approx(zvd.times_s, rel=1e-14)
