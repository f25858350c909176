"""The phase clock does not drift: in float, after hours without rest, all is as exact as at the start."""

import numpy as np

from swayless.controller import CommandShaper, ShaperInput
from tests.properties.phase_histories import TICK_S, longest_tail, released, ticks_to_rest
from tests.unit.controller.blocks import phase_block, run

MOVING, REPEATED = 50_000, 150_000
PERIOD = 34
"""Ticks after which a command repeats itself on a rope that stands, so that its rounding errors do too."""


def hoisting(settings, random):
    """Commands that change every 10 ticks, on a rope that goes up and down."""
    commands = random.uniform(-0.8, 0.8, MOVING // 10).astype(np.float32)
    lengths = (6.0 + 2.9 * np.sin(0.002 * np.arange(MOVING))).astype(np.float32)
    speeds = (np.diff(lengths, append=lengths[-1]) / TICK_S).astype(np.float32)
    for k in range(MOVING):
        yield ShaperInput(commands[k // 10], rope_length=lengths[k], hoist_speed=speeds[k])


def test_in_float_a_command_that_never_rested_comes_back_exactly():
    settings = phase_block("float", family="zv", tick_s=TICK_S)
    shaper, scalar, random = CommandShaper(settings), settings.number.scalar, np.random.default_rng(7)
    for now in hoisting(settings, random):
        shaper.step(now)
    still = now._replace(hoist_speed=scalar(0), rope_length=scalar(7.3))
    pattern = [still._replace(command=scalar(0.7 if k < PERIOD // 3 else 0.1)) for k in range(PERIOD)]
    for k in range(REPEATED):
        shaper.step(pattern[k % PERIOD])
    assert shaper._filter.is_running
    # What was released before the rope stood is forgotten after two rings.
    wild = random.uniform(-0.8, 0.8, 4 * longest_tail(settings)).astype(np.float32)
    out = [shaper.step(still._replace(command=command)) for command in wild][-1]
    stopped = run(shaper, released(settings, still, 2 * ticks_to_rest(settings)))
    way_m = sum(float(each.reference) for each in stopped) * TICK_S
    # Two rings of 60 cells with two sums each of at most 0.8 m/s x 60 ticks, right to 2**-24 of that. Without
    # the second sum of `FloatPhaseFilter` the pattern drifts to three times as much.
    assert abs(float(out.stop_distance) - way_m) <= 240 * 48 * 2.0**-24 * TICK_S
    assert (stopped[-1].reference, stopped[-1].stop_distance, stopped[-1].stop_time_ticks) == (0, 0, 0)
    assert stopped[-1].settled
