"""How a timing diagram of `block.md` looks: lanes of inputs, the speed, one number more, lanes of outputs.

Not for: what is played (`block.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.controller import Status
from swayless.report.strip import LANE_HEIGHT_IN, name_lanes
from swayless.report.style import GREY, INK, figure_style, line_style, new_figure, settle

if TYPE_CHECKING:
    from block import Played
    from block_scenes import Scene

SPEED_HEIGHT_IN, NUMBER_HEIGHT_IN, TITLE_HEIGHT_IN = 1.5, 1.0, 0.45
STRAIGHT = 2e-5
"""A line bends where its slope changes by more than this part of its height in a tick."""

UNITS = {
    "stop_distance": "stop\ndistance [m]",
    "position": "position [m]",
    "distance_forward": "distance [m]",
    "speed_limit": "speed\nlimit [m/s]",
    "rope_length": "rope [m]",
    "residual_bound": "residual\nbound",
    "actual_speed": "actual [m/s]",
    "predicted_sway": "sway [m]",
}


def values_of(played: Played, name: str) -> list[Any]:
    """Give a pin, a status bit or the position over time."""
    if name == "position":
        return list(played.position_m)
    if name in Status.__members__:
        return [bool(out.status & Status[name]) for out in played.outputs]
    source = played.outputs if name in played.outputs[0]._fields else played.inputs
    return [getattr(each, name) for each in source]


def draw(scene: Scene, played: Played) -> Figure:
    """Draw a scene.

    Parameters
    ----------
    scene : Scene
        What to show.
    played : Played
        What happened.
    """
    heights = [
        *([_lanes_height_in(scene.inputs)] if scene.inputs else []),
        SPEED_HEIGHT_IN,
        *([NUMBER_HEIGHT_IN] if scene.number else []),
        _lanes_height_in(scene.lanes),
    ]
    with figure_style():
        labels = ["x" * 20]
        figure, panels = new_figure(scene.title, heights, labels=labels, sharex=True)
        rest = iter(panels)
        if scene.inputs:
            _draw_lanes(next(rest), played, scene.inputs, line_style(0)["color"])
        _draw_speed(next(rest), played)
        if scene.number:
            _draw_number(next(rest), played, scene.number)
        last = next(rest)
        _draw_lanes(last, played, scene.lanes, GREY)
        last.set_xlabel("time [s]")
        last.set_xlim(0.0, scene.last_s)
        figure.align_ylabels(panels)
        return settle(figure)


def _lanes_height_in(names: Sequence[str]) -> float:
    return LANE_HEIGHT_IN * len(names) + TITLE_HEIGHT_IN / 2


def _draw_speed(axes: Axes, played: Played) -> None:
    command = np.array([each.command for each in played.inputs], dtype=float)
    reference = [out.reference for out in played.outputs]
    axes.plot(*_corners(played.time_s, command), label="command", color=GREY, linestyle=(0, (3, 2)))
    axes.plot(*_corners(played.time_s, reference), label="reference", color=line_style(0)["color"])
    axes.set_ylabel("speed [m/s]")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2, ncols=2)


def _draw_number(axes: Axes, played: Played, name: str) -> None:
    axes.plot(*_corners(played.time_s, values_of(played, name)), color=line_style(1)["color"])
    axes.set_ylabel(UNITS[name])


def _corners(time_s: Sequence[float], values: Sequence[float]) -> tuple[list[float], list[float]]:
    """Leave out the points that lie on the line between others, to `STRAIGHT` of the largest value."""
    line = np.asarray(values, dtype=float)
    off = STRAIGHT * (1e-12 + np.nanmax(np.abs(line)))
    kept, open_ends = {0, len(line) - 1}, [(0, len(line) - 1)]
    while open_ends:
        first, last = open_ends.pop()
        between = np.arange(first + 1, last)
        chord = line[first] + (line[last] - line[first]) * (between - first) / max(last - first, 1)
        apart = np.nan_to_num(np.abs(line[between] - chord), nan=np.inf)
        if apart.size and apart.max() > off:
            middle = int(between[apart.argmax()])
            kept.add(middle)
            open_ends += [(first, middle), (middle, last)]
    ticks = sorted(kept)
    return [time_s[tick] for tick in ticks], [float(line[tick]) for tick in ticks]


def _draw_lanes(axes: Axes, played: Played, names: Sequence[str], colour: str) -> None:
    """Draw a bar where each is TRUE, or with its value where it is a number."""
    for lane, name in enumerate(names):
        ticks = zip(played.time_s, values_of(played, name), strict=True)
        step_s = played.time_s[1] - played.time_s[0]
        for value, group in groupby(ticks, key=lambda tick: tick[1]):
            times_s = [time_s for time_s, _ in group]
            if value is False:
                continue
            width_s = times_s[-1] - times_s[0] + step_s
            is_number = not isinstance(value, bool)
            axes.barh(
                lane,
                width_s,
                0.62,
                times_s[0],
                color="white" if is_number else colour,
                edgecolor=INK,
                linewidth=0.6,
            )
            if is_number:
                middle_s = times_s[0] + width_s / 2
                axes.text(middle_s, lane, f"{value}", ha="center", va="center_baseline", fontsize=8.0)
    name_lanes(axes, list(names), [])
