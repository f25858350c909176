"""What is set on site: the speed limit and the rope offset, within their ranges."""

import math

import pytest

from swayless.controller import CommandShaper, Status
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import command_of, run
from tests.unit.controller.operator_blocks import KINDS, hands_off, metres, operator_block

ROPED = ("phase", "modified", "original")


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_speed_limit_is_the_maximum_of_commands_and_a_change_is_ramped_and_shaped(kind, number):
    settings = operator_block(kind, number, speed_limit=True)
    shaper, half = CommandShaper(settings), command_of(settings, 0.5)
    full = hands_off(settings, command=settings.limits.max_command)
    assert run(shaper, [full] * 250)[-1].reference == settings.limits.max_command
    slower = run(shaper, [full._replace(speed_limit=half)] * 250)
    # The phase clock brings commands to the grid of its ramps, two units in the last place of the maximum.
    assert slower[-1].reference == pytest.approx(half, rel=1e-6)
    assert slower[0].reference > half
    assert not slower[0].status & Status.SPEED_LIMIT_INVALID
    stopped = run(shaper, [full._replace(speed_limit=settings.number.scalar(0))] * 250)
    assert stopped[-1].reference == 0


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(("limit", "expected"), [(2.0, 1.0), (-1.0, 0.0), (math.nan, 0.0), (math.inf, 0.0)])
def test_a_speed_limit_out_of_range_is_clamped_and_said(number, limit, expected):
    if number == "int32" and not math.isfinite(limit):
        return
    settings = operator_block("zvd", number, speed_limit=True)
    given = command_of(settings, limit) if math.isfinite(limit) else settings.number.scalar(limit)
    now = hands_off(settings, command=settings.limits.max_command, speed_limit=given)
    out = run(CommandShaper(settings), [now] * 40)[-1]
    assert out.reference == command_of(settings, expected)
    assert out.status & Status.SPEED_LIMIT_INVALID
    assert out.error


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", ROPED)
def test_a_rope_offset_is_added_to_the_measured_length(kind, number):
    settings = operator_block(kind, number, rope_offset_m=(-1.0, 2.0))
    pushed = hands_off(settings, command=settings.limits.max_command)
    tuned, plain = CommandShaper(settings), CommandShaper(settings)
    outs = run(tuned, [pushed._replace(rope_offset=metres(settings, 1.5))] * 100)
    longer = pushed._replace(rope_length=pushed.rope_length + metres(settings, 1.5))
    assert outs == run(plain, [longer] * 100)
    far = tuned.step(pushed._replace(rope_offset=metres(settings, 2.5)))
    assert far.status & Status.ROPE_OFFSET_INVALID
    assert far.error
