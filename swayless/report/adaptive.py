"""The learning figure: what vibrates under an adaptive shaper, and what it learns from that.

Not for: simulating; what is drawn comes in as arrays.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from swayless.design.shaper import FloatArray
from swayless.report.style import (
    ALARM,
    GREY,
    INK,
    figure_style,
    legend_beside,
    line_style,
    new_figure,
    settle,
)

_MOST_POINTS = 4000


@dataclass(frozen=True, eq=False)
class PlottedLearning:
    """Some moves under an adaptive shaper.

    Parameters
    ----------
    title : str
        Machine, vibration and moves.
    time_s : ndarray, shape (n,)
        Times.
    measured_ratio, vibration_ratio : ndarray, shape (n,)
        Vibration with and without measurement noise, relative to what an unshaped move leaves.
    coefficients : ndarray, shape (n, 3)
        What has been learned.
    wanted : ndarray, shape (3,)
        Eq 4 for the vibration: what is to be learned.
    in_use_from_s : float or None
        When the coefficients begin to shape the command; None if they never do.
    """

    title: str
    time_s: FloatArray
    measured_ratio: FloatArray
    vibration_ratio: FloatArray
    coefficients: FloatArray
    wanted: FloatArray
    in_use_from_s: float | None


def learning_figure(learning: PlottedLearning) -> Figure:
    """Draw how an adaptive shaper learns.

    Parameters
    ----------
    learning : PlottedLearning
        Some moves.

    Returns
    -------
    Figure
        For `save_figure`.

    Examples
    --------
    >>> import numpy as np
    >>> time_s, wanted = np.linspace(0.0, 1.0, 11), np.array([0.25, 0.5, 0.25])
    >>> found = np.tile(wanted, (11, 1))
    >>> figure = learning_figure(PlottedLearning("Robot", time_s, 0 * time_s, 0 * time_s, found, wanted, 0.5))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['Vibration', 'Coefficients']
    """
    names = ["measured", "without noise"], ["first", "middle", "last", "eq 4", "in use from here"]
    with figure_style():
        figure, (above, below) = new_figure(
            learning.title, (2.1, 2.4), labels=[*names[0], *names[1]], sharex=True
        )
        _draw_vibration(above, learning, names[0])
        _draw_coefficients(below, learning, names[1])
        above.set_ylabel("Vibration")
        below.set_ylabel("Coefficients")
        below.set_xlabel("Time (s)")
        below.set_xlim(learning.time_s[0], learning.time_s[-1])
        return settle(figure)


def _draw_vibration(panel: Axes, learning: PlottedLearning, names: Sequence[str]) -> None:
    """Draw what is measured and what vibrates, relative to an unshaped move."""
    every = max(1, learning.time_s.size // _MOST_POINTS)
    time_s = learning.time_s[::every]
    lines = panel.plot(time_s, learning.measured_ratio[::every], color=GREY, linewidth=0.5, label=names[0])
    lines += panel.plot(time_s, learning.vibration_ratio[::every], color=INK, linewidth=0.8, label=names[1])
    _draw_in_use(panel, learning, None)
    legend_beside(panel, lines)


def _draw_coefficients(panel: Axes, learning: PlottedLearning, names: Sequence[str]) -> None:
    """Draw the coefficients, and what they should become."""
    lines = []
    for index in range(3):
        wanted = panel.axhline(learning.wanted[index], color=GREY, linestyle=(0, (3, 2)), linewidth=0.8)
        lines += panel.step(
            learning.time_s,
            learning.coefficients[:, index],
            where="post",
            label=names[index],
            **line_style(index),
        )
    wanted.set_label(names[3])
    legend_beside(panel, [*lines, wanted, *_draw_in_use(panel, learning, names[4])])


def _draw_in_use(panel: Axes, learning: PlottedLearning, name: str | None) -> list[Line2D]:
    """Mark when the coefficients begin to shape the command, if they do."""
    if learning.in_use_from_s is None:
        return []
    return [panel.axvline(learning.in_use_from_s, color=ALARM, linewidth=0.8, label=name)]
