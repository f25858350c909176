"""Stops of the phase clock: at once, whatever the rope does, and nothing stays behind."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, ShaperInput, Status
from tests.properties.phase_histories import (
    TICK_S,
    commands,
    hoists,
    on_ropes,
    phase_blocks,
    ramp_ticks,
    spoilt,
    travelling,
)
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import command_of, phase_block, press, run


@examples(40)
@given(st.data())
def test_stops_latch_and_take_the_reference_to_0_at_once_by_their_own_law(data):
    settings = data.draw(phase_blocks())
    history = data.draw(travelling(settings, most=12, stops=True))
    inputs = data.draw(spoilt(settings, history))
    quick = emergency = False
    reference = settings.number.scalar(0)
    for now, out in zip(inputs, run(CommandShaper(settings), inputs), strict=True):
        emergency = now.emergency_stop or (emergency and now.command != 0)
        quick = now.quick_stop or (quick and not (now.command == 0 and reference == 0))
        assert bool(out.status & Status.EMERGENCY_STOP) == emergency
        assert bool(out.status & Status.QUICK_STOP) == quick
        if emergency:
            assert out.reference == out.stop_distance == out.stop_time_ticks == 0
        elif quick:
            left = max(abs(reference) - settings.limits.quick_stop_step, 0)
            assert out.reference == (left if reference > 0 else -left)
        assert not (emergency or quick) or not out.active
        reference = out.reference


@examples(25)
@given(st.data())
def test_after_a_stop_nothing_is_pending_and_the_block_is_as_new(data):
    settings = data.draw(phase_blocks())
    shaper = CommandShaper(settings)
    history = data.draw(travelling(settings, stops=True))
    run(shaper, history)
    standing = {"hoist_speed": settings.number.scalar(0), "rope_length": history[-1].rope_length}
    held = ShaperInput(command_of(settings, data.draw(st.sampled_from([1.0, -0.4]))), **standing)
    stop = data.draw(st.sampled_from(["quick_stop", "emergency_stop"]))
    stopped = run(shaper, [held._replace(**{stop: True})] * (ramp_ticks(settings) + 2))[-1]
    assert (stopped.reference, stopped.stop_distance, stopped.stop_time_ticks) == (0, 0, 0)
    assert all(out.reference == 0 for out in run(shaper, [held] * 30)), "it restarts by itself"
    new = CommandShaper(settings)
    free = held._replace(command=settings.number.scalar(0))
    assert shaper.step(free) == new.step(free)
    again = data.draw(travelling(settings, stops=True))
    assert run(shaper, again) == run(new, again)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_quick_stop_while_hoisting_goes_to_0_on_its_ramp_and_ends_there(number):
    settings = phase_block(number, tick_s=TICK_S)
    move = press(settings, 1.0, 60)
    ticks = 60 + 30
    lengths = [8.0 - 0.3 * TICK_S * k for k in range(ticks)]
    stop = [each._replace(quick_stop=True) for each in press(settings, 1.0, 30)]
    outs = run(CommandShaper(settings), on_ropes(settings, move + stop, lengths, [-0.3] * ticks))
    reference, step = outs[59].reference, settings.limits.quick_stop_step
    assert reference > 5 * step
    expected = [max(reference - (k + 1) * step, 0) for k in range(30)]
    assert [out.reference for out in outs[60:]] == expected
    assert outs[-1].stop_distance == 0


@examples(20)
@given(st.data())
def test_a_command_that_is_not_finite_is_a_release(data):
    settings = data.draw(phase_blocks(numbers=("double", "float")))
    scalar = settings.number.scalar
    good = data.draw(commands(settings))
    rope = data.draw(hoists(settings, len(good)))
    bad = data.draw(st.sampled_from([math.nan, math.inf, -math.inf]))
    start = data.draw(st.integers(0, len(good) - 1))
    broken = good[:start] + [each._replace(command=scalar(bad)) for each in good[start:]]
    freed = good[:start] + [each._replace(command=scalar(0)) for each in good[start:]]
    pairs = zip(
        run(CommandShaper(settings), on_ropes(settings, broken, *rope)),
        run(CommandShaper(settings), on_ropes(settings, freed, *rope)),
        strict=True,
    )
    for k, (out, free) in enumerate(pairs):
        assert (out.reference, out.stop_distance) == (free.reference, free.stop_distance)
        assert bool(out.status & Status.COMMAND_INVALID) == (k >= start)
