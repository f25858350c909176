"""Shapers and histories for the properties of the command shaper."""

from itertools import pairwise

from hypothesis import settings
from hypothesis import strategies as st

from swayless.controller import ShaperInput
from tests.unit.controller.blocks import MAX_SPEED_M_S, TICK_S, block, command_of

NUMBERS = ("double", "float", "int32")


def examples(count):
    """Settings of a property: the same examples in every run, and as many as the time allows."""
    return settings(derandomize=True, deadline=None, max_examples=count)


@st.composite
def delays(draw, count):
    """Delays of taps, neighbours included."""
    found = [0]
    for _ in range(count - 1):
        found.append(found[-1] + draw(st.integers(1, 6)))
    return found


@st.composite
def positive_rows(draw):
    """Two to five taps with positive amplitudes."""
    weights = draw(st.lists(st.integers(1, 20), min_size=2, max_size=5))
    return tuple(zip(draw(delays(len(weights))), [w / sum(weights) for w in weights], strict=True))


@st.composite
def negative_rows(draw):
    """Taps whose partial sums stay in [0, 1] and fall at least once; unity magnitude among them."""
    if draw(st.booleans()):
        inner = [1.0, 0.0] * draw(st.integers(1, 2))
    else:
        sixteenths = draw(st.lists(st.integers(0, 16), min_size=2, max_size=4))
        inner = [s / 16 for s in sixteenths]
    sums = [*inner, 1.0]
    if all(a <= b for a, b in pairwise(sums)):
        sums = [1.0, *sums[:-1], 0.5, 1.0]
    amplitudes = [b - a for a, b in zip([0.0, *sums[:-1]], sums, strict=True)]
    return tuple(zip(draw(delays(len(amplitudes))), amplitudes, strict=True))


@st.composite
def ramps(draw):
    """Accelerations of 1 to 14 ticks to full speed, or none."""
    named = {}
    for name in ("acceleration_m_s2", "deceleration_m_s2", "quick_stop_m_s2"):
        ticks = draw(st.one_of(st.none(), st.floats(0.7, 14.0)))
        named[name] = None if ticks is None else MAX_SPEED_M_S / (ticks * TICK_S)
    return named


@st.composite
def small_commands(draw):
    """Minimum, inching and resolution: each on or off."""
    return {
        "minimum_speed_m_s": draw(st.sampled_from([0.0, 0.03])),
        "inching_speed_m_s": draw(st.sampled_from([0.0, 0.08])),
        "command_resolution_m_s": draw(st.sampled_from([0.0, 0.02])),
    }


@st.composite
def blocks(draw, rows=None, most_rows=3, optional=False):
    """Settings of a shaper with one to three rows, in any number type."""
    rows = positive_rows() | negative_rows() if rows is None else rows
    limits = draw(ramps()) | (draw(small_commands()) if optional else {})
    return block(
        *draw(st.lists(rows, min_size=1, max_size=most_rows)), number=draw(st.sampled_from(NUMBERS)), **limits
    )


ratios = st.one_of(
    st.sampled_from([0.0, 0.0, 1.0, -1.0, 0.1, -0.1]), st.floats(-1.1, 1.1, allow_subnormal=False)
)
"""Commands as a ratio of the maximum; a few beyond it."""


@st.composite
def segments(draw, settings, most=8, longest=12, stops=False, selectors=True, commands=ratios):
    """A history of pieces during which no input changes, tick by tick."""
    inputs = []
    for _ in range(draw(st.integers(1, most))):
        ratio = draw(commands)
        piece = ShaperInput(
            command_of(settings, ratio),
            selector=draw(st.integers(0, len(settings.bank.rows) + 1)) if selectors else 1,
            enable=draw(st.integers(0, 4)) > 0 if selectors else True,
            quick_stop=draw(st.integers(0, 5)) == 0 if stops else False,
            emergency_stop=draw(st.integers(0, 9)) == 0 if stops else False,
        )
        inputs += [piece] * draw(st.integers(1, longest))
    return inputs
