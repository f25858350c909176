"""The ramp before the shaper keeps its limits, arrives exactly and never overshoots."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper
from tests.properties.strategies import blocks, examples, positive_rows, segments
from tests.unit.controller.blocks import MAX_SPEED_M_S, TICK_S, ZVD, block, ramped_commands, run

STEP_SLACK = {"double": 2.0**-50, "float": 2.0**-21, "int32": 0.0}
"""Of the maximum: steps are rounded up to a grid of two last places, a growing command to the nearest."""


def changes(settings, inputs):
    """Growth of the magnitude and shrinkage of it, tick by tick; a tick through 0 has both."""
    commands = np.array([0.0, *(float(x) for x in ramped_commands(settings, inputs))])
    before, after = commands[:-1], commands[1:]
    through = before * after < 0.0
    grown = np.where(through, abs(after), abs(after) - abs(before))
    shrunk = np.where(through, abs(before), abs(before) - abs(after))
    return grown.max(), shrunk.max()


@examples(60)
@given(st.data())
def test_command_grows_by_the_acceleration_and_shrinks_by_the_deceleration_at_most(data):
    settings = data.draw(blocks(positive_rows(), most_rows=1))
    inputs = data.draw(segments(settings, selectors=False))
    grown, shrunk = changes(settings, inputs)
    limits = settings.limits
    slack = STEP_SLACK[settings.number.name] * float(limits.max_command)
    assert grown <= float(limits.acceleration_step) + slack
    assert shrunk <= float(limits.deceleration_step) + slack


@examples(60)
@given(st.floats(0.05, 3.0), st.floats(0.05, 3.0), st.sampled_from(["double", "float", "int32"]))
def test_steps_are_those_of_the_machine(acceleration_m_s2, deceleration_m_s2, number):
    limits = block(
        ZVD, number=number, acceleration_m_s2=acceleration_m_s2, deceleration_m_s2=deceleration_m_s2
    ).limits
    full = float(limits.max_command)
    for step, asked_m_s2 in (
        (limits.acceleration_step, acceleration_m_s2),
        (limits.deceleration_step, deceleration_m_s2),
    ):
        asked = asked_m_s2 * TICK_S * limits.units_per_m_s
        # Whole counts are rounded down; floats up to the grid, two last places of the largest command.
        low, high = (-1.0, 0.0) if number == "int32" else (-1e-15, full * STEP_SLACK[number])
        assert low <= float(step) - asked <= high


@examples(60)
@given(st.data())
def test_ramp_moves_towards_its_target_and_never_overshoots(data):
    settings = data.draw(blocks(positive_rows(), most_rows=1))
    inputs = data.draw(segments(settings, selectors=False))
    limit, before = settings.limits.max_command, 0
    for now, command in zip(inputs, ramped_commands(settings, inputs), strict=True):
        target = min(max(now.command, -limit), limit)
        assert min(before, target) <= command <= max(before, target)
        assert command != before or command == target
        before = command


@examples(60)
@given(st.data(), st.floats(0.7, 14.0))
def test_ramp_agrees_with_a_naive_clip_where_both_accelerations_are_equal(data, ticks):
    change_m_s = MAX_SPEED_M_S / ticks
    rate = {"acceleration_m_s2": change_m_s / TICK_S, "deceleration_m_s2": change_m_s / TICK_S}
    settings = block(ZVD, **rate)
    inputs = data.draw(segments(settings, selectors=False))
    naive = 0.0
    for now, command in zip(inputs, ramped_commands(settings, inputs), strict=True):
        target = min(max(now.command, -MAX_SPEED_M_S), MAX_SPEED_M_S)
        naive += min(max(target - naive, -change_m_s), change_m_s)
        assert abs(command - naive) <= 1e-12


@examples(30)
@given(st.data())
def test_without_ramps_the_command_jumps(data):
    settings = block(
        ZVD, number=data.draw(st.sampled_from(["double", "float", "int32"])), acceleration_m_s2=None
    )
    limit = settings.limits.max_command
    inputs = data.draw(segments(settings, selectors=False))
    shaper = CommandShaper(settings)
    jumped = [out.reference for out in run(shaper, [now._replace(selector=0) for now in inputs])]
    assert jumped == [min(max(now.command, -limit), limit) for now in inputs]
