"""The trade-off figure: how wide a range is held, against how long it takes and how far the machine goes on.

Not for: ranking what could serve a machine (`swayless.design.tradeoff`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from swayless.design import FloatArray, Shaper, overtravel_s
from swayless.design.robust import Amplitudes
from swayless.design.tradeoff import PLACED_FAMILIES, Frontier, Need, anchored_shaper, frontier, held_by_ramp
from swayless.errors import DesignError
from swayless.report.style import (
    GREY,
    INK,
    TOLERANCE_LINE,
    figure_style,
    legend_beside,
    line_style,
    new_figure,
    settle,
)

_NARROWEST, _WIDEST = 1.015, 7.9  # ratios of frequencies; robust design ends at 8
_BEFORE_CORNER = 0.9995  # of a ratio: beyond it the frontier jumps, and at it it is hard to compute
_ROOM = 1.12  # by ratio, above the need and the widest family
_TICKS = (1.1, 1.2, 1.4, 1.7, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0, 14.0, 20.0, 30.0, 40.0, 60.0)
_KINDS: tuple[Amplitudes, ...] = ("positive", "bounded")
_NEGATIVE_STYLE = 1  # of the lines of a figure; 0 is for positive amplitudes
_LABEL_OFFSETS: tuple[dict[str, Any], ...] = (
    {"xytext": (6.0, -8.0), "ha": "left"},
    {"xytext": (-6.0, -1.0), "ha": "right"},
)
_BOUND_LINE: dict[str, Any] = {"color": INK, "linewidth": 0.8, "linestyle": (0, (2, 3))}
_RAMP_LINE: dict[str, Any] = {"color": GREY, "linewidth": 1.2, "linestyle": (0, (6, 2))}
_HALO = withStroke(linewidth=2.5, foreground="white", alpha=0.8)


def tradeoff_figure(name: str, need: Need, *, widths: int = 48) -> Figure:
    """Draw how wide a range families and robust shapers hold, over their durations and ways to rest.

    Every design holds its range from the machine's lowest frequency (longest rope) up, so that all stand
    beside one frontier: the shortest shapers there are, computed over a sweep of widths. Shorter than their
    lower bounds there is nothing, which is proved. A plain ramp counts for moves that reach full speed.

    Parameters
    ----------
    name : str
        Of the machine.
    need : Need
        Its range, tolerance and damping.
    widths : int
        In how many steps the frontier is swept, beside the widths of the families: at least 2.

    Returns
    -------
    Figure
        For `save_figure`.

    Raises
    ------
    DesignError
        If robust shapers do not exist for the tolerance or the damping.

    Examples
    --------
    >>> from swayless.plant import Band
    >>> figure = tradeoff_figure("crane", Need(Band(0.9, 1.1)), widths=2)
    >>> [axes.get_xlabel() for axes in figure.axes]
    ['Duration of the shaper, or of the plain ramp (s)', 'Way from full speed to rest (m)']
    """
    families, missing = _families(need)
    widest = max(need.ratio, *(_ratio(shaper) for shaper in families))
    ratios = _sweep(families, min(_WIDEST, _ROOM * widest), widths)
    fronts = [_front(need, ratios, kind) for kind in _KINDS]
    with figure_style():
        title = f"{name}: what robustness costs at {100.0 * need.tolerance:g} %"
        figure, (durations, ways) = new_figure(title, (3.9, 3.9))
        _draw_durations(durations, need, families, fronts)
        _draw_ways(ways, need, families, fronts)
        for axes in (durations, ways):
            _scale(axes, need, ratios)
        start = "longest rope down" if need.on_rope else "lowest frequency up"
        durations.set_title(f"every design holds a range from the {start}")
        legend_beside(durations, _legend(need))
        if missing:
            ways.set_title(f"does not exist at this tolerance and damping: {', '.join(missing)}")
        return settle(figure)


def _families(need: Need) -> tuple[list[Shaper], list[str]]:
    """Design every named family, and name those that do not exist."""
    found: list[Shaper] = []
    missing: list[str] = []
    for family in PLACED_FAMILIES:
        try:
            found.append(anchored_shaper(family, need))
        except DesignError:
            missing.append(family)
    return found, missing


def _sweep(families: Sequence[Shaper], widest: float, widths: int) -> FloatArray:
    """Choose widths: even ones, and those of families, which end level stretches of the frontier."""
    even = np.geomspace(_NARROWEST, widest, widths)
    corners = np.array([_ratio(shaper) for shaper in families]) * _BEFORE_CORNER
    return np.union1d(even, corners[(corners > even[0]) & (corners < even[-1])])


def _front(need: Need, ratios: FloatArray, kind: Amplitudes) -> Frontier:
    return frontier(
        need.band.low_hz,
        ratios,
        tolerance=need.tolerance,
        damping_ratio=need.damping_ratio,
        amplitudes=kind,
    )


def _ratio(shaper: Shaper) -> float:
    """Ratio of the frequencies that a shaper holds."""
    band = shaper.guarantee.band
    return band.high_hz / band.low_hz


def _draw_durations(axes: Axes, need: Need, families: Sequence[Shaper], fronts: Sequence[Frontier]) -> None:
    """Draw everything over duration, with what is proved impossible shaded."""
    for index, (front, shade) in enumerate(zip(fronts, (0.10, 0.22), strict=True)):
        # A wider band needs no less time: what is proved for one width is proved up to the next one.
        bounds_s = np.repeat(front.lower_bounds_s, 2)[:-1]
        steps = _height(need, np.repeat(front.ratios, 2)[1:])
        axes.fill_betweenx(steps, 0.0, bounds_s, color=GREY, alpha=shade, linewidth=0.0)
        axes.plot(front.durations_s, _height(need, front.ratios), color=line_style(index)["color"])
        axes.plot(bounds_s, steps, **_BOUND_LINE)
    _draw_ramp(axes, need, 1.0)
    _draw_families(axes, need, [(shaper, shaper.duration_s) for shaper in families])
    longest_s = max(*(shaper.duration_s for shaper in families), *(f.durations_s[-1] for f in fronts))
    axes.set_xlim(0.0, 1.16 * longest_s)
    axes.set_xlabel("Duration of the shaper, or of the plain ramp (s)")


def _draw_ways(axes: Axes, need: Need, families: Sequence[Shaper], fronts: Sequence[Frontier]) -> None:
    """Draw everything over the way to rest, the machine's own ramp included."""
    for index, front in enumerate(fronts):
        ways_m = [need.overtravel_m(way_s) for way_s in front.overtravels_s.tolist()]
        axes.plot(ways_m, _height(need, front.ratios), color=line_style(index)["color"])
    _draw_ramp(axes, need, need.speed_m_s / 2.0)
    ways_m = [need.overtravel_m(overtravel_s(shaper)) for shaper in families]
    _draw_families(axes, need, list(zip(families, ways_m, strict=True)))
    if need.longest_overtravel_m is not None:
        axes.axvline(need.longest_overtravel_m, gid="limit", linewidth=1.2, **TOLERANCE_LINE)
    axes.set_xlim(0.0, 1.16 * max(*ways_m, need.overtravel_m(float(fronts[0].overtravels_s[-1]))))
    axes.set_xlabel("Way from full speed to rest (m)")


