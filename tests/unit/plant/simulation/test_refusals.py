"""What simulated plants refuse, and how they say so."""

from __future__ import annotations

import math

import numpy as np
import pytest

from swayless.errors import PlantError
from swayless.plant.servo_drive import ServoDrive, servo_drive_mode
from swayless.plant.simulation import (
    DrivenCrane,
    FlexibleArm,
    HoistingCrane,
    HookAndLoad,
    drag_m_s2,
    dryden_gusts,
    one_cosine_gust,
)

SPEEDS = np.full(10, 0.5)
CRANE = HoistingCrane()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"reference_m_s": [0.1, math.nan]}, r"reference_m_s = nan: must be finite"),
        ({"reference_m_s": []}, r"reference_m_s of shape \(0,\): must be \(ticks,\) or \(cases, ticks\)"),
        ({"reference_m_s": 0.5}, r"reference_m_s of shape \(\): must be"),
        ({"rope_length_m": math.inf}, r"rope_length_m = inf: must be finite"),
        ({"rope_length_m": [4.0] * 10 + [0.0]}, r"rope_length_m = 0.0: must be > 0 at every tick"),
        ({"rope_length_m": [4.0] * 10}, r"rope_length_m of shape \(10,\): must be one number, or end in 11"),
        ({"wind_m_s2": [0.0] * 11}, r"wind_m_s2 of shape \(11,\): must be one number, or end in 10"),
        ({"rope_length_m": np.full((3, 1), 4.0), "wind_m_s2": np.zeros((2, 1))}, r"must have as many cases"),
        ({"tick_s": 0.0}, r"tick_s = 0.0: must be finite and > 0"),
        ({"tick_s": math.nan}, r"tick_s = nan: must be finite and > 0"),
        ({"swing_rad": math.nan}, r"state at the beginning = \(nan, 0.0\): must be finite"),
        ({"hold": "spline"}, r"hold = 'spline': must be 'step' or 'line'"),
    ],
)
def test_bad_inputs_of_a_crane_are_refused(arguments, message):
    given = {"reference_m_s": SPEEDS, "rope_length_m": 4.0, "tick_s": 0.01} | arguments
    reference, rope = given.pop("reference_m_s"), given.pop("rope_length_m")
    with pytest.raises(PlantError, match=message):
        CRANE.simulate(reference, rope, **given)


@pytest.mark.parametrize("crane", [CRANE, HookAndLoad(1.0, 10.0, 10.0)], ids=["rope", "sling"])
def test_a_swing_to_the_horizontal_is_refused(crane):
    with pytest.raises(PlantError, match=r"to the horizontal at .* s: it must stay below 90 degrees"):
        crane.simulate(np.full(200, 15.0), 4.0, tick_s=0.01)


@pytest.mark.parametrize("damping_ratio", [-0.1, 1.0, math.nan])
def test_a_damping_ratio_that_does_not_vibrate_is_refused(damping_ratio):
    drive = ServoDrive(1.0, 1.0, 1.0)
    for make in (
        lambda: HoistingCrane(damping_ratio),
        lambda: DrivenCrane(drive, damping_ratio),
        lambda: HookAndLoad(1.0, 1.0, 1.0, damping_ratio),
        lambda: FlexibleArm(1.0, 1.0, damping_ratio),
        lambda: servo_drive_mode(drive, 4.0, damping_ratio),
    ):
        with pytest.raises(PlantError, match=r"damping_ratio = .*: must be at least 0 and below 1"):
            make()


@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
def test_masses_lengths_and_gains_that_are_not_finite_and_positive_are_refused(value):
    for make in (
        lambda: ServoDrive(value, 1.0, 1.0),
        lambda: ServoDrive(1.0, value, 1.0),
        lambda: ServoDrive(1.0, 1.0, value),
        lambda: ServoDrive.from_lag(1.0, 1.0, value),
        lambda: HookAndLoad(value, 1.0, 1.0),
        lambda: HookAndLoad(1.0, value, 1.0),
        lambda: HookAndLoad(1.0, 1.0, value),
        lambda: FlexibleArm(value, 1.0),
        lambda: FlexibleArm(1.0, value),
        lambda: FlexibleArm.over_circle(1.0, 2.0, value),
        lambda: drag_m_s2(1.0, area_m2=value, drag_coefficient=1.0, load_mass_kg=1.0),
        lambda: drag_m_s2(1.0, area_m2=1.0, drag_coefficient=value, load_mass_kg=1.0),
        lambda: drag_m_s2(1.0, area_m2=1.0, drag_coefficient=1.0, load_mass_kg=value),
        lambda: one_cosine_gust(3, tick_s=value, start_s=0.0, duration_s=1.0, peak_m_s=1.0),
        lambda: one_cosine_gust(3, tick_s=1.0, start_s=0.0, duration_s=value, peak_m_s=1.0),
        lambda: dryden_gusts(3, tick_s=value, mean_m_s=1.0, deviation_m_s=1.0, length_m=1.0, seed=0),
        lambda: dryden_gusts(3, tick_s=1.0, mean_m_s=value, deviation_m_s=1.0, length_m=1.0, seed=0),
        lambda: dryden_gusts(3, tick_s=1.0, mean_m_s=1.0, deviation_m_s=1.0, length_m=value, seed=0),
        lambda: CRANE.simulate(SPEEDS, 4.0, tick_s=0.01).residual_ratio(value),
    ):
        with pytest.raises(PlantError, match=r"must be finite and > 0"):
            make()


def test_a_loop_without_integral_has_an_infinite_integral_time_and_none_that_is_not_positive():
    for value in (0.0, -1.0, math.nan):
        with pytest.raises(PlantError, match=r"integral_time_s = .*: must be > 0"):
            ServoDrive(1.0, 1.0, 1.0, value)


def test_negative_deviations_and_falling_frequencies_are_refused():
    with pytest.raises(PlantError, match=r"deviation_m_s = -1.0: must be finite and >= 0"):
        dryden_gusts(3, tick_s=1.0, mean_m_s=1.0, deviation_m_s=-1.0, length_m=1.0, seed=0)
    with pytest.raises(PlantError, match=r"5.5 to 3.7 Hz: must be finite, > 0 and rising"):
        FlexibleArm.over_circle(5.5, 3.7, 1.0)


def test_a_drive_too_soft_for_any_vibration_has_no_mode():
    with pytest.raises(PlantError, match=r"gain_n_s_m = 45.0: .* nothing vibrates; a mode needs a stiffer"):
        servo_drive_mode(ServoDrive(1.0, 250.0, 45.0), 9.80665)


@pytest.mark.parametrize("reach_m", [np.ones(10), np.ones((2, 11)), 1.0])
def test_an_arm_needs_a_reach_at_both_ends_of_every_tick(reach_m):
    with pytest.raises(PlantError, match=r"command_m of shape \(10,\) and reach_m of .*: must be one longer"):
        FlexibleArm(1.0, 1.0).simulate(SPEEDS, reach_m, tick_s=0.01)


def test_an_arm_needs_a_positive_reach():
    with pytest.raises(PlantError, match=r"reach_m = -1.0: must be > 0 at every tick"):
        FlexibleArm(1.0, 1.0).simulate(SPEEDS, np.full(11, -1.0), tick_s=0.01)
