"""Properties of shapers on the tick grid, against the definition of residual vibration written out anew."""

from __future__ import annotations

import math
from decimal import Decimal

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design.families import FAMILIES, design_shaper
from swayless.design.grid import EXTRA_TICKS, solve_on_grid
from swayless.design.grid_shaper import decimal_amplitudes
from swayless.plant import Mode

FAMILY_NAMES = [name for name, family in FAMILIES.items() if not family.parameters & {"order", "delay_s"}]


def _ratio(times_s, amplitudes, frequency_hz, damping_ratio):
    """Residual vibration from its definition, shape (frequencies,)."""
    w = 2.0 * math.pi * np.atleast_1d(frequency_hz)[:, np.newaxis]
    lag_s = times_s - times_s[-1]
    return np.abs(np.exp(w * complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2)) * lag_s) @ amplitudes)


@settings(derandomize=True, deadline=None, max_examples=80)
@given(
    family=st.sampled_from(FAMILY_NAMES),
    damping_ratio=st.floats(0.0, 0.2),
    tolerance=st.floats(0.02, 0.1),
    ticks_per_period=st.floats(9.0, 600.0),
    frequency_hz=st.floats(0.05, 20.0),
)
def test_taps_hold_the_band_that_the_ideal_shaper_promises(
    family, damping_ratio, tolerance, ticks_per_period, frequency_hz
):
    shaper = design_shaper(family, Mode(frequency_hz, damping_ratio), tolerance=tolerance)
    tick_s = 1.0 / (frequency_hz * ticks_per_period)
    taps = solve_on_grid(shaper, tick_s)
    ideal, held = shaper.guarantee.band, taps.guarantee.band
    assert held.low_hz <= ideal.low_hz
    assert held.high_hz >= ideal.high_hz
    # Ten times finer than the ripple of V needs; a damped band may reach to 128 times the mode, so it is cut.
    top_hz = min(held.high_hz, 8.0 * frequency_hz)
    points = 200 + int(640.0 * taps.duration_s * (top_hz - held.low_hz))
    ratio = _ratio(taps.times_s, taps.amplitudes, np.linspace(held.low_hz, top_hz, points), damping_ratio)
    assert ratio.max() <= tolerance * (1.0 + 1e-7)  # the slack of 2e-9, to the least tolerance
    assert taps.delays_ticks[-1] <= math.ceil(shaper.duration_s / tick_s - 1e-6) + EXTRA_TICKS
    if FAMILIES[family].zero_orders is not None:
        at_mode = _ratio(taps.times_s, taps.amplitudes, frequency_hz, damping_ratio)
        assert at_mode[0] < 2e-9  # an equality counts as met within 1e-9, and a zero is two of them
    levels = np.cumsum(np.rint(taps.amplitudes * 1e12))
    assert levels.min() >= 0
    assert levels.max() <= 10**12
    assert FAMILIES[family].negative or taps.amplitudes.min() > 0.0


@settings(derandomize=True, deadline=None, max_examples=200)
@given(weights=st.lists(st.floats(1e-6, 1.0), min_size=1, max_size=12))
def test_decimal_amplitudes_are_decimals_near_the_given_ones_and_sum_to_one(weights):
    amplitudes = np.array(weights) / math.fsum(weights)
    rounded = decimal_amplitudes(amplitudes)
    decimals = [Decimal(repr(value)) for value in rounded.tolist()]
    assert sum(decimals) == 1
    assert all(decimal == round(decimal, 12) for decimal in decimals)
    assert rounded.min() >= 0.0
    # Two partial sums move by half of 1e-12 each, and doubles near 1 are 1e-16 apart.
    assert np.abs(rounded - amplitudes).max() <= 1e-12 + 1e-14


@settings(derandomize=True, deadline=None, max_examples=200)
@given(levels=st.lists(st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 1.0])), min_size=0, max_size=8))
def test_decimal_amplitudes_keep_partial_sums_between_0_and_1(levels):
    rounded = decimal_amplitudes(np.diff([*levels, 1.0], prepend=0.0))
    sums = np.cumsum(np.rint(rounded * 1e12))
    assert sums.min() >= 0.0
    assert sums.max() <= 1e12
