"""The bank figure: what all rows of a machine hold together over its range. Not for: choosing rows."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.errors import DesignError
from swayless.plant.response import VelocityProfile
from swayless.report.abscissa import ABSCISSAE, Abscissa, Over
from swayless.report.plotted import PlottedShaper
from swayless.report.ranges import Range
from swayless.report.sensitivity import draw_residuals, show_near_tolerance
from swayless.report.strip import LANE_HEIGHT_IN, draw_held_bands, ends, name_lanes
from swayless.report.style import ALARM, INK, figure_style, line_style, new_figure, settle

_SWITCH_LINE: dict[str, Any] = {"color": INK, "linewidth": 0.8, "linestyle": (0, (4, 3)), "zorder": 3.0}
_STAIR_LANE_IN = 0.42
_STAIR_HEIGHT = 0.62  # of a lane
_EDGE_RATIO = 0.03  # of the range, shown on both sides of it
_REMARK_WIDTH = 90  # characters across the strip


def bank_figure(
    rows: Sequence[PlottedShaper],
    *,
    rope_length_m: Range | None = None,
    frequency_hz: Range | None = None,
    switching_hz: Sequence[float] = (),
) -> Figure:
    """Draw all rows of a machine over its range: their residuals, what they hold together, their steps.

    A point of the range is held when it lies in the guaranteed band of at least one row.

    Parameters
    ----------
    rows : sequence of PlottedShaper
        At least one, in the order of the knob.
    rope_length_m, frequency_hz : (low, high)
        The machine's range, 0 < low < high. Exactly one of the two.
    switching_hz : sequence of float
        Where one row hands over to the next, on whichever axis.

    Returns
    -------
    Figure
        For `save_figure`.

    Raises
    ------
    DesignError
        If there is no row, not exactly one range, or a range that does not rise from above 0.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import pendulum_mode
    >>> ei = design_shaper("ei", pendulum_mode(4.0))
    >>> figure = bank_figure([PlottedShaper("EI 4 m", ei, ei.guarantee)], rope_length_m=(3.0, 5.0))
    >>> figure.axes[1].get_title(loc="left")
    'every point is held by at least one row'
    """
    if not rows:
        raise DesignError("bank figure: needs at least one row, got none")
    over, whole = _only_range(rope_length_m, frequency_hz)
    abscissa = ABSCISSAE[over]
    points = abscissa.samples(whole, rows)
    labels = [row.label for row in rows]
    with figure_style():
        heights_in = (3.2, 0.8 + LANE_HEIGHT_IN * (len(rows) + 1), 0.7 + _STAIR_LANE_IN * len(rows))
        title = f"What the bank leaves over {abscissa.title.lower()}"
        figure, (curves, strip, stairs) = new_figure(title, heights_in, labels=labels)
        draw_residuals(curves, rows, abscissa, points)
        show_near_tolerance(curves, rows)
        _draw_coverage(curves, strip, rows, abscissa, whole)
        for frequency in switching_hz:
            for axes in (curves, strip):
                axes.axvline(abscissa.position(frequency), gid="switch", **_SWITCH_LINE)
        _draw_stairs(stairs, rows)
        return settle(figure)


def _only_range(rope_length_m: Range | None, frequency_hz: Range | None) -> tuple[Over, Range]:
    """Take the one range that is given, and which axis it is of."""
    if rope_length_m is not None and frequency_hz is None:
        return "rope_length", rope_length_m
    if frequency_hz is not None and rope_length_m is None:
        return "frequency", frequency_hz
    given = f"rope_length_m = {rope_length_m}, frequency_hz = {frequency_hz}"
    raise DesignError(f"bank figure: {given}: exactly one of them must be given")


def _draw_coverage(
    curves: Axes, strip: Axes, rows: Sequence[PlottedShaper], abscissa: Abscissa, whole: Range
) -> None:
    """Show what each row holds and what they hold together, and name the gaps."""
    gaps = draw_held_bands(strip, rows, abscissa, whole)
    for low, high in gaps:
        curves.axvspan(low, high, color=ALARM, alpha=0.12, linewidth=0.0)
    if gaps:
        # No line ends inside an interval: its spaces are no-break ones while the text is filled.
        intervals = [ends(gap, abscissa.unit).replace(" ", "\xa0") for gap in gaps]
        text = textwrap.fill("held by no row: " + ", ".join(intervals), _REMARK_WIDTH)
        strip.set_title(text.replace("\xa0", " "), color=ALARM)
    else:
        strip.set_title("every point is held by at least one row")
    edge = _EDGE_RATIO * (whole[1] - whole[0])
    for axes in (curves, strip):
        axes.set_xlim(whole[0] - edge, whole[1] + edge)


def _draw_stairs(axes: Axes, rows: Sequence[PlottedShaper]) -> None:
    """Draw the answer of each row to a step as a staircase in its own lane, with its duration."""
    levels = np.concatenate([np.cumsum(row.impulses.amplitudes) for row in rows])
    lowest, highest = min(0.0, float(levels.min())), max(1.0, float(levels.max()))
    edges_s = np.array([-0.04, 1.06]) * max(row.duration_s for row in rows)
    for lane, row in enumerate(rows):
        amplitudes = row.impulses.amplitudes
        corners_s, heights = VelocityProfile(row.impulses.times_s, amplitudes, 0.0 * amplitudes).vertices()
        corners_s = np.concatenate([edges_s[:1], corners_s, edges_s[1:]])
        heights = np.concatenate([[0.0], heights, heights[-1:]])
        # Lanes count downwards, so a higher level is a smaller number.
        lane_heights = lane + _STAIR_HEIGHT * (0.5 - (heights - lowest) / (highest - lowest))
        floor = lane + _STAIR_HEIGHT * (0.5 + lowest / (highest - lowest))
        color = line_style(lane)["color"]
        axes.plot(corners_s, lane_heights, color=color)
        axes.fill_between(corners_s, lane_heights, floor, color=color, alpha=0.15, linewidth=0.0)
    name_lanes(axes, [row.label for row in rows], [f"{row.duration_s:#.4g} s" for row in rows])
    axes.set_xlim(edges_s[0], edges_s[1])
    axes.set_xlabel("Time (s)")
    axes.set_title("reference after a step of the command, and how long it takes")
