"""The sensitivity figure shows what `residual_vibration` and the guarantees say."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from swayless.design.residual import residual_vibration, vibration_error
from swayless.errors import DesignError
from swayless.plant import Band
from swayless.report import PlottedShaper, sensitivity_figure
from swayless.report.abscissa import ABSCISSAE, Over


def _line(axes: Axes, label: str) -> tuple[np.ndarray, np.ndarray]:
    (line,) = (line for line in axes.lines if line.get_label() == label)
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


def _bar(axes: Axes, name: str) -> Rectangle:
    (bar,) = (patch for patch in axes.patches if patch.get_gid() == name)
    assert isinstance(bar, Rectangle)
    return bar


@pytest.mark.parametrize("over", ["frequency", "rope_length"])
def test_curves_are_exactly_the_residual_vibration(over: Over, zv: PlottedShaper, ei: PlottedShaper) -> None:
    curves = sensitivity_figure([zv, ei], over=over).axes[0]
    for shaper in (zv, ei):
        points, percent = _line(curves, shaper.label)
        frequencies_hz = ABSCISSAE[over].to_frequency_hz(points)
        damping_ratio = shaper.guarantee.mode.damping_ratio
        expected = residual_vibration(shaper.impulses, frequencies_hz, damping_ratio=damping_ratio)
        assert points.size > 800
        np.testing.assert_array_equal(percent, 100.0 * expected)


def test_curves_in_magees_definition_are_exactly_the_vibration_error_to_full_height(
    zv: PlottedShaper,
) -> None:
    curves = sensitivity_figure([zv], span=(0.01, 0.5), definition="magee").axes[0]
    frequencies_hz, percent = _line(curves, "ZV")
    np.testing.assert_array_equal(
        percent, 100.0 * vibration_error(zv.impulses, frequencies_hz, damping_ratio=0.1)
    )
    assert percent.max() > 100.0
    assert curves.get_ylim()[1] > percent.max()
    assert curves.get_ylabel() == "Vibration error (%)"


@pytest.mark.parametrize("over", ["frequency", "rope_length"])
def test_the_marked_band_is_the_guarantee(over: Over, zv: PlottedShaper, ei: PlottedShaper) -> None:
    strip = sensitivity_figure([zv, ei], over=over).axes[1]
    for lane, shaper in enumerate((zv, ei)):
        low, high = ABSCISSAE[over].interval(shaper.guarantee.band)
        bar = _bar(strip, f"held-band-{lane + 1}")
        assert bar.get_x() == low
        # matplotlib keeps low and width: their sum is the high end to a rounding.
        assert bar.get_x() + bar.get_width() == pytest.approx(high, rel=1e-15)
        assert f"{low:#.4g} to {high:#.4g} {ABSCISSAE[over].unit}" in [
            text.get_text() for text in strip.texts
        ]
        positions = [tuple(line.get_xydata()[0]) for line in strip.lines]
        assert (ABSCISSAE[over].position(shaper.guarantee.mode.frequency_hz), lane) in positions


def test_the_curve_meets_the_tolerance_line_at_the_ends_of_the_marked_band(ei: PlottedShaper) -> None:
    curves = sensitivity_figure([ei]).axes[0]
    frequencies_hz, percent = _line(curves, "EI")
    band = ei.guarantee.band
    at_ends = percent[np.isin(frequencies_hz, [band.low_hz, band.high_hz])]
    np.testing.assert_allclose(
        at_ends, _line(curves, "tolerance 5 %")[1], rtol=1e-9
    )  # edges are found to 1e-14


def test_each_tolerance_has_one_line(zv: PlottedShaper, ei: PlottedShaper) -> None:
    loose = dataclasses.replace(zv, guarantee=dataclasses.replace(zv.guarantee, tolerance=0.2))
    labels = [line.get_label() for line in sensitivity_figure([zv, loose, ei]).axes[0].lines]
    assert [label for label in labels if str(label).startswith("tolerance")] == [
        "tolerance 5 %",
        "tolerance 20 %",
    ]


def test_any_name_reaches_the_legend(zv: PlottedShaper) -> None:
    named = dataclasses.replace(zv, label="_4 $ slings")
    legend = sensitivity_figure([named]).axes[0].get_legend()
    assert legend is not None
    assert legend.get_texts()[0].get_text() == "_4 $ slings"


def test_the_mode_is_marked_on_the_curve_where_it_is_in_view(ei: PlottedShaper) -> None:
    def marks(span: tuple[float, float]) -> list[tuple[float, float]]:
        lines = sensitivity_figure([ei], span=span).axes[0].lines
        return [tuple(line.get_xydata()[0]) for line in lines if line.get_marker() == "D"]

    assert marks((0.1, 0.3)) == [(0.25, 100.0 * float(residual_vibration(ei.impulses, 0.25)))]
    assert marks((0.3, 0.5)) == []


def test_rope_lengths_have_feet_above(ei: PlottedShaper) -> None:
    curves = sensitivity_figure([ei], over="rope_length", span=(3.048, 6.096)).axes[0]
    (feet,) = curves.child_axes
    assert feet.get_xlabel() == "Rope length (ft)"
    assert feet.get_xlim() == pytest.approx((10.0, 20.0), rel=1e-12)


def test_a_given_span_is_the_axis_and_shows_whole_curves(ei: PlottedShaper) -> None:
    curves, strip = sensitivity_figure([ei], span=(0.1, 0.6)).axes
    assert curves.get_xlim() == strip.get_xlim() == (0.1, 0.6)
    assert curves.get_ylim()[1] >= _line(curves, "EI")[1].max()


def test_no_designs_are_refused() -> None:
    with pytest.raises(DesignError, match="needs at least one design"):
        sensitivity_figure([])


def test_bands_of_further_modes_have_bars_of_their_own(ei: PlottedShaper) -> None:
    second = Band(0.74, 0.76)  # the third harmonic, which EI holds too
    both = dataclasses.replace(ei, guarantee=dataclasses.replace(ei.guarantee, further_bands=(second,)))
    curves, strip = sensitivity_figure([both]).axes
    bar = _bar(strip, "held-band-1-mode-2")
    assert (bar.get_x(), bar.get_width()) == pytest.approx((0.74, 0.02), rel=1e-12)
    assert _bar(strip, "held-band-1").get_x() == ei.guarantee.band.low_hz
    assert curves.get_xlim()[1] > second.high_hz
    assert "0.7400 to 0.7600 Hz" in strip.texts[0].get_text()


def test_of_a_damping_range_the_worst_is_drawn(ei: PlottedShaper) -> None:
    ranged = dataclasses.replace(ei, guarantee=dataclasses.replace(ei.guarantee, highest_damping_ratio=0.1))
    frequencies_hz, percent = _line(sensitivity_figure([ranged]).axes[0], "EI")
    ends = [residual_vibration(ei.impulses, frequencies_hz, damping_ratio=ratio) for ratio in (0.0, 0.1)]
    assert np.all(percent >= 100.0 * np.max(ends, axis=0))
    assert np.any(percent > 100.0 * ends[0])
