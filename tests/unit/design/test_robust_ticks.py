"""Robust designs on whole ticks: the taps themselves hold the band, on the fewest ticks there are."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.design import residual_vibration
from swayless.design.minimax import AmplitudeRule, minimax_amplitudes
from swayless.design.robust import Amplitudes, specified_insensitivity_on_ticks
from swayless.errors import DesignError
from swayless.plant import Band


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


def test_unity_magnitude_is_refused_on_ticks() -> None:
    with pytest.raises(DesignError, match="use 'bounded'"):
        specified_insensitivity_on_ticks(Band(0.8, 1.3), 0.01, amplitudes="unity-magnitude")
