"""Held bands, worst residuals and the figures of robustness, against brute force and known widths."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import (
    FAMILIES,
    design_shaper,
    guarantee_of,
    held_band,
    insensitivity_width,
    overtravel_s,
    partial_sums,
    peak_factor,
    proven_shaper,
    residual_vibration,
    rope_length_interval_m,
    worst_residual,
)
from swayless.design.robustness import TOUCH_SLACK, WIDEST_RATIO
from swayless.errors import DesignError
from swayless.plant import Band, Mode, pendulum_frequency_hz

SETTINGS = settings(derandomize=True, deadline=None, max_examples=50)
WITHOUT_PARAMETER = [name for name, family in FAMILIES.items() if family.parameters <= {"tolerance"}]


def impulses(times_s, amplitudes):
    return SimpleNamespace(
        times_s=np.array(times_s, dtype=float), amplitudes=np.array(amplitudes, dtype=float)
    )


@pytest.mark.parametrize(
    ("family", "width"),
    [
        ("zv", 0.06368853294664),
        ("zvd", 0.28713258625741),
        ("ei", 0.39945075132908),
        ("ei2", 0.72454365144167),
        ("ei3", 0.96389310933946),
    ],
)
def test_undamped_widths_at_5_percent_are_the_known_ones(family, width):
    # ZV: |cos(pi f / 2)| <= 0.05; ZVD: its square; the others follow from their formulas in cos(pi f / 2).
    shaper = design_shaper(family, Mode(1.0), tolerance=0.05)
    assert insensitivity_width(shaper, Mode(1.0), tolerance=0.05) == pytest.approx(width, abs=1e-12)


@pytest.mark.parametrize("frequency_hz", [0.05, 1.0, 37.0])
@pytest.mark.parametrize("tolerance", [0.001, 0.05, 0.3])
def test_the_band_of_an_undamped_zv_shaper_is_its_closed_form(frequency_hz, tolerance):
    mode = Mode(frequency_hz)
    band = held_band(design_shaper("zv", mode), mode, tolerance=tolerance)
    reach = 2.0 / math.pi * math.asin(tolerance)  # V = |cos(pi f / 2 f_mode)|
    assert band.low_hz == pytest.approx(frequency_hz * (1.0 - reach), rel=1e-13)
    assert band.high_hz == pytest.approx(frequency_hz * (1.0 + reach), rel=1e-13)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05, 0.2])
@pytest.mark.parametrize("tolerance", [0.02, 0.05, 0.1])
@pytest.mark.parametrize("family", WITHOUT_PARAMETER)
def test_the_promised_band_holds_everywhere_and_not_a_hair_beyond(family, tolerance, damping_ratio):
    shaper = design_shaper(family, Mode(0.8, damping_ratio), tolerance=tolerance)
    band = shaper.guarantee.band
    inside_hz = np.linspace(band.low_hz, band.high_hz, 20_001)
    within = residual_vibration(shaper, inside_hz, damping_ratio=damping_ratio)
    assert within.max() <= tolerance * (1.0 + TOUCH_SLACK)
    beyond = residual_vibration(
        shaper, [band.low_hz * (1 - 1e-7), band.high_hz * (1 + 1e-7)], damping_ratio=damping_ratio
    )
    assert beyond[0] > tolerance
    assert beyond[1] > tolerance or band.high_hz == pytest.approx(0.8 * WIDEST_RATIO)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05, 0.2])
@pytest.mark.parametrize("family", WITHOUT_PARAMETER)
def test_the_guarantee_states_the_worst_residual_in_its_band(family, damping_ratio):
    shaper = design_shaper(family, Mode(0.8, damping_ratio), tolerance=0.05)
    worst = worst_residual(shaper, shaper.guarantee.band, damping_ratio=damping_ratio)
    assert shaper.guarantee.worst_residual_ratio == pytest.approx(worst, abs=1e-12)
    assert worst == pytest.approx(0.05, abs=1e-10)


@SETTINGS
@given(
    gaps_s=st.lists(st.floats(0.05, 1.0), min_size=1, max_size=5),
    weights=st.lists(st.floats(0.05, 1.0), min_size=6, max_size=6),
    low_hz=st.floats(0.05, 2.0),
    width_hz=st.floats(0.0, 3.0),
    damping_ratio=st.floats(0.0, 0.4),
)
def test_no_dense_sample_exceeds_the_worst_residual_and_one_comes_near(
    gaps_s, weights, low_hz, width_hz, damping_ratio
):
    amplitudes = np.array(weights[: len(gaps_s) + 1])
    shape = impulses(np.concatenate([[0.0], np.cumsum(gaps_s)]), amplitudes / amplitudes.sum())
    worst = worst_residual(shape, Band(low_hz, low_hz + width_hz), damping_ratio=damping_ratio)
    samples = residual_vibration(
        shape, np.linspace(low_hz, low_hz + width_hz, 20_001), damping_ratio=damping_ratio
    )
    assert samples.max() <= worst + 1e-14
    # Between samples 1.5e-4 Hz apart V rises by at most its bend, (2 pi 5 s)^2, times an eighth step squared.
    assert samples.max() >= worst - 1e-5


@SETTINGS
@given(peak_hz=st.floats(0.9, 1.1))
def test_a_maximum_between_samples_is_found_to_rounding(peak_hz):
    shape = impulses([0.0, 0.5 / peak_hz], [1.0, -1.0])  # undamped, V = 2 |sin(pi f / 2 peak)|
    assert worst_residual(shape, Band(0.5, 1.6)) == pytest.approx(2.0, abs=1e-15)


def test_a_hump_above_the_tolerance_ends_the_band_before_it():
    ei = design_shaper("ei", Mode(1.0), tolerance=0.05)
    low_zero_hz = 1.0 - 2.0 / math.pi * math.atan(math.sqrt(0.05))
    at_the_zero = Mode(low_zero_hz)
    assert held_band(ei, at_the_zero, tolerance=0.05).contains(1.0)
    lower = held_band(ei, at_the_zero, tolerance=0.05 * (1.0 - 1e-6))
    assert lower.high_hz < 1.0
    assert worst_residual(ei, lower) <= 0.05


def test_a_hump_that_touches_the_tolerance_by_rounding_does_not_end_the_band():
    ei = design_shaper("ei", Mode(1.0), tolerance=0.05)
    at_the_zero = Mode(1.0 - 2.0 / math.pi * math.atan(math.sqrt(0.05)))
    assert held_band(ei, at_the_zero, tolerance=0.05 / (1.0 + 0.9 * TOUCH_SLACK)).contains(1.1)
    assert not held_band(ei, at_the_zero, tolerance=0.05 / (1.0 + 1.1 * TOUCH_SLACK)).contains(1.1)


def test_a_narrow_spike_far_out_in_a_long_shaper_is_not_stepped_over():
    # Two short ZV shapers 40 s apart: V dips and rises 40 times a hertz.
    shape = impulses([0.0, 0.5, 40.0, 40.5], [0.25] * 4)
    band = held_band(shape, Mode(1.0), tolerance=0.02)
    reach = 2.0 / math.pi * math.asin(0.02)
    assert band.high_hz < 1.0 + reach + 1.0 / 40.0
    assert worst_residual(shape, band) == pytest.approx(0.02, rel=1e-9)


def test_the_low_edge_stays_above_zero_for_the_widest_tolerance():
    band = held_band(design_shaper("zv", Mode(1.0)), Mode(1.0), tolerance=0.999999)
    assert 0.0 < band.low_hz < 0.001


def test_a_band_without_an_upper_end_is_cut_at_the_widest_ratio():
    mode = Mode(1.0, 0.6)  # so damped that high frequencies die out within the shaper
    band = held_band(design_shaper("zvd", mode), mode, tolerance=0.05)
    assert band.high_hz == pytest.approx(WIDEST_RATIO, rel=1e-13)


def test_impulses_that_leave_more_than_the_tolerance_at_the_mode_hold_no_band():
    zv = design_shaper("zv", Mode(1.0))
    with pytest.raises(
        DesignError, match=r"leave 0\.1564.* at the mode \(1\.1 Hz, .*more than the tolerance 0\.05"
    ):
        held_band(zv, Mode(1.1), tolerance=0.05)


@pytest.mark.parametrize("tolerance", [0.0, -0.05, 1.0, 5.0, math.nan])
def test_tolerances_out_of_range_are_refused(tolerance):
    zv = design_shaper("zv", Mode(1.0))
    for function in (held_band, guarantee_of, insensitivity_width):
        with pytest.raises(DesignError, match=r"tolerance = .*: must be above 0 and below 1"):
            function(zv, Mode(1.0), tolerance=tolerance)


def test_the_rope_lengths_covered_at_5_percent_are_the_known_ratios():
    ratios = []
    for family in ("zv", "zvd", "ei", "ei2", "ei3"):
        shortest_m, longest_m = rope_length_interval_m(design_shaper(family, Mode(0.3)).guarantee.band)
        ratios.append(longest_m / shortest_m)
    # Squares of the ratios of the band edges; 5e-3 is the rounding of the published figures.
    assert ratios == pytest.approx([1.14, 1.78, 2.25, 4.56, 8.18], abs=5e-3)


def test_rope_lengths_rise_and_are_those_of_the_band_ends():
    shortest_m, longest_m = rope_length_interval_m(Band(0.2, 0.3))
    assert shortest_m < longest_m
    assert pendulum_frequency_hz(shortest_m) == pytest.approx(0.3, rel=1e-14)
    assert pendulum_frequency_hz(longest_m) == pytest.approx(0.2, rel=1e-14)


def test_overtravel_is_the_area_between_command_and_reference():
    shaper = design_shaper("zvd", Mode(0.5))  # 1/4, 1/2, 1/4 at 0, 1 and 2 s
    assert overtravel_s(shaper) == pytest.approx(1.0, rel=1e-15)


def test_the_peak_factor_counts_sizes_and_partial_sums_count_signs():
    shaper = design_shaper("um-zvd", Mode(1.0))
    assert peak_factor(shaper) == 5.0
    assert partial_sums(shaper).tolist() == [1.0, 0.0, 1.0, 0.0, 1.0]
    assert peak_factor(design_shaper("ei3", Mode(1.0))) == pytest.approx(1.0, rel=1e-15)


def test_a_proven_shaper_carries_the_band_of_its_own_impulses():
    shaper = proven_shaper(
        [0.0, 0.5], [0.5, 0.5], Mode(1.0), tolerance=0.1, family="posicast", source="Smith"
    )
    assert shaper.guarantee == guarantee_of(shaper, Mode(1.0), tolerance=0.1)
    assert (shaper.family, shaper.source) == ("posicast", "Smith")
