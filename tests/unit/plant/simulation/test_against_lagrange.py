"""Every crane, under steps, ramps, hoisting and wind, against equations put together by derivatives."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import sqrtm

from swayless.plant.servo_drive import ServoDrive
from swayless.plant.simulation import DrivenCrane, HoistingCrane, HookAndLoad
from tests.unit.plant.simulation.lagrange import GRAVITY_M_S2, LENGTH, ROPE, SLING, TROLLEY, Mechanism

TICK_S = 0.5  # long: some ten steps within a tick
TICKS = 16
RNG = np.random.default_rng(11)
REFERENCE_M_S = np.cumsum(RNG.normal(size=TICKS)) * 0.2
ROPE_LENGTH_M = 5.0 + np.concatenate([[0.0], np.cumsum(RNG.uniform(-0.3, 0.3, TICKS)) * TICK_S])
WIND_M_S2 = RNG.uniform(-0.3, 0.3, TICKS)
DRIVE = ServoDrive(2000.0, 6000.0, 30e3, 0.8)
SLING_M, HOOK_KG, LOAD_KG = 2.0, 500.0, 1000.0
START_RAD = 0.3


def told_ticks(hold: str, load_mass_kg: float) -> np.ndarray:
    """The same inputs as rows (jump, reference, slope, hoist speed, wind in N)."""
    before = np.concatenate([[0.0], REFERENCE_M_S[:-1]])
    steps = REFERENCE_M_S - before
    hoist = np.diff(ROPE_LENGTH_M) / TICK_S
    wind = load_mass_kg * WIND_M_S2
    if hold == "step":
        return np.column_stack([steps, REFERENCE_M_S, np.zeros(TICKS), hoist, wind])
    return np.column_stack([np.zeros(TICKS), before, steps / TICK_S, hoist, wind])


def simulated(crane, hold: str, **start):
    return crane.simulate(
        REFERENCE_M_S, ROPE_LENGTH_M, tick_s=TICK_S, hold=hold, wind_m_s2=WIND_M_S2, **start
    )


@pytest.mark.parametrize("hold", ["step", "line"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_hoisting_crane_obeys_lagrange(hold, damping_ratio):
    def drag(y, rates):
        return np.array(
            [0.0, 2.0 * damping_ratio * np.sqrt(GRAVITY_M_S2 / y[LENGTH]) * rates[ROPE], 0.0, 0.0]
        )

    mechanism = Mechanism((1.0, 0.0, 1.0), 0.0, (ROPE,), drag=drag)
    start = np.array([0.0, START_RAD, 0.0, ROPE_LENGTH_M[0]])
    expected = mechanism.run(start, told_ticks(hold, 1.0), TICK_S)
    run = simulated(HoistingCrane(damping_ratio), hold, swing_rad=START_RAD)
    # Steps of 0.1 rad err by 8e-8 rad of phase each, 120 of them in 8 s at 1.5 rad/s, of 0.4 rad.
    np.testing.assert_allclose(run.swing_rad, expected[ROPE], rtol=0.0, atol=4e-6)
    np.testing.assert_allclose(run.trolley_m, expected[TROLLEY], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(run.rope_length_m, expected[LENGTH], rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("hold", ["step", "line"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_driven_crane_obeys_lagrange(hold, damping_ratio):
    def force(y, rates, reference, travel):
        drive_n = DRIVE.gain_n_s_m * (reference - rates[TROLLEY])
        drive_n += DRIVE.integral_gain_n_m * (travel - y[TROLLEY])
        rope_m = y[LENGTH]
        moment = 2.0 * damping_ratio * DRIVE.load_mass_kg * np.sqrt(GRAVITY_M_S2 * rope_m**3) * rates[ROPE]
        return np.array([drive_n, -moment, 0.0, 0.0])

    masses = (DRIVE.trolley_mass_kg, 0.0, DRIVE.load_mass_kg)
    mechanism = Mechanism(masses, 0.0, (TROLLEY, ROPE), force_n=force)
    start = np.array([0.0, START_RAD, 0.0, ROPE_LENGTH_M[0]])
    expected = mechanism.run(start, told_ticks(hold, DRIVE.load_mass_kg), TICK_S)
    run = simulated(DrivenCrane(DRIVE, damping_ratio), hold, swing_rad=START_RAD)
    # As above, and with half a time constant of the trolley's own (67 ms) a step, on 10 us of what decays.
    np.testing.assert_allclose(run.swing_rad, expected[ROPE], rtol=0.0, atol=2e-6)
    np.testing.assert_allclose(run.trolley_m, expected[TROLLEY], rtol=0.0, atol=2e-6)


@pytest.mark.parametrize("hold", ["step", "line"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_hook_and_load_obey_lagrange(hold, damping_ratio):
    share = LOAD_KG / (HOOK_KG + LOAD_KG)

    def drag(y, rates):
        mass = np.array([[y[LENGTH], share * SLING_M], [y[LENGTH], SLING_M]])
        stiffness = np.linalg.solve(mass, GRAVITY_M_S2 * np.eye(2))
        return np.concatenate([[0.0], 2.0 * damping_ratio * sqrtm(stiffness) @ rates[[ROPE, SLING]], [0.0]])

    mechanism = Mechanism((1.0, HOOK_KG, LOAD_KG), SLING_M, (ROPE, SLING), drag=drag)
    start = np.array([0.0, START_RAD, -0.5 * START_RAD, ROPE_LENGTH_M[0]])
    expected = mechanism.run(start, told_ticks(hold, LOAD_KG), TICK_S)
    crane = HookAndLoad(SLING_M, HOOK_KG, LOAD_KG, damping_ratio)
    run = simulated(crane, hold, hook_rad=START_RAD, sling_rad=-0.5 * START_RAD)
    # The upper vibration, at 5 rad/s, takes 400 steps of 0.1 rad in 8 s, each 8e-8 rad late.
    np.testing.assert_allclose(run.angles_rad, expected[[ROPE, SLING]], rtol=0.0, atol=1e-5)
    load_m = expected[TROLLEY] + expected[LENGTH] * np.sin(expected[ROPE]) + SLING_M * np.sin(expected[SLING])
    np.testing.assert_allclose(run.load_m, load_m, rtol=0.0, atol=5e-5)
