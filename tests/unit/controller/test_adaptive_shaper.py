"""The adaptive shaper as a block: its gain, its transfer, and inputs that cannot be right."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.controller import number_type
from swayless.controller.adaptive import (
    AdaptiveInput,
    AdaptiveSettings,
    AdaptiveShaper,
    AdaptiveStatus,
    explain_adaptive,
)
from swayless.errors import ControllerError
from swayless.plant import Mode
from tests.unit.controller.adaptive_moves import Experiment

ANY = st.one_of(st.floats(width=32), st.sampled_from([0.0, 1.0, -1.0, math.nan, math.inf, -math.inf, 1e300]))


def settings_of(**changes):
    values = {
        "delay_ticks": 4,
        "tick_s": 0.01,
        "max_command": 1.0,
        "vibration_scale": 1.0,
        "cycle_ticks": 100,
    }
    return AdaptiveSettings(**(values | changes))


@settings(derandomize=True, deadline=None, max_examples=30)
@given(
    moves=st.lists(st.tuples(ANY, ANY, st.booleans(), st.integers(1, 120)), max_size=12),
    phase=st.floats(0.0, 3.0),
    number=st.sampled_from(["double", "float"]),
)
def test_whatever_comes_in_the_reference_stays_within_the_drive_and_the_gain_is_exactly_1(
    moves, phase, number
):
    scalar = number_type(number).scalar
    block = settings_of(max_reference=4.0, cycle_ticks=20, number=number_type(number))
    shaper, tick = AdaptiveShaper(block), 0
    with np.errstate(over="ignore"):  # 1e300 is infinite in float, which is the point
        for command, vibration, enable, ticks in moves:
            for n in range(ticks):
                reading = vibration if n < 3 else math.cos(phase * tick)
                output = shaper.step(AdaptiveInput(scalar(command), scalar(reading), enable))
                tick += 1
                assert abs(output.reference) <= 4.0 * (1.0 + 1e-6)  # products are rounded
                assert sum(Fraction(float(c)) for c in output.coefficient) == 1


def test_the_reference_is_the_command_until_the_first_cycle_has_passed():
    experiment = Experiment()
    experiment.run(1)
    assert experiment.status[0] & AdaptiveStatus.UNSHAPED
    assert experiment.error() < 1e-8  # learned, and not yet used
    shaper, c0 = experiment.shaper, experiment.coefficients[-1][0]
    assert not shaper.step(AdaptiveInput(0.0, experiment.vibration)).status & AdaptiveStatus.UNSHAPED
    assert shaper.step(AdaptiveInput(0.25, 0.0)).reference == 0.25 * c0


def test_coefficients_change_only_where_the_reference_is_the_command_bit_for_bit():
    experiment = Experiment(noise=0.2)
    experiment.run(1)
    shaper, changes, before = experiment.shaper, 0, None
    for command in experiment.cycle:
        output = shaper.step(
            AdaptiveInput(command, experiment.vibration + 0.2 * experiment.random.standard_normal())
        )
        experiment.vibration = experiment.robot.step(output.reference)
        if before is not None and shaper._used != before:
            changes += 1
            assert output.reference == command
        before = shaper._used
    assert changes > 2


def test_disabled_it_passes_the_command_from_rest_on_and_learns_nothing():
    experiment = Experiment()
    experiment.run(2)
    shaper, learned = experiment.shaper, experiment.coefficients[-1].tolist()
    for command in (0.5, -0.5):
        output = shaper.step(AdaptiveInput(command, 0.0, enable=False))
        assert output.reference != command  # shaped until the command has rested
    assert output.status & AdaptiveStatus.DISABLED
    for _ in range(60):
        output = shaper.step(AdaptiveInput(-0.5, 0.3, enable=False))
    assert shaper.step(AdaptiveInput(0.7, 0.0, enable=False)).reference == 0.7
    assert list(output.coefficient) == learned
    assert not output.adapting


@pytest.mark.parametrize("command", [math.nan, math.inf, -math.inf])
def test_a_command_that_is_not_finite_holds_the_last(command):
    shaper = AdaptiveShaper(settings_of())
    shaper.step(AdaptiveInput(0.5, 0.0))
    output = shaper.step(AdaptiveInput(command, 0.0))
    assert output.reference == 0.5
    assert output.status & AdaptiveStatus.COMMAND_INVALID


def test_a_command_beyond_the_maximum_is_clamped():
    output = AdaptiveShaper(settings_of()).step(AdaptiveInput(-1.5, 0.0))
    assert (output.reference, output.status) == (
        -1.0,
        AdaptiveStatus.COMMAND_CLAMPED | AdaptiveStatus.UNSHAPED,
    )


@pytest.mark.parametrize("vibration", [math.nan, math.inf, 101.0])
def test_a_vibration_that_cannot_be_right_stops_learning_until_two_delays_are_clean(vibration):
    block = settings_of()
    shaper = AdaptiveShaper(block)
    for _ in range(block.quiet_ticks):
        output = shaper.step(AdaptiveInput(0.0, 0.5))
    assert output.adapting
    output = shaper.step(AdaptiveInput(0.0, vibration))
    assert not output.adapting
    assert output.status & AdaptiveStatus.VIBRATION_INVALID
    adapting = [shaper.step(AdaptiveInput(0.0, 0.5)).adapting for _ in range(block.quiet_ticks)]
    assert adapting == [False] * (block.quiet_ticks - 1) + [True]


def test_the_block_adapts_only_after_the_command_has_rested_for_four_delays_and_a_tick():
    block = settings_of(lag_ticks=3)
    shaper = AdaptiveShaper(block)
    adapting = [shaper.step(AdaptiveInput(1.0, 0.0)).adapting for _ in range(30)]
    assert adapting.index(True) == 4 * 4 + 1 + 3


def test_the_window_spans_eight_delays_or_64_ticks():
    assert [settings_of(delay_ticks=n).window_ticks for n in (1, 4, 25)] == [64, 64, 200]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"number": number_type("int32")}, "number = 'int32': must be double or float"),
        ({"delay_ticks": 0}, "delay_ticks = 0: must be from 1 to 125000"),
        ({"cycle_ticks": -1}, "cycle_ticks = -1: must be from 1"),
        ({"lag_ticks": 10**7}, "lag_ticks = 10000000: must be from 0 to 1000000"),
        ({"tick_s": math.nan}, "tick_s = nan: must be from"),
        ({"max_command": 0.0}, "max_command = 0.0: must be from"),
        ({"vibration_scale": math.inf}, "vibration_scale = inf: must be from"),
        ({"max_reference": 0.5}, "max_reference = 0.5: must be from max_command = 1.0 to 8 times that"),
        ({"dead_zone_ratio": 2.0}, "dead_zone_ratio = 2.0: must be from 0 to 1"),
        ({"mode": Mode(25.0)}, "|cos(w Td)| = 1 of the vibration of 25 Hz: must be at most 0.95"),
        ({"mode": Mode(12.5)}, "delays such as 0.02 to 0.03 s can be learned"),
        ({"mode": Mode(5.0)}, "amplitudes of 0.72361, -0.44721 and 0.72361"),
        ({"mode": Mode(5.0, 0.1)}, "with max_reference = 1 times max_command delays such as 0.06 to 0.09 s"),
        (
            {"mode": Mode(49.9)},
            "delays from 0.00501 to 0.0090072 s can be learned, which no whole number of ",
        ),
        ({"mode": Mode(1.0), "max_reference": 8.0}, "|cos(w Td)| = 0.96858"),
        ({"mode": Mode(2.6), "max_reference": 8.0}, "which take max_reference = 8.7"),
    ],
)
def test_what_cannot_run_is_refused(changes, message):
    with pytest.raises(ControllerError) as refused:
        settings_of(**changes)
    assert message in str(refused.value)


def test_every_bit_is_explained():
    assert all(explain_adaptive(bit) for bit in AdaptiveStatus)
