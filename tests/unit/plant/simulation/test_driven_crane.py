"""The driven crane against its linear model, and against the crane whose drive is ideal."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm

from swayless.plant.servo_drive import ServoDrive, servo_drive_mode
from swayless.plant.simulation import DrivenCrane, HoistingCrane
from tests.unit.plant.linear_drive import state_matrix

TICK_S = 0.01
ROPE_M = 4.0
DRIVES = [ServoDrive.from_lag(2000.0, 6000.0, 0.1), ServoDrive.from_lag(2000.0, 6000.0, 0.2, 0.5)]


@pytest.mark.parametrize("drive", DRIVES, ids=["P", "PI"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.05])
def test_small_moves_are_those_of_the_linear_model(drive, damping_ratio):
    reference = np.repeat([1e-3, 0.0, -5e-4], 400)
    run = DrivenCrane(drive, damping_ratio).simulate(reference, ROPE_M, tick_s=TICK_S)
    matrix = state_matrix(drive, ROPE_M, damping_ratio)
    inputs = np.array([drive.gain_n_s_m / drive.trolley_mass_kg, 1.0, 0.0, 0.0])
    inputs[3] = -inputs[0] / ROPE_M
    step = expm(TICK_S * np.block([[matrix, inputs[:, np.newaxis]], [np.zeros((1, 5))]]))
    states = [np.zeros(4)]
    for speed in reference:
        states.append((step @ [*states[-1], speed])[:4])
    expected = np.array(states).T
    # Steps of 0.4 time constants of the trolley err by 1e-4 of 1e-3 m/s as it starts, then less.
    np.testing.assert_allclose(run.trolley_m_s, expected[0], rtol=0.0, atol=2e-7)
    np.testing.assert_allclose(run.swing_rad, expected[2], rtol=0.0, atol=5e-9)


@pytest.mark.parametrize("drive", DRIVES, ids=["P", "PI"])
def test_the_swing_dies_out_as_its_true_mode_says(drive):
    mode = servo_drive_mode(drive, ROPE_M)
    tick_s = mode.damped_period_s / 100.0
    run = DrivenCrane(drive).simulate(np.full(1000, 0.01), ROPE_M, tick_s=tick_s)
    peaks = abs(run.swing_rad[400:-1]).reshape(6, 100).max(axis=1)  # of the fifth period and those after it
    ratio = mode.damping_ratio
    expected = math.exp(-2.0 * math.pi * ratio / math.sqrt(1.0 - ratio**2))
    # By then all else has died out to 1e-6 of the swing, which is small: 1e-3 rad.
    np.testing.assert_allclose(peaks[1:] / peaks[:-1], expected, rtol=1e-4)


def test_a_drive_of_no_lag_moves_the_load_as_an_ideal_one():
    rng = np.random.default_rng(1)
    reference, rope = np.repeat(rng.uniform(-0.5, 0.5, 8), 50), np.linspace(5.0, 3.0, 401)
    wind = 0.1 * rng.normal(size=400)
    ideal = HoistingCrane(0.01).simulate(reference, rope, tick_s=TICK_S, wind_m_s2=wind)
    errors = []
    for lag_s in (0.02, 0.005):
        driven = DrivenCrane(ServoDrive.from_lag(5000.0, 500.0, lag_s), 0.01)
        errors.append(
            abs(driven.simulate(reference, rope, tick_s=TICK_S, wind_m_s2=wind).sway_m - ideal.sway_m).max()
        )
    assert errors[0] < 0.02
    assert errors[1] == pytest.approx(errors[0] / 4.0, rel=0.1)  # of the first order in the lag


def test_the_hoist_jerks_the_trolley_by_the_pull_of_the_load():
    drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
    ropes = np.interp(np.arange(201) * 1e-4, [0.0, 0.01, 0.02], [4.0, 4.0, 3.99])
    run = DrivenCrane(drive).simulate(np.zeros(200), ropes, tick_s=1e-4, swing_rad=0.2)
    sine = math.sin(run.swing_rad[100])
    expected = 6000.0 * sine / (2000.0 + 6000.0 * sine**2)  # the jump of the hoist speed is -1 m/s
    assert np.diff(run.trolley_m_s)[100] == pytest.approx(expected, rel=5e-3)  # beside 1e-4 s of the rest


def test_wind_on_the_load_pushes_the_trolley_away_until_the_integral_holds_it():
    run = DrivenCrane(DRIVES[1], 0.05).simulate(np.zeros(6000), ROPE_M, tick_s=TICK_S, wind_m_s2=0.2)
    # At rest the integral carries the wind: K / T times the way = m f; the rest decays as exp(-0.1 w t).
    expected_m = 6000.0 * 0.2 / DRIVES[1].integral_gain_n_m
    assert run.trolley_m[-1] == pytest.approx(expected_m, rel=1e-3)
    assert run.trolley_m_s[-1] == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("drive", DRIVES, ids=["P", "PI"])
def test_the_amplitude_is_that_of_the_true_mode_from_the_first_tick_on(drive):
    """Whatever trolley and loop still do: once the reference stays it decays as the mode does."""
    run = DrivenCrane(drive, 0.01).simulate(np.full(600, 0.02), ROPE_M, tick_s=TICK_S)
    mode = servo_drive_mode(drive, ROPE_M, 0.01)
    decay = np.exp(-mode.damping_ratio * mode.angular_frequency_rad_s * run.time_s)
    steady = run.amplitude_rad[1:] / decay[1:]
    # A swing of 3 mrad is linear to 1e-6; first steps of half a time constant err by a few 1e-5.
    np.testing.assert_allclose(steady, steady[-1], rtol=1e-4)
    # Once all else has died out, it is what the swing's own peaks reach.
    quarter = round(0.5 * mode.damped_period_s / TICK_S)
    window = slice(600 - quarter, 600)
    envelope = run.amplitude_rad[window] / decay[window]
    assert (abs(run.swing_rad[window]) / decay[window]).max() == pytest.approx(envelope.mean(), rel=3e-3)


def test_the_amplitudes_of_many_cases_are_those_of_each_alone():
    references, ropes = np.array([[0.1] * 50, [0.3] * 50]), np.array([[4.0] * 51, np.linspace(5.0, 4.5, 51)])
    together = DrivenCrane(DRIVES[1]).simulate(references, ropes, tick_s=TICK_S).amplitude_m
    for case in (0, 1):
        alone = DrivenCrane(DRIVES[1]).simulate(references[case], ropes[case], tick_s=TICK_S).amplitude_m
        # 1e-6 m: the shorter rope among them makes the steps of all shorter.
        np.testing.assert_allclose(together[case], alone, rtol=0.0, atol=1e-6)


def test_there_is_no_amplitude_on_a_rope_on_which_nothing_vibrates():
    drive = ServoDrive.from_lag(100.0, 3000.0, 0.8)
    run = DrivenCrane(drive).simulate(np.full(5, 0.1), 1.2, tick_s=TICK_S)
    assert np.isnan(run.amplitude_rad).all()
