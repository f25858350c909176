"""The flexible arm against closed forms, and over the circle of Magee and Book."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from swayless.plant.simulation import FlexibleArm

TICK_S = 0.02


@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_a_step_at_one_reach_answers_as_magee_eq_1(damping_ratio):
    """The answer to a step is the integral of eq 1: 1 - exp(-d w t) (cos + d / sqrt(1 - d^2) sin)."""
    arm = FlexibleArm(4.0, 3.0, damping_ratio)
    run = arm.simulate(np.full(500, 0.01), np.full(501, 3.0), tick_s=TICK_S)
    phase, damped = 2.0 * math.pi * 4.0 * run.time_s, math.sqrt(1.0 - damping_ratio**2)
    swing = np.cos(damped * phase) + damping_ratio / damped * np.sin(damped * phase)
    decay = np.exp(-damping_ratio * phase)
    # 250 rad in steps of 0.1 rad are late by 2e-4 rad, of 0.01 m.
    np.testing.assert_allclose(run.tip_m, 0.01 * (1.0 - decay * swing), rtol=0.0, atol=3e-6)
    w_rad_s = 8.0 * math.pi
    acceleration = (
        decay * w_rad_s**2 * (np.cos(damped * phase) - damping_ratio / damped * np.sin(damped * phase))
    )
    # The same late phase, of w^2 times 0.01 m; at rest the command has not acted yet.
    np.testing.assert_allclose(run.tip_m_s2[1:], 0.01 * acceleration[1:], rtol=0.0, atol=2e-3)


@pytest.mark.parametrize("hold", ["step", "line"])
def test_a_changing_reach_agrees_with_an_adaptive_integrator(hold):
    arm = FlexibleArm.over_circle(3.7, 5.5, 0.9144, 0.01)
    phase = 2.0 * math.pi * np.arange(101) * TICK_S / 9.0
    reach, command = arm.reach_m - 0.4572 * np.cos(phase), 0.4572 * np.sin(phase[1:])
    run = arm.simulate(command, reach, tick_s=TICK_S, hold=hold)
    state, before, tips = np.zeros(2), 0.0, [0.0]
    for tick in range(100):
        begins = before if hold == "line" else command[tick]

        def motion(t, state, begins=begins, tick=tick):
            told = begins + (command[tick] - begins) * t / TICK_S
            reach_m = reach[tick] + (reach[tick + 1] - reach[tick]) * t / TICK_S
            w_rad_s = 2.0 * math.pi * arm.frequency_at(reach_m)
            return [state[1], w_rad_s**2 * (told - state[0]) - 0.02 * w_rad_s * state[1]]

        state = solve_ivp(motion, (0.0, TICK_S), state, rtol=1e-9, atol=1e-12).y[:, -1]
        before = command[tick]
        tips.append(state[0])
    # 60 rad in steps of 0.1 rad are late by 5e-5 rad, of a vibration of 0.02 m.
    np.testing.assert_allclose(run.tip_m, tips, rtol=0.0, atol=2e-6)


def test_magee_and_book_fig_16_frequencies_span_the_circle():
    arm = FlexibleArm.over_circle(3.7, 5.5, 0.9144)
    near_m, far_m = arm.reach_m - 0.4572, arm.reach_m + 0.4572
    np.testing.assert_allclose(arm.frequency_at([near_m, far_m]), [5.5, 3.7], rtol=1e-14)  # roundings
    # A light beam: three halves of an octave for one octave of reach.
    assert arm.frequency_at(2.0 * arm.reach_m) == pytest.approx(arm.frequency_hz / 2.0**1.5, rel=1e-15)


def test_many_arms_at_once_give_what_each_gives_alone():
    arm, rng = FlexibleArm(4.0, 3.0, 0.02), np.random.default_rng(2)
    commands, reaches = rng.normal(size=(3, 30)), rng.uniform(2.9, 3.1, (3, 31))
    many = arm.simulate(commands, reaches, tick_s=TICK_S)
    for case in range(3):
        alone = arm.simulate(commands[case], reaches[case], tick_s=TICK_S)
        # The steps of all are those of the shortest reach; 30 rad are late by 2e-5 rad at most.
        np.testing.assert_allclose(many.tip_m[case], alone.tip_m, rtol=0.0, atol=2e-4)


def test_an_arm_that_is_told_nothing_stays():
    run = FlexibleArm(4.0, 3.0).simulate(np.zeros(50), np.linspace(3.0, 4.0, 51), tick_s=TICK_S)
    assert not run.tip_m.any()
