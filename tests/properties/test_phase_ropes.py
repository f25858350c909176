"""Readings of the rope that cannot be right: the last length holds, the status says so, shaping goes on."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, Status
from tests.properties.phase_histories import (
    TICK_S,
    commands,
    hoists,
    longest_tail,
    on_ropes,
    phase_blocks,
    ramp_ticks,
    rope_input,
    still_ropes,
)
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import phase_block, press, run

TICKS = 400
HOIST_M_S = 0.3


def moving(number, ticks=TICKS, rope_m=8.0, hoist_m_s=0.0, **fields):
    """A phase clock of zvd, a start and a stop on a rope that stands or moves, with these fields."""
    settings = phase_block(number, tick_s=TICK_S)
    inputs = press(settings, 1.0, ticks // 2, **fields) + press(settings, 0.0, ticks - ticks // 2, **fields)
    lengths = [rope_m + hoist_m_s * TICK_S * k for k in range(ticks)]
    return settings, on_ropes(settings, inputs, lengths, [hoist_m_s] * ticks)


def references(settings, inputs):
    return [out.reference for out in run(CommandShaper(settings), inputs)]


def spoil(inputs, start, stop, **fields):
    """Replace fields of some ticks."""
    return [x._replace(**fields) if start <= k < stop else x for k, x in enumerate(inputs)]


FLAWS = [(number, flaw) for number in NUMBERS for flaw in ("invalid", "jump")]
FLAWS += [(number, flaw) for number in ("double", "float") for flaw in ("nan", "inf")]


@pytest.mark.parametrize(("number", "flaw"), FLAWS)
def test_a_bad_length_is_not_taken_and_the_move_is_shaped_as_if_the_rope_had_stood(number, flaw):
    settings, good = moving(number)
    scalar = settings.number.scalar
    if flaw == "jump":
        bit, fields = Status.ROPE_JUMP, rope_input(settings, 4.0, 0.0)
    elif flaw == "invalid":
        bit, fields = Status.ROPE_INVALID, {"rope_length_valid": False, "rope_length": scalar(0)}
    else:
        bit, fields = Status.ROPE_INVALID, {"rope_length": scalar(float(flaw))}
    outs = run(CommandShaper(settings), spoil(good, 10, 60, **fields))
    assert [out.reference for out in outs] == references(settings, good)
    assert [bool(out.status & bit) for out in outs] == [10 <= k < 60 for k in range(TICKS)]
    assert all(out.error == (10 <= k < 60) and out.active for k, out in enumerate(outs))


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(("reading_m", "clamped_m"), [(2.97, 3.0), (9.04, 9.0)])
def test_a_length_just_out_of_range_counts_as_its_end(number, reading_m, clamped_m):
    settings, end = moving(number, rope_m=clamped_m)
    outside = [each._replace(**rope_input(settings, reading_m, 0.0)) for each in end]
    outs = run(CommandShaper(settings), outside)
    assert [out.reference for out in outs] == references(settings, end)
    assert all(out.status & Status.ROPE_OUT_OF_RANGE and not out.error for out in outs)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_length_that_jumped_is_taken_at_rest_at_once_and_under_way_when_the_hoist_can_have_got_there(
    number,
):
    settings, good = moving(number)
    far = spoil(good, 10, TICKS, **rope_input(settings, 7.6, 0.0))
    outs = run(CommandShaper(settings), far)
    # 0.4 m off: 0.05 m are always taken, and 0.4 m/s for 0.05 s a tick.
    held = math.ceil((0.4 - 0.05) / (0.4 * TICK_S)) - 1
    flagged = [k for k, out in enumerate(outs) if out.status & Status.ROPE_JUMP]
    assert flagged == list(range(10, 10 + len(flagged)))
    assert abs(len(flagged) - held) <= 1  # the last one is a matter of rounding
    shaper = CommandShaper(settings)
    run(shaper, good + good[-1:] * 2 * longest_tail(settings))
    assert not shaper.step(far[-1]).status & Status.ROPE_JUMP


@pytest.mark.parametrize("number", NUMBERS)
def test_a_length_that_stays_while_the_hoist_moves_is_frozen_after_the_way_of_a_jump(number):
    settings, still = moving(number)
    frozen = spoil(still, 10, 90, hoist_speed=rope_input(settings, 8.0, -HOIST_M_S)["hoist_speed"])
    outs = run(CommandShaper(settings), frozen)
    flagged = [k for k, out in enumerate(outs) if out.status & Status.ROPE_FROZEN]
    ticks = math.ceil(0.05 / (HOIST_M_S * TICK_S))
    assert flagged[0] in {10 + ticks - 1, 10 + ticks}  # the last one is a matter of rounding
    assert flagged == list(range(flagged[0], 90))
    assert all(out.active for out in outs)
    assert not run(CommandShaper(settings), still)[-1].status & Status.ROPE_FROZEN


@pytest.mark.parametrize("number", ["double", "float"])
@pytest.mark.parametrize("speed", [math.nan, math.inf, -math.inf])
def test_a_hoist_speed_that_is_not_finite_counts_as_0(number, speed):
    settings, good = moving(number)
    bad = spoil(good, 10, 60, hoist_speed=settings.number.scalar(speed))
    outs = run(CommandShaper(settings), bad)
    assert [out.reference for out in outs] == references(settings, good)
    assert [bool(out.status & Status.HOIST_SPEED_INVALID) for out in outs] == [
        10 <= k < 60 for k in range(TICKS)
    ]


@pytest.mark.parametrize("number", NUMBERS)
def test_a_hoist_speed_beyond_the_limit_counts_as_the_limit(number):
    settings, fast = moving(number, hoist_m_s=-0.4)
    faster = [each._replace(hoist_speed=each.hoist_speed * 3) for each in fast]
    assert references(settings, faster) == references(settings, fast)


@examples(20)
@given(st.data())
def test_a_noisy_hoist_speed_keeps_no_block_from_settling(data):
    settings = data.draw(phase_blocks())
    moves = data.draw(commands(settings))
    ticks = len(moves) + ramp_ticks(settings) + 2 * longest_tail(settings)
    moves = moves + [moves[-1]] * (ticks - len(moves))
    rope_m = data.draw(still_ropes(settings))
    noise = np.random.default_rng(data.draw(st.integers(0, 99))).uniform(-0.01, 0.01, ticks)
    shaper = CommandShaper(settings)
    outs = run(shaper, on_ropes(settings, moves, [rope_m] * ticks, noise.tolist()))
    assert outs[-1].settled


@examples(20)
@given(st.data())
def test_true_readings_raise_no_bit(data):
    settings = data.draw(phase_blocks())
    inputs = data.draw(commands(settings, longest=20))
    outs = run(CommandShaper(settings), on_ropes(settings, inputs, *data.draw(hoists(settings, len(inputs)))))
    bits = Status.ROPE_INVALID | Status.ROPE_JUMP | Status.ROPE_FROZEN | Status.HOIST_SPEED_INVALID
    assert not any(out.status & bits for out in outs)
