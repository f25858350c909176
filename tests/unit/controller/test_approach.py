"""Coming to rest within a way, exactly; and planned moves that rise, hold and fall within one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import number_type
from swayless.controller.approach import Approach
from swayless.controller.limits import SpeedLimits, command_limits
from swayless.controller.planned_move import PlannedMove
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import UM_ZV, block


def limits_of(acceleration, deceleration, number="int32"):
    """Limits in counts a tick, of 1000 counts at most."""
    speeds = SpeedLimits(1.0, acceleration, deceleration, units_per_m_s=1000.0)
    return command_limits(speeds, tick_s=1.0, number=number_type(number))


ramps = st.one_of(st.none(), st.sampled_from([0.01, 0.037, 0.1, 0.5, 2.0]))


@examples(150)
@given(ramps, ramps, st.integers(0, 50_000), st.integers(50, 1000))
def test_a_way_in_counts_is_used_to_its_last_count_within_the_ramps(up, down, way, target):
    limits = limits_of(up, down)
    approach = Approach(limits, number_type("int32"))
    command, left, ticks = 0, way, 0
    while left > 0:
        after = approach.within(command, target, left)
        assert 0 <= after <= target
        assert -limits.deceleration_step <= after - command <= limits.acceleration_step
        assert after > 0, "it stands and does not arrive"
        command, left, ticks = after, left - after, ticks + 1
    assert left == 0
    assert command <= limits.deceleration_step
    ramp = (target // limits.acceleration_step + 2) + (target // limits.deceleration_step + 2)
    assert ticks <= way // target + 3 * ramp + 3


@examples(100)
@given(ramps, ramps, st.integers(0, 1000), st.integers(-500, 100_000), st.integers(0, 1000))
def test_where_stopping_is_possible_it_stays_possible(up, down, command, slack, target):
    limits = limits_of(up, down)
    approach = Approach(limits, number_type("int32"))
    way = approach.glide(command) + slack
    after = approach.within(command, target, way)
    if slack >= 0:
        assert after + approach.glide(after) <= way
    else:
        assert after == max(command - limits.deceleration_step, 0)


def test_a_way_that_a_full_step_would_pass_is_begun_gently():
    limits = limits_of(None, 0.1)  # at once to any speed, and down by 100 counts a tick
    approach = Approach(limits, number_type("int32"))
    assert approach.within(0, 1000, 5500) == 1000
    assert approach.within(0, 1000, 5499) == 100
    assert approach.within(0, 1000, 70) == 70


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("acceleration", [None, 0.3, 1.0])
def test_a_planned_move_keeps_within_its_way_and_wastes_no_more_than_a_step_of_the_ramp(number, acceleration):
    settings = block(UM_ZV, number=number, acceleration_m_s2=acceleration, deceleration_m_s2=0.7)
    approach = Approach(settings.limits, settings.number)
    plan, most = PlannedMove(settings, approach), settings.limits.max_command
    zero = settings.number.scalar(0)
    full = float(plan.needs(zero, most))
    for share in np.geomspace(0.001, 1.5, 40):
        way = settings.number.scalar(share * full)
        speed = plan.speed(way, most)
        assert 0 < speed <= most
        assert plan.needs(zero, speed) <= way
        faster = speed + approach.gentle_step
        if acceleration is not None and approach.gentle_step < speed and faster <= most:
            assert plan.needs(zero, faster) > way
    assert plan.speed(settings.number.scalar(full), most) == most
    assert plan.speed(zero, most) == 0


def test_the_shortest_planned_move_in_counts_is_one_count():
    settings = block(UM_ZV, number="int32")
    plan = PlannedMove(settings, Approach(settings.limits, settings.number))
    assert plan.speed(plan.shortest, settings.limits.max_command) == 1
    assert plan.speed(plan.shortest - 1, settings.limits.max_command) == 0
