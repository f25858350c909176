"""From SI units to the constants of the operator's functions, and what is refused on the way."""

from dataclasses import replace

import pytest

from swayless.controller import OperatorOptions, OperatorSettings, Status, operator_settings
from swayless.errors import ControllerError
from tests.unit.controller.blocks import COUNTS_PER_M_S, TICK_S, UM_ZV, ZVD, block
from tests.unit.controller.operator_blocks import block_of, operated

UNRAMPED = {"acceleration_m_s2": None, "deceleration_m_s2": None, "quick_stop_m_s2": None}


def made(settings, **options):
    """The constants for a block."""
    return operator_settings(OperatorOptions(**options), settings.bank, settings.limits)


def test_without_options_a_block_has_no_function_and_no_bit_more():
    settings = block(ZVD)
    assert made(settings) == settings.operator == OperatorSettings()
    assert settings.operator.status_bits == Status(0)
    assert operated(settings).status_bits == settings.status_bits


def test_each_function_brings_its_own_status_bits():
    settings = operated(block_of("phase", "double"), step_sizes_m=(0.1, 0.2, 0.4), rope_offset_m=(-1.0, 1.0))
    added = set(settings.status_bits) - set(block_of("phase", "double").status_bits)
    assert added == {
        Status.STEPPING,
        Status.STEP_REFUSED,
        Status.STEP_SIZE_INVALID,
        Status.COMMAND_LOCKED,
        Status.ROPE_OFFSET_INVALID,
    }


@pytest.mark.parametrize("number", ["double", "float"])
def test_float_steps_are_the_ways_of_the_file_over_command_and_tick(number):
    steps = made(block(ZVD, number=number), step_sizes_m=(0.1, 0.25, 1.0)).steps
    for size, asked_m in zip(steps.sizes, (0.1, 0.25, 1.0), strict=True):
        # 16 of the largest are 24 or 53 bits less 2 of the unit: an eighth of 2**-18 of the smallest at most.
        assert float(size) * TICK_S == pytest.approx(asked_m, rel=1e-5 if number == "float" else 1e-13)
    assert steps.capacity == 16 * steps.sizes[2]


def test_int32_steps_are_whole_and_of_rows_that_wait_multiples_of_their_hold():
    exact = COUNTS_PER_M_S / TICK_S
    assert made(block(ZVD, number="int32"), step_sizes_m=(0.1, 0.2, 0.4)).steps.sizes == (
        0.1 * exact,
        0.2 * exact,
        0.4 * exact,
    )
    waiting = block(UM_ZV, number="int32")
    sizes = made(waiting, step_sizes_m=(0.1, 0.2, 0.4)).steps.sizes
    assert all(size % (waiting.longest_delay_ticks + 2) == 0 for size in sizes)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"step_sizes_m": (0.1, 0.2)}, "three ways"),
        ({"step_sizes_m": (0.1, 0.2, -0.3)}, "three ways"),
        ({"step_sizes_m": (0.1, 0.2, float("nan"))}, "three ways"),
        ({"step_speed_m_s": 0.2}, "needs step_sizes_m"),
        ({"step_sizes_m": (0.1, 0.2, 0.3), "step_speed_m_s": 0.6}, "at most max_speed_m_s = 0.5"),
        ({"slow_speed_m_s": 0.0}, "must be finite and > 0"),
        ({"slow_speed_m_s": 0.51}, "at most max_speed_m_s = 0.5"),
        ({"limit_margin_m": -0.1}, "finite and >= 0"),
        ({"contactor_speeds_m_s": (0.5, 0.1)}, "one or two, rising"),
        ({"contactor_speeds_m_s": (0.1, 0.2, 0.5)}, "one or two, rising"),
        ({"contactor_speeds_m_s": (0.5,), "drive_feedback": True}, "drive_feedback"),
        ({"contactor_speeds_m_s": (0.5,), "step_sizes_m": (0.1, 0.2, 0.3)}, "step_sizes_m"),
        ({"contactor_speeds_m_s": (0.5,), "speed_limit": True}, "speed_limit"),
        ({"contactor_speeds_m_s": (0.4,)}, "the last one must be max_speed"),
        ({"rope_offset_m": (0.1, 0.2)}, "a range around 0"),
    ],
)
def test_what_cannot_be_is_refused_with_what_is_allowed(options, said):
    with pytest.raises(ControllerError, match=said):
        made(block(ZVD), **options)


def test_counts_too_coarse_for_a_step_are_refused():
    with pytest.raises(ControllerError, match=r"step_sizes_m: 0\.0001 m is not within 0\.1%.*counts_per_m_s"):
        made(block(UM_ZV, number="int32"), step_sizes_m=(0.0001, 0.2, 0.3))


def test_a_rope_offset_needs_a_measured_rope():
    with pytest.raises(ControllerError, match="rope_offset_m: needs a measured rope"):
        operated(block(ZVD), rope_offset_m=(-1.0, 1.0))


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (block(ZVD, **UNRAMPED), r'row "row 1": a contactor drive takes amplitudes \+1, -1'),
        (block(UM_ZV), "no ramps"),
        (block(UM_ZV, inching_speed_m_s=0.2, **UNRAMPED), "inches at one of its speeds"),
    ],
)
def test_rows_and_limits_that_a_contactor_drive_cannot_make_are_refused(settings, said):
    with pytest.raises(ControllerError, match=said):
        operated(settings, contactor_speeds_m_s=(0.1, 0.5))


def test_a_slow_speed_that_no_contactor_has_is_the_next_below_or_refused():
    settings = block(UM_ZV, **UNRAMPED)
    assert made(settings, contactor_speeds_m_s=(0.1, 0.5), slow_speed_m_s=0.3).slow_command == 0.1
    with pytest.raises(ControllerError, match="below the slowest"):
        operated(settings, contactor_speeds_m_s=(0.1, 0.5), slow_speed_m_s=0.05)


def test_ways_beyond_every_stop_count_as_the_farthest_and_int32_ones_fit_in_64_bits():
    for number in ("double", "float", "int32"):
        way = made(block(ZVD, number=number), limit_margin_m=0.5).way
        per_m = 1000 if number == "int32" else 1
        assert way.budget(way.margin) == 0
        assert way.budget(type(way.margin)(0)) == 0
        assert way.budget(way.margin + 2 * way.farthest) == way.most
        one = way.budget(way.margin + per_m)
        scale = COUNTS_PER_M_S if number == "int32" else 1.0
        assert float(one) == pytest.approx(scale / TICK_S, rel=1e-6)
        assert number != "int32" or way.farthest * way.scale < 1 << 62


def test_functions_are_part_of_the_settings_and_equal_by_value():
    settings = operated(block(ZVD), stop_switches=True)
    assert settings.operator == replace(OperatorSettings(), has_stop_switches=True)
    assert settings.operator.has_switches
    assert settings.operator.locks
