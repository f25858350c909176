"""Modes and bands: what they compute and what they refuse."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import PlantError, SwaylessError
from swayless.plant import Band, Mode


@settings(derandomize=True, deadline=None)
@given(period_s=st.floats(1e-3, 1e3), damping_ratio=st.floats(0.0, 0.99))
def test_a_mode_made_from_its_damped_period_has_that_period(period_s, damping_ratio):
    mode = Mode.from_damped_period(period_s, damping_ratio)
    assert mode.damped_period_s == pytest.approx(period_s, rel=1e-14)  # two roundings of a square root


def test_the_damped_period_is_longer_than_the_undamped_one_by_the_factor_of_the_damping():
    mode = Mode(0.25, 0.6)  # sqrt(1 - 0.36) = 0.8
    assert mode.damped_period_s == pytest.approx(4.0 / 0.8, rel=1e-15)
    assert mode.angular_frequency_rad_s == pytest.approx(math.pi / 2.0, rel=1e-15)


@pytest.mark.parametrize("frequency_hz", [0.0, -1.0, math.inf, -math.inf, math.nan])
def test_a_frequency_that_is_not_finite_and_positive_is_refused(frequency_hz):
    with pytest.raises(PlantError, match=r"frequency_hz = .*: must be finite and > 0"):
        Mode(frequency_hz)


@pytest.mark.parametrize("damping_ratio", [-1e-9, 1.0, 2.0, math.nan, math.inf])
def test_a_damping_ratio_that_does_not_vibrate_is_refused(damping_ratio):
    with pytest.raises(PlantError, match=r"damping_ratio = .*: must be at least 0 and below 1"):
        Mode(1.0, damping_ratio)


@pytest.mark.parametrize("period_s", [0.0, -2.0, math.inf, math.nan])
def test_a_period_that_is_not_finite_and_positive_is_refused(period_s):
    with pytest.raises(PlantError, match="period_s"):
        Mode.from_damped_period(period_s)


@pytest.mark.parametrize(
    ("low_hz", "high_hz"),
    [(0.0, 1.0), (-1.0, 1.0), (2.0, 1.0), (1.0, math.inf), (math.nan, 1.0), (1.0, math.nan)],
)
def test_a_band_out_of_order_or_range_is_refused(low_hz, high_hz):
    with pytest.raises(PlantError, match="rising order"):
        Band(low_hz, high_hz)


def test_a_band_contains_its_ends_and_nothing_beyond():
    band = Band(0.2, 0.3)
    assert band.contains(0.2)
    assert band.contains(0.3)
    assert not band.contains(math.nextafter(0.2, 0.0))
    assert not band.contains(math.nextafter(0.3, 1.0))


def test_a_plant_error_can_be_caught_as_a_value_error_and_as_a_swayless_error():
    assert issubclass(PlantError, ValueError)
    assert issubclass(PlantError, SwaylessError)
