"""Robust designs on whole ticks: the taps themselves hold the band, on the fewest ticks there are."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.design import GridShaper, residual_vibration
from swayless.design.minimax import AmplitudeRule, minimax_amplitudes
from swayless.design.robust import Amplitudes
from swayless.design.robust.ticks import (
    fixed_duration_on_ticks,
    last_tick,
    least_residual_on_ticks,
    specified_insensitivity_on_ticks,
)
from swayless.errors import DesignError
from swayless.plant import Band


def _dense_worst(taps: GridShaper, band: Band, damping_ratio: float) -> float:
    """Worst residual from its definition, at 4001 frequencies; the worst are ends of bands or flat."""
    turn = 2.0 * np.pi * complex(damping_ratio, np.sqrt(1.0 - damping_ratio**2))
    rates = np.linspace(band.low_hz, band.high_hz, 4001) * turn
    return float(
        np.abs(np.exp(np.multiply.outer(rates, taps.times_s - taps.times_s[-1])) @ taps.amplitudes).max()
    )


@pytest.mark.parametrize("amplitudes", ["positive", "bounded"])
@pytest.mark.parametrize(("tick_s", "damping_ratio"), [(0.01, 0.0), (0.1, 0.05), (0.5, 0.0)])
def test_taps_hold_the_band_on_the_ticks_and_one_tick_less_cannot(
    amplitudes: Amplitudes, tick_s: float, damping_ratio: float
) -> None:
    band = Band(0.17, 0.3)
    design = specified_insensitivity_on_ticks(
        band, tick_s, damping_ratio=damping_ratio, amplitudes=amplitudes
    )
    samples_hz = np.linspace(band.low_hz, band.high_hz, 20_001)
    assert residual_vibration(design.taps, samples_hz, damping_ratio=damping_ratio).max() <= 0.05
    last = int(design.taps.delays_ticks[-1])
    assert last * tick_s > design.ideal.lower_bound_s
    rule = AmplitudeRule(amplitudes)
    less = minimax_amplitudes(np.arange(last) * tick_s, band, damping_ratio=damping_ratio, rule=rule)
    assert less.lower_bound_ratio > 0.05 - 2e-9  # the slack that the decimal lattice is given


def test_eleven_ticks_a_period_take_a_tick_more_than_ei() -> None:
    design = specified_insensitivity_on_ticks(Band(0.8003, 1.1997), 1.0 / 11.0)
    assert design.taps.delays_ticks[-1] == 12


def test_a_tick_too_coarse_is_refused_with_the_ideal_duration() -> None:
    with pytest.raises(DesignError, match=r"a finer tick does \(the ideal shaper lasts 1\.\d+ s\)"):
        specified_insensitivity_on_ticks(Band(0.8003, 1.3), 1.0)


def test_a_duration_is_rounded_down_to_ticks_and_a_hair_below_one_is_on_it() -> None:
    assert last_tick(0.3, 0.1) == last_tick(3 * 0.1, 0.1) == last_tick(0.35, 0.1) == 3
    with pytest.raises(DesignError, match=r"duration_s = 0.05: must be at least a tick, 0.1 s"):
        last_tick(0.05, 0.1)


@pytest.mark.parametrize("amplitudes", ["positive", "bounded"])
@pytest.mark.parametrize(("tick_s", "damping_ratio"), [(0.01, 0.0), (0.15, 0.0), (0.05, 0.04)])
def test_taps_of_a_fixed_duration_hold_the_widest_band_that_any_on_these_ticks_do(
    amplitudes: Amplitudes, tick_s: float, damping_ratio: float
) -> None:
    design = fixed_duration_on_ticks(3.0, 0.17, tick_s, damping_ratio=damping_ratio, amplitudes=amplitudes)
    band = design.taps.guarantee.band
    assert design.taps.delays_ticks[-1] == round(3.0 / tick_s)
    assert band.low_hz == 0.17
    assert _dense_worst(design.taps, band, damping_ratio) <= 0.05
    assert band.high_hz <= design.ideal.shaper.guarantee.band.high_hz
    # The edge is right to 1e-8: a band wider by 1e-6 leaves more on these ticks, whatever the amplitudes are.
    wider = minimax_amplitudes(
        np.arange(round(3.0 / tick_s) + 1) * tick_s,
        Band(0.17, band.high_hz * (1.0 + 1e-6)),
        damping_ratio=damping_ratio,
        rule=AmplitudeRule(amplitudes),
    )
    assert wider.lower_bound_ratio > 0.05


def test_least_residual_on_ticks_is_the_minimax_optimum() -> None:
    design = least_residual_on_ticks(2.5, Band(0.3, 0.8), 0.1)
    best = minimax_amplitudes(np.arange(26) * 0.1, Band(0.3, 0.8))
    # Amplitudes of 12 decimals move it by 1e-11 at most.
    assert design.taps.guarantee.tolerance == pytest.approx(best.worst_residual_ratio, abs=1e-10)
    assert design.taps.guarantee.tolerance >= design.ideal.shaper.guarantee.tolerance * (1.0 - 1e-9)


@pytest.mark.parametrize("amplitudes", ["positive", "bounded"])
def test_taps_hold_several_bands_at_every_damping_ratio_of_a_range(amplitudes: Amplitudes) -> None:
    bands = [Band(0.2, 0.25), Band(0.7, 0.9)]
    design = specified_insensitivity_on_ticks(bands, 0.05, damping_ratio=(0.0, 0.12), amplitudes=amplitudes)
    assert design.taps.guarantee.bands == tuple(bands)
    for damping_ratio in np.linspace(0.0, 0.12, 49).tolist():
        assert all(_dense_worst(design.taps, band, damping_ratio) <= 0.05 for band in bands)


def test_unity_magnitude_on_ticks_switches_on_whole_ticks_alone() -> None:
    design = fixed_duration_on_ticks(3.0, 0.17, 0.01, amplitudes="unity-magnitude")
    assert design.taps.amplitudes.tolist() == [(-1.0) ** k for k in range(design.taps.amplitudes.size)]
    assert _dense_worst(design.taps, design.taps.guarantee.band, 0.0) <= 0.05


def test_the_refusal_of_whole_ticks_names_a_tolerance_that_does() -> None:
    band, tick_s = Band(1.0, 1.3), 0.03
    with pytest.raises(DesignError, match=r"leave 7\.639 % at best .* a tolerance of 0\.077 does"):
        specified_insensitivity_on_ticks(band, tick_s, amplitudes="unity-magnitude")
    design = specified_insensitivity_on_ticks(band, tick_s, tolerance=0.077, amplitudes="unity-magnitude")
    assert design.taps.guarantee.worst_residual_ratio <= 0.077
