"""One program over several bands against a convolution of single-mode shapers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import residual_vibration
from swayless.design.several_modes import compare_with_convolution
from swayless.errors import DesignError
from swayless.plant import Band, double_pendulum_modes

HOOK_AND_LOAD = [Band(0.2, 0.25), Band(0.8, 1.0)]


def crane_bands(ropes_m: tuple[float, float]) -> list[Band]:
    """Bands of a hook of 300 kg with 1.5 t on a sling of 3 m, over a range of rope."""
    longest, shortest = (
        double_pendulum_modes(rope_m, 3.0, 300.0, 1500.0) for rope_m in sorted(ropes_m)[::-1]
    )
    return [Band(low.frequency_hz, high.frequency_hz) for low, high in zip(longest, shortest, strict=True)]


def worst_sampled(modes, band: Band) -> float:
    """What the convolution leaves in a band, as a product of what its shapers leave, on a fine grid."""
    frequency_hz = np.linspace(band.low_hz, band.high_hz, 4001)
    return float(
        np.prod([residual_vibration(one.shaper, frequency_hz) for one in modes.designs], axis=0).max()
    )


def test_a_crane_with_a_light_hook_saves_a_twelfth_of_the_convolution():
    modes = compare_with_convolution(crane_bands((5.0, 7.0)))
    assert modes.one.shaper.duration_s == pytest.approx(4.7444, abs=5e-5)  # quoted to four decimals
    assert modes.convolved_duration_s == pytest.approx(5.1744, abs=5e-5)
    assert modes.saving_ratio == pytest.approx(0.0831, abs=5e-5)
    assert modes.one.shaper.guarantee.bands == tuple(crane_bands((5.0, 7.0)))


def test_an_arm_with_two_damped_resonances_saves_an_eighth():
    modes = compare_with_convolution([Band(1.9, 2.4), Band(5.0, 6.5)], damping_ratio=0.02)
    assert modes.saving_ratio == pytest.approx(0.1291, abs=5e-5)
    assert modes.one.shaper.guarantee.damping_ratios == (0.02, 0.02)


def test_the_convolution_is_that_of_the_shortest_shaper_for_each_band():
    modes = compare_with_convolution(HOOK_AND_LOAD)
    assert [design.shaper.guarantee.bands for design in modes.separate] == [(band,) for band in HOOK_AND_LOAD]
    durations_s = [design.shaper.duration_s for design in modes.separate]
    assert modes.convolved_duration_s == pytest.approx(math.fsum(durations_s), rel=1e-15)
    assert modes.convolved.amplitudes.sum() == pytest.approx(1.0, abs=1e-12)
    assert np.all(np.diff(modes.convolved.times_s) >= 0.0)


def test_what_the_convolution_leaves_is_the_product_of_what_its_shapers_leave():
    modes = compare_with_convolution(HOOK_AND_LOAD)
    sampled = [worst_sampled(modes.convolved, band) for band in HOOK_AND_LOAD]
    # A grid misses a maximum by half of its curvature times a squared step: below 1e-6 here.
    assert modes.convolved.worst_residual_ratios == pytest.approx(sampled, rel=1e-6)
    assert modes.convolved_worst_ratio == max(modes.convolved.worst_residual_ratios)


def test_the_relaxed_convolution_just_holds_the_tolerance_in_each_band_and_is_shorter():
    modes = compare_with_convolution(HOOK_AND_LOAD)
    relaxed = modes.relaxed
    assert relaxed is not None
    assert [worst_sampled(relaxed, band) for band in HOOK_AND_LOAD] == pytest.approx([0.05, 0.05], rel=2e-6)
    tolerances = [design.shaper.guarantee.tolerance for design in relaxed.designs]
    # Of the higher band there are several shapers of one duration, and each lets through something else.
    assert tolerances == pytest.approx([0.05557, 0.0504], abs=1e-4)
    assert modes.one.shaper.duration_s < relaxed.duration_s < modes.convolved_duration_s
    assert modes.relaxed_saving_ratio == pytest.approx(0.0995, abs=5e-4)


def test_a_relaxed_tolerance_stops_at_20_percent():
    modes = compare_with_convolution([Band(1.0, 1.05), Band(3.0, 3.1)])
    assert modes.relaxed is not None
    assert modes.relaxed.designs[1].shaper.guarantee.tolerance == 0.2
    assert modes.relaxed.worst_residual_ratios[1] < 0.034
    # At 5 % each the convolution leaves far less than asked for where the first shaper already helps.
    assert modes.convolved.worst_residual_ratios[1] < 0.008


def test_convolved_unity_magnitude_shapers_leave_more_than_either_promises():
    modes = compare_with_convolution(HOOK_AND_LOAD, amplitudes="unity-magnitude")
    assert modes.convolved_worst_ratio == pytest.approx(0.1316, abs=5e-5)
    assert modes.saving_ratio == pytest.approx(0.0811, abs=5e-5)
    assert modes.relaxed is not None
    assert modes.relaxed.designs[1].shaper.guarantee.tolerance < 0.05


def test_convolved_unity_magnitude_shapers_may_ask_for_twice_the_full_speed_and_for_reverse():
    modes = compare_with_convolution([Band(0.2, 0.3), Band(0.4, 0.5)], amplitudes="unity-magnitude")
    # Levels are whole numbers but for the rounding of a dozen sums.
    assert modes.convolved.reference_range == pytest.approx((-1.0, 2.0), abs=1e-12)
    assert set(np.cumsum(modes.one.shaper.amplitudes).round(9)) == {0.0, 1.0}


def test_positive_amplitudes_keep_the_reference_in_range():
    modes = compare_with_convolution(HOOK_AND_LOAD)
    assert modes.convolved.reference_range == pytest.approx((0.0, 1.0), abs=1e-12)


@settings(derandomize=True, deadline=None, max_examples=6)
@given(
    steps=st.tuples(st.floats(1.05, 1.6), st.floats(1.2, 2.5), st.floats(1.05, 1.6)),
    tolerance=st.floats(0.03, 0.15),
    damping_ratio=st.sampled_from([0.0, 0.03]),
)
def test_one_program_is_never_longer_than_the_convolution_and_both_hold_the_bands(
    steps, tolerance, damping_ratio
):
    ends = np.cumprod([1.0, *steps]).tolist()
    bands = [Band(*ends[:2]), Band(*ends[2:])]
    modes = compare_with_convolution(bands, tolerance=tolerance, damping_ratio=damping_ratio)
    # Both are the shortest of their kind to about 1e-6, which is what a tie may be lost by.
    assert modes.saving_ratio > -2e-6
    assert modes.convolved_worst_ratio <= tolerance * (1.0 + 1e-9)
    assert modes.one.lower_bound_s <= modes.convolved_duration_s


@pytest.mark.parametrize("bands", [[Band(0.2, 0.3)], [Band(0.2, 0.3), Band(0.25, 0.4)]])
def test_bands_that_are_one_are_refused(bands):
    with pytest.raises(DesignError, match=r"bands = .*: must be at least two that do not meet"):
        compare_with_convolution(bands)
