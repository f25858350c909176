"""Robust designs against known optima and an independent linear program; certificates against sampling."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import linprog

from swayless.design import partial_sums, residual_vibration, worst_residual
from swayless.design.minimax import AmplitudeRule
from swayless.design.robust import (
    RobustDesign,
    fixed_duration,
    least_residual,
    specified_insensitivity,
)
from swayless.design.robust.certificate import Certificate
from swayless.errors import DesignError
from swayless.plant import Band

PROVED_GAP = 0.003  # of the duration: what is promised; usual is 1e-6
TOUCH = 1.0 + 1e-8  # peaks touch the tolerance to rounding


@pytest.mark.parametrize(("width", "periods"), [(0.3994, 1.0), (0.7245, 1.5), (0.9638, 2.0)])
def test_undamped_widths_at_5_percent_need_the_durations_of_ei_and_its_humps(
    width: float, periods: float
) -> None:
    design = specified_insensitivity(Band(1.0 - width / 2.0, 1.0 + width / 2.0), tolerance=0.05)
    # The widths are quoted to four digits, and the duration moves by as much.
    assert design.shaper.duration_s == pytest.approx(periods, abs=2e-4)
    assert 0.0 < design.gap_ratio < PROVED_GAP


def test_a_single_frequency_at_zero_damping_has_the_textbook_optimum() -> None:
    # Two halves a time T apart leave |cos(pi f T)|, and no positive shaper leaves less.
    design = specified_insensitivity(Band(1.0, 1.0), tolerance=0.05)
    assert design.shaper.duration_s == pytest.approx(np.arccos(0.05) / np.pi, rel=1e-9)
    np.testing.assert_allclose(design.shaper.amplitudes, [0.5, 0.5], atol=1e-9)


def test_impulses_that_come_to_coincide_are_one() -> None:
    # Newton's method ends with a second impulse on the last one here: two impulses are optimal.
    band = Band(3.9312927622640634, 4.98012363792802)
    design = specified_insensitivity(band, tolerance=0.1575, damping_ratio=0.1)
    assert design.shaper.times_s.size == 2
    _check(design, band, 0.1575, 0.1, "positive")


@pytest.mark.parametrize("amplitudes", ["positive", "bounded"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.1, (0.05, 0.15)])
def test_two_single_frequencies_are_two_bands_without_width(
    amplitudes: str, damping_ratio: float | tuple[float, float]
) -> None:
    bands = [Band(1.0, 1.0), Band(2.3, 2.3)]
    design = specified_insensitivity(bands, damping_ratio=damping_ratio, amplitudes=amplitudes)  # type: ignore[arg-type]
    dampings = damping_ratio if isinstance(damping_ratio, tuple) else (damping_ratio,)
    left = [worst_residual(design.shaper, band, damping_ratio=z) for band in bands for z in dampings]
    assert max(left) == pytest.approx(0.05, rel=1e-8)
    assert 0.0 < design.gap_ratio < PROVED_GAP


@pytest.mark.parametrize("damping_ratio", [0.0, 0.02, 0.2])
@pytest.mark.parametrize("ratio", [1.3, 2.5, 8.0])
@pytest.mark.parametrize("amplitudes", ["positive", "bounded"])
def test_specified_insensitivity_holds_the_band_and_is_proved_shortest(
    amplitudes: str, ratio: float, damping_ratio: float
) -> None:
    band = Band(0.3, 0.3 * ratio)
    design = specified_insensitivity(band, damping_ratio=damping_ratio, amplitudes=amplitudes)  # type: ignore[arg-type]
    _check(design, band, 0.05, damping_ratio, amplitudes)


def _check(design: RobustDesign, band: Band, tolerance: float, damping_ratio: float, amplitudes: str) -> None:
    """Assert what every design promises."""
    samples_hz = np.linspace(band.low_hz, band.high_hz, 20_001)
    residual = residual_vibration(design.shaper, samples_hz, damping_ratio=damping_ratio)
    assert residual.max() <= tolerance * TOUCH
    assert 0.0 < design.gap_ratio < PROVED_GAP
    if amplitudes == "positive":
        assert design.shaper.amplitudes.min() > 0.0
    else:
        levels = partial_sums(design.shaper)
        assert levels.min() >= -1e-12
        assert levels.max() <= 1.0 + 1e-12


@pytest.mark.parametrize("amplitudes", ["positive", "bounded"])
@pytest.mark.parametrize(
    ("ratio", "damping_ratio", "tolerance"),
    [(1.3, 0.0, 0.02), (3.0, 0.0, 0.1), (2.0, 0.1, 0.03), (1.5, 0.2, 0.05), (2.0, (0.0, 0.1), 0.05)],
)
def test_an_independent_linear_program_brackets_the_optimum_to_a_thousandth(
    amplitudes: str, ratio: float, damping_ratio: float | tuple[float, float], tolerance: float
) -> None:
    design = specified_insensitivity(
        Band(1.0, ratio),
        tolerance=tolerance,
        damping_ratio=damping_ratio,
        amplitudes=amplitudes,  # type: ignore[arg-type]
    )
    points = _points(ratio, damping_ratio)
    own, bounded = design.shaper.times_s, amplitudes == "bounded"
    # The program may use the design's own times, so that it cannot leave more.
    times, enough = np.union1d(np.linspace(0.0, own[-1], 61), own), tolerance * (1.0 - 1e-3)
    assert enough <= _cut_program(times, points, enough, bounded=bounded) <= tolerance * (1.0 + 1e-6)
    # A thousandth less time than the bound does not do, with times to choose from that were right just above.
    shorter = own * (design.lower_bound_s / own[-1] * 0.999)
    times = np.union1d(np.linspace(0.0, shorter[-1], 61), shorter)
    assert _cut_program(times, points, tolerance * (1.0 + 1e-9), bounded=bounded) > tolerance


def _points(ratio: float, damping_ratio: float | tuple[float, float]) -> NDArray[np.complex128]:
    """Frequencies from 1 to a ratio at the ends of a damping range, and both ends of the band between."""
    low, high = damping_ratio if isinstance(damping_ratio, tuple) else (damping_ratio, damping_ratio)
    frequency, between = np.linspace(1.0, ratio, 1001), np.linspace(low, high, 201)
    f, z = frequency, np.full(1001, low)
    if high > low:
        f = np.concatenate([f, frequency, np.ones(201), np.full(201, ratio)])
        z = np.concatenate([z, np.full(1001, high), between, between])
    return 2.0 * np.pi * f * (z + 1j * np.sqrt(1.0 - z**2))


def _cut_program(
    times: NDArray[np.float64], points: NDArray[np.complex128], enough: float, *, bounded: bool
) -> float:
    """Bound the least worst residual over the points from below, by enough if it can be.

    Tangents of |G| <= v are added where it is broken, so that the value rises to the optimum from below.
    """
    columns, count = np.exp(np.multiply.outer(points, times - times[-1])), times.size
    sums = np.tri(count) if bounded else np.empty((0, count))
    limits = np.hstack([np.vstack([sums, -sums]), np.zeros((2 * len(sums), 1))])
    right = np.append(np.ones(len(sums)), np.zeros(len(sums)))
    amplitudes, level, cuts = np.full(count, 1.0 / count), 0.0, np.empty((0, count + 1))
    for _ in range(60):
        value = columns @ amplitudes
        size = np.abs(value)
        over = (size > level * (1.0 + 1e-6)) & (size >= np.roll(size, 1)) & (size >= np.roll(size, -1))
        if level >= enough or not over.any():
            return level
        tangents = (np.exp(-1j * np.angle(value[over]))[:, np.newaxis] * columns[over]).real
        cuts = np.vstack([cuts, np.hstack([tangents, np.full((len(tangents), 1), -1.0)])])
        result = linprog(
            np.append(np.zeros(count), 1.0),
            A_ub=np.vstack([limits, cuts]),
            b_ub=np.append(right, np.zeros(len(cuts))),
            A_eq=np.append(np.ones(count), 0.0)[np.newaxis],
            b_eq=[1.0],
            bounds=[(None if bounded else 0.0, None)] * count + [(0.0, None)],
        )
        amplitudes, level = result.x[:count], float(result.x[count])
    raise AssertionError("the cuts did not close in 60 rounds")


def test_several_bands_are_held_by_one_shaper_and_overlapping_ones_are_one() -> None:
    bands = [Band(0.8, 1.0), Band(0.2, 0.25)]
    design = specified_insensitivity(bands)
    assert design.shaper.guarantee.bands == (bands[1], bands[0])
    assert max(worst_residual(design.shaper, band) for band in bands) <= 0.05 * TOUCH
    assert 0.0 < design.gap_ratio < PROVED_GAP
    merged = specified_insensitivity([Band(0.2, 0.3), Band(0.25, 0.4)])
    assert merged.shaper.guarantee.bands == (Band(0.2, 0.4),)


def test_a_given_number_of_impulses_is_kept_and_bounded_by_the_bounded_optimum() -> None:
    band = Band(0.2, 0.27)
    design = specified_insensitivity(band, amplitudes="unity-magnitude", impulses=5)
    np.testing.assert_array_equal(design.shaper.amplitudes, [1.0, -1.0, 1.0, -1.0, 1.0])
    free = specified_insensitivity(band, amplitudes="bounded")
    assert design.lower_bound_s == pytest.approx(free.lower_bound_s, rel=1e-9)
    assert design.shaper.duration_s > design.lower_bound_s


def test_where_nothing_is_gained_the_least_residual_is_a_thousandth() -> None:
    design = least_residual(9.0, Band(0.2, 0.203))
    assert design.shaper.guarantee.tolerance == 1e-3
    assert design.shaper.duration_s < 9.0


def test_a_damping_range_is_held_at_every_damping_ratio_in_it() -> None:
    band = Band(0.2, 0.5)
    design = specified_insensitivity(band, damping_ratio=(0.0, 0.15))
    for damping_ratio in np.linspace(0.0, 0.15, 31):
        assert worst_residual(design.shaper, band, damping_ratio=damping_ratio) <= 0.05 * TOUCH
    alone = specified_insensitivity(band)
    assert design.shaper.duration_s >= alone.lower_bound_s


def test_bounded_optima_switch_between_zero_and_one() -> None:
    design = specified_insensitivity(Band(0.2, 0.5), amplitudes="bounded")
    signs = (-1.0) ** np.arange(design.shaper.times_s.size)
    np.testing.assert_allclose(design.shaper.amplitudes, signs, atol=1e-15)
    same = specified_insensitivity(Band(0.2, 0.5), amplitudes="unity-magnitude")
    np.testing.assert_array_equal(design.shaper.times_s, same.shaper.times_s)


def test_fixed_duration_and_specified_insensitivity_are_each_others_inverse() -> None:
    reach = fixed_duration(3.0, 0.25, tolerance=0.04)
    back = specified_insensitivity(reach.shaper.guarantee.band, tolerance=0.04)
    assert back.shaper.duration_s == pytest.approx(3.0, rel=1e-8)


def test_least_residual_is_the_tolerance_that_needs_the_duration() -> None:
    best = least_residual(2.5, Band(0.3, 0.8), damping_ratio=0.05)
    tolerance = best.shaper.guarantee.tolerance
    back = specified_insensitivity(Band(0.3, 0.8), tolerance=tolerance, damping_ratio=0.05)
    assert back.shaper.duration_s == pytest.approx(2.5, rel=1e-8)


def test_an_ei_duration_where_weights_are_not_unique_is_still_proved() -> None:
    design = fixed_duration(1.0, 0.8003)
    assert 0.0 < design.gap_ratio < PROVED_GAP


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: specified_insensitivity(Band(0.1, 0.9)), r"ratio 9 must be at most 8"),
        (lambda: specified_insensitivity(Band(0.1, 0.2), tolerance=0.5), r"tolerance = 0.5: must be 0.01"),
        (lambda: specified_insensitivity(Band(0.1, 0.2), damping_ratio=(0.1, 0.05)), r"lowest first"),
        (lambda: specified_insensitivity(Band(0.1, 0.2), amplitudes="any"), r"must be one of"),  # type: ignore[arg-type]
        (lambda: fixed_duration(0.5, 0.2), r"too short"),
        (lambda: fixed_duration(50.0, 0.2), r"and more; ask for the shortest"),
        (lambda: fixed_duration(float("nan"), 0.2), r"finite and > 0"),
    ],
)
def test_refusals_say_what_is_allowed(call: object, message: str) -> None:
    with pytest.raises(DesignError, match=message):
        call()  # type: ignore[operator]


@pytest.mark.parametrize("seed", range(6))
def test_certificates_bound_the_sampled_polynomial_from_below(seed: int) -> None:
    rng = np.random.default_rng(seed)
    weights = rng.dirichlet(np.ones(5))
    coefficients: NDArray[np.complex128] = weights * np.exp(2j * np.pi * rng.random(5))
    rates = 2.0 * np.pi * rng.uniform(1.0, 6.0, 5) * complex(0.1 * (seed % 2), 1.0)
    certificate = Certificate(coefficients, rates, 1.7)
    times = np.linspace(0.0, 1.7, 200_001)
    value, _ = certificate(times)
    # Sampling misses the minimum by at most |p''| h^2 / 8 = 1e-8; the bound gives away 1e-9.
    least = certificate.bound(AmplitudeRule.POSITIVE)
    assert value.min() - 1e-7 <= least <= value.min()
    rises = value[-1] - np.maximum(np.diff(value), 0.0).sum()
    assert rises - 1e-7 <= certificate.bound(AmplitudeRule.BOUNDED) <= rises + 1e-12
