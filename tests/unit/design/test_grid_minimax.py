"""The minimax program behind the tick grid: optimal, proved, and exact where it says so."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import linprog

from swayless.design.families import design_shaper
from swayless.design.minimax import AmplitudeRule, minimax_amplitudes, zero_equalities
from swayless.design.minimax.polish import Deciding, independent, polish
from swayless.design.minimax.program import solve_program
from swayless.design.minimax.response import Response
from swayless.errors import DesignError
from swayless.plant import Band, Mode

EI_BAND = Band(0.8002746243354598, 1.1997253756645385)  # 5 %, undamped, 1 Hz


def _ratio(times_s, amplitudes, frequency_hz, damping_ratio=0.0):
    """Residual vibration from its definition, shape (frequencies,)."""
    w = 2.0 * math.pi * np.atleast_1d(frequency_hz)[:, np.newaxis]
    lag_s = times_s - times_s[-1]
    phase = 1j * w * math.sqrt(1.0 - damping_ratio**2) * lag_s
    return np.abs(np.exp(damping_ratio * w * lag_s + phase) @ amplitudes)


def _polygon_optimum(times_s, band, damping_ratio, directions=180, frequencies=101):
    """The positive optimum with circles cut to polygons: too low by 1 - cos(pi / directions) at most."""
    w = 2.0 * math.pi * np.linspace(band.low_hz, band.high_hz, frequencies)[:, np.newaxis]
    lag_s = times_s - times_s[-1]
    columns = np.exp(w * complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2)) * lag_s)
    turned = np.exp(-2j * math.pi * np.arange(directions) / directions)[:, np.newaxis, np.newaxis] * columns
    rows = turned.real.reshape(-1, times_s.size)
    result = linprog(
        np.append(np.zeros(times_s.size), 1.0),
        A_ub=np.hstack([rows, np.full((len(rows), 1), -1.0)]),
        b_ub=np.zeros(len(rows)),
        A_eq=np.append(np.ones(times_s.size), 0.0)[np.newaxis],
        b_eq=[1.0],
    )
    return result.fun


@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_optimum_is_that_of_one_large_polygonal_program(damping_ratio):
    times_s = np.arange(15) / 11.0
    best = minimax_amplitudes(times_s, EI_BAND, damping_ratio=damping_ratio)
    polygonal = _polygon_optimum(times_s, EI_BAND, damping_ratio)
    # The polygon lowers it by 1.5e-4 of itself at most, and so does a frequency grid of 1 % of the band.
    assert polygonal * (1.0 - 1e-9) <= best.worst_residual_ratio <= polygonal * (1.0 + 3e-4)


@pytest.mark.parametrize("rule", AmplitudeRule)
def test_worst_ratio_and_lower_bound_meet(rule):
    best = minimax_amplitudes(np.arange(41) / 25.0, Band(0.7, 1.4), rule=rule)
    assert best.lower_bound_ratio <= best.worst_residual_ratio * (1.0 + 1e-12)
    # The exchange ends within 1e-8 of its unit, the thousandth part of the residual.
    assert best.worst_residual_ratio - best.lower_bound_ratio < 1e-10


def test_no_random_amplitudes_beat_the_lower_bound():
    times_s = np.arange(13) / 11.0
    bound = minimax_amplitudes(times_s, EI_BAND).lower_bound_ratio
    frequency_hz = np.linspace(EI_BAND.low_hz, EI_BAND.high_hz, 200)
    sparse = np.random.default_rng(2).dirichlet(np.full(13, 0.3), 2000)
    worst = np.array([_ratio(times_s, amplitudes, frequency_hz).max() for amplitudes in sparse])
    assert worst.min() > bound


def test_closed_form_of_the_ei_shaper_is_the_optimum_on_its_times():
    best = minimax_amplitudes(np.array([0.0, 0.5, 1.0]), EI_BAND)
    # Newton's method leaves rounding, times the flatness of the optimum in the odd direction.
    np.testing.assert_allclose(best.amplitudes, [0.2625, 0.475, 0.2625], atol=1e-13)
    assert best.worst_residual_ratio == pytest.approx(0.05, abs=1e-13)


def test_ei_band_on_eleven_ticks_is_held_at_5_28_percent_at_best():
    best = minimax_amplitudes(np.arange(12) / 11.0, EI_BAND)
    assert round(100.0 * best.worst_residual_ratio, 2) == 5.28
    assert round(100.0 * best.lower_bound_ratio, 2) == 5.28


def test_bounded_amplitudes_keep_partial_sums_between_0_and_1():
    best = minimax_amplitudes(np.arange(41) / 40.0, Band(0.8, 1.2), rule=AmplitudeRule.BOUNDED)
    levels = np.cumsum(best.amplitudes)
    assert best.amplitudes.min() < -0.1
    assert levels.min() >= 0.0
    assert levels.max() <= 1.0
    assert best.worst_residual_ratio < 0.05  # the positive optimum in one period


def test_start_decides_nothing_when_the_optimum_is_asked_for():
    times_s = np.arange(301) / 200.0
    spread = minimax_amplitudes(times_s, Band(0.7, 1.3))
    ends = minimax_amplitudes(times_s, Band(0.7, 1.3), start=np.array([0, 300]))
    assert spread.taps.tolist() == ends.taps.tolist()
    np.testing.assert_allclose(spread.amplitudes, ends.amplitudes, atol=1e-11)  # both polished


def test_target_within_reach_keeps_to_the_times_preferred():
    times_s = np.arange(121) / 100.0
    best = minimax_amplitudes(times_s, EI_BAND, start=np.array([0, 50, 100, 120]), target_ratio=0.06)
    assert set(best.taps.tolist()) <= {0, 50, 100, 120}
    assert best.worst_residual_ratio <= 0.06
    assert best.lower_bound_ratio == 0.0


def test_target_out_of_reach_is_proved_so():
    best = minimax_amplitudes(np.arange(12) / 11.0, EI_BAND, target_ratio=0.05)
    assert 0.05 < best.lower_bound_ratio <= 0.0528


def test_equalities_out_of_reach_are_proved_so():
    times_s = np.arange(4) / 11.0  # a positive shaper of less than half a period cancels nothing
    best = minimax_amplitudes(times_s, EI_BAND, equalities=zero_equalities(times_s, Mode(1.0)))
    assert best.lower_bound_ratio == math.inf
    assert best.worst_residual_ratio == math.inf


def test_equalities_are_met_to_rounding():
    times_s = np.arange(61) / 37.3
    rows = zero_equalities(times_s, Mode(1.0, 0.1), derivatives=2)
    best = minimax_amplitudes(times_s, EI_BAND, damping_ratio=0.1, equalities=rows)
    assert np.abs(rows[:, best.taps] @ best.amplitudes).max() < 1e-14


def test_equalities_that_repeat_each_other_do_no_harm():
    times_s = np.array([0.0, 0.5, 1.0])  # on half periods the imaginary parts are rounding only
    rows = zero_equalities(times_s, Mode(1.0))
    best = minimax_amplitudes(times_s, Band(0.95, 1.05), equalities=np.vstack([rows, rows]))
    np.testing.assert_allclose(best.amplitudes, [0.25, 0.5, 0.25], atol=1e-13)


def test_last_time_is_used_where_it_must_be():
    times_s = np.array([0.0, 0.5, 0.6])
    rows = zero_equalities(times_s, Mode(1.0))
    free = minimax_amplitudes(times_s, Band(0.97, 1.03), equalities=rows)
    held = minimax_amplitudes(times_s, Band(0.97, 1.03), least_last=0.01)
    assert free.taps.tolist() == [0, 1]
    assert held.taps[-1] == 2
    assert held.amplitudes[-1] >= 0.01 - 1e-12


@pytest.mark.parametrize("derivatives", [0, 1, 2])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_zero_equalities_hold_for_the_derivative_families(derivatives, damping_ratio):
    mode = Mode(0.7, damping_ratio)
    shaper = design_shaper("zvm", mode, order=derivatives)
    rows = zero_equalities(shaper.times_s, mode, derivatives=derivatives)
    assert np.abs(rows @ shaper.amplitudes).max() < 1e-14
    one_more = zero_equalities(shaper.times_s, mode, derivatives=derivatives + 1)
    assert np.abs(one_more @ shaper.amplitudes).max() > 1e-3


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05])
def test_peaks_are_all_found(damping_ratio):
    random = np.random.default_rng(4)
    for _ in range(20):
        times = np.sort(np.append(random.uniform(0.0, 1.0, 7), [0.0, 1.0]))
        amplitudes = random.normal(size=9)
        peaks = Response.of_times(times, damping_ratio).peaks(amplitudes, 0.3, 6.0)
        dense = _ratio(times, amplitudes, np.linspace(0.3, 6.0, 20001), damping_ratio)
        inner = dense[1:-1][(dense[1:-1] > dense[:-2]) & (dense[1:-1] > dense[2:])]
        tops = np.sort(np.append(inner, [end for end, nxt in (dense[:2], dense[:-3:-1]) if end > nxt]))
        # Between samples 2.85e-4 apart a maximum rises by less than (2 pi 1.4e-4)^2 / 2 of sum |A|.
        np.testing.assert_allclose(np.sort(np.abs(peaks.value)), tops, atol=4e-6)


def test_program_tells_by_how_much_equalities_are_missed():
    vertex = solve_program(np.ones((1, 2)), np.array([[1.0, 1.0]]), AmplitudeRule.POSITIVE, 0.0)
    assert vertex.shortfall == pytest.approx(1.0, abs=1e-9)


def test_polish_gives_up_where_the_ratio_has_a_corner():
    exponents = 2j * np.pi * np.array([[-1.0, -0.5, 0.0]])
    rows, targets = independent(np.ones((1, 3)), np.ones(1))
    peaks = Deciding(
        np.zeros(1, np.intp), np.ones(1), np.ones(1), np.ones(1)
    )  # the least at 1 Hz is 0, where the phase turns without limit
    assert polish(exponents, rows, targets, np.array([0.4, 0.3, 0.3]), peaks) is None


@pytest.mark.parametrize("times_s", [[0.0], [0.0, 1.0, 1.0], [1.0, 0.0]])
def test_times_must_rise(times_s):
    with pytest.raises(DesignError, match=r"^times_s = .*: must be at least two, rising$"):
        minimax_amplitudes(np.array(times_s), EI_BAND)


@pytest.mark.parametrize("damping_ratio", [-0.1, 1.0, math.nan])
def test_damping_must_be_below_one(damping_ratio):
    reason = rf"^damping_ratio = {damping_ratio!r}: must be at least 0 and below 1$"
    with pytest.raises(DesignError, match=reason):
        minimax_amplitudes(np.array([0.0, 1.0]), EI_BAND, damping_ratio=damping_ratio)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_a_single_frequency_is_one_peak(damping_ratio: float) -> None:
    times, amplitudes = np.array([0.0, 0.4, 1.0]), np.array([0.3, 0.5, 0.2])
    peaks = Response.of_times(times, damping_ratio).peaks(amplitudes, 1.3, 1.3)
    np.testing.assert_array_equal(peaks.frequency, [1.3])
    # Three terms of order 1, each right to a few units in the last place.
    assert np.abs(peaks.value) == pytest.approx(_ratio(times, amplitudes, 1.3, damping_ratio), rel=1e-14)
