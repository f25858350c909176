from __future__ import annotations

import numpy as np
import pytest

from swayless.errors import PlantError
from swayless.plant.identification import Quantity, SwingRecord, identify_swing
from swayless.plant.identification.samples import Samples
from swayless.plant.identification.swing_model import SwingModel
from swayless.plant.identification.waveform import WAVEFORMS
from tests.unit.plant.identification.swings import Truth, pendulum_swing

FREQUENCY_HZ = 0.25
TIME_S = np.linspace(0.0, 120.0, 1201)


@pytest.mark.parametrize("quantity", WAVEFORMS)
@pytest.mark.parametrize(("damping_ratio", "angle_rad"), [(0.0, 0.7), (0.004, 0.35), (0.05, 0.6)])
def test_large_swings_give_the_frequency_of_small_ones(quantity, damping_ratio, angle_rad):
    value = pendulum_swing(TIME_S, FREQUENCY_HZ, damping_ratio, angle_rad, quantity)
    record = SwingRecord(TIME_S, value, quantity)
    mode = identify_swing(record, pendulum=True).modes[0]
    assert abs(mode.frequency_hz - FREQUENCY_HZ) < 2.0 * mode.frequency_hz_std
    assert abs(mode.damping_ratio - damping_ratio) < 2.0 * mode.damping_ratio_std
    # What is stated is small beside the correction of up to 3 %.
    assert mode.frequency_hz_std < 1e-3 * FREQUENCY_HZ
    linear = identify_swing(record, pendulum=False, modes=1).modes[0].frequency_hz
    slowest = angle_rad**2 / 16.0
    assert linear < FREQUENCY_HZ * (1.0 - 0.05 * slowest)


def test_an_angle_that_shows_its_lag_is_corrected_without_being_asked():
    noise = 0.01 * np.random.default_rng(0).normal(size=TIME_S.size)
    value = pendulum_swing(TIME_S, FREQUENCY_HZ, 0.004, 0.3) + noise
    found = identify_swing(SwingRecord(TIME_S, value, Quantity.angle))
    assert found.is_decided
    assert found.slowed_ratio == pytest.approx(0.3**2 / 16.0, rel=0.05)
    assert abs(found.modes[0].frequency_hz - FREQUENCY_HZ) < 3.5 * found.modes[0].frequency_hz_std


def test_an_angle_whose_frequency_stays_is_not_corrected():
    value = Truth(FREQUENCY_HZ, 0.004, 0.3).swing(TIME_S)
    found = identify_swing(SwingRecord(TIME_S, value, Quantity.angle))
    assert found.slowed_ratio == 0.0
    assert found.modes[0].frequency_hz == pytest.approx(FREQUENCY_HZ, rel=1e-9)


@pytest.mark.parametrize("is_pendulum", [False, True])
def test_what_the_record_leaves_open_is_covered(is_pendulum):
    noise = 0.02 * np.random.default_rng(0).normal(size=TIME_S.size)
    linear = Truth(FREQUENCY_HZ, 0.0, 0.2).swing(TIME_S)
    swing = pendulum_swing(TIME_S, FREQUENCY_HZ, 0.0, 0.2) if is_pendulum else linear
    found = identify_swing(SwingRecord(TIME_S, swing + noise, Quantity.angle))
    assert not found.is_decided
    assert found.modes[0].band().contains(FREQUENCY_HZ)


@pytest.mark.parametrize("is_pendulum", [False, True])
@pytest.mark.parametrize(("apart_hz", "second"), [(1 / 60, 0.5), (1 / 30, 0.5), (1 / 3, 0.2)])
def test_a_second_mode_does_not_hide_what_the_first_one_is(is_pendulum, apart_hz, second):
    time_s = np.arange(0.0, 60.0, 0.05)
    large = Truth(0.4, 0.005, 0.15)
    swing = pendulum_swing(time_s, 0.4, 0.005, 0.15) if is_pendulum else large.swing(time_s)
    small = Truth(0.4 + apart_hz, 0.005, 0.15 * second).swing(time_s)
    noise = 3e-4 * np.random.default_rng(98).normal(size=time_s.size)
    found = identify_swing(SwingRecord(time_s, swing + small + noise, Quantity.angle))
    mode = min(found.modes, key=lambda each: abs(each.frequency_hz - 0.4))
    # Taken for the other one it would be off by 24 of the stated deviations at least.
    assert abs(mode.frequency_hz - 0.4) < 3.0 * mode.frequency_hz_std
    assert found.is_decided is False or (found.slowed_ratio > 0.0) == is_pendulum


def test_fast_angles_are_those_of_arms():
    time_s = np.linspace(0.0, 10.0, 2001)
    value = Truth(4.0, 0.0, 0.5).swing(time_s) + 0.05 * np.random.default_rng(0).normal(size=2001)
    found = identify_swing(SwingRecord(time_s, value, Quantity.angle))
    assert (found.slowed_ratio, found.is_decided) == (0.0, True)


def test_no_load_on_a_rope_swings_beyond_the_horizontal():
    record = SwingRecord(TIME_S, Truth(FREQUENCY_HZ, 0.0, 3.0).swing(TIME_S), Quantity.angle)
    assert identify_swing(record).slowed_ratio == 0.0
    with pytest.raises(PlantError, match="would swing 172 deg: must be below 90: check the unit"):
        identify_swing(record, pendulum=True)


def test_a_pendulum_needs_a_unit():
    with pytest.raises(PlantError, match="say what unit the record is in"):
        identify_swing(SwingRecord(TIME_S, np.cos(TIME_S)), pendulum=True)


@pytest.mark.parametrize("waveform", [None, *WAVEFORMS.values()])
@pytest.mark.parametrize("decay_rad_s", [0.0, 0.03, -0.01])
def test_the_jacobian_is_that_of_the_model(waveform, decay_rad_s):
    samples = Samples.of_record(np.linspace(0.0, 20.0, 101), np.zeros(101))
    model = SwingModel(samples, modes=2, drift_degree=2, waveform=waveform)
    parameters = np.array([1.3, decay_rad_s, 0.3, 0.2, 2.1, 0.02, 0.1, -0.2, 0.1, 0.2, 0.3])
    _, jacobian = model.evaluate(parameters)
    steps = 1e-6 * np.eye(parameters.size)
    differences = [
        (model.evaluate(parameters + d)[0] - model.evaluate(parameters - d)[0]) / 2e-6 for d in steps
    ]
    # 1e-8: central differences of 1e-6 leave their square and rounding over the step.
    np.testing.assert_allclose(jacobian, np.stack(differences, axis=1), atol=1e-8)
