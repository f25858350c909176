"""The strip under the curves: a bar for what each design holds, with its ends in numbers.

Not for: the curves.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes

from swayless.report.abscissa import Abscissa
from swayless.report.plotted import PlottedShaper
from swayless.report.ranges import Range, uncovered
from swayless.report.style import ALARM, GREY, INK, line_style

LANE_HEIGHT_IN = 0.24

MODE_MARKER: dict[str, Any] = {
    "linestyle": "none",
    "marker": "D",
    "markersize": 5.0,
    "color": "white",
    "markeredgecolor": INK,
    "zorder": 4.0,
}

_BAR_HEIGHT = 0.5


def ends(interval: Range, unit: str) -> str:
    """Write an interval in numbers.

    Examples
    --------
    >>> ends((0.16, 0.24), "Hz")
    '0.1600 to 0.2400 Hz'
    """
    low, high = interval
    return f"{low:#.4g} to {high:#.4g} {unit}"


def name_lanes(axes: Axes, names: Sequence[str], remarks: Sequence[str]) -> None:
    """Give a panel one lane per name, from the top, with the name left of it and a remark right of it."""
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0.0)
    axes.grid(visible=False, axis="y")
    for lane, remark in enumerate(remarks):
        axes.text(
            1.01, lane, remark, transform=axes.get_yaxis_transform(), va="center_baseline", fontsize=8.5
        )


def draw_held_bands(
    axes: Axes, shapers: Sequence[PlottedShaper], abscissa: Abscissa, whole: Range | None = None
) -> list[Range]:
    """Draw each design's held bands as bars, its mode as a diamond, and write the ends beside it.

    With `whole`, one more bar shows that range, and in another colour the gaps that no band covers. They are
    returned.
    """
    names = [shaper.label for shaper in shapers]
    held = [[abscissa.interval(band) for band in shaper.guarantee.bands] for shaper in shapers]
    gaps = [] if whole is None else uncovered([interval for lane in held for interval in lane], whole)
    for lane, (shaper, intervals) in enumerate(zip(shapers, held, strict=True)):
        for number, interval in enumerate(intervals):
            name = f"held-band-{lane + 1}" + (f"-mode-{number + 1}" if number else "")
            _draw_bar(axes, lane, interval, name, color=line_style(lane)["color"])
        draw_mode(axes, abscissa.position(shaper.guarantee.mode.frequency_hz), lane)
    if whole is not None:
        _draw_bar(axes, len(shapers), whole, "whole", color=GREY)
        names.append("range")
        held.append([whole])
    for number, gap in enumerate(gaps, 1):
        _draw_bar(axes, len(shapers), gap, f"gap-{number}", color="white", edgecolor=ALARM, hatch="//////")
    name_lanes(axes, names, ["\n".join(ends(each, abscissa.unit) for each in lane) for lane in held])
    axes.set_xlabel(abscissa.label)
    return gaps


def draw_mode(axes: Axes, x: float, y: float, *, clip_on: bool = True) -> None:
    """Mark a design's mode; without clipping the mark stays whole on the edge of the panel."""
    axes.plot([x], [y], clip_on=clip_on, **MODE_MARKER)


def _draw_bar(axes: Axes, lane: int, interval: Range, name: str, **look: Any) -> None:
    """Draw one bar, to be found by its name in the figure and in the SVG."""
    low, high = interval
    (bar,) = axes.barh(lane, high - low, _BAR_HEIGHT, low, **look)
    bar.set_gid(name)
