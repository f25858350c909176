"""The mode of a load below a driven trolley, against matrices, limits and first-order formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.plant import pendulum_mode
from swayless.plant.servo_drive import ServoDrive, servo_drive_mode, servo_drive_modes
from tests.unit.plant.linear_drive import state_matrix


@settings(derandomize=True, deadline=None, max_examples=200)
@given(
    load_ratio=st.floats(0.1, 8.0),
    lag_s=st.floats(0.01, 3.0),
    integral_time_s=st.one_of(st.just(math.inf), st.floats(0.1, 10.0)),
    rope_m=st.floats(1.0, 40.0),
    damping_ratio=st.floats(0.0, 0.1),
)
def test_modes_are_eigenvalues_of_trolley_load_and_loop(
    load_ratio, lag_s, integral_time_s, rope_m, damping_ratio
):
    drive = ServoDrive.from_lag(1000.0, 1000.0 * load_ratio, lag_s, integral_time_s)
    values = np.linalg.eigvals(state_matrix(drive, rope_m, damping_ratio))
    for mode in servo_drive_modes(drive, rope_m, damping_ratio):
        w_rad_s, ratio = mode.angular_frequency_rad_s, mode.damping_ratio
        pole = w_rad_s * complex(-ratio, math.sqrt(1.0 - ratio**2))
        # Poles that nearly meet are known to the root of the rounding, 1e-8 of the fastest one.
        assert abs(values - pole).min() < 1e-7 * abs(values).max()


@settings(derandomize=True, deadline=None, max_examples=100)
@given(load_ratio=st.floats(0.1, 8.0), lag_s=st.floats(1e-4, 2e-3), rope_m=st.floats(2.0, 40.0))
def test_a_stiff_proportional_loop_adds_damping_of_load_share_times_lag(load_ratio, lag_s, rope_m):
    mode = servo_drive_mode(ServoDrive.from_lag(1000.0, 1000.0 * load_ratio, lag_s), rope_m)
    w_rad_s = pendulum_mode(rope_m).angular_frequency_rad_s
    share = load_ratio / (1.0 + load_ratio)
    # The next terms are of the second order in w lag (1 + m / M), at most 0.05.
    assert mode.damping_ratio == pytest.approx(0.5 * share * w_rad_s * lag_s, rel=5e-3)
    assert mode.angular_frequency_rad_s == pytest.approx(w_rad_s, rel=5e-4)


@pytest.mark.parametrize("integral_time_s", [0.2, 1.0, 5.0])
def test_an_integral_shifts_the_frequency_as_first_order_perturbation_says(integral_time_s):
    """s^2 = -w^2 (1 + m s / (M s + K + K / (T s))), with s = j w on the right."""
    rope_m = 6.0
    w_rad_s = pendulum_mode(rope_m).angular_frequency_rad_s
    for lag_s, tolerance in ((0.02, 4e-4), (0.01, 1e-4)):  # the second order, a quarter when halved
        drive = ServoDrive.from_lag(2000.0, 4000.0, lag_s, integral_time_s)
        s = 1j * w_rad_s
        loop = drive.trolley_mass_kg * s + drive.gain_n_s_m + drive.integral_gain_n_m / s
        pole = w_rad_s * 1j * (1.0 + 0.5 * drive.load_mass_kg * s / loop)
        mode = servo_drive_mode(drive, rope_m)
        assert mode.angular_frequency_rad_s == pytest.approx(abs(pole), rel=tolerance)
        assert mode.damping_ratio == pytest.approx(-pole.real / abs(pole), abs=tolerance)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.004, 0.1])
def test_an_ideal_drive_leaves_the_pendulum(damping_ratio):
    mode = servo_drive_mode(ServoDrive.from_lag(1000.0, 3000.0, 1e-9), 5.0, damping_ratio)
    pendulum = pendulum_mode(5.0, damping_ratio)
    assert mode.frequency_hz == pytest.approx(pendulum.frequency_hz, rel=1e-8)
    assert mode.damping_ratio == pytest.approx(damping_ratio, abs=1e-8)


def test_a_trolley_that_hardly_any_loop_holds_swings_against_its_load():
    """Free trolley: w^2 = g / L (1 + m / M)."""
    mode = servo_drive_mode(ServoDrive.from_lag(1000.0, 3000.0, 1e7), 5.0)
    assert mode.frequency_hz == pytest.approx(2.0 * pendulum_mode(5.0).frequency_hz, rel=1e-6)
    assert mode.damping_ratio < 1e-6


def test_a_loop_that_vibrates_itself_is_the_second_mode():
    sway, loop = servo_drive_modes(ServoDrive(2000.0, 500.0, 8000.0, 0.2), 8.0)
    # Without a load, M s^2 + K s + K / T: 4.5 rad/s with a damping ratio of 0.45.
    assert loop.angular_frequency_rad_s == pytest.approx(math.sqrt(20.0), rel=0.05)
    assert loop.damping_ratio == pytest.approx(math.sqrt(8000.0 * 0.2 / 2000.0) / 2.0, rel=0.1)
    assert sway.damping_ratio < 0.1 * loop.damping_ratio


def test_lag_and_gain_are_two_names_for_one_drive():
    drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1, 0.5)
    assert drive == ServoDrive(2000.0, 6000.0, 80e3, 0.5)
    assert drive.lag_s == pytest.approx(0.1, rel=1e-15)
    assert drive.integral_gain_n_m == 160e3
    assert ServoDrive(1.0, 1.0, 1.0).integral_gain_n_m == 0.0
