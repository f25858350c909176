"""Magee and Book, input shaping of a system with varying parameters: eqs 13-25, figs 4-8."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import design_shaper, residual_vibration, vibration_error
from swayless.plant import Mode

NORMALISED = np.linspace(0.0, 2.5, 2501)
DAMPINGS = [0.0, 0.05, 0.1, 0.2]
BY_IMPULSES = {2: "zv", 3: "zvd", 4: "zvdd"}
FIGURE = {2: "fig 4", 3: "fig 7", 4: "fig 8"}


def figure_ids(impulses):
    return FIGURE[impulses]


def decay_over_half_a_period(damping_ratio):
    """M of eq 23."""
    return math.exp(-damping_ratio * math.pi / math.sqrt(1.0 - damping_ratio**2))


def error_of(impulses, damping_ratio, ratio=NORMALISED):
    """Vibration error over normalised frequency of the shaper with so many impulses."""
    shaper = design_shaper(BY_IMPULSES[impulses], Mode(1.0, damping_ratio))
    return vibration_error(shaper, ratio, damping_ratio=damping_ratio)


def held_half_widths(impulses, damping_ratio):
    """How far below and above the design frequency the vibration error stays within 5 %."""
    within = NORMALISED[error_of(impulses, damping_ratio) <= 0.05]
    return 1.0 - within.min(), within.max() - 1.0


@settings(derandomize=True, deadline=None, max_examples=60)
@given(order=st.integers(0, 6), frequency_hz=st.floats(0.05, 20.0), damping_ratio=st.floats(0.0, 0.5))
def test_eqs_13_to_16_hold_up_to_the_order_of_the_shaper(order, frequency_hz, damping_ratio):
    mode = Mode(frequency_hz, damping_ratio)
    shaper = design_shaper("zvm", mode, order=order)
    angular = mode.angular_frequency_rad_s
    decay = np.exp(-damping_ratio * angular * (shaper.duration_s - shaper.times_s))
    phase = angular * math.sqrt(1.0 - damping_ratio**2) * shaper.times_s
    for m in range(order + 1):
        weights = shaper.amplitudes * shaper.times_s**m * decay
        scale = np.abs(weights).sum()
        # Phases of up to 7 pi are right to 1e-14 of the terms they turn.
        assert abs(weights @ np.cos(phase)) < 1e-13 * scale
        assert abs(weights @ np.sin(phase)) < 1e-13 * scale


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
def test_eqs_17_and_18_hold_for_two_impulses(damping_ratio):
    shaper = design_shaper("zv", Mode(2.0, damping_ratio))
    angular = 4.0 * math.pi
    b = shaper.amplitudes * np.exp(damping_ratio * angular * shaper.times_s)
    phi = angular * math.sqrt(1.0 - damping_ratio**2) * shaper.times_s
    assert abs(b @ np.cos(phi)) < 1e-15  # two terms of 1/2, equal and opposite
    assert abs(b @ np.sin(phi)) < 1e-15


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
def test_eqs_19_to_23_are_the_two_impulses(damping_ratio):
    shaper = design_shaper("zv", Mode(2.0, damping_ratio))
    m = decay_over_half_a_period(damping_ratio)
    assert shaper.amplitudes == pytest.approx([1.0 / (1.0 + m), m / (1.0 + m)], rel=1e-15)
    second_s = math.pi / (4.0 * math.pi * math.sqrt(1.0 - damping_ratio**2))
    assert shaper.times_s == pytest.approx([0.0, second_s], rel=1e-15)


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
def test_eq_24_is_the_ratio_of_the_responses_after_the_last_impulse(damping_ratio):
    actual_hz = 1.7
    shaper = design_shaper("zvd", Mode(1.0, damping_ratio))
    pole = 2.0 * math.pi * actual_hz * complex(-damping_ratio, math.sqrt(1.0 - damping_ratio**2))
    later_s = shaper.duration_s + np.linspace(0.0, 3.0, 7)
    shaped = np.exp(pole * (later_s[:, np.newaxis] - shaper.times_s)) @ shaper.amplitudes
    ratio = np.abs(shaped) / np.abs(np.exp(pole * later_s))
    error = float(vibration_error(shaper, actual_hz, damping_ratio=damping_ratio))
    assert ratio == pytest.approx(np.full(7, error), rel=1e-13)


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
def test_eq_25_and_fig_4_are_the_vibration_error_of_two_impulses(damping_ratio):
    m, r = decay_over_half_a_period(damping_ratio), NORMALISED
    square = (1.0 + 2.0 * m ** (1.0 - r) * np.cos(np.pi * r) + m ** (2.0 * (1.0 - r))) / (m + 1.0) ** 2
    # Squares, because the printed root loses half its digits where the error vanishes. Terms of order 1.
    assert error_of(2, damping_ratio) ** 2 == pytest.approx(square, rel=1e-14, abs=1e-15)


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
@pytest.mark.parametrize("impulses", [3, 4], ids=figure_ids)
def test_figs_7_and_8_are_powers_of_fig_4(impulses, damping_ratio):
    # Each derivative constraint convolves the two impulses once more with themselves.
    expected = error_of(2, damping_ratio) ** (impulses - 1)
    assert error_of(impulses, damping_ratio) == pytest.approx(expected, rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("impulses", [2, 3, 4], ids=figure_ids)
def test_figs_4_7_8_the_error_vanishes_at_the_design_frequency_and_is_one_at_rest(impulses):
    for damping_ratio in DAMPINGS:
        assert error_of(impulses, damping_ratio, 1.0) < 1e-15
        assert error_of(impulses, damping_ratio, 0.0) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize("damping_ratio", [0.05, 0.1, 0.2])
def test_fig_6_shaping_at_half_the_actual_frequency_is_worse_than_none(damping_ratio):
    # Eq 25 at twice the design frequency is 1 / M, above 1 as soon as there is damping.
    error = float(error_of(2, damping_ratio, 2.0))
    assert error == pytest.approx(1.0 / decay_over_half_a_period(damping_ratio), rel=1e-14)
    assert error > 1.0


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
@pytest.mark.parametrize("family", ["zv", "zvd", "zvdd", "ei", "ei2", "mzv"])
def test_fig_5_in_singers_definition_positive_impulses_never_exceed_100_percent(family, damping_ratio):
    shaper = design_shaper(family, Mode(1.0, damping_ratio))
    ratio = residual_vibration(shaper, NORMALISED, damping_ratio=damping_ratio)
    assert ratio.max() <= 1.0 + 1e-15  # the sum of the amplitudes, to rounding


@pytest.mark.parametrize("impulses", [2, 3, 4], ids=figure_ids)
def test_figs_4_7_8_the_error_grows_with_damping(impulses):
    for less, more in pairwise(DAMPINGS):
        assert (error_of(impulses, more) >= error_of(impulses, less) - 1e-15).all()


def test_fig_5_in_singers_definition_the_residual_at_high_frequency_falls_with_damping():
    peaks = []
    for damping_ratio in DAMPINGS:
        shaper = design_shaper("zv", Mode(1.0, damping_ratio))
        peaks.append(float(residual_vibration(shaper, 2.0, damping_ratio=damping_ratio)))
    assert peaks == sorted(peaks, reverse=True)
    assert peaks[-1] < 0.6 * peaks[0]


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
def test_two_impulses_hold_5_percent_only_within_5_percent_of_the_frequency(damping_ratio):
    below, above = held_half_widths(2, damping_ratio)
    assert 0.02 < below < 0.05
    assert 0.02 <= above < 0.05


@pytest.mark.parametrize("damping_ratio", DAMPINGS)
def test_figs_4_7_8_more_impulses_are_more_robust_at_a_larger_penalty_outside(damping_ratio):
    widths = [sum(held_half_widths(impulses, damping_ratio)) for impulses in (2, 3, 4)]
    assert widths[0] < widths[1] < widths[2]
    if damping_ratio > 0.0:
        penalties = [float(error_of(impulses, damping_ratio, 2.0)) for impulses in (2, 3, 4)]
        assert penalties[0] < penalties[1] < penalties[2]
