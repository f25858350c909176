"""What the adaptive shaper says of itself: when coefficients have converged, and when they do not fit."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.controller import number_type
from swayless.controller.adaptive import AdaptiveInput, AdaptiveSettings, AdaptiveShaper, AdaptiveStatus
from swayless.controller.adaptive.learner import Learner
from swayless.plant import Mode
from swayless.plant.simulation.flexible_robot import FlexibleRobot

DELAY, TICK_S = 4, 0.01
MISFIT = AdaptiveStatus.LEARNING_AGAIN | AdaptiveStatus.SET_REFUSED


def settings_of(**changes):
    values = {"max_command": 1.0, "vibration_scale": 1.0, "cycle_ticks": 100}
    return AdaptiveSettings(DELAY, TICK_S, **(values | changes))


class Rests:
    """A learner whose windows are made to order."""

    def __init__(self, max_reference=1.0):
        self.learner = Learner(settings_of(max_reference=max_reference))
        self.random = np.random.default_rng(1)

    def noise(self, *, in_use=True):
        """A window of noise above the dead zone: nothing to learn from."""
        self.window(0.01 * self.random.standard_normal((64, 3)), in_use=in_use)

    def swing(self, phase, *, in_use=True):
        """A window of free vibration, so many rad in a delay: an absolute sum of 1 from pi / 2 on."""
        times = np.arange(64)[:, None] / DELAY - np.arange(3)
        self.window(np.cos(phase * times), in_use=in_use)

    def window(self, samples, *, in_use):
        for v0, v1, v2 in samples.tolist():
            self.learner.learn(v0, v1, v2, in_use=in_use)

    @property
    def says(self):
        return self.learner.is_converged, self.learner.learns_again, self.learner.was_refused


CONVERGED, AGAIN, REFUSED, NOTHING = (
    (True, False, False),
    (False, True, False),
    (False, True, True),
    (False, False, False),
)


def learned(phase, max_reference=1.0):
    """Coefficients that have been confirmed by a move after which nothing was left."""
    rests = Rests(max_reference)
    rests.swing(phase)
    rests.learner.begin_rest()
    rests.noise()
    assert rests.says == CONVERGED
    return rests


@pytest.mark.parametrize(("phase", "said"), [(2.2, AGAIN), (1.0, REFUSED)])
def test_vibration_that_sinks_into_noise_during_a_rest_confirms_nothing(phase, said):
    rests = learned(1.8)
    for _ in range(2):
        rests.learner.begin_rest()
        rests.swing(phase)
    assert rests.says == said
    rests.noise()
    assert rests.learner.is_frozen
    assert rests.says == said


def test_no_single_rest_unseats_a_set_that_had_converged_and_two_in_a_row_do():
    rests = learned(1.8)
    before = rests.learner.coefficients
    rests.learner.begin_rest()
    for _ in range(3):
        rests.swing(2.2)
        assert (rests.says, rests.learner.coefficients) == (AGAIN, before)
    rests.learner.begin_rest()
    rests.swing(2.2)
    assert rests.says == AGAIN
    assert rests.learner.coefficients != before
    rests.swing(2.2)
    assert rests.says == CONVERGED


@pytest.mark.parametrize("phase", [1.8, None])
def test_a_rest_that_fits_or_leaves_nothing_restores_the_trust(phase):
    rests = learned(1.8)
    before = rests.learner.coefficients
    for _ in range(3):
        rests.learner.begin_rest()
        rests.swing(2.2)
        rests.learner.begin_rest()
        rests.swing(phase) if phase else rests.noise()
        assert rests.says == CONVERGED
    assert rests.learner.coefficients == pytest.approx(before, abs=1e-8)  # P(0) fades: 1e-7 beside a window


@pytest.mark.parametrize("phase", [2.2, 1.0])
def test_a_shaped_move_that_leaves_nothing_from_the_beginning_of_the_rest_confirms(phase):
    rests = learned(1.8)
    rests.learner.begin_rest()
    rests.swing(phase)
    rests.learner.begin_rest()
    rests.noise()
    assert rests.says == CONVERGED


def test_a_move_that_was_not_shaped_confirms_nothing():
    rests = Rests()
    rests.swing(1.8)
    rests.learner.begin_rest()
    rests.noise(in_use=False)
    assert rests.says == NOTHING


def test_a_rest_with_a_gap_in_the_readings_confirms_nothing():
    rests = Rests()
    rests.swing(1.8)
    rests.learner.begin_rest()
    rests.learner.interrupt()
    rests.noise()
    assert rests.says == NOTHING


EVENTS = st.sampled_from(["move", "gap", "noise", "unshaped noise", 1.0, 1.7, 1.8, 2.4])


@settings(derandomize=True, deadline=None, max_examples=60)
@given(events=st.lists(EVENTS, max_size=14), max_reference=st.sampled_from([1.0, 2.0]))
def test_converged_stands_beside_no_misfit_and_comes_from_a_fit_or_from_the_first_rest_after_a_shaped_move(
    events, max_reference
):
    rests, before = Rests(max_reference), None
    for event in events:
        was_converged = rests.learner.is_converged
        if event == "move":
            rests.learner.begin_rest()
        elif event == "gap":
            rests.learner.interrupt()
        elif isinstance(event, float):
            rests.swing(event)
        else:
            rests.noise(in_use=event == "noise")
            if rests.learner.is_converged and not was_converged:
                assert (before, event) == ("move", "noise")
        assert rests.says in {CONVERGED, AGAIN, REFUSED, NOTHING, (False, False, True)}
        before = event


@settings(derandomize=True, deadline=None, max_examples=25)
@given(
    cosines=st.tuples(st.floats(-0.9, 0.6), st.floats(-0.9, 0.6)),
    damping_ratio=st.floats(0.0, 0.1),
    noise=st.sampled_from([0.0, 0.02, 0.1]),
    max_reference=st.sampled_from([1.0, 3.0]),
    rests=st.lists(st.integers(2, 200), min_size=1, max_size=30),
    number=st.sampled_from(["double", "float"]),
)
def test_whatever_moves_and_payloads_come_converged_never_stands_beside_a_misfit(
    cosines, damping_ratio, noise, max_reference, rests, number
):
    block = settings_of(max_reference=max_reference, vibration_scale=60.0, number=number_type(number))
    shaper, random, scalar = AdaptiveShaper(block), np.random.default_rng(len(rests)), block.number.scalar
    modes = [Mode(math.acos(c) / (2 * math.pi * DELAY * TICK_S), damping_ratio) for c in cosines]
    robot, vibration = FlexibleRobot(modes[0], TICK_S), 0.0
    for index, ticks in enumerate(rests):
        if index == len(rests) // 2:
            robot.load(modes[1])
        for error in (60.0 * noise * random.standard_normal(ticks)).tolist():
            output = shaper.step(AdaptiveInput(scalar(index % 2), scalar(vibration + error)))
            vibration = robot.step(float(output.reference))
            assert not (output.converged and output.status & MISFIT)


@pytest.mark.parametrize("rest_ticks", [16, 17, 30, 80])
def test_rests_too_short_for_a_window_are_put_together(rest_ticks):
    mode, shaper = Mode(9.0, 0.002), AdaptiveShaper(settings_of(vibration_scale=60.0))
    robot, vibration, adapting = FlexibleRobot(mode, TICK_S), 0.0, 0
    for tick in range(3000):
        command = float(tick // (rest_ticks + 1) % 2)
        output = shaper.step(AdaptiveInput(command, vibration))
        vibration, adapting = robot.step(output.reference), adapting + output.adapting
    if rest_ticks == 16:  # four delays: nothing is left of them, but of the first one, before any move
        assert (adapting, output.coefficient[0]) == (1, pytest.approx(1 / 3))
    else:
        decay = math.exp(-0.002 * mode.angular_frequency_rad_s * DELAY * TICK_S)
        cosine = math.cos(2 * math.pi * DELAY * TICK_S / mode.damped_period_s)
        wanted = np.array([1.0, -2.0 * cosine * decay, decay**2]) / (1.0 - 2.0 * cosine * decay + decay**2)
        assert output.coefficient == pytest.approx(wanted, abs=1e-8)


@settings(derandomize=True, deadline=None, max_examples=20)
@given(parts=st.lists(st.integers(1, 60), max_size=20), seed=st.integers(0, 9))
def test_a_window_in_parts_teaches_bit_for_bit_what_it_teaches_in_one(parts, seed):
    samples = np.random.default_rng(seed).standard_normal((640, 2)).cumsum(axis=0) @ np.ones((2, 3))
    samples += np.cos(1.9 * np.arange(640))[:, None] * [1.0, -0.3, -0.8]
    whole, divided = Learner(settings_of(max_reference=8.0)), Learner(settings_of(max_reference=8.0))
    ends = set(np.cumsum(parts).tolist())
    divided.begin_rest()
    for tick, (v0, v1, v2) in enumerate(samples[:64].tolist()):
        if tick in ends:
            divided.begin_rest()
        whole.learn(v0, v1, v2, in_use=True)
        divided.learn(v0, v1, v2, in_use=True)
    assert whole.coefficients == divided.coefficients
