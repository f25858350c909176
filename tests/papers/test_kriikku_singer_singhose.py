"""Kriikku, Singer and Singhose (1997), an input shaping controller for cranes: eqs 1-3, figs 4 and 11."""

import math

import numpy as np
import pytest

from swayless.design import FAMILIES, design_shaper, partial_sums, residual_vibration
from swayless.plant import Mode, pendulum_frequency_hz, pendulum_mode

FOOT_M = 0.3048


def rope_mode(length_ft):
    return pendulum_mode(length_ft * FOOT_M)


def residual_at_rope(design_ft, actual_ft):
    """Residual of the UM ZV shaper for one rope length at another."""
    shaper = design_shaper("um-zv", rope_mode(design_ft))
    return float(residual_vibration(shaper, pendulum_frequency_hz(actual_ft * FOOT_M)))


@pytest.mark.parametrize("damping_ratio", [0.0, 0.004, 0.1])
@pytest.mark.parametrize("family", ["zv", "ei3", "um-zvd"])
def test_eq_1_is_the_residual_vibration(family, damping_ratio):
    shaper, angular = design_shaper(family, Mode(0.2, damping_ratio)), 2.0 * math.pi * 0.23
    growth = shaper.amplitudes * np.exp(damping_ratio * angular * shaper.times_s)
    phase = angular * math.sqrt(1.0 - damping_ratio**2) * shaper.times_s
    c, s = growth @ np.cos(phase), growth @ np.sin(phase)
    eq_1 = math.exp(-damping_ratio * angular * shaper.duration_s) * math.sqrt(c**2 + s**2)
    assert float(residual_vibration(shaper, 0.23, damping_ratio=damping_ratio)) == pytest.approx(
        eq_1, rel=1e-13
    )


@pytest.mark.parametrize("damping_ratio", [0.0, 0.004, 0.1])
@pytest.mark.parametrize("family", FAMILIES)
def test_eq_2_amplitudes_sum_to_one(family, damping_ratio):
    parameters = {"zvm": {"order": 4}, "oatf": {"delay_s": 1.3}}.get(family, {})
    shaper = design_shaper(family, Mode(0.2, damping_ratio), **parameters)
    assert shaper.amplitudes.sum() == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.004, 0.1])
@pytest.mark.parametrize("family", ["um-zv", "um-zvd", "um-ei"])
def test_eq_3_unity_magnitude_amplitudes_alternate_and_the_reference_is_full_on_or_off(family, damping_ratio):
    shaper = design_shaper(family, Mode(0.2, damping_ratio))
    assert shaper.amplitudes.size % 2 == 1
    assert shaper.amplitudes.tolist() == [(-1.0) ** i for i in range(shaper.amplitudes.size)]
    assert set(partial_sums(shaper).tolist()) == {0.0, 1.0}


def test_fig_4_the_zv_shaper_is_sensitive_to_the_frequency():
    ratio = np.linspace(0.0, 2.0, 401)
    residual = residual_vibration(design_shaper("zv", Mode(1.0)), ratio)
    assert residual == pytest.approx(np.abs(np.cos(0.5 * np.pi * ratio)), abs=1e-15)
    # A tenth off the frequency already leaves a sixth of the swing.
    assert residual[180] == pytest.approx(0.156, abs=5e-4)


@pytest.mark.parametrize(("length_ft", "frequency_hz"), [(20.0, 0.2), (4.0, 0.45)])
def test_section_3_the_example_crane_swings_between_0_2_and_0_45_hz(length_ft, frequency_hz):
    assert rope_mode(length_ft).frequency_hz == pytest.approx(
        frequency_hz, abs=0.005
    )  # two digits are printed


@pytest.mark.parametrize(("length_ft", "duration_s"), [(24.0, 1.8089), (16.0, 1.4769), (11.0, 1.2246)])
def test_section_4_um_zv_durations_are_a_third_of_the_pendulum_period(length_ft, duration_s):
    shaper = design_shaper("um-zv", rope_mode(length_ft))
    period_s = 2.0 * math.pi * math.sqrt(length_ft * FOOT_M / 9.80665)
    assert shaper.duration_s == pytest.approx(period_s / 3.0, rel=1e-14)
    assert shaper.duration_s == pytest.approx(duration_s, abs=5e-5)


def test_section_4_the_longest_um_zv_shaper_takes_1_8_seconds():
    longest_s = max(
        design_shaper("um-zv", rope_mode(length_ft)).duration_s for length_ft in (24.0, 16.0, 11.0)
    )
    assert longest_s == pytest.approx(1.8, abs=0.05)  # one decimal is printed


def test_section_4_um_zv_is_shorter_than_any_positive_zero_vibration_shaper():
    mode = rope_mode(24.0)
    assert design_shaper("um-zv", mode).duration_s < design_shaper("zv", mode).duration_s


@pytest.mark.parametrize(
    ("design_ft", "actual_ft", "theory"),
    [
        (24.0, 29.0, 0.1590),
        (24.0, 20.0, 0.1778),
        (16.0, 20.0, 0.1850),
        (16.0, 13.0, 0.2046),
        (11.0, 13.0, 0.1417),
        (11.0, 9.0, 0.1971),
    ],
)
def test_fig_11_theoretical_residuals_where_the_operator_switches(design_ft, actual_ft, theory):
    assert residual_at_rope(design_ft, actual_ft) == pytest.approx(theory, abs=5e-5)


def test_fig_11_theory_leaves_20_5_percent_at_13_ft_where_the_paper_reports_20():
    # The paper measured below 20 % for ropes of 29 to 9 ft with switches at 20 and 13 ft. By its eq 1 that
    # is so everywhere but just above 13 ft, where the shaper for 16 ft leaves 20.5 %.
    reported = 0.20
    spans_ft = {24.0: (29.0, 20.0), 16.0: (20.0, 13.0), 11.0: (13.0, 9.0)}
    worst = {
        design_ft: max(residual_at_rope(design_ft, actual_ft) for actual_ft in np.linspace(*ends_ft, 101))
        for design_ft, ends_ft in spans_ft.items()
    }
    assert worst[16.0] == pytest.approx(0.2046, abs=5e-5)
    assert worst[16.0] > reported
    assert worst[24.0] < reported
    assert worst[11.0] < reported


def test_fig_8_forty_cycles_at_28_ft_take_nearly_four_minutes():
    assert 40.0 / rope_mode(28.0).frequency_hz == pytest.approx(240.0, abs=10.0)
