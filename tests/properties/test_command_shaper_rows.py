"""A row changes at rest only, and its change alone never moves the reference."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, ShaperInput, Status
from tests.properties.strategies import NUMBERS, blocks, examples, positive_rows, segments
from tests.unit.controller.blocks import ZVD, block, command_of, press, ramped_commands, run

ROUNDING = {"double": 6 * 2.0**-53, "float": 6 * 2.0**-24, "int32": 0.0}
"""Of the maximum: at most five products and five sums, each rounded to half a last place."""


def wanted_rows(settings, inputs):
    """Row that selector and enable ask for, tick by tick."""
    selected, wanted = 0, []
    for now in inputs:
        selected = now.selector if now.selector <= len(settings.bank.rows) else selected
        wanted.append(selected if now.enable else 0)
    return wanted


@examples(80)
@given(st.data())
def test_reference_stays_within_the_commands_of_the_longest_delay_whatever_the_knob_does(data):
    settings = data.draw(blocks(positive_rows()))
    inputs = data.draw(segments(settings))
    last = settings.longest_delay_ticks
    commands = [0] * last + ramped_commands(settings, inputs)
    slack = ROUNDING[settings.number.name] * float(settings.limits.max_command)
    for k, out in enumerate(run(CommandShaper(settings), inputs)):
        reached = commands[k : k + last + 1]
        assert min(reached) - slack <= out.reference <= max(reached) + slack


@examples(60)
@given(st.data())
def test_row_is_the_wanted_one_after_a_settled_tick_and_the_old_one_else(data):
    settings = data.draw(blocks())
    inputs = data.draw(segments(settings))
    row, settled = 0, True
    for out, wanted in zip(run(CommandShaper(settings), inputs), wanted_rows(settings, inputs), strict=True):
        row = wanted if settled else row
        settled = out.settled
        assert out.row == row
        assert bool(out.status & Status.ROW_WAITS) == (row != wanted)
        assert bool(out.status & Status.UNSHAPED) == (row == 0)
        assert out.active == (row > 0)


@examples(40)
@given(st.data())
def test_a_row_change_alone_never_moves_the_reference(data):
    settings = data.draw(blocks())
    shaper = CommandShaper(settings)
    held = ShaperInput(command_of(settings, data.draw(st.floats(-1.0, 1.0, allow_subnormal=False))))
    before = run(shaper, [held] * 200)[-1].reference
    knob = st.builds(held._replace, selector=st.integers(0, 5)) | st.just(held._replace(enable=False))
    outs = run(shaper, data.draw(st.lists(knob, max_size=30)))
    assert {out.reference for out in outs} <= {before}


@pytest.mark.parametrize("number", NUMBERS)
def test_pressing_turning_the_knob_to_0_and_releasing_never_reverses(number):
    settings = block(ZVD, number=number, acceleration_m_s2=None)
    for pressed in range(1, 12):
        for turned in range(1, 12):
            inputs = press(settings, 1.0, pressed) + press(settings, 0.0, 30)
            outs = run(
                CommandShaper(settings),
                [now._replace(selector=int(k < turned)) for k, now in enumerate(inputs)],
            )
            assert min(out.reference for out in outs) == 0
            assert outs[-1].reference == 0
            assert outs[-1].row == 0


@examples(40)
@given(st.data())
def test_disabled_is_row_0_wanted_and_nothing_else(data):
    settings = data.draw(blocks(optional=True))
    inputs = data.draw(segments(settings, stops=True))
    inputs = [now._replace(selector=min(now.selector, len(settings.bank.rows))) for now in inputs]
    disabled = run(CommandShaper(settings), inputs)
    unshaped = run(
        CommandShaper(settings),
        [now._replace(selector=now.selector * now.enable, enable=True) for now in inputs],
    )
    for now, out, twin in zip(inputs, disabled, unshaped, strict=True):
        assert bool(out.status & Status.DISABLED) == (not now.enable)
        assert out._replace(status=out.status & ~Status.DISABLED) == twin


@examples(40)
@given(st.data())
def test_an_invalid_selector_keeps_the_last_valid_one(data):
    settings = data.draw(blocks(optional=True))
    inputs = data.draw(segments(settings, stops=True))
    kept, selected = [], 0
    for now in inputs:
        selected = now.selector if now.selector <= len(settings.bank.rows) else selected
        kept.append(now._replace(selector=selected))
    twins = run(CommandShaper(settings), kept)
    for now, out, twin in zip(inputs, run(CommandShaper(settings), inputs), twins, strict=True):
        invalid = now.selector > len(settings.bank.rows)
        assert bool(out.status & Status.SELECTOR_INVALID) == out.error == invalid
        assert out._replace(status=out.status & ~Status.SELECTOR_INVALID, error=False) == twin
