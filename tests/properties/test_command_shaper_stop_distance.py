"""The stop distance is exact at every tick and in every state: what it foretells is what happens."""

from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper
from tests.properties.strategies import blocks, examples, segments
from tests.unit.controller.blocks import TICK_S, fork

FLOAT_M = 5e-6
"""A hundred sums below 16 m/s x ticks, each rounded by at most 2**-20 of that, times 0.05 s."""

DISTANCE_M = {"double": 1e-9, "float": FLOAT_M, "int32": 1e-3}


def stopped(shaper, inputs):
    """References and foretold ticks from the tick at which the command is 0 until nothing is pending."""
    references, ticks = [], []
    while not ticks or ticks[-1] > 0:
        out = shaper.step(inputs)
        references.append(out.reference)
        ticks.append(out.stop_time_ticks)
        assert len(ticks) < 500, "the block does not come to rest"
    return references, ticks


def check(settings, inputs):
    """Fork the shaper at every tick, stop it, and compare with what it foretold."""
    shaper, number = CommandShaper(settings), settings.number
    for now in inputs:
        out = shaper.step(now)
        released = now._replace(command=number.scalar(0))
        references, ticks = stopped(fork(shaper), released)
        metres = float(sum(references)) * TICK_S / settings.limits.units_per_m_s
        foretold_m = out.stop_distance / 1000 if number.is_integer else float(out.stop_distance)
        assert abs(metres - foretold_m) <= DISTANCE_M[number.name]
        assert ticks == [max(out.stop_time_ticks - 1 - k, 0) for k in range(len(ticks))]
        last = max((k + 1 for k, reference in enumerate(references) if reference != 0), default=0)
        moves = last + 1 if last else int(out.reference != 0)
        if number.is_integer:  # the last of a reference may be less than half a count
            assert moves <= out.stop_time_ticks
        else:
            assert moves == out.stop_time_ticks


@examples(60)
@given(st.data())
def test_stop_distance_and_time_come_true_in_every_state(data):
    settings = data.draw(blocks(optional=True))
    check(settings, data.draw(segments(settings, stops=True)))
