"""Contactor drives: amplitudes stay +1, -1, ..., +1 on whole ticks, and what is promised is kept."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from swayless.design import Shaper, design_shaper, residual_vibration
from swayless.design.robust.lines import Line
from swayless.design.robust.unity import shortest
from swayless.design.robust.whole_ticks import whole_tick_fixed_duration, whole_tick_taps
from swayless.design.robustness import worst_residual
from swayless.design.shaper import Guarantee
from swayless.errors import DesignError
from swayless.plant import Band, Mode


class _Taps:
    def __init__(self, delays: tuple[int, ...], tick_s: float) -> None:
        self.times_s = np.array(delays, dtype=np.float64) * tick_s
        self.amplitudes = (-1.0) ** np.arange(len(delays))


def _ideal(tolerance: float = 0.05) -> Shaper:
    optimum = shortest([Line(1.0, 1.2, 0.0)], tolerance, 5)
    promise = Guarantee(tolerance, Mode(0.22), Band(0.2, 0.24), tolerance)
    return Shaper(optimum.times / 0.2, optimum.amplitudes, "si", promise, "test")


@pytest.mark.parametrize("tick_s", [0.01, 0.05])
def test_the_band_is_held_on_whole_ticks(tick_s: float) -> None:
    taps = whole_tick_taps(_ideal(), tick_s)
    assert taps.amplitudes.tolist() == [1.0, -1.0, 1.0, -1.0, 1.0]
    assert residual_vibration(taps, np.linspace(0.2, 0.24, 20_001)).max() <= 0.05 * (1.0 + 1e-9)
    assert taps.duration_s >= _ideal().duration_s - 1e-9


def test_every_choice_on_coarse_ticks_agrees_with_the_refusal() -> None:
    first = int(np.ceil(_ideal().duration_s / 0.25))
    choices = [
        (0, *inner, last)
        for last in range(first, first + 9)
        for inner in itertools.combinations(range(1, last), 3)
    ]
    best = min(worst_residual(_Taps(choice, 0.25), Band(0.2, 0.24)) for choice in choices)
    assert best > 0.05
    with pytest.raises(DesignError, match=f"leave {100.0 * best:.4g} % at best"):
        whole_tick_taps(_ideal(), 0.25)


@pytest.mark.parametrize("family", ["um-zv", "um-zvd", "um-ei"])
def test_named_families_hold_a_band_about_their_mode(family: str) -> None:
    shaper = design_shaper(family, Mode(0.2))
    taps = whole_tick_taps(shaper, 0.01)
    assert taps.guarantee.band.contains(0.2)
    assert np.abs(taps.times_s - shaper.times_s).max() < 0.05  # a window of four ticks, and one of duration


def test_within_the_same_duration_the_band_is_cut() -> None:
    taps = whole_tick_fixed_duration(_ideal(), 0.05)
    assert taps.duration_s <= _ideal().duration_s
    assert taps.guarantee.band.low_hz == 0.2
    assert 0.2 < taps.guarantee.band.high_hz <= 0.24
    assert worst_residual(taps, taps.guarantee.band) <= 0.05 * (1.0 + 1e-9)


def test_other_amplitudes_are_refused() -> None:
    with pytest.raises(DesignError, match="are not"):
        whole_tick_taps(design_shaper("ei", Mode(0.2)), 0.01)


def test_a_tick_without_room_for_the_impulses_is_refused() -> None:
    with pytest.raises(DesignError, match="too coarse for 5 impulses"):
        whole_tick_taps(_ideal(), 1.0)
