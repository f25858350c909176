from __future__ import annotations

import numpy as np
import pytest

from swayless.errors import PlantError
from swayless.plant import pendulum_frequency_hz
from swayless.plant.identification import (
    IdentifiedMode,
    decrement,
    fit_rope_offset,
    identify_peaks,
    identify_periods,
)
from tests.unit.plant.identification.swings import pendulum_swing

SWING = np.arange(30.0)


def peaks(damping_ratio, noise, seed):
    fall = 2.0 * np.pi * damping_ratio / np.sqrt(1.0 - damping_ratio**2)
    return 10.0 * np.exp(-fall * SWING) + noise * np.random.default_rng(seed).normal(size=SWING.size)


@pytest.mark.parametrize("damping_ratio", [0.001, 0.004, 0.01])
def test_the_damping_of_peaks_is_covered_by_its_uncertainty(damping_ratio):
    found = [decrement(SWING, peaks(damping_ratio, 0.1, seed)) for seed in range(100)]
    errors = [(each.damping_ratio - damping_ratio) / each.damping_ratio_std for each in found]
    # 95.4 of 100 are expected; 90: one in 80 times.
    assert np.sum(np.abs(errors) <= 2.0) >= 90


def test_exact_peaks_give_exact_damping_also_where_it_is_large():
    # 1e-12: thirty numbers of fifteen digits.
    assert decrement(SWING, peaks(0.05, 0.0, 0)).damping_ratio == pytest.approx(0.05, rel=1e-12)


def test_peaks_that_grow_have_no_damping():
    found = decrement(SWING, 10.0 + 0.01 * SWING)
    assert (found.per_swing, found.damping_ratio) == (0.0, 0.0)
    assert found.damping_ratio_std > 0.0


def test_times_of_peaks_give_the_frequency_over_missed_ones():
    kept = np.delete(SWING, [3, 4, 11])
    time_s = 4.0 * kept + 0.05 * np.random.default_rng(1).normal(size=kept.size)
    mode, _ = identify_peaks(time_s, np.delete(peaks(0.01, 0.05, 2), [3, 4, 11]))
    assert abs(mode.mode.damped_period_s - 4.0) < 3.5 * 4.0 * mode.frequency_hz_std / mode.frequency_hz
    assert abs(mode.damping_ratio - 0.01) < 3.5 * mode.damping_ratio_std
    both, _ = identify_peaks(np.arange(20) * 2.0, np.exp(-0.01 * np.arange(20)), peaks_per_swing=2)
    assert both.mode.damped_period_s == pytest.approx(4.0)


@pytest.mark.parametrize("resolution_s", [0.01, 0.5, 1.0])
def test_swings_are_counted_though_times_are_rounded(resolution_s):
    time_s = resolution_s * np.round(5.85 * np.arange(41.0) / resolution_s)
    mode, found = identify_peaks(time_s, 25.0 * 0.97 ** np.arange(41.0))
    assert (found.peaks, found.swings) == (41, 40.0)
    # Rounding is no normal noise; 4 standard deviations are beyond its reach.
    assert abs(mode.mode.damped_period_s - 5.85) < 4.0 * 5.85 * mode.frequency_hz_std / mode.frequency_hz


@pytest.mark.parametrize(
    "read",
    [[0, 2, 4, 5, 7, 9, 11, 13, 16], [0, 2, 4, 7, 9, 11], [0, 1, 2, 3, 80, 81, 83]],
)
def test_missed_peaks_do_not_halve_the_frequency(read):
    swing = np.array(read, dtype=float)
    mode, found = identify_peaks(5.85 * swing, 25.0 * 0.97**swing)
    assert found.swings == swing[-1]
    assert mode.mode.damped_period_s == pytest.approx(5.85)


@pytest.mark.parametrize(
    ("read", "worst"), [([0.0, 1.0, 2.0, 3.3, 4.3, 5.8, 7.1], "5 and 6"), ([0, 3, 7, 10, 13], "2 and 3")]
)
def test_gaps_that_may_be_no_whole_swings_are_refused(read, worst):
    swing = np.array(read)
    with pytest.raises(PlantError, match=rf"peaks {worst} are .* times the usual gap: must be whole swings"):
        identify_peaks(5.85 * swing, 25.0 * 0.97**swing)


@pytest.mark.parametrize(
    ("swing", "height", "message"),
    [
        (SWING[:3], np.ones(3), "3 peaks: must be at least 4"),
        (SWING, np.zeros(30), "peak heights must be finite and > 0"),
        (np.zeros(30), np.ones(30), "not all the same"),
    ],
)
def test_what_are_no_peaks_is_refused(swing, height, message):
    with pytest.raises(PlantError, match=message):
        decrement(swing, height)


