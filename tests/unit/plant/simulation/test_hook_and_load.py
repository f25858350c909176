"""The crane with a heavy hook against its linear modes and its energy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from swayless.plant.double_pendulum import double_pendulum_modes, double_pendulum_participation
from swayless.plant.simulation import HoistingCrane, HookAndLoad

GRAVITY_M_S2 = 9.80665
ROPE_M, SLING_M = 6.0, 3.0
MASSES_KG = [(300.0, 60.0), (300.0, 300.0), (300.0, 1500.0)]


def modal_vectors(hook_kg: float, load_kg: float) -> tuple[np.ndarray, np.ndarray]:
    """Angular frequencies and shapes (rope, sling) of small vibrations, from mass and stiffness matrix."""
    mass = np.array(
        [
            [(hook_kg + load_kg) * ROPE_M**2, load_kg * ROPE_M * SLING_M],
            [load_kg * ROPE_M * SLING_M, load_kg * SLING_M**2],
        ]
    )
    stiffness = GRAVITY_M_S2 * np.diag([(hook_kg + load_kg) * ROPE_M, load_kg * SLING_M])
    squares, shapes = np.linalg.eig(np.linalg.solve(mass, stiffness))
    order = np.argsort(squares)
    return np.sqrt(squares[order]), shapes[:, order]


@pytest.mark.parametrize(("hook_kg", "load_kg"), MASSES_KG)
@pytest.mark.parametrize("mode", [0, 1])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.05])
def test_each_small_vibration_has_its_own_frequency_shape_and_damping(hook_kg, load_kg, mode, damping_ratio):
    frequencies_rad_s, shapes = modal_vectors(hook_kg, load_kg)
    w_rad_s, shape = frequencies_rad_s[mode], 1e-4 * shapes[:, mode]
    crane = HookAndLoad(SLING_M, hook_kg, load_kg, damping_ratio)
    tick_s = 2.0 * math.pi / w_rad_s / 200.0
    run = crane.simulate(np.zeros(2000), ROPE_M, tick_s=tick_s, hook_rad=shape[0], sling_rad=shape[1])
    damped = math.sqrt(1.0 - damping_ratio**2)
    phase = w_rad_s * run.time_s
    free = np.exp(-damping_ratio * phase) * (
        np.cos(damped * phase) + damping_ratio / damped * np.sin(damped * phase)
    )
    # Ten periods of at most 1e-4 rad: the nonlinearity is 1e-9 of it and the steps are late by 1e-5 rad.
    np.testing.assert_allclose(run.angles_rad, shape[:, np.newaxis] * free, rtol=0.0, atol=2e-9)


@pytest.mark.parametrize(("hook_kg", "load_kg"), MASSES_KG)
def test_modes_of_a_trajectory_are_those_of_the_design(hook_kg, load_kg):
    run = HookAndLoad(SLING_M, hook_kg, load_kg).simulate(np.zeros(2), ROPE_M, tick_s=0.01)
    modes = double_pendulum_modes(ROPE_M, SLING_M, hook_kg, load_kg)
    expected = [mode.angular_frequency_rad_s for mode in modes]
    np.testing.assert_allclose(run.mode_frequencies_rad_s[:, 0], expected, rtol=1e-13)  # roundings


@pytest.mark.parametrize(("hook_kg", "load_kg"), MASSES_KG)
def test_a_step_of_the_trolley_excites_both_modes_by_their_share(hook_kg, load_kg):
    run = HookAndLoad(SLING_M, hook_kg, load_kg).simulate(np.full(500, 1e-3), ROPE_M, tick_s=0.01)
    shares = np.array(double_pendulum_participation(ROPE_M, SLING_M, hook_kg, load_kg).load_ratio)
    expected = 1e-3 * abs(shares) / run.mode_frequencies_rad_s[:, 0]
    # Angles of 1e-4 rad, and steps that lose 7e-9 of the amplitude each.
    np.testing.assert_allclose(run.mode_amplitudes_m[:, -1], expected, rtol=1e-6)
    assert run.amplitude_m[-1] == pytest.approx(expected.sum(), rel=1e-6)
    assert run.residual_ratio(1e-3) == pytest.approx(1.0, rel=1e-6)


def test_energy_does_not_drift_at_large_angles():
    crane = HookAndLoad(SLING_M, 300.0, 500.0)
    run = crane.simulate(np.zeros(6000), ROPE_M, tick_s=0.01, hook_rad=0.6, sling_rad=-0.4)
    (hook, sling), (hook_rate, sling_rate) = run.angles_rad, run.angles_rad_s
    rope_m_s, sling_m_s = ROPE_M * hook_rate, SLING_M * sling_rate
    load_squared = rope_m_s**2 + sling_m_s**2 + 2.0 * rope_m_s * sling_m_s * np.cos(hook - sling)
    rise_m = 2.0 * ROPE_M * np.sin(0.5 * hook) ** 2
    load_rise_m = rise_m + 2.0 * SLING_M * np.sin(0.5 * sling) ** 2
    energy_j = 0.5 * 300.0 * rope_m_s**2 + 0.5 * 500.0 * load_squared
    energy_j += GRAVITY_M_S2 * (300.0 * rise_m + 500.0 * load_rise_m)
    # 6000 steps of 0.04 rad lose (w h)^6 / 72 of the energy each, 6e-11, in a motion that is not small.
    np.testing.assert_allclose(energy_j, energy_j[0], rtol=2e-6)


def test_a_hook_without_weight_swings_as_one_rope():
    """The load on rope and sling in a line is the simple pendulum of both lengths."""
    speeds = np.full(1000, 0.3)
    double = HookAndLoad(2.0, 1.0, 1e4).simulate(speeds, 4.0, tick_s=0.005, hold="line")
    single = HoistingCrane().simulate(speeds, 6.0, tick_s=0.005, hold="line")
    # The hook moves 1e-4 of the mass.
    np.testing.assert_allclose(double.sway_m, single.sway_m, rtol=0.0, atol=1e-3 * single.amplitude_m[-1])


def test_a_hoist_that_starts_with_a_jerk_kicks_a_bent_sling():
    ropes = np.interp(np.arange(201) * 1e-4, [0.0, 0.01, 0.02], [4.0, 4.0, 3.99])
    run = HookAndLoad(2.0, 500.0, 1000.0).simulate(
        np.zeros(200), ropes, tick_s=1e-4, hook_rad=0.1, sling_rad=-0.1
    )
    kicks = np.diff(run.angles_rad_s)[:, 100]
    share, difference = 2.0 / 3.0, run.angles_rad[0, 100] - run.angles_rad[1, 100]
    # From A + u cos(c) B = 0 and cos(c) A + B = -L' sin(c), the jump of L' being -1 m/s.
    sling_m_s = math.sin(difference) / (1.0 - share * math.cos(difference) ** 2)
    expected = [-share * math.cos(difference) * sling_m_s / 4.0, sling_m_s / 2.0]
    np.testing.assert_allclose(kicks, expected, rtol=5e-3)  # beside 1e-4 s of gravity


def test_sway_is_that_of_both_ropes():
    run = HookAndLoad(2.0, 500.0, 1000.0).simulate(
        np.zeros(1), 4.0, tick_s=0.01, hook_rad=0.3, sling_rad=-0.2
    )
    assert run.hook_sway_m[0] == pytest.approx(4.0 * math.sin(0.3), rel=1e-15)
    assert run.load_m[0] == pytest.approx(4.0 * math.sin(0.3) - 2.0 * math.sin(0.2), rel=1e-15)
