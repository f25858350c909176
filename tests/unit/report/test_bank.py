"""The bank figure shows what the rows hold together."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from matplotlib.axes import Axes

from swayless.design.residual import residual_vibration
from swayless.errors import DesignError
from swayless.plant import Band
from swayless.report import PlottedShaper, bank_figure
from swayless.report.abscissa import ABSCISSAE


def _bars(axes: Axes, prefix: str) -> list[tuple[float, float]]:
    bars = [patch for patch in axes.patches if (patch.get_gid() or "").startswith(prefix)]
    return [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in bars]  # type: ignore[attr-defined]


@pytest.fixture
def rows(zv: PlottedShaper, ei: PlottedShaper) -> list[PlottedShaper]:
    """Bands of 0.195 to 0.205 Hz (about) and 0.2 to 0.3 Hz."""
    return [zv, ei]


def test_gaps_are_marked_and_named(zv: PlottedShaper, ei: PlottedShaper) -> None:
    band = Band(0.19, 0.199)
    first = dataclasses.replace(zv, guarantee=dataclasses.replace(zv.guarantee, band=band))
    curves, strip, _ = bank_figure([first, ei], frequency_hz=(0.18, 0.31)).axes
    low_hz, high_hz = ei.guarantee.band.low_hz, ei.guarantee.band.high_hz
    gaps = [(0.18, 0.19), (0.199, low_hz), (high_hz, 0.31)]
    np.testing.assert_allclose(_bars(strip, "gap-"), gaps, rtol=1e-15)  # low + width rounds
    assert _bars(strip, "whole") == [(0.18, 0.31)]
    text = "held by no row: " + ", ".join(f"{low:#.4g} to {high:#.4g} Hz" for low, high in gaps)
    assert strip.get_title(loc="left").replace("\n", " ") == text
    shaded = [patch for patch in curves.patches if patch.get_alpha() is not None]
    assert len(shaded) == len(gaps)


def test_a_covered_range_has_no_gaps(ei: PlottedShaper) -> None:
    figure = bank_figure([ei], frequency_hz=(0.21, 0.29))
    assert _bars(figure.axes[1], "gap-") == []
    assert figure.axes[1].get_title(loc="left") == "every point is held by at least one row"


def test_rows_over_rope_length_are_exactly_the_residual_vibration(rows: list[PlottedShaper]) -> None:
    curves = bank_figure(rows, rope_length_m=(3.0, 8.0)).axes[0]
    for line, row in zip((line for line in curves.lines if len(line.get_xdata()) > 2), rows, strict=True):
        frequencies_hz = ABSCISSAE["rope_length"].to_frequency_hz(line.get_xdata())
        damping_ratio = row.guarantee.mode.damping_ratio
        expected = residual_vibration(row.impulses, frequencies_hz, damping_ratio=damping_ratio)
        np.testing.assert_array_equal(line.get_ydata(), 100.0 * expected)
        assert (line.get_xdata()[0], line.get_xdata()[-1]) == (3.0, 8.0)


def test_the_held_bands_are_the_guarantees(rows: list[PlottedShaper]) -> None:
    strip = bank_figure(rows, rope_length_m=(3.0, 8.0)).axes[1]
    expected = [ABSCISSAE["rope_length"].interval(row.guarantee.band) for row in rows]
    np.testing.assert_allclose(_bars(strip, "held-band-"), expected, rtol=1e-15)  # low + width rounds


def test_staircases_step_at_the_impulses_by_the_amplitudes(ei: PlottedShaper, um_zv: PlottedShaper) -> None:
    stairs = bank_figure([ei, um_zv], frequency_hz=(0.2, 0.3)).axes[2]
    for lane, (line, row) in enumerate(zip(stairs.lines, (ei, um_zv), strict=True)):
        times_s, heights = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        np.testing.assert_array_equal(times_s[1:-1:2], row.impulses.times_s)
        levels = (heights[0] - heights[2:-1:2]) / (heights[0] - heights[-1])
        np.testing.assert_allclose(
            levels, np.cumsum(row.impulses.amplitudes), atol=1e-12
        )  # scaled to the lane
        assert np.all(abs(heights - lane) < 0.5)
    assert [text.get_text() for text in stairs.texts] == ["4.000 s", "1.333 s"]


def test_a_long_list_of_gaps_is_wrapped(ei: PlottedShaper) -> None:
    bands = [Band(0.1 + 0.01 * number, 0.105 + 0.01 * number) for number in range(8)]
    rows = [dataclasses.replace(ei, guarantee=dataclasses.replace(ei.guarantee, band=band)) for band in bands]
    strip = bank_figure(rows, frequency_hz=(0.1, 0.2)).axes[1]
    assert len(_bars(strip, "gap-")) == 8
    assert max(map(len, strip.get_title(loc="left").split("\n"))) <= 90


def test_no_rows_are_refused() -> None:
    with pytest.raises(DesignError, match="needs at least one row"):
        bank_figure([], frequency_hz=(0.1, 0.2))


@pytest.mark.parametrize("length_m", [None, (3.0, 8.0)])
def test_exactly_one_range_must_be_given(ei: PlottedShaper, length_m: tuple[float, float] | None) -> None:
    frequency_hz = None if length_m is None else (0.1, 0.2)
    with pytest.raises(DesignError, match="exactly one of them must be given"):
        bank_figure([ei], rope_length_m=length_m, frequency_hz=frequency_hz)


def test_a_falling_range_is_refused(ei: PlottedShaper) -> None:
    with pytest.raises(DesignError, match=r"rope length from 8\.0 to 3\.0 m: must be finite, > 0 and rise"):
        bank_figure([ei], rope_length_m=(8.0, 3.0))


def test_switching_points_are_marked_on_curves_and_strip(ei: PlottedShaper) -> None:
    panels = bank_figure([ei], rope_length_m=(3.0, 8.0), switching_hz=[0.22, 0.25]).axes
    expected = ABSCISSAE["rope_length"].from_frequency_hz([0.22, 0.25]).tolist()
    for axes in panels[:2]:
        assert [line.get_xdata()[0] for line in axes.lines if line.get_gid() == "switch"] == expected  # type: ignore[index]
