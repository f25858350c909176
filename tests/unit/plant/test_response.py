"""The exact state of a swinging mode."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from swayless.errors import PlantError
from swayless.plant import Mode
from swayless.plant.response import VelocityProfile, swing_state

RNG = np.random.default_rng(20240501)


def _random_profile(count: int) -> VelocityProfile:
    return VelocityProfile(RNG.uniform(0.0, 20.0, count), RNG.normal(size=count), RNG.normal(size=count))


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05, 0.9])
@pytest.mark.parametrize("count", [1, 2, 3, 1000])
def test_state_is_the_sum_of_the_answers_to_each_change(damping_ratio: float, count: int) -> None:
    mode, profile = Mode(0.7, damping_ratio), _random_profile(count)
    time_s = np.linspace(-1.0, 40.0, 301)
    pole = mode.angular_frequency_rad_s * complex(-damping_ratio, math.sqrt(1.0 - damping_ratio**2))
    elapsed_s = time_s[:, np.newaxis] - profile.times_s
    answer = np.exp(pole * elapsed_s.clip(0.0)) * profile.jumps_m_s
    answer += np.expm1(pole * elapsed_s.clip(0.0)) / pole * profile.acceleration_steps_m_s2
    expected = np.where(elapsed_s >= 0.0, answer, 0.0).sum(axis=1)
    # A thousand roundings of terms of size 1, and phases up to 180 rad whose last bit is 3e-14.
    np.testing.assert_allclose(swing_state(mode, profile, time_s), expected, rtol=0.0, atol=1e-11)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_pendulum_angle_agrees_with_numerical_integration_of_a_ramp(damping_ratio: float) -> None:
    length_m, ramp_s, speed_m_s = 4.0, 1.7, 0.5
    omega = math.sqrt(9.80665 / length_m)
    mode = Mode(omega / (2.0 * math.pi), damping_ratio)

    def swing(time_s: float, state: np.ndarray) -> list[float]:
        angle, rate = state
        acceleration = speed_m_s / ramp_s if time_s < ramp_s else 0.0
        return [rate, -2.0 * damping_ratio * omega * rate - omega**2 * angle - acceleration / length_m]

    time_s = np.linspace(0.0, 10.0, 51)
    solved = solve_ivp(swing, (0.0, 10.0), [0.0, 0.0], t_eval=time_s, rtol=1e-10, atol=1e-12, max_step=0.01)
    ramp = VelocityProfile([0.0, ramp_s], [0.0, 0.0], [speed_m_s / ramp_s, -speed_m_s / ramp_s])
    state = swing_state(mode, ramp, time_s)
    angle = -state.imag / (length_m * omega * math.sqrt(1.0 - damping_ratio**2))
    # The integrator meets the corner of the ramp inside a step of 10 ms: an error of 1e-6 of the angle.
    np.testing.assert_allclose(angle, solved.y[0], atol=1e-6)


def test_envelope_after_a_unit_jump_decays_from_one() -> None:
    mode = Mode(0.5, 0.1)
    jump = VelocityProfile(np.zeros(1), np.ones(1), np.zeros(1))
    time_s = np.array([-0.1, 0.0, 2.0])
    expected = [0.0, 1.0, math.exp(-0.1 * 2.0 * math.pi * 0.5 * 2.0)]
    np.testing.assert_allclose(abs(swing_state(mode, jump, time_s)), expected, rtol=1e-14)


def test_order_of_the_changes_does_not_matter() -> None:
    profile = VelocityProfile([2.0, 0.0, 1.0], [3.0, 1.0, 2.0], [0.0, 0.0, 0.0])
    assert profile.times_s.tolist() == [0.0, 1.0, 2.0]
    assert profile.jumps_m_s.tolist() == [1.0, 2.0, 3.0]


def test_vertices_hold_the_velocity_before_and_after_each_change() -> None:
    profile = VelocityProfile([0.0, 1.0, 3.0], [1.0, 0.0, -0.5], [0.0, 0.25, -0.25])
    times_s, velocity_m_s = profile.vertices()
    assert times_s.tolist() == [0.0, 0.0, 1.0, 1.0, 3.0, 3.0]
    assert velocity_m_s.tolist() == [0.0, 1.0, 1.0, 1.0, 1.5, 1.0]  # quarters: exact in binary


def test_a_scalar_time_gives_a_scalar_state() -> None:
    jump = VelocityProfile(np.zeros(1), np.ones(1), np.zeros(1))
    assert swing_state(Mode(1.0), jump, 0.25).shape == ()


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        (([], [], []), r"must all be one \(n,\), n >= 1"),
        (([0.0], [1.0, 2.0], [0.0]), r"must all be one \(n,\), n >= 1"),
        (([0.0], [math.inf], [0.0]), "jumps_m_s = inf: must be finite"),
        (([math.nan], [1.0], [0.0]), "times_s = nan: must be finite"),
    ],
)
def test_bad_profiles_are_refused(
    columns: tuple[list[float], list[float], list[float]], message: str
) -> None:
    with pytest.raises(PlantError, match=message):
        VelocityProfile(*columns)
