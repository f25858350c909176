"""Minimum speed, inching and the resolution of the command."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, ShaperInput, Status
from tests.properties.strategies import (
    NUMBERS,
    examples,
    negative_rows,
    positive_rows,
    ramps,
    segments,
)
from tests.unit.controller.blocks import (
    MAX_SPEED_M_S,
    UM_ZV,
    ZVD,
    block,
    command_of,
    press,
    ramped_commands,
    run,
)

INCHING = {"inching_speed_m_s": 0.1}
RESOLUTION_M_S = 0.02
RESOLUTION = {"command_resolution_m_s": RESOLUTION_M_S}


@examples(60)
@given(st.data())
def test_a_command_below_the_minimum_counts_as_0(data):
    number = data.draw(st.sampled_from(NUMBERS))
    settings = block(data.draw(positive_rows()), number=number, minimum_speed_m_s=0.1, **data.draw(ramps()))
    inputs = data.draw(segments(settings, stops=True))
    minimum = settings.limits.minimum_command
    zero = settings.number.scalar(0)
    counted = [now._replace(command=now.command if abs(now.command) >= minimum else zero) for now in inputs]
    twins = run(CommandShaper(settings), counted)
    for now, out, twin in zip(inputs, run(CommandShaper(settings), inputs), twins, strict=True):
        assert bool(out.status & Status.BELOW_MINIMUM) == (0 < abs(now.command) < minimum)
        assert out._replace(status=out.status & ~Status.BELOW_MINIMUM) == twin


@examples(40)
@given(st.data())
def test_a_small_jog_from_rest_passes_unshaped(data):
    settings = block(
        data.draw(positive_rows() | negative_rows()), number=data.draw(st.sampled_from(NUMBERS)), **INCHING
    )
    small = st.floats(-0.1, 0.1, allow_subnormal=False).map(lambda speed: speed / MAX_SPEED_M_S)
    inputs = data.draw(segments(settings, selectors=False, commands=small))
    outs = run(CommandShaper(settings), inputs)
    assert [out.reference for out in outs] == ramped_commands(settings, inputs)
    assert all(out.row == 0 and bool(out.status & Status.INCHING) for out in outs if out.reference != 0)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("row", [ZVD, UM_ZV])
def test_pressing_further_while_inching_waits_for_rest(number, row):
    settings = block(row, number=number, **INCHING)
    shaper = CommandShaper(settings)
    run(shaper, press(settings, 0.1, 3))
    outs = run(shaper, press(settings, 1.0, 60))
    limits = settings.limits
    waiting = [out for out in outs if out.status & Status.INCHING]
    assert waiting == outs[: len(waiting)]
    # The ramp to the inching speed, and rest there for the longest delay.
    assert len(waiting) >= settings.longest_delay_ticks
    assert all(
        out.status & Status.COMMAND_WAITS and out.reference <= limits.inching_command for out in waiting
    )
    assert all(out.row == 1 for out in outs[len(waiting) :])
    assert outs[-1].reference == limits.max_command


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("unshaped", [{"selector": 0}, {"enable": False}])
def test_in_row_0_there_is_no_inching_and_nothing_waits(number, unshaped):
    settings = block(ZVD, number=number, **INCHING)
    inputs = press(settings, 0.1, 3, **unshaped) + press(settings, 1.0, 20, **unshaped)
    outs = run(CommandShaper(settings), inputs)
    assert not any(out.status & (Status.INCHING | Status.COMMAND_WAITS) for out in outs)
    assert [out.reference for out in outs] == ramped_commands(block(ZVD, number=number), inputs)


@pytest.mark.parametrize("number", NUMBERS)
def test_inching_shows_that_it_is_in_use_and_no_row_waits_for_it(number):
    settings = block(ZVD, UM_ZV, number=number, **INCHING)
    outs = run(CommandShaper(settings), press(settings, 0.1, 30, selector=2))
    assert all(out.status & Status.INCHING and out.status & Status.UNSHAPED for out in outs)
    assert not any(out.status & Status.ROW_WAITS for out in outs)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("stop", ["quick_stop", "emergency_stop"])
def test_a_stop_ends_inching(number, stop):
    settings = block(ZVD, number=number, **INCHING)
    shaper = CommandShaper(settings)
    assert run(shaper, press(settings, 0.1, 3))[-1].status & Status.INCHING
    assert not run(shaper, press(settings, 0.1, 1, **{stop: True}))[0].status & Status.INCHING


@examples(60)
@given(st.data(), st.floats(-1.0, 1.0), st.floats(0.0, 0.49))
def test_noise_below_half_the_resolution_comes_to_rest_at_any_level(data, level, height):
    settings = block(ZVD, number=data.draw(st.sampled_from(NUMBERS)), **RESOLUTION)
    shaper = CommandShaper(settings)
    run(shaper, data.draw(segments(settings, selectors=False)))
    fraction = RESOLUTION_M_S / MAX_SPEED_M_S
    noise = st.floats(0.0, height * fraction).map(lambda up: ShaperInput(command_of(settings, level + up)))
    # One ramp of 10 ticks each way, then the longest delay.
    run(shaper, [data.draw(noise) for _ in range(20)] * 2)
    outs = run(shaper, [data.draw(noise) for _ in range(10)])
    assert all(out.settled for out in outs)
    assert len({out.reference for out in outs}) == 1
    low, high = level * float(settings.limits.max_command), float(settings.limits.command_resolution)
    assert abs(float(outs[0].reference) - low) <= 1.5 * high


@examples(60)
@given(st.data(), st.sampled_from([0.0, 1.0, -1.0, 1.3]))
def test_0_and_the_maximum_always_arrive_whatever_the_resolution(data, ratio):
    number, row = data.draw(st.sampled_from(NUMBERS)), data.draw(positive_rows() | negative_rows())
    settings = block(row, number=number, **RESOLUTION, **data.draw(ramps()))
    shaper = CommandShaper(settings)
    run(shaper, data.draw(segments(settings)))
    out = run(shaper, press(settings, ratio, 150))[-1]
    assert out.reference == command_of(settings, min(ratio, 1.0))


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_the_maximum_arrives_also_from_within_the_resolution_of_it(number, direction):
    settings = block(ZVD, number=number, **RESOLUTION)
    near = direction * (1.0 - 0.5 * RESOLUTION_M_S / MAX_SPEED_M_S)
    inputs = press(settings, near, 30) + press(settings, direction, 30)
    outs = run(CommandShaper(settings), inputs)
    assert outs[29].reference == command_of(settings, near)
    assert outs[-1].reference == command_of(settings, direction)


@examples(40)
@given(st.data())
def test_a_command_is_new_only_when_it_changes_by_the_resolution(data):
    settings = block(ZVD, number=data.draw(st.sampled_from(NUMBERS)), acceleration_m_s2=None, **RESOLUTION)
    resolution, limit = settings.limits.command_resolution, settings.limits.max_command
    inputs = data.draw(segments(settings, stops=False, selectors=False))
    held = 0
    for now, command in zip(inputs, ramped_commands(settings, inputs), strict=True):
        wanted = min(max(now.command, -limit), limit)
        if abs(wanted) + abs(wanted) < resolution:
            held = 0
        elif abs(wanted) == limit or abs(wanted - held) >= resolution:
            held = wanted
        assert command == held


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("small", [0.0, 0.09, -0.09, 0.019])
def test_commands_that_count_as_0_release_a_stop(number, small):
    settings = block(ZVD, number=number, minimum_speed_m_s=0.05, **RESOLUTION)
    shaper = CommandShaper(settings)
    run(shaper, press(settings, 1.0, 30) + press(settings, 1.0, 1, emergency_stop=True))
    out = run(shaper, press(settings, small, 1))[0]
    assert not out.status & Status.EMERGENCY_STOP
    assert bool(out.status & Status.BELOW_MINIMUM) == (small != 0.0)
