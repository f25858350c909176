"""The steps through the ticks: their order, and one case against many."""

from __future__ import annotations

import math
import timeit

import numpy as np
import pytest

from swayless.plant.servo_drive import ServoDrive
from swayless.plant.simulation import DrivenCrane, HoistingCrane, HookAndLoad
from swayless.plant.simulation.crane_ticks import crane_inputs
from swayless.plant.simulation.integration import integrate, steps_per_tick

DRIVE = ServoDrive.from_lag(2000.0, 6000.0, 0.1, 1.0)
CRANES = [HoistingCrane(0.01), DrivenCrane(DRIVE, 0.01), HookAndLoad(2.0, 500.0, 1000.0, 0.01)]
NAMES = ["hoisting", "driven", "hook and load"]
STATES = [2, 5, 4]


@pytest.mark.parametrize(("crane", "numbers"), list(zip(CRANES, STATES, strict=True)), ids=NAMES)
def test_halving_the_step_divides_the_error_by_sixteen(crane, numbers):
    speeds, ropes = np.linspace(0.0, 2.0, 41)[1:], np.linspace(4.0, 3.0, 41)
    inputs = crane_inputs(speeds, ropes, 0.05, 0.1, "line")
    start = [0.1] * numbers
    ends = [integrate(crane, start, inputs.ticks, 0.1, steps)[:, -1] for steps in (2, 4, 64)]
    errors = [abs(end - ends[-1]).max() for end in ends[:2]]
    # Order 4; the error's next term still counts for a fifth at steps of this size.
    assert math.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.35)


@pytest.mark.parametrize("crane", CRANES, ids=NAMES)
@pytest.mark.parametrize("hold", ["step", "line"])
def test_many_cases_at_once_give_what_each_gives_alone(crane, hold):
    rng = np.random.default_rng(5)
    reference = rng.uniform(-0.5, 0.5, (3, 40))
    rope, wind = (
        np.linspace([[3.0], [5.0], [9.0]], [[4.0], [4.0], [4.0]], 41, axis=-1)[:, 0],
        rng.normal(size=40),
    )
    many = crane.simulate(reference, rope, tick_s=0.05, hold=hold, wind_m_s2=0.1 * wind)
    assert many.load_m.shape == (3, 41)
    for case in range(3):
        alone = crane.simulate(reference[case], rope[case], tick_s=0.05, hold=hold, wind_m_s2=0.1 * wind)
        # The steps of all cases are those of the shortest rope: 1e-8 of the swing, beside rounding.
        np.testing.assert_allclose(many.load_m[case], alone.load_m, rtol=0.0, atol=1e-7)
        np.testing.assert_allclose(many.trolley_m_s[case], alone.trolley_m_s, rtol=0.0, atol=1e-7)


def test_one_rope_or_one_reference_serves_all_cases():
    crane = HoistingCrane()
    one = crane.simulate(np.full(10, 0.5), np.array([[3.0], [6.0]]), tick_s=0.1)
    other = crane.simulate(np.full((2, 10), 0.5), np.full(11, 3.0), tick_s=0.1)
    assert one.sway_m.shape == other.sway_m.shape == (2, 11)
    np.testing.assert_allclose(one.sway_m[0], other.sway_m[1], rtol=0.0, atol=1e-15)  # a few roundings


@pytest.mark.parametrize("crane", CRANES, ids=NAMES)
def test_steps_follow_the_fastest_vibration_whatever_the_tick(crane):
    """A tick of 0.2 s is cut into steps as fine as those of short ticks."""
    coarse = crane.simulate(np.full(50, 0.5), 4.0, tick_s=0.2)
    fine = crane.simulate(np.full(10000, 0.5), 4.0, tick_s=0.001)
    # 500 steps of 0.1 rad at most, each 8e-8 rad late, of a sway of 0.3 m; the trolley's decay, 2e-6 m.
    np.testing.assert_allclose(coarse.sway_m, fine.sway_m[::200], rtol=0.0, atol=1.5e-5)


def test_steps_follow_a_light_trolley_that_swings_against_a_heavy_load():
    crane = DrivenCrane(ServoDrive(10.0, 1000.0, 1.0))  # ten times as fast as the load on a held trolley
    coarse = crane.simulate(np.zeros(20), 4.0, tick_s=0.5, swing_rad=0.01)
    fine = crane.simulate(np.zeros(10000), 4.0, tick_s=0.001, swing_rad=0.01)
    # 160 rad in steps of 0.1 rad are late by 1.3e-4 rad, of 0.01 rad.
    np.testing.assert_allclose(coarse.swing_rad, fine.swing_rad[::500], rtol=0.0, atol=2e-6)


def test_a_tick_needs_at_least_one_step():
    assert steps_per_tick(1e-6, 1.0) == 1
    assert steps_per_tick(1.0, 0.1) == 1
    assert steps_per_tick(1.0, 0.1 + 1e-12) == 2
    assert steps_per_tick(0.01, 1.0, decay_per_s=250.0) == 5


def test_simulating_is_two_hundred_times_faster_than_real_time():
    crane, reference = HoistingCrane(0.004), np.full(1000, 0.5)  # 10 s on 10 ms
    seconds = min(timeit.repeat(lambda: crane.simulate(reference, 8.0, tick_s=0.01), number=1, repeat=5))
    assert seconds < 10.0 / 200.0
