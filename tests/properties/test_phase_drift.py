"""The phase clock does not drift: in float, after hours without rest, all is as exact as at the start."""

import numpy as np

from swayless.controller import CommandShaper, ShaperInput
from tests.properties.phase_histories import TICK_S, longest_tail, released, ticks_to_rest
from tests.unit.controller.blocks import phase_block, run

TICKS = 200_000


def test_in_float_a_command_that_never_rested_on_a_rope_that_never_stood_comes_back_exactly():
    settings = phase_block("float", family="zv", tick_s=TICK_S)
    shaper, scalar = CommandShaper(settings), settings.number.scalar
    random = np.random.default_rng(7)
    commands = random.uniform(-0.8, 0.8, TICKS // 10).astype(np.float32)
    swell = np.sin(0.002 * np.arange(TICKS))
    lengths = (6.0 + 2.9 * swell).astype(np.float32)
    speeds = (np.diff(lengths, append=lengths[-1]) / TICK_S).astype(np.float32)
    for k in range(TICKS):
        shaper.step(ShaperInput(commands[k // 10], rope_length=lengths[k], hoist_speed=speeds[k]))
    assert shaper._filter.is_running
    # The rope stands for two rings, so that the stop distance has forgotten the hoist.
    still = ShaperInput(scalar(0), rope_length=lengths[-1], hoist_speed=scalar(0))
    wild = random.uniform(-0.8, 0.8, 4 * longest_tail(settings)).astype(np.float32)
    out = [shaper.step(still._replace(command=command)) for command in wild][-1]
    stopped = run(shaper, released(settings, still, 2 * ticks_to_rest(settings)))
    way_m = sum(float(each.reference) for each in stopped) * TICK_S
    # Two rings of 60 cells with two sums each of at most 0.8 m/s x 60 ticks, right to 2**-24 of that.
    assert abs(float(out.stop_distance) - way_m) <= 240 * 48 * 2.0**-24 * TICK_S
    assert (stopped[-1].reference, stopped[-1].stop_distance, stopped[-1].stop_time_ticks) == (0, 0, 0)
    assert stopped[-1].settled
