"""Phase clocks, and histories of their commands and ropes, for the properties of the phase clock."""

import math

import numpy as np
from hypothesis import strategies as st

from swayless.controller import ShaperInput
from swayless.controller.rope import MM_PER_M
from tests.properties.strategies import NUMBERS, ratios
from tests.unit.controller.blocks import command_of, phase_block

TICK_S = 0.05
ROPE_LENGTH_M = (3.0, 9.0)
FAMILIES = ("zv", "zvd", "ei", "zvdd", "ei3")


@st.composite
def phase_blocks(draw, numbers=NUMBERS, families=FAMILIES, damping_ratios=(0.0, 0.02, 0.1), **limits):
    """Settings of a phase clock: any positive family, damped or not, and ramps of 1 to 40 ticks."""
    ramps = {
        f"{name}_m_s2": draw(st.sampled_from([40.0, 0.4, 1.1]))
        for name in ("acceleration", "deceleration", "quick_stop")
    }
    return phase_block(
        draw(st.sampled_from(numbers)),
        family=draw(st.sampled_from(families)),
        damping_ratio=draw(st.sampled_from(damping_ratios)),
        rope_length_m=ROPE_LENGTH_M,
        hoist_speed_m_s=draw(st.sampled_from([0.3, 1.0])),
        tick_s=TICK_S,
        **(ramps | limits),
    )


def longest_tail(settings):
    """Ticks in which the last tap passes on the longest rope, and one for its split."""
    return settings.longest_delay_ticks + 1


def ramp_ticks(settings):
    """Ticks from full speed to 0 on the slowest ramp."""
    limits = settings.limits
    slowest = min(limits.acceleration_step, limits.deceleration_step, limits.quick_stop_step)
    return math.ceil(float(limits.max_command) / float(slowest))


def ticks_to_rest(settings):
    """Ticks after which all is at rest on a rope that stands: ramp, taps, answers, and what these lack."""
    return ramp_ticks(settings) + 4 * longest_tail(settings)


def rope_input(settings, length_m, speed_m_s):
    """Rope length and hoist speed in the units of the block."""
    scalar = settings.number.scalar
    if settings.number.is_integer:
        return {"rope_length": round(length_m * MM_PER_M), "hoist_speed": round(speed_m_s * MM_PER_M)}
    return {"rope_length": scalar(length_m), "hoist_speed": scalar(speed_m_s)}


def hoist_limit_m_s(settings):
    """Fastest hoist, in m/s."""
    return float(settings.rope.hoist_speed) / (MM_PER_M if settings.number.is_integer else 1)


@st.composite
def still_ropes(draw, settings):
    """One rope length within the range, ends included."""
    return draw(st.sampled_from(ROPE_LENGTH_M) | st.floats(*ROPE_LENGTH_M))


@st.composite
def hoists(draw, settings, ticks, noise_m_s=0.0):
    """Lengths and speeds of a hoist that starts and stops, within the range: shape (ticks,) each."""
    limit = hoist_limit_m_s(settings)
    length, lengths, speeds = draw(still_ropes(settings)), [], []
    while len(lengths) < ticks:
        speed = draw(st.sampled_from([0.0, 0.0, limit, -limit]) | st.floats(-limit, limit))
        for _ in range(draw(st.integers(1, 60))):
            after = min(max(length + speed * TICK_S, ROPE_LENGTH_M[0]), ROPE_LENGTH_M[1])
            lengths.append(length)
            speeds.append((after - length) / TICK_S)
            length = after
    noise = np.random.default_rng(draw(st.integers(0, 99))).uniform(-noise_m_s, noise_m_s, ticks)
    return lengths[:ticks], (np.array(speeds[:ticks]) + noise).tolist()


@st.composite
def commands(draw, settings, most=8, longest=30, stops=False, selectors=False):
    """Inputs without a rope: pieces during which nothing changes."""
    inputs = []
    for _ in range(draw(st.integers(1, most))):
        piece = ShaperInput(
            command_of(settings, draw(ratios)),
            selector=draw(st.integers(0, 2)) if selectors else 1,
            enable=draw(st.integers(0, 4)) > 0 if selectors else True,
            quick_stop=draw(st.integers(0, 5)) == 0 if stops else False,
            emergency_stop=draw(st.integers(0, 9)) == 0 if stops else False,
        )
        inputs += [piece] * draw(st.integers(1, longest))
    return inputs


def on_ropes(settings, inputs, lengths_m, speeds_m_s):
    """Give the inputs their ropes."""
    return [
        each._replace(**rope_input(settings, length, speed))
        for each, length, speed in zip(inputs, lengths_m, speeds_m_s, strict=True)
    ]


@st.composite
def travelling(draw, settings, **options):
    """Random commands on a random rope."""
    inputs = draw(commands(settings, **options))
    return on_ropes(settings, inputs, *draw(hoists(settings, len(inputs))))


@st.composite
def standing(draw, settings, **options):
    """Random commands on a rope that stands."""
    inputs, rope = draw(commands(settings, **options)), draw(still_ropes(settings))
    return on_ropes(settings, inputs, [rope] * len(inputs), [0.0] * len(inputs))


def bad_ropes(settings):
    """Readings that cannot be true, or are flagged: fields to replace."""
    scalar, rope = settings.number.scalar, settings.rope
    bad = [
        {"rope_length_valid": False},
        {"rope_length": rope.longest + rope.longest},
        {"rope_length": scalar(0)},
        {"rope_length": -rope.longest},
        {"rope_length": rope.shortest},
        {"rope_length": rope.longest},
        {"hoist_speed": rope.hoist_speed + rope.hoist_speed},
    ]
    if not settings.number.is_integer:
        odd = [scalar(value) for value in (math.nan, math.inf, -math.inf)]
        bad += [{"rope_length": value} for value in odd] + [{"hoist_speed": value} for value in odd]
    return st.sampled_from(bad)


@st.composite
def spoilt(draw, settings, inputs):
    """Spoil some pieces of a history: single readings, and readings that stay bad."""
    inputs = list(inputs)
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(inputs) - 1))
        fields = draw(bad_ropes(settings))
        for k in range(start, min(start + draw(st.sampled_from([1, 2, 15])), len(inputs))):
            inputs[k] = inputs[k]._replace(**fields)
    return inputs


def released(settings, last, ticks=None):
    """Command 0 on the rope of the last input, now still."""
    still = last._replace(
        command=settings.number.scalar(0),
        hoist_speed=settings.number.scalar(0),
        selector=1,
        enable=True,
        quick_stop=False,
        emergency_stop=False,
        rope_length_valid=True,
    )
    return [still] * (ticks_to_rest(settings) if ticks is None else ticks)


def rounding(settings, ticks):
    """Largest error of a reference in which the changes of so many ticks are under way, in command units.

    Each tap's part, and each part of a part, is rounded to half of a grid unit, and the weights are right
    to a few units in the last place. In int32 the same holds for scaled commands, and the reference is
    rounded to a count.
    """
    taps = max(len(table.lags) for table in settings.row_tables)
    if settings.number.is_integer:
        return 1.0 + ticks * taps * 2.0 ** -(30 - int(settings.limits.max_command).bit_length())
    unit = float(np.spacing(settings.limits.ramp_anchor))
    return 2.0 * ticks * taps * unit
