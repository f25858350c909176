"""The phase clock on a rope that stands: the taps' convolution, and a stop that comes as foretold."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper
from swayless.controller.rope import MM_PER_M
from tests.properties.phase_histories import (
    TICK_S,
    longest_tail,
    on_ropes,
    phase_blocks,
    released,
    rounding,
    standing,
    still_ropes,
)
from tests.properties.strategies import examples
from tests.unit.controller.blocks import fork, press, ramped_commands, run


def split_taps(settings, quanta):
    """Delays and amplitudes of row 1 on a still rope: each tap shared by two ticks, in proportion."""
    table = settings.row_tables[1]
    amplitudes = np.array([float(a) for a in table.amplitudes])
    if settings.number.is_integer:
        amplitudes /= 2.0**30
    whole, rest = np.divmod(np.array(table.lags), quanta)
    kernel = np.zeros(longest_tail(settings) + 2)
    np.add.at(kernel, whole, amplitudes * (1.0 - rest / quanta))
    np.add.at(kernel, whole + 1, amplitudes * (rest / quanta))
    return kernel


@examples(40)
@given(st.data())
def test_the_reference_is_the_convolution_with_taps_split_between_two_ticks(data):
    settings = data.draw(phase_blocks())
    inputs = data.draw(standing(settings))
    quanta = settings.clock.quanta(inputs[0].rope_length)
    command = np.array([float(x) for x in ramped_commands(settings, inputs)])
    expected = np.convolve(command, split_taps(settings, quanta))[: len(inputs)]
    references = np.array([float(out.reference) for out in run(CommandShaper(settings), inputs)])
    assert np.abs(references - expected).max() <= rounding(settings, len(inputs))


@examples(40)
@given(st.data())
def test_the_reference_stays_within_the_commands_of_the_last_lag(data):
    settings = data.draw(phase_blocks())
    inputs = data.draw(standing(settings))
    reach = longest_tail(settings)
    command = [float(x) for x in ramped_commands(settings, inputs)]
    slack = rounding(settings, len(inputs))
    for k, out in enumerate(run(CommandShaper(settings), inputs)):
        recent = command[max(k - reach, 0) : k + 1] + ([0.0] if k < reach else [])
        assert min(recent) - slack <= out.reference <= max(recent) + slack


@examples(25)
@given(st.data())
def test_the_reference_to_a_step_never_turns_back(data):
    settings = data.draw(phase_blocks())
    rope = data.draw(still_ropes(settings))
    step = press(settings, data.draw(st.sampled_from([1.0, -0.3])), 2 * longest_tail(settings))
    outs = run(CommandShaper(settings), on_ropes(settings, step, [rope] * len(step), [0.0] * len(step)))
    magnitudes = [abs(out.reference) for out in outs]
    # In int32 the carry of a count may come and go.
    turn = 1 if settings.number.is_integer else 0
    assert all(after >= before - turn for before, after in pairwise(magnitudes))
    assert outs[-1].settled


@examples(25)
@given(st.data())
def test_stop_distance_and_time_come_true(data):
    settings = data.draw(phase_blocks())
    inputs = data.draw(standing(settings, most=5))
    shaper, number = CommandShaper(settings), settings.number
    longest_m = settings.limits.max_command / settings.limits.units_per_m_s * longest_tail(settings) * TICK_S
    # double and float: relative to the longest stop distance; a few hundred sums of an ulp each.
    # int32: half a millimetre, and a count's carry at each end.
    slack_m = {"double": 1e-12 * longest_m, "float": 1e-5 * longest_m, "int32": 1.5 / MM_PER_M}[number.name]
    for k, now in enumerate(inputs):
        out = shaper.step(now)
        if k % 11:
            continue
        stopped = run(fork(shaper), released(settings, now))
        references = np.array([float(each.reference) for each in stopped])
        foretold_m = float(out.stop_distance) / (MM_PER_M if number.is_integer else 1)
        assert abs(references.sum() * TICK_S / settings.limits.units_per_m_s - foretold_m) <= slack_m
        moving = np.flatnonzero(references)
        moves = moving[-1] + 2 if moving.size else int(out.reference != 0)
        if number.is_integer:  # the last references may round to 0
            assert moves <= out.stop_time_ticks + 1
        else:
            assert abs(moves - out.stop_time_ticks) <= 1
        assert stopped[-1].settled
