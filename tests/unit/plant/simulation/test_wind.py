"""Gusts: their form, their statistics and what they push with."""

from __future__ import annotations

import math

import numpy as np
import pytest

from swayless.plant.simulation import drag_m_s2, dryden_gusts, one_cosine_gust

DRYDEN = {"tick_s": 0.1, "mean_m_s": 12.0, "deviation_m_s": 2.0, "length_m": 60.0}


def test_drag_grows_with_the_square_and_keeps_the_sign():
    push = drag_m_s2(
        [0.0, 10.0, -10.0, 20.0], area_m2=2.0, drag_coefficient=1.5, load_mass_kg=100.0, air_density_kg_m3=1.0
    )
    np.testing.assert_allclose(push, [0.0, 1.5, -1.5, 6.0], rtol=1e-15)


def test_a_single_gust_rises_to_its_peak_and_is_still_before_and_after():
    gust = one_cosine_gust(1000, tick_s=0.01, start_s=2.0, duration_s=4.0, peak_m_s=10.0)
    time_s = 0.01 * (np.arange(1000) + 0.5)
    assert not gust[(time_s < 2.0) | (time_s > 6.0)].any()
    assert gust.max() == pytest.approx(10.0, rel=1e-4)  # 5 ms beside the peak
    assert time_s[gust.argmax()] == pytest.approx(4.0, abs=0.01)
    assert gust.sum() * 0.01 == pytest.approx(20.0, rel=1e-9)  # half of peak times duration


def test_turbulence_has_the_mean_the_deviation_and_the_memory_it_was_asked_for():
    wind = dryden_gusts(1_000_000, **DRYDEN, seed=3)
    memory_s = 60.0 / 12.0
    # 100000 s hold 10000 independent gusts: 1 % of the deviation, 3 of them allowed.
    assert wind.mean() == pytest.approx(12.0, abs=0.06)
    assert wind.std() == pytest.approx(2.0, rel=0.03)
    gusts = wind - wind.mean()
    for lag in (1, 10, 50, 100):
        correlation = (gusts[lag:] * gusts[:-lag]).mean() / gusts.var()
        assert correlation == pytest.approx(math.exp(-0.1 * lag / memory_s), abs=0.03)


def test_turbulence_has_drydens_spectrum():
    segments = (dryden_gusts(1 << 20, **DRYDEN, seed=4) - 12.0).reshape(256, -1)
    power = (abs(np.fft.rfft(segments * np.hanning(4096))) ** 2).mean(axis=0)
    power *= 2.0 * 0.1 / (np.hanning(4096) ** 2).sum()  # one-sided, per hertz
    frequency_hz = np.fft.rfftfreq(4096, 0.1)
    band = (frequency_hz > 0.02) & (frequency_hz < 0.5)
    expected = 2.0 * 2.0 * 2.0**2 * 5.0 / (1.0 + (2.0 * np.pi * frequency_hz * 5.0) ** 2)
    ratio = power[band] / expected[band]
    # 256 segments scatter by 6 % each frequency, 0.5 % in the mean; sampling folds in 1 % below 0.5 Hz.
    assert ratio.mean() == pytest.approx(1.0, abs=0.03)
    assert abs(ratio - 1.0).max() < 0.3


def test_the_seed_makes_the_wind():
    first, again, other = (dryden_gusts(100, **DRYDEN, seed=seed) for seed in (1, 1, 2))
    assert (first == again).all()
    assert (first != other).any()


def test_turbulence_begins_in_the_steady_state():
    first = np.array([dryden_gusts(1, **DRYDEN, seed=seed)[0] for seed in range(400)])
    assert first.std() == pytest.approx(2.0, rel=0.15)  # 400 values scatter by 3.5 %
