"""While one row is used, the reference is the plain convolution of the ramped command with its taps."""

from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper
from tests.properties.strategies import NUMBERS, blocks, examples, positive_rows, segments
from tests.unit.controller.blocks import ZVD, block, convolved, press, ramped_commands, run

THIRDS = ((0, 1 / 3), (1, 1 / 3), (3, 1 / 3))

single_rows = blocks(positive_rows(), most_rows=1)

RELATIVE = {"double": 1e-12, "float": 6 * 2.0**-24, "int32": 0.0}
"""Of the maximum. In float, five products and five sums at most are rounded, each by half of 2**-23."""

COUNTS = {"double": 0, "float": 0, "int32": 1}
"""In int32 a reference and the carry from the one before are each rounded by half a count."""


@examples(60)
@given(st.data())
def test_reference_is_the_convolution_of_the_ramped_command_with_the_taps(data):
    settings = data.draw(single_rows)
    inputs = data.draw(segments(settings, selectors=False))
    outs = run(CommandShaper(settings), inputs)
    commands = ramped_commands(settings, inputs)
    expected = convolved(commands, settings.row_tables[1], settings.number)
    allowed = (
        RELATIVE[settings.number.name] * float(settings.limits.max_command) + COUNTS[settings.number.name]
    )
    for out, reference in zip(outs, expected, strict=True):
        assert abs((int if settings.number.is_integer else float)(out.reference) - reference) <= allowed


@examples(60)
@given(st.data())
def test_settled_means_that_the_reference_is_the_command_and_none_has_come_for_the_longest_delay(data):
    settings = data.draw(blocks(positive_rows()))
    inputs = data.draw(segments(settings))
    outs = run(CommandShaper(settings), inputs)
    commands = [0] * (settings.longest_delay_ticks + 1) + ramped_commands(settings, inputs)
    for k, out in enumerate(outs):
        reached = commands[k : k + settings.longest_delay_ticks + 2]
        assert out.settled == (len(set(reached[1:])) == 1)
        assert not out.settled or out.reference == reached[-1]


@examples(100)
@given(st.floats(-1.0, 1.0, allow_subnormal=False), st.sampled_from(NUMBERS))
def test_reference_is_exactly_the_command_once_it_has_rested_for_the_delay_of_its_row(ratio, number):
    settings = block(THIRDS, ZVD, number=number, acceleration_m_s2=None)
    inputs = press(settings, ratio, THIRDS[-1][0] + 1)
    out = run(CommandShaper(settings), inputs)[-1]
    # Three rounded products of a third would not sum to it: the block rests, long before it is settled.
    assert out.reference == inputs[0].command
    assert out.settled == (inputs[0].command == 0)


@examples(40)
@given(st.data())
def test_reference_arrives_exactly_at_a_held_command(data):
    settings = data.draw(blocks())
    shaper = CommandShaper(settings)
    run(shaper, data.draw(segments(settings, stops=False)))
    held = data.draw(segments(settings, most=1))[0]
    # Four ramps of at most 14 ticks and as many settlings of at most 24: a waiting row may rest on its way.
    out = run(shaper, [held] * 200)[-1]
    limit = settings.limits.max_command
    assert out.settled
    assert out.reference == min(max(held.command, -limit), limit)


@examples(60)
@given(st.data())
def test_references_of_a_whole_move_in_counts_sum_to_exactly_its_commands(data):
    settings = data.draw(single_rows.filter(lambda made: made.number.is_integer))
    inputs = data.draw(segments(settings, selectors=False)) + press(settings, 0, 60)
    references = [out.reference for out in run(CommandShaper(settings), inputs)]
    assert references[-1] == 0
    assert sum(references) == sum(ramped_commands(settings, inputs))
