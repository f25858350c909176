"""The simulation figure: what was asked of a crane, what its drive was told, and how the load swayed.

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
    TOLERANCE_LINE,
    LineStyle,
    figure_style,
    legend_beside,
    line_style,
    new_figure,
    settle,
)

_COMMAND: LineStyle = {"color": GREY, "linestyle": (0, (1, 1.5))}
_UNSHAPED: LineStyle = {"color": GREY, "linestyle": (0, (5, 2))}
_MM_PER_M = 1000.0


@dataclass(frozen=True, eq=False)
class SimulatedRun:
    """One way in which the crane moved.

    Parameters
    ----------
    label : str
        For the legend.
    reference_m_s : ndarray, shape (ticks + 1,)
        What the drive was told, as each tick begins; drawn in steps.
    sway_m : ndarray, shape (ticks + 1,)
        How far the load was ahead of the trolley.
    residual_m : float
        Sway that is left, for the legend.
    shaped : bool
        Whether a shaper was at work: what moved without one is drawn in grey.
    """

    label: str
    reference_m_s: FloatArray
    sway_m: FloatArray
    residual_m: float
    shaped: bool = True


def simulation_figure(
    title: str,
    time_s: FloatArray,
    command_m_s: FloatArray,
    runs: Sequence[SimulatedRun],
    *,
    places: tuple[str, FloatArray] | None = None,
    tolerance: tuple[str, float] | None = None,
) -> Figure:
    """Draw one move of a crane, made in several ways.

    Parameters
    ----------
    title : str
        Machine and move.
    time_s, command_m_s : ndarray, shape (ticks + 1,)
        Times, and what the operator asked for.
    runs : sequence of SimulatedRun
        What became of it.
    places : str and ndarray, optional
        What is drawn below and its values: the rope where it is hoisted, the position of an arm that turns.
    tolerance : str and float, optional
        What is promised, and the sway in m that this is.

    Returns
    -------
    Figure
        For `save_figure`.

    Examples
    --------
    >>> import numpy as np
    >>> time_s = np.linspace(0.0, 10.0, 101)
    >>> run = SimulatedRun("zv", np.full(101, 0.5), 0.1 * np.sin(time_s), 0.002)
    >>> figure = simulation_figure("Crane", time_s, np.full(101, 0.5), [run])
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['command', 'zv: 2.0 mm left']
    """
    heights = (2.1, 2.9) if places is None else (2.1, 2.9, 1.2)
    with figure_style():
        figure, panels = new_figure(title, heights, labels=[_label(run) for run in runs], sharex=True)
        speeds, sways = panels[:2]
        lines = speeds.step(time_s, command_m_s, where="post", label="command", **_COMMAND)
        lines += _draw_runs(speeds, sways, time_s, runs)
        if tolerance is not None:
            lines += _draw_tolerance(sways, *tolerance)
        if places is not None:
            panels[2].plot(time_s, places[1], color=INK)
            panels[2].set_ylabel(places[0])
        _name_axes(panels, time_s)
        legend_beside(speeds, lines)
        return settle(figure)


def _name_axes(panels: Sequence[Axes], time_s: FloatArray) -> None:
    for panel, name in zip(panels, ("Speed (m/s)", "Sway (mm)"), strict=False):
        panel.set_ylabel(name)
    panels[-1].set_xlabel("Time (s)")
    panels[-1].set_xlim(time_s[0], time_s[-1])


def _draw_runs(speeds: Axes, sways: Axes, time_s: FloatArray, runs: Sequence[SimulatedRun]) -> list[Line2D]:
    """Draw what the drive was told and how the load swayed; give the lines of the sway."""
    lines: list[Line2D] = []
    colours = iter(range(len(runs)))
    for run in runs:
        look = line_style(next(colours)) if run.shaped else _UNSHAPED
        speeds.step(time_s, run.reference_m_s, where="post", **look)
        lines += sways.plot(time_s, _MM_PER_M * run.sway_m, label=_label(run), **look)
    return lines


def _label(run: SimulatedRun) -> str:
    return f"{run.label}: {_MM_PER_M * run.residual_m:.1f} mm left"


def _draw_tolerance(sways: Axes, label: str, tolerance_m: float) -> list[Line2D]:
    """Shade what a shaper may leave after one change of the speed."""
    limit_mm = _MM_PER_M * tolerance_m
    sways.axhspan(-limit_mm, limit_mm, color=ALARM, alpha=0.12, linewidth=0.0)
    sways.axhline(-limit_mm, **TOLERANCE_LINE)
    return [sways.axhline(limit_mm, label=label, **TOLERANCE_LINE)]
