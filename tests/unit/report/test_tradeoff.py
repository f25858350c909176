"""The trade-off figure shows what was computed, and shades only what is proved."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.design import overtravel_s
from swayless.design.tradeoff import PLACED_FAMILIES, Need, anchored_shaper, frontier, worst_ramp_residual
from swayless.errors import DesignError
from swayless.plant import Band
from swayless.report import figure_bytes, tradeoff_figure

NEED = Need(Band(0.2, 0.3), speed_m_s=0.5, ramp_up_s=1.0, ramp_down_s=1.0, longest_overtravel_m=1.2)
CURVES = 2  # positive and bounded


@pytest.fixture(scope="module")
def figure() -> Figure:
    return tradeoff_figure("crane", NEED, widths=6)


def curves(axes: Axes) -> list[tuple[np.ndarray, np.ndarray]]:
    """Solid lines: the shortest shapers."""
    return [
        (np.asarray(line.get_xdata()), np.asarray(line.get_ydata()))
        for line in axes.lines
        if line.get_linestyle() == "-" and len(line.get_xdata()) > 2
    ]


def points(axes: Axes) -> dict[str, tuple[float, float]]:
    """Places of the families."""
    return {label.get_text(): label.xy for label in axes.texts}  # type: ignore[attr-defined]


def test_every_family_stands_at_its_duration_its_way_and_the_ropes_that_it_holds(figure: Figure) -> None:
    durations, ways = (points(axes) for axes in figure.axes)
    assert set(durations) == set(ways) == set(PLACED_FAMILIES)
    for family in PLACED_FAMILIES:
        shaper = anchored_shaper(family, NEED)
        band = shaper.guarantee.band
        assert band.low_hz == pytest.approx(0.2, rel=1e-12)  # edges are right to 1e-14
        ropes = (band.high_hz / band.low_hz) ** 2
        assert durations[family] == pytest.approx((shaper.duration_s, ropes), rel=1e-12)
        # 0.5 m/s for the mean delay of the shaper and for half of the ramp's second
        assert ways[family] == pytest.approx((0.5 * (overtravel_s(shaper) + 0.5), ropes), rel=1e-12)


def test_the_curves_are_the_shortest_shapers(figure: Figure) -> None:
    drawn = curves(figure.axes[0])
    assert len(drawn) == len(curves(figure.axes[1])) == CURVES
    for (durations_s, ropes), kind in zip(drawn, ("positive", "bounded"), strict=True):
        some = np.sqrt(ropes[[1, 6]])
        front = frontier(0.2, some, amplitudes=kind)  # type: ignore[arg-type]
        np.testing.assert_allclose(durations_s[[1, 6]], front.durations_s, rtol=1e-6)  # a solver's last step


def test_nothing_is_left_of_what_is_proved(figure: Figure) -> None:
    axes = figure.axes[0]
    shades = axes.collections[:CURVES]
    for shade, (durations_s, ropes) in zip(shades, curves(axes), strict=True):
        outline = shade.get_paths()[0].vertices
        edge = outline[outline[:, 0] > 0.0]
        for duration_s, height in zip(durations_s, ropes, strict=True):
            proved = edge[edge[:, 1] <= height * (1.0 - 1e-12), 0]
            assert proved.max(initial=0.0) < duration_s
    bounded = shades[1].get_paths()[0].vertices
    for duration_s, height in points(axes).values():
        assert bounded[bounded[:, 1] <= height * (1.0 - 1e-12), 0].max(initial=0.0) < duration_s


def test_plain_ramps_hold_what_is_drawn_and_no_more(figure: Figure) -> None:
    (ramp,) = (
        line for line in figure.axes[0].lines if line.get_linestyle() == "--" and line.get_gid() == "ramp"
    )
    corners = np.asarray(ramp.get_xydata())
    for duration_s, ropes in corners[1::2][:3]:
        held = Band(0.2, 0.2 * np.sqrt(ropes))
        assert worst_ramp_residual(duration_s, held) == pytest.approx(0.05, rel=1e-6)
        beyond = Band(0.2, 0.2 * np.sqrt(ropes) * 1.001)
        assert worst_ramp_residual(duration_s, beyond) > 0.05


def test_need_and_limit_are_marked(figure: Figure) -> None:
    durations, ways = figure.axes
    levels = [line.get_ydata()[0] for line in durations.lines if line.get_gid() == "need"]
    assert levels == pytest.approx([2.25], rel=1e-12)
    assert [line.get_xdata()[0] for line in ways.lines if line.get_gid() == "limit"] == [1.2]
    legend = durations.get_legend()
    assert legend is not None
    assert "the machine's ropes, 2.25 : 1" in [text.get_text() for text in legend.get_texts()]


def test_an_arm_is_drawn_over_frequencies_and_missing_families_are_named() -> None:
    need = Need(Band(4.0, 5.0), on_rope=False, damping_ratio=0.2, tolerance=0.15)
    durations, ways = tradeoff_figure("arm", need, widths=2).axes
    assert durations.get_ylabel() == "Frequencies held, high : low"
    assert [line.get_ydata()[0] for line in durations.lines if line.get_gid() == "need"] == [1.25]
    assert "ei3" not in points(durations)
    assert ways.get_title(loc="left") == "does not exist at this tolerance and damping: ei3"


def test_drawing_again_gives_the_same_bytes(figure: Figure) -> None:
    assert figure_bytes(figure, "svg") == figure_bytes(figure, "svg")


def test_more_damping_than_robust_design_knows_is_refused() -> None:
    with pytest.raises(DesignError, match=r"damping_ratio = 0.25"):
        tradeoff_figure("arm", Need(Band(4.0, 5.0), damping_ratio=0.25))
