"""Axes that stand for frequency, and where curves are sampled on them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from swayless.errors import DesignError
from swayless.plant import Band, pendulum_rope_length_m
from swayless.report import PlottedShaper
from swayless.report.abscissa import ABSCISSAE, Over

ROPE = ABSCISSAE["rope_length"]


def test_rope_length_is_that_of_the_pendulum() -> None:
    frequencies_hz = np.array([0.1, 0.25, 2.0])
    expected = [pendulum_rope_length_m(frequency) for frequency in frequencies_hz]
    # The same formula in another order of operations: a few roundings.
    np.testing.assert_allclose(ROPE.from_frequency_hz(frequencies_hz), expected, rtol=1e-15)
    np.testing.assert_allclose(ROPE.to_frequency_hz(expected), frequencies_hz, rtol=1e-15)


def test_interval_of_a_band_rises_on_both_axes() -> None:
    band = Band(0.2, 0.3)
    assert ABSCISSAE["frequency"].interval(band) == (0.2, 0.3)
    low_m, high_m = ROPE.interval(band)
    assert low_m < high_m


@pytest.mark.parametrize("over", ["frequency", "rope_length"])
def test_span_shows_every_band_with_a_margin(over: Over, zv: PlottedShaper, ei: PlottedShaper) -> None:
    low, high = ABSCISSAE[over].span([zv, ei])
    for shaper in (zv, ei):
        start, end = ABSCISSAE[over].interval(shaper.guarantee.band)
        assert 0.0 < low < start
        assert end < high


@pytest.mark.parametrize("over", ["frequency", "rope_length"])
def test_samples_hold_the_ends_the_mode_and_the_band(over: Over, ei: PlottedShaper) -> None:
    axis = ABSCISSAE[over]
    span = axis.span([ei])
    points = axis.samples(span, [ei])
    assert (points[0], points[-1]) == span
    assert np.all(np.diff(points) > 0.0)
    assert {axis.position(0.25), *axis.interval(ei.guarantee.band)} <= set(points.tolist())


@pytest.mark.parametrize("span", [(0.05, 30.0), (1.0, 40.0)])
def test_samples_over_rope_length_follow_the_oscillation_of_short_ropes(
    span: tuple[float, float], ei: PlottedShaper
) -> None:
    frequencies_hz = ROPE.to_frequency_hz(ROPE.samples(span, [ei]))
    # 64 points a cycle are asked for, or 801 in all if that is more.
    width_hz = np.ptp(frequencies_hz)
    most_hz = max(1.0 / (64.0 * ei.duration_s), 0.0) if width_hz * 4.0 * 64.0 > 801 else width_hz / 800.0
    assert np.abs(np.diff(frequencies_hz)).max() <= most_hz * (1.0 + 1e-9)


@pytest.mark.parametrize(
    "span", [(0.0, 1.0), (-1.0, 1.0), (2.0, 1.0), (1.0, 1.0), (1.0, math.inf), (math.nan, 1.0)]
)
@pytest.mark.parametrize("over", ["frequency", "rope_length"])
def test_spans_that_do_not_rise_from_above_zero_are_refused(
    over: Over, span: tuple[float, float], ei: PlottedShaper
) -> None:
    with pytest.raises(DesignError, match="must be finite, > 0 and rise"):
        ABSCISSAE[over].samples(span, [ei])


def test_a_span_of_too_many_oscillations_is_refused(ei: PlottedShaper) -> None:
    with pytest.raises(
        DesignError, match=r"from 0\.1 to 1000000\.0 Hz holds 4e\+06 oscillations.* at most 3125"
    ):
        ABSCISSAE["frequency"].samples((0.1, 1e6), [ei])
