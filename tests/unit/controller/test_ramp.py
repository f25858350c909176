"""The closed form of a ramp is the ramp, to the tick, and in counts to the last count."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller.ramp import Glider, on_grid, ramped
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import MAX_SPEED_M_S, TICK_S, ZVD, block

SUM_SLACK = {"double": 2e-12, "float": 1e-3, "int32": 0.0}
"""A sum of 200 commands below 64 m/s is rounded by 2**-47 or 2**-18 each time at most."""


def walked(start, target, limits):
    """Ticks and sum of the commands of a ramp, step by step."""
    ticks, total, command = 0, 0.0, start
    while command != target:
        command = ramped(command, target, limits)
        ticks, total = ticks + 1, total + float(command)
        assert ticks < 500
    return ticks, total


def hard_ramps(settings, random, count):
    """Starts and targets a whole number of steps apart, give or take a few last places; either direction."""
    limits, scalar = settings.limits, settings.number.scalar
    while count > 0:
        first = scalar(random.choice([0.0, 1.0, random.uniform()]) * float(limits.max_command))
        rises = random.random() < 0.6
        step = limits.acceleration_step if rises else -limits.deceleration_step
        last = scalar(float(first) + random.choice([0, random.integers(0, 300)]) * float(step))
        last += random.integers(-3, 4) * (1 if settings.number.is_integer else scalar(np.spacing(last)))
        last = scalar(last) if random.random() < 0.9 else scalar(0)
        if 0 <= last <= limits.max_command and last != first:
            sign = scalar(random.choice([-1, 1]))
            yield first * sign + scalar(0), last * sign + scalar(0)
            count -= 1


@pytest.mark.parametrize("number", NUMBERS)
def test_closed_form_lands_on_the_tick_of_the_ramp_however_close_the_target(number):
    random = np.random.default_rng(11)
    for _ in range(40):
        acceleration, deceleration = MAX_SPEED_M_S / (random.uniform(1.0, 200.0, 2) * TICK_S)
        settings = block(ZVD, number=number, acceleration_m_s2=acceleration, deceleration_m_s2=deceleration)
        limits = settings.limits
        for first, last in hard_ramps(settings, random, 25):
            step = limits.acceleration_step if abs(last) > abs(first) else limits.deceleration_step
            glide = Glider(step, limits, settings.number)(first, last)
            ticks, total = walked(first, last, limits)
            assert glide.ticks == ticks
            assert abs(float(glide.total) - total) <= SUM_SLACK[number]


def test_reciprocal_in_counts_divides_exactly():
    random = np.random.default_rng(7)
    settings = block(ZVD, number="int32")
    gaps = np.concatenate([2 ** random.uniform(0, 29, 200_000), [1.0, 2.0**29]]).astype(np.int64)
    for step in [1, 2, 3, 7, 2**30 - 1, 2**30, *(2 ** random.uniform(0, 30, 12)).astype(int).tolist()]:
        glider = Glider(step, settings.limits, settings.number)
        near = np.clip(gaps // step * step + random.integers(-1, 3, gaps.size), 1, 2**29)
        for some in (gaps, near):
            # Vectorised in unsigned 64 bits, as the C does it.
            whole = ((some - 1).astype(np.uint64) * np.uint64(glider.reciprocal)) >> np.uint64(glider.shift)
            np.testing.assert_array_equal(whole.astype(np.int64), (some - 1) // step)


@pytest.mark.parametrize("number", NUMBERS)
@examples(50)
@given(ratio=st.floats(-1.0, 1.0))
def test_on_grid_moves_a_command_by_half_a_unit_at_most_and_never_twice(number, ratio):
    settings = block(ZVD, number=number)
    limits = settings.limits
    command = settings.number.scalar(ratio * float(limits.max_command))
    gridded = on_grid(command, limits)
    unit = 0.0 if number == "int32" else float(np.spacing(limits.ramp_anchor))
    assert abs(float(gridded) - float(command)) <= unit / 2
    assert on_grid(gridded, limits) == gridded
