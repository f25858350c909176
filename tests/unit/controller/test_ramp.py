"""The closed form of a ramp is the ramp, to the tick, and in counts to the last count."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller.ramp import Glider, on_grid, ramped
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import COUNTS_PER_M_S, MAX_SPEED_M_S, TICK_S, ZVD, block

SUM_SLACK = {"double": 1e-13, "float": 1e-4, "int32": 0.0}
"""Some 300 roundings of sums below 64 m/s: by 2**-48 or 2**-19 each at most."""


def walked(start, target, limits):
    """Ticks and sum of the commands of a ramp, step by step."""
    ticks, total, command = 0, 0.0, start
    while command != target:
        command = ramped(command, target, limits)
        ticks, total = ticks + 1, total + float(command)
        assert ticks < 500
    return ticks, total


def moved(value, places, settings):
    """A command some last places away."""
    if settings.number.is_integer:
        return value + places
    for _ in range(abs(places)):
        value = np.nextafter(value, settings.number.scalar(np.sign(places) * np.inf))
    return settings.number.scalar(value)


@examples(300)
@given(
    number=st.sampled_from(NUMBERS),
    ticks=st.tuples(st.floats(1.0, 300.0), st.floats(1.0, 300.0)),
    start=st.floats(0.0, 1.0),
    steps=st.integers(0, 300),
    places=st.integers(-3, 3),
    rises=st.booleans(),
    negative=st.booleans(),
)
def test_closed_form_lands_on_the_tick_of_the_ramp_however_close_the_target(
    number, ticks, start, steps, places, rises, negative
):
    rates = [MAX_SPEED_M_S / (each * TICK_S) for each in ticks]
    # Steps of one count would be refused: 300 ticks of at least 20 counts.
    settings = block(
        ZVD,
        number=number,
        acceleration_m_s2=rates[0],
        deceleration_m_s2=rates[1],
        units_per_m_s=COUNTS_PER_M_S if number == "int32" else 1.0,
    )
    limits, scalar = settings.limits, settings.number.scalar
    first = scalar(start * float(limits.max_command))
    step = limits.acceleration_step if rises else -limits.deceleration_step
    # The hardest target lies a whole number of steps away, give or take a last place.
    last = moved(scalar(float(first) + steps * float(step)), places, settings)
    if not 0 <= last <= limits.max_command or (last > first) != rises:
        last = limits.max_command if rises else scalar(0)
    if negative:
        first, last = scalar(0) - first, scalar(0) - last
    glide = Glider(abs(step), limits, settings.number)(first, last)
    walked_ticks, walked_sum = walked(first, last, limits)
    assert glide.ticks == walked_ticks
    assert abs(float(glide.total) - walked_sum) <= SUM_SLACK[number]


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