def _draw_families(axes: Axes, need: Need, places: Sequence[tuple[Shaper, float]]) -> None:
    """Draw families as points with their names, those with negative amplitudes hollow."""
    for shaper, x in places:
        negative = bool(np.any(shaper.amplitudes < 0.0))
        color = line_style(_NEGATIVE_STYLE if negative else 0)["color"]
        y = float(_height(need, _ratio(shaper)))
        axes.plot([x], [y], "o", markersize=5.0, color=color, markerfacecolor="white" if negative else color)
        label = axes.annotate(
            shaper.family, (x, y), textcoords="offset points", fontsize=8.5, **_LABEL_OFFSETS[negative]
        )
        label.set_path_effects([_HALO])


def _draw_ramp(axes: Axes, need: Need, scale: float) -> None:
    """Draw the shortest plain ramps: each number of cycles serves a width, and the next one a wider one."""
    corners: list[tuple[float, float]] = []
    reached = 1.0
    for band in held_by_ramp(1.0, tolerance=need.tolerance, damping_ratio=need.damping_ratio):
        ratio = band.high_hz / band.low_hz
        if ratio > reached:
            duration_s = band.low_hz / need.band.low_hz
            corners += [(scale * duration_s, reached), (scale * duration_s, min(ratio, _WIDEST))]
            reached = ratio
    x, ratios = np.array(corners).T
    axes.plot(x, _height(need, ratios), gid="ramp", **_RAMP_LINE)


def _height(need: Need, ratios: FloatArray | float) -> FloatArray:
    """Ratio of ropes, or of frequencies, for ratios of frequencies."""
    return np.asarray(ratios, dtype=np.float64) ** (2.0 if need.on_rope else 1.0)


def _scale(axes: Axes, need: Need, ratios: FloatArray) -> None:
    """Make the axis of widths, and mark the need on it."""
    axes.set_yscale("log")
    axes.set_ylim(*_height(need, ratios[[0, -1]]).tolist())
    axes.yaxis.set_major_locator(FixedLocator(_TICKS))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g} : 1"))
    axes.set_ylabel("Ropes held, longest : shortest" if need.on_rope else "Frequencies held, high : low")
    axes.axhline(float(_height(need, need.ratio)), gid="need", linewidth=1.2, **TOLERANCE_LINE)


def _legend(need: Need) -> list[Line2D]:
    """Name what is drawn."""
    positive, bounded = (line_style(index)["color"] for index in range(len(_KINDS)))
    what = "ropes" if need.on_rope else "frequencies"
    height = float(_height(need, need.ratio))
    return [
        Line2D([], [], label="si positive: the shortest", color=positive),
        Line2D([], [], label="si bounded: the shortest", color=bounded),
        Line2D([], [], label="proved: nothing is shorter", **_BOUND_LINE),
        Line2D([], [], label="family", color=positive, linestyle="none", marker="o", markersize=5.0),
        Line2D(
            [],
            [],
            label="family, amplitudes negative",
            color=bounded,
            linestyle="none",
            marker="o",
            markersize=5.0,
            markerfacecolor="white",
        ),
        Line2D([], [], label="plain ramp, full-speed moves", **_RAMP_LINE),
        Line2D([], [], label=f"the machine's {what}, {height:.3g} : 1", linewidth=1.2, **TOLERANCE_LINE),
    ]
