"""Outputs in metres and seconds, in int32 in whole millimetres and seconds."""

from fractions import Fraction

import numpy as np
import pytest

from swayless.controller import CommandShaper
from swayless.controller.output_units import OutputUnits, residual_bounds
from swayless.errors import ControllerError
from tests.unit.controller.blocks import TICK_S, ZVD, block, press, run
from tests.unit.controller.operator_blocks import operated


@pytest.mark.parametrize("counts_per_m_s", [700.0, 20_000.0, 333_333.3, 4e7])
def test_int32_distance_is_the_nearest_millimetre_and_symmetric(counts_per_m_s):
    units = OutputUnits(block(ZVD, number="int32", units_per_m_s=counts_per_m_s))
    millimetres = Fraction(repr(TICK_S)) * 1000 / Fraction(repr(counts_per_m_s))
    largest = int(MAX_M * 1000 / millimetres)
    totals = np.random.default_rng(3).integers(0, largest, 2000).tolist()
    for total in [0, 1, *totals]:
        # The scale has at least 31 bits: what it is off by is far below a thousandth of a millimetre.
        assert abs(units.distance(total) - total * millimetres) <= Fraction(501, 1000)
        assert units.distance(-total) == -units.distance(total)


MAX_M = 0.5 * TICK_S * (2 * 10 + 4 * 8)
"""The longest stop: two ramps of 10 ticks and four settlings of 8."""


def test_int32_time_is_rounded_up_to_whole_seconds():
    units = OutputUnits(block(ZVD, number="int32"))
    assert [units.time_s(ticks) for ticks in (0, 1, 19, 20, 21, 2000)] == [0, 1, 1, 1, 2, 100]


def test_a_stop_beyond_the_range_of_int32_is_refused():
    with pytest.raises(ControllerError, match=r"exceeds 2\^31 mm"):
        OutputUnits(block(ZVD, number="int32", max_speed_m_s=5e5, acceleration_m_s2=5e4, units_per_m_s=100.0))


def test_the_longest_sum_of_a_stop_fits_64_bits():
    settings = block(ZVD, number="int32", max_speed_m_s=0.5, units_per_m_s=2.0**29)
    units = OutputUnits(settings)
    out = run(CommandShaper(settings), press(settings, 1.0, 60))[-1]
    assert settings.limits.max_command == 1 << 28
    assert out.stop_distance * units.distance_scale < 1 << 63
    # At full speed: half the ramp of 10 ticks less half a tick, and half the taps; 212.5 mm, away from 0.
    assert out.stop_distance == int(1000 * 0.5 * TICK_S * (4.5 + 4.0) + 0.5)


@pytest.mark.parametrize(
    ("number", "bound"), [("double", 0.05), ("float", np.float32(0.05)), ("int32", 50_000)]
)
def test_residual_bounds_are_the_tolerances_and_1_for_row_0(number, bound):
    assert residual_bounds(block(ZVD, number=number)) == ((10**6 if number == "int32" else 1.0), bound)


def test_the_steps_that_may_be_pressed_are_part_of_the_longest_sum():
    settings = operated(block(ZVD, number="int32"), step_sizes_m=(1.0, 10.0, 100.0))
    units, capacity = OutputUnits(settings), settings.operator.steps.capacity
    assert units.distance(capacity) == 16 * 100_000
    assert units.distance_scale * capacity < 1 << 62
    with pytest.raises(ControllerError, match=r"exceeds 2\^31 mm"):
        OutputUnits(operated(block(ZVD, number="int32"), step_sizes_m=(1.0, 10.0, 200_000.0)))