def test_a_stopwatch_gives_the_mean_and_student_s_uncertainty():
    mode = identify_periods(np.array([6.1, 6.0, 6.2]))
    assert mode.frequency_hz == pytest.approx(1.0 / 6.1)
    # 0.1 s / sqrt(3), and Student's t of two degrees of freedom for 95.45 %: 4.527 / 2.
    assert mode.frequency_hz_std * 6.1**2 == pytest.approx(0.1 / np.sqrt(3.0) * 2.2634, rel=1e-4)
    assert (mode.damping_ratio, mode.damping_ratio_std) == (None, None)


def test_readings_of_ten_swings_are_ten_times_as_exact():
    one, ten = (
        identify_periods(np.array([6.1, 6.0, 6.2]) + add, swings=n) for add, n in ((0.0, 1), (54.9, 10))
    )
    assert ten.frequency_hz == pytest.approx(one.frequency_hz)
    assert ten.frequency_hz_std == pytest.approx(one.frequency_hz_std / 10.0)


def test_equal_readings_are_exact_to_their_rounding_and_a_single_one_to_a_hand():
    equal = identify_periods(np.array([6.1, 6.1, 6.1]), resolution_s=0.1)
    assert equal.frequency_hz_std * 6.1**2 == pytest.approx(0.1 / np.sqrt(12.0))
    assert identify_periods(np.array([6.1])).frequency_hz_std * 6.1**2 == pytest.approx(0.15)


@pytest.mark.parametrize("angle_rad", [0.2, 0.6])
def test_the_size_of_the_swing_is_taken_out_of_a_period(angle_rad):
    time_s = np.linspace(0.0, 12.0, 120_001)
    swing = pendulum_swing(time_s, 0.25, 0.0, angle_rad)
    down = time_s[1:][(swing[1:] < 0.0) & (swing[:-1] >= 0.0)]
    amplitude = np.max(np.abs(swing))
    mode = identify_periods(np.array([down[1] - down[0]]), amplitude_rad=amplitude)
    # 1e-4 s: the grid of the crossings.
    assert 1.0 / mode.frequency_hz == pytest.approx(4.0, abs=2e-4)


@pytest.mark.parametrize(
    ("reading", "options", "message"),
    [
        ([], {}, "one or more finite times > 0"),
        ([-1.0], {}, "one or more finite times > 0"),
        ([6.0], {"swings": 0}, "swings = 0"),
        ([6.0], {"amplitude_rad": 2.0}, "below a right angle"),
    ],
)
def test_what_are_no_readings_is_refused(reading, options, message):
    with pytest.raises(PlantError, match=message):
        identify_periods(np.array(reading), **options)


def on_ropes(shown_m, offset_m, *, scale=1.0, std=1e-4, seed=0):
    rng = np.random.default_rng(seed)
    frequencies = [pendulum_frequency_hz(scale * length + offset_m) for length in shown_m]
    return [IdentifiedMode(f * (1.0 + std * rng.normal()), 0.0, f * std, 1e-3) for f in frequencies]


def test_the_offset_of_the_ropes_is_covered_by_its_uncertainty():
    shown_m = np.array([3.0, 5.0, 7.0, 9.0])
    found = [fit_rope_offset(shown_m, on_ropes(shown_m, 0.45, seed=seed)) for seed in range(100)]
    errors = [(each.offset_m - 0.45) / each.offset_m_std for each in found]
    # As above; one in a hundred sets is taken for inconsistent by chance.
    assert np.sum(np.abs(errors) <= 2.0) >= 90
    assert np.sum([each.is_consistent for each in found]) >= 95


def test_a_wrong_scale_is_seen_from_three_ropes_on_and_widens_the_offset():
    shown_m = np.array([3.0, 5.0, 9.0])
    found = fit_rope_offset(shown_m, on_ropes(shown_m, 0.4, scale=1.03))
    assert not found.is_consistent
    assert found.scale_is_doubtful
    assert found.slope == pytest.approx(1.03, abs=1e-3)
    two = fit_rope_offset(shown_m[:2], on_ropes(shown_m[:2], 0.4))
    assert two.slope is None


def test_one_rope_shows_no_offset():
    with pytest.raises(PlantError, match="two different rope lengths"):
        fit_rope_offset(np.array([3.0, 3.0]), on_ropes([3.0, 3.0], 0.0))
