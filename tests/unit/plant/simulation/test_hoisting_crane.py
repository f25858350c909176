"""The hoisting crane against closed forms: elliptic period, adiabatic invariant, the linear response."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import ellipk

from swayless.plant import pendulum_mode
from swayless.plant.response import VelocityProfile, swing_state
from swayless.plant.simulation import HoistingCrane

GRAVITY_M_S2 = 9.80665
AT_REST_M_S = np.zeros(4000)


@pytest.mark.parametrize("amplitude_deg", [5.0, 10.0, 20.0, 40.0])
def test_period_is_the_complete_elliptic_integral(amplitude_deg):
    amplitude_rad, rope_m = math.radians(amplitude_deg), 4.0
    period_s = 4.0 * math.sqrt(rope_m / GRAVITY_M_S2) * ellipk(math.sin(0.5 * amplitude_rad) ** 2)
    crane, tick_s = HoistingCrane(), period_s / 400.0
    run = crane.simulate(AT_REST_M_S, rope_m, tick_s=tick_s, swing_rad=amplitude_rad)
    # Ten periods, 4000 steps of 0.016 rad: a phase late by 4e-8 rad in all and an amplitude less by 1e-9.
    np.testing.assert_allclose(run.swing_rad[::400], amplitude_rad, rtol=1e-8)
    np.testing.assert_allclose(run.swing_rad_s[::400], 0.0, atol=2e-7)
    np.testing.assert_allclose(run.swing_rad[100::200], 0.0, atol=1e-7)


@pytest.mark.parametrize("amplitude_deg", [5.0, 40.0, 85.0])
def test_energy_and_with_it_the_amplitude_do_not_drift(amplitude_deg):
    run = HoistingCrane().simulate(np.zeros(18000), 4.0, tick_s=0.01, swing_rad=math.radians(amplitude_deg))
    # Three minutes of 1e-13 of the energy a step, and more where the swing is not small.
    np.testing.assert_allclose(run.amplitude_rad, math.radians(amplitude_deg), rtol=1e-7)


@pytest.mark.parametrize("ends_m", [(9.0, 4.0), (4.0, 9.0)])
def test_slow_hoisting_keeps_energy_over_frequency(ends_m):
    """E / w ~ L^(3/2) amplitude^2 is the adiabatic invariant, so the amplitude goes with L^(-3/4)."""
    errors = []
    for hoist_s in (200, 800):
        ropes = np.linspace(*ends_m, 20 * hoist_s + 1)
        run = HoistingCrane().simulate(
            np.zeros(20 * hoist_s), ropes, tick_s=0.05, swing_rad=math.radians(1.0)
        )
        invariant = run.rope_length_m**0.75 * run.amplitude_rad
        errors.append(np.ptp(invariant) / invariant[0])
    # Within a period the amplitude trembles by 3 L' / (2 L w), twice that from end to end: 1.2 % and 0.3 %.
    assert errors[0] < 0.02
    assert errors[1] == pytest.approx(errors[0] / 4.0, rel=0.2)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05])
@pytest.mark.parametrize("hold", ["step", "line"])
def test_small_swings_agree_with_the_exact_linear_response(damping_ratio, hold):
    rng = np.random.default_rng(7)
    speeds, tick_s, rope_m = 1e-3 * rng.normal(size=300), 0.05, 4.0
    run = HoistingCrane(damping_ratio).simulate(speeds, rope_m, tick_s=tick_s, hold=hold)
    changes, times = np.diff(speeds, prepend=0.0), tick_s * np.arange(300)
    if hold == "step":
        profile = VelocityProfile(times, changes, np.zeros(300))
    else:
        bends = np.diff(np.concatenate([[0.0], changes])) / tick_s
        profile = VelocityProfile(times, np.zeros(300), bends)
    mode = pendulum_mode(rope_m, damping_ratio)
    damped_rad_s = mode.angular_frequency_rad_s * math.sqrt(1.0 - damping_ratio**2)
    moments = run.time_s[1:] - 1e-9  # just before the next step
    linear_rad = -swing_state(mode, profile, moments).imag / (rope_m * damped_rad_s)
    # Swings of 2e-4 rad: the nonlinearity is 1e-8 of them, 24 rad in steps of 0.08 rad are 1e-5 rad late.
    np.testing.assert_allclose(run.swing_rad[1:], linear_rad, rtol=0.0, atol=4e-9)
    assert abs(linear_rad).max() > 1e-4


def test_two_equal_steps_half_a_period_apart_leave_only_the_nonlinearity():
    """ZV at 5 degrees leaves 0.015 degrees: the period is longer by amplitude^2 / 16."""
    rope_m = 4.0
    half_s = math.pi * math.sqrt(rope_m / GRAVITY_M_S2)
    speed_m_s = math.radians(5.0) * math.sqrt(GRAVITY_M_S2 * rope_m)
    speeds = np.repeat([0.5 * speed_m_s, speed_m_s], 200)
    run = HoistingCrane().simulate(speeds, rope_m, tick_s=half_s / 200.0)
    left_deg = math.degrees(run.amplitude_rad[-1])
    assert 0.0 < left_deg < 0.015
    assert math.degrees(abs(run.swing_rad).max()) == pytest.approx(2.5, rel=2e-3)


def test_one_step_leaves_the_swing_it_is_compared_with():
    run = HoistingCrane().simulate(np.full(100, 0.01), 4.0, tick_s=0.01)
    assert run.peak_sway_m == pytest.approx(run.amplitude_m[-1], rel=1e-4)  # a tick beside the peak
    assert run.residual_ratio(0.01) == pytest.approx(1.0, rel=1e-6)  # amplitude^2 / 24 of 1.6e-3 rad


def test_a_hoist_that_starts_with_a_jerk_does_not_kick_a_swinging_load():
    """L'' has no moment about the suspension: the rate of the swing is continuous where L' jumps."""
    ropes = np.interp(np.arange(201) * 1e-4, [0.0, 0.01, 0.02], [4.0, 4.0, 3.99])
    run = HoistingCrane().simulate(np.zeros(200), ropes, tick_s=1e-4, swing_rad=0.2)
    accelerations = np.diff(run.swing_rad_s) / 1e-4
    # Up to -g sin(a) / L = -0.5 rad/s2 plus 2 L' a' / L = 0.02; an impulse would show as thousands.
    assert abs(accelerations).max() < 0.6


