"""Rows with negative amplitudes take a new command at rest only: the reference stays in range."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, ShaperInput, Status
from tests.properties.strategies import NUMBERS, blocks, examples, negative_rows, segments
from tests.unit.controller.blocks import (
    TICK_S,
    UM_SPLIT,
    UM_ZV,
    block,
    command_of,
    press,
    ramped_commands,
    run,
)

one_row = blocks(negative_rows(), most_rows=1)

SUM_SLACK = {"double": 1e-12, "float": 1e-5, "int32": 0.0}
"""Of a sum of at most 100 references: as many roundings of 2**-53 or 2**-24 of up to 50 times the maximum."""


@examples(100)
@given(st.data())
def test_reference_stays_within_the_maximum_under_a_random_joystick_and_knob(data):
    settings = data.draw(blocks(optional=True))
    limit = settings.limits.max_command
    outs = run(CommandShaper(settings), data.draw(segments(settings, most=12, stops=True)))
    assert all(-limit <= out.reference <= limit for out in outs)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("row", [UM_ZV, UM_SPLIT])
@pytest.mark.parametrize("ramp", [{}, {"acceleration_m_s2": None}, {"deceleration_m_s2": 0.7}])
def test_a_jog_of_any_length_never_reverses_and_goes_as_far_as_its_stretched_command(number, row, ramp):
    settings = block(row, number=number, **ramp)
    limits, last = settings.limits, settings.longest_delay_ticks
    rise = -(-float(limits.max_command) // min(float(limits.acceleration_step), float(limits.max_command)))
    for pressed in range(1, 30):
        inputs = press(settings, 1.0, pressed) + press(settings, 0.0, 80)
        outs = run(CommandShaper(settings), inputs)
        references = [out.reference for out in outs]
        assert min(references) == 0
        assert max(references) == limits.max_command
        assert references[-1] == 0
        stretched = max(pressed, int(rise) + last)
        commands = ramped_commands(settings, press(settings, 1.0, stretched) + press(settings, 0.0, 80))
        slack = SUM_SLACK[number] * float(sum(commands))
        assert abs(sum(references) - sum(commands)) <= slack
        metres = float(sum(references[1:])) * TICK_S / limits.units_per_m_s
        expected_m = float(sum(commands[1:])) * TICK_S / limits.units_per_m_s
        assert abs(metres - expected_m) <= slack
        if pressed == 1:  # what a jog of one tick foretells of its own stretched way
            foretold_m = outs[0].stop_distance / 1000 if number == "int32" else float(outs[0].stop_distance)
            assert abs(foretold_m - metres) <= (1e-3 if number == "int32" else slack + 1e-12)


@examples(80)
@given(st.data())
def test_command_waits_until_a_settled_tick_and_a_reversal_rests_at_0_first(data):
    settings = data.draw(one_row)
    limit = settings.limits.max_command
    inputs = data.draw(segments(settings, selectors=False))
    settled, resting, target = True, 0, 0
    for now, out in zip(inputs, run(CommandShaper(settings), inputs), strict=True):
        wanted = min(max(now.command, -limit), limit)
        if settled:
            target = 0 if resting * wanted < 0 else wanted
        assert bool(out.status & Status.COMMAND_WAITS) == (target != wanted)
        settled, resting = out.settled, out.reference


@examples(80)
@given(st.data())
def test_between_motion_one_way_and_the_other_there_is_rest(data):
    settings = data.draw(one_row)
    direction = 0
    for out in run(CommandShaper(settings), data.draw(segments(settings, most=12, selectors=False))):
        if out.settled and out.reference == 0:
            direction = 0
        assert direction * out.reference >= 0
        direction = direction or int(out.reference > 0) - int(out.reference < 0)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_waiting_command_takes_over_when_it_is_released_in_time(number):
    settings = block(UM_ZV, number=number)
    shaper = CommandShaper(settings)
    moving = run(shaper, press(settings, 0.5, 3))[-1]
    changed = shaper.step(ShaperInput(command_of(settings, 1.0)))
    assert not moving.status & Status.COMMAND_WAITS
    assert changed.status & Status.COMMAND_WAITS
    outs = run(shaper, press(settings, 0.5, 40))
    assert not outs[0].status & Status.COMMAND_WAITS
    assert outs[-1].reference == command_of(settings, 0.5)
