"""The phase clock under any history of commands, ropes and stops: it stays in range, and it comes to rest."""

import math

from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper
from tests.properties.phase_histories import phase_blocks, released, spoilt, standing, travelling
from tests.properties.strategies import examples
from tests.unit.controller.blocks import command_of, run


@examples(40)
@given(st.data())
def test_whatever_happened_a_released_block_comes_to_rest_at_exactly_0(data):
    settings = data.draw(phase_blocks())
    history = data.draw(travelling(settings, stops=True, selectors=True))
    last = run(CommandShaper(settings), history + released(settings, history[-1]))[-1]
    assert (last.reference, last.stop_distance, last.stop_time_ticks) == (0, 0, 0)
    assert last.settled


@examples(40)
@given(st.data())
def test_the_reference_stays_within_the_maximum_and_every_output_is_finite_and_never_minus_0(data):
    settings = data.draw(phase_blocks())
    history = data.draw(travelling(settings, stops=True, selectors=True))
    inputs = data.draw(spoilt(settings, history))
    if not settings.number.is_integer:
        odd = st.sampled_from([math.nan, math.inf, -math.inf, -0.0, 1e-30, -1e-30, 3.4e38, -3.4e38])
        for k in range(0, len(inputs), 7):
            inputs[k] = inputs[k]._replace(command=settings.number.scalar(data.draw(odd)))
    limit = settings.limits.max_command
    for out in run(CommandShaper(settings), inputs):
        assert -limit <= out.reference <= limit
        for value in (out.reference, out.stop_distance, out.stop_time_s, out.residual_bound):
            assert math.isfinite(value)
            assert value != 0 or math.copysign(1.0, value) > 0


@examples(25)
@given(st.data())
def test_a_command_that_holds_arrives_exactly(data):
    settings = data.draw(phase_blocks())
    history = data.draw(travelling(settings))
    command = command_of(settings, data.draw(st.sampled_from([1.0, -1.0, 0.3])))
    held = [each._replace(command=command) for each in released(settings, history[-1])]
    outs = run(CommandShaper(settings), history + held)
    assert outs[-1].settled
    # Commands are rounded to the grid of the ramp steps.
    unit = 0 if settings.number.is_integer else settings.limits.ramp_anchor * 2.0**-23
    assert abs(outs[-1].reference - command) <= unit
    assert outs[-2].reference == outs[-1].reference


@examples(25)
@given(st.data())
def test_every_pointer_lags_by_exactly_its_phase(data):
    settings = data.draw(phase_blocks())
    shaper = CommandShaper(settings)
    pointers = shaper._filter
    for now in data.draw(travelling(settings, stops=True, selectors=True)):
        out = shaper.step(now)
        if not pointers.is_running:
            continue
        size = len(pointers._gaps)
        for tap, lag in list(enumerate(settings.row_tables[out.row].lags))[1:]:
            behind = (pointers._head - pointers._cells[tap]) % size + 1
            gaps = [pointers._gaps[(pointers._cells[tap] + k) % size] for k in range(behind)]
            assert pointers._ahead[tap] + sum(gaps) == lag
            assert pointers._ahead[tap] >= 0


@examples(20)
@given(st.data())
def test_two_runs_and_a_run_after_init_are_the_same(data):
    settings = data.draw(phase_blocks())
    inputs = data.draw(spoilt(settings, data.draw(travelling(settings, stops=True, selectors=True))))
    shaper = CommandShaper(settings)
    first = run(shaper, inputs)
    shaper.init()
    assert run(shaper, inputs) == first
    assert run(CommandShaper(settings), inputs) == first


@examples(25)
@given(st.data())
def test_a_steady_command_passes_any_hoist_unchanged(data):
    settings = data.draw(phase_blocks())
    start = data.draw(standing(settings, most=1))
    settled = released(settings, start[-1])
    command = command_of(settings, data.draw(st.sampled_from([0.0, 1.0, -0.4])))
    settled = [each._replace(command=command) for each in settled]
    shaper = CommandShaper(settings)
    reference = run(shaper, settled)[-1].reference
    hoisting = [each._replace(command=command) for each in data.draw(travelling(settings))]
    assert all(out.reference == reference and out.settled for out in run(shaper, hoisting))