@settings(derandomize=True, deadline=None, max_examples=20)
@given(
    rope_m=st.floats(0.5, 50.0),
    damping_ratio=st.floats(0.0, 0.5),
    tick_s=st.floats(1e-3, 0.2),
    hoist_m_s=st.floats(-0.02, 0.3),
)
def test_no_command_no_sway(rope_m, damping_ratio, tick_s, hoist_m_s):
    ropes = rope_m + hoist_m_s * tick_s * np.arange(101)
    run = HoistingCrane(damping_ratio).simulate(np.zeros(100), ropes, tick_s=tick_s)
    assert not run.load_m.any()
    assert not run.amplitude_rad.any()


@settings(derandomize=True, deadline=None, max_examples=20)
@given(scale=st.floats(0.1, 1.0), seed=st.integers(0, 99))
def test_the_mirrored_command_makes_the_mirrored_move(scale, seed):
    speeds = scale * np.random.default_rng(seed).uniform(-0.5, 0.5, 50)
    runs = HoistingCrane(0.01).simulate(np.array([speeds, -speeds]), 4.0, tick_s=0.05)
    assert (runs.load_m[0] == -runs.load_m[1]).all()  # signs commute with every operation


def test_steady_wind_holds_the_load_where_its_force_meets_gravity():
    run = HoistingCrane(0.2).simulate(np.zeros(4000), 4.0, tick_s=0.02, wind_m_s2=0.5)
    # exp(-0.2 * 1.57 * 80) = 1e-11 is left of the swing into place
    assert run.swing_rad[-1] == pytest.approx(math.atan(0.5 / GRAVITY_M_S2), rel=1e-9)


def test_travel_is_the_integral_of_the_reference():
    speeds = np.array([0.0, 0.2, 0.4, 0.4, 0.1])
    crane = HoistingCrane()
    stepped = crane.simulate(speeds, 4.0, tick_s=0.5)
    straight = crane.simulate(speeds, 4.0, tick_s=0.5, hold="line")
    np.testing.assert_allclose(stepped.trolley_m, [0.0, 0.0, 0.1, 0.3, 0.5, 0.55], rtol=1e-14)  # roundings
    np.testing.assert_allclose(straight.trolley_m, [0.0, 0.0, 0.05, 0.2, 0.4, 0.525], rtol=1e-14)
    np.testing.assert_array_equal(straight.trolley_m_s, [0.0, *speeds])
