"""The spacing of taps over a position, the taps that follow it, and what they refuse."""

import math
from dataclasses import replace

import numpy as np
import pytest

from swayless.controller import Bank, Row, ShaperSettings, number_type
from swayless.controller.spaced_taps import SpacedTaps, worst_truncated_residual
from swayless.controller.spacing import Spacing, rope_spacing, sampled_spacing
from swayless.controller.spacing_filter import check_products, spacing_of
from swayless.design import design_shaper, residual_vibration
from swayless.errors import ControllerError
from swayless.plant import STANDARD_GRAVITY_M_S2, Mode
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import GUARANTEE, TICK_S, ZVD, block
from tests.unit.controller.spaced_blocks import rope_block, spaced_block

DOUBLE = number_type("double")


@pytest.mark.parametrize("number", NUMBERS)
def test_the_spacing_of_a_rope_is_half_a_damped_period_cut_to_whole_ticks(number):
    spacing = rope_spacing((3.0, 9.0), 0.1, tick_s=0.01, number=number_type(number))
    lengths_mm = np.arange(3000, 9001, 7)
    half_s = math.pi * np.sqrt(lengths_mm / 1000 / STANDARD_GRAVITY_M_S2) / math.sqrt(1.0 - 0.1**2)
    scale = 1 if number == "int32" else 1000
    found = [spacing.at(length / scale) for length in lengths_mm.tolist()]
    assert found == np.floor(half_s / 0.01).astype(int).tolist()


def test_the_spacing_of_an_arm_follows_frequencies_that_rise_and_fall():
    places = np.array([-1.0, 0.0, 0.5, 2.0])
    hertz = np.array([4.0, 5.5, 5.5, 3.7])
    spacing = sampled_spacing(places, hertz, 0.05, tick_s=0.02, number=DOUBLE)
    inside = np.linspace(-1.0, 2.0, 1000)[1:]  # none of them is where the spacing changes
    per_hertz = 1.0 / (2.0 * math.sqrt(1.0 - 0.05**2) * 0.02)
    expected = np.floor(per_hertz / np.interp(inside, places, hertz)).astype(int).tolist()
    assert [spacing.at(place) for place in inside] == expected
    assert (spacing.least, spacing.most) == (4, 6)
    assert spacing.at(-9.0) == spacing.ticks[0]
    assert spacing.at(9.0) == spacing.ticks[-1]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Spacing((), ()), "at least one piece"),
        (lambda: Spacing((1.0, 1.0), (2, 3)), "increasing positions"),
        (lambda: Spacing((1.0,), (0,)), r"spacing of 0 to 0 ticks: allowed are 1 to 32768"),
        (lambda: rope_spacing((3.0, 9.0), 0.0, tick_s=5.0, number=DOUBLE), "too coarse or too fine"),
        (lambda: rope_spacing((3.0, 9.0), 0.0, tick_s=1e-12, number=DOUBLE), "too coarse or too fine"),
        (
            lambda: sampled_spacing([0, 1], [1e-300, 1.0], 0.0, tick_s=0.02, number=DOUBLE),
            "spacing of 25 to 2.5e.301 ticks: allowed are 1 to 32768",
        ),
        (lambda: sampled_spacing([0, 0], [1, 2], 0.0, tick_s=0.1, number=DOUBLE), "increasing, as many"),
        (lambda: sampled_spacing([0, 1], [1, 0], 0.0, tick_s=0.1, number=DOUBLE), "frequency_hz = 0.0"),
    ],
)
def test_a_spacing_that_cannot_be_is_refused(make, message):
    with pytest.raises(ControllerError, match=message):
        make()


def taps_of(amplitudes, law="modified", number=DOUBLE):
    return SpacedTaps(np.array(amplitudes), Spacing((1.0,), (4,)), law, TICK_S, GUARANTEE, number)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: taps_of([1.0]), "at least two"),
        (lambda: taps_of([1.0, -1.0, 1.0]), "positive amplitudes only"),
        (lambda: taps_of([0.5, 0.25]), "do not sum to exactly 1 in double"),
        (lambda: taps_of([0.5, 0.5], law="fixed"), "law = 'fixed': must be one of original, modified"),
        (lambda: rope_block(family="mzv", tick_s=0.01), "those of family = 'mzv' are not"),
        (
            lambda: rope_block(family="zv", tick_s=0.3),
            "0.3 s leave .* at a spacing of 5 ticks, more than the 5 %",
        ),
    ],
)
def test_taps_that_cannot_follow_a_spacing_are_refused(make, message):
    with pytest.raises(ControllerError, match=message):
        make()


def test_what_truncation_leaves_is_the_most_that_any_rope_of_the_range_finds():
    settings = rope_block(tick_s=0.1, tolerance=0.2)
    taps = settings.bank.rows[0].taps
    lengths_m = np.linspace(3.0, 9.0, 4001)
    hertz = np.sqrt(STANDARD_GRAVITY_M_S2 / lengths_m) / (2.0 * math.pi)
    zvd = design_shaper("zvd", Mode(1.0))
    left = []
    for length_m, frequency in zip(lengths_m, hertz, strict=True):
        times = np.arange(3) * taps.spacing.at(length_m) * 0.1
        left.append(float(residual_vibration(replace(zvd, times_s=times, guarantee=None), frequency)))
    # The range ends inside a spacing, and the lengths are 1.5 mm apart: the bound is above by little.
    assert max(left) <= worst_truncated_residual(taps) <= max(left) * 1.02


def test_rows_that_differ_in_law_or_spacing_are_refused():
    one = spaced_block(law="modified", amplitudes=[0.5, 0.5], ticks=[4, 5])
    other = spaced_block(law="original", amplitudes=[0.5, 0.5], ticks=[4, 5])
    rows = (one.bank.rows[0], Row("row 2", "zv", other.bank.rows[0].taps))
    with pytest.raises(ControllerError, match="must follow one law and one spacing"):
        spacing_of(ShaperSettings(Bank(rows), one.limits, one.rope))
    with pytest.raises(ControllerError, match="must follow one law and one spacing"):
        spacing_of(block(ZVD))


def test_counts_whose_products_leave_64_bits_are_refused():
    fine = spaced_block("int32", amplitudes=[0.5, 0.5], ticks=[1000], units_per_m_s=4e6)
    check_products(fine)
    large = spaced_block("int32", amplitudes=[0.5, 0.5], ticks=[1000], units_per_m_s=2e7)
    with pytest.raises(ControllerError, match="10000000 counts times 1000 ticks exceeds 64 bits"):
        check_products(large)


def test_the_duration_is_that_of_the_widest_spacing():
    taps = taps_of([0.25, 0.5, 0.25])
    assert taps.longest_delay_ticks == 8
    assert taps.duration_s == pytest.approx(8 * TICK_S, rel=1e-15)
    assert taps.times_s.tolist() == pytest.approx([0.0, 4 * TICK_S, 8 * TICK_S], rel=1e-15)
    assert not taps.has_negative
