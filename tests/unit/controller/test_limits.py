"""Limits of a machine in a number type, and what cannot be told in one."""

import math
import re
from fractions import Fraction

import pytest

from swayless.controller import SpeedLimits, command_limits, number_type
from swayless.errors import ControllerError


def limits(number, *, tick_s=0.01, **speeds):
    return command_limits(SpeedLimits(**speeds), tick_s=tick_s, number=number_type(number))


@pytest.mark.parametrize("number", ["double", "float"])
@pytest.mark.parametrize("max_speed_m_s", [0.5, 0.7, 1.0, 1.9999, 31.4])
@pytest.mark.parametrize("ticks", [1.5, 7, 100, 1000])
def test_float_steps_are_rounded_up_to_the_grid_of_two_last_places(number, max_speed_m_s, ticks):
    made = limits(number, max_speed_m_s=max_speed_m_s, acceleration_m_s2=max_speed_m_s / ticks / 0.01)
    bits = number_type(number).significand_bits
    unit = Fraction(float(made.ramp_anchor)) / 2 ** (bits - 1)
    steps = Fraction(float(made.acceleration_step)) / unit
    assert steps.denominator == 1
    assert math.ceil(
        Fraction(float(made.max_command)) / Fraction(float(made.acceleration_step))
    ) <= math.ceil(ticks)
    assert made.max_command < made.ramp_anchor <= 2 * made.max_command


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_without_ramps_a_step_reaches_any_command_from_any_other(number):
    made = limits(
        number, max_speed_m_s=0.5, acceleration_m_s2=0.5, units_per_m_s=3e4 if number == "int32" else 1.0
    )
    assert made.deceleration_step >= 2 * made.max_command
    assert made.quick_stop_step >= 2 * made.max_command
    assert made.acceleration_step < made.max_command


def test_counts_are_rounded_down():
    made = limits(
        "int32", max_speed_m_s=0.3, acceleration_m_s2=0.77, minimum_speed_m_s=0.0199, units_per_m_s=1e4
    )
    assert (made.max_command, made.acceleration_step, made.minimum_command) == (3000, 77, 199)
    assert made.ramp_anchor == 0


REFUSED = [
    (
        "float",
        {"max_speed_m_s": 0.5, "acceleration_m_s2": 0.005},
        "acceleration = 0.005 m/s2 takes 10000 ticks to full speed, too many for float: "
        "use double, a longer tick or a higher acceleration",
    ),
    (
        "double",
        {"max_speed_m_s": 0.5, "quick_stop_m_s2": 1e-5},
        "quick_stop = 1e-05 m/s2 takes 5000000 ticks to full speed: allowed are 1048576",
    ),
    (
        "int32",
        {"max_speed_m_s": 0.5, "deceleration_m_s2": 0.5, "units_per_m_s": 1150.0},
        "deceleration = 0.5 m/s2 is 5.75 counts per tick, and int32 takes whole counts: "
        "raise counts_per_m_s to at least 4000",
    ),
    (
        "int32",
        {"max_speed_m_s": 0.5, "units_per_m_s": 1e9},
        "max_speed = 0.5 m/s is 500000000 counts: int32 allows 268435456; lower counts_per_m_s",
    ),
    (
        "int32",
        {"max_speed_m_s": 0.5, "minimum_speed_m_s": 1e-5, "units_per_m_s": 1e4},
        "minimum_speed = 1e-05 m/s is less than one count: raise counts_per_m_s",
    ),
    (
        "float",
        {"max_speed_m_s": 0.5, "units_per_m_s": 1e32},
        "max_speed = 0.5 m/s is 5e+31 command units: float allows 1e-30 to 1e+30",
    ),
    (
        "double",
        {"max_speed_m_s": 0.5, "inching_speed_m_s": 1e-40},
        "inching_speed = 1e-40 m/s is 1e-40 command units: double allows 1e-30 to 1e+30",
    ),
]


@pytest.mark.parametrize(("number", "speeds", "message"), REFUSED)
def test_a_limit_that_the_type_cannot_tell_is_refused_with_what_would_do(number, speeds, message):
    with pytest.raises(ControllerError, match=f"^{re.escape(message)}$"):
        limits(number, **speeds)


def test_the_counts_that_a_refusal_asks_for_are_accepted():
    limits("int32", max_speed_m_s=0.5, deceleration_m_s2=0.5, units_per_m_s=4000.0)


@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
@pytest.mark.parametrize(
    "name", ["max_speed_m_s", "acceleration_m_s2", "deceleration_m_s2", "quick_stop_m_s2", "units_per_m_s"]
)
def test_a_limit_must_be_finite_and_above_0(name, value):
    with pytest.raises(ControllerError, match=rf"^{name} = {value!r}: must be finite and > 0$"):
        SpeedLimits(**{"max_speed_m_s": 0.5, name: value})


@pytest.mark.parametrize("value", [-0.1, 0.5, math.nan])
@pytest.mark.parametrize("name", ["minimum_speed_m_s", "inching_speed_m_s", "command_resolution_m_s"])
def test_a_small_speed_must_be_below_the_largest(name, value):
    with pytest.raises(
        ControllerError, match=rf"^{name} = {value!r}: must be at least 0 and below max_speed_m_s = 0.5$"
    ):
        SpeedLimits(0.5, **{name: value})
