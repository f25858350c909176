"""How every figure looks: one style, one set of colours and lines, in one place.

Not for: what a figure shows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypedDict

import matplotlib.style
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.textpath import text_to_path

INK = "#222222"
GREY = "#767676"
GRID = "#d9d9d9"
ALARM = "#d55e00"
"""Vermilion: the tolerance and what is not held. No design is drawn in it."""

# Okabe and Ito's colours, which stay apart for every kind of colour blindness, without vermilion and yellow;
# orange, the nearest to vermilion, comes last.
_COLOURS = ("#0072b2", "#009e73", "#cc79a7", "#000000", "#56b4e9", "#e69f00")
_DASHES = ("-", (0, (6, 2)), (0, (6, 2, 1.2, 2)), (0, (1.2, 1.6)), (0, (9, 2, 3, 2)))

FIGURE_WIDTH_IN = 7.5

_USUAL_LABEL_LENGTH = 16
_CHARACTER_WIDTH_IN = 0.075  # of the usual letter of 9 points
_TITLE_FONT = FontProperties(family="DejaVu Sans", size=11.0, weight="bold")
_TITLE_LINE_IN = 0.19
_MARGIN_IN = 0.07
_POINTS_PER_IN = 72.0

_RC: dict[str, Any] = {
    "axes.axisbelow": True,
    "axes.edgecolor": GREY,
    "axes.formatter.use_mathtext": False,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.prop_cycle": cycler(color=_COLOURS),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.unicode_minus": False,
    "figure.dpi": 100.0,
    "font.family": "DejaVu Sans",  # ships with matplotlib: the same shapes on every machine
    "font.size": 9.0,
    "grid.color": GRID,
    "grid.linewidth": 0.5,
    "hatch.linewidth": 0.8,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "legend.handlelength": 3.2,
    "lines.linewidth": 1.6,
    "path.simplify_threshold": 0.05,
    "pdf.fonttype": 42,
    "savefig.dpi": 150.0,
    "svg.fonttype": "path",
    "svg.hashsalt": "swayless",
    "text.color": INK,
    "text.parse_math": False,  # a dollar in a name is a dollar
    "xtick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.color": GREY,
    "ytick.labelcolor": INK,
}


class LineStyle(TypedDict):
    """Colour and dashes of a line, as matplotlib takes them."""

    color: str
    linestyle: Any


TOLERANCE_LINE: LineStyle = {"color": ALARM, "linestyle": (0, (3, 2))}


@contextmanager
def figure_style() -> Iterator[None]:
    """Draw with this style and nothing of the user's; everything is as before on the way out.

    Matplotlib has one set of settings per process, so figures are not made from several threads at once.
    """
    with matplotlib.style.context(_RC, after_reset=True):
        yield


def line_style(index: int) -> LineStyle:
    """Colour and dashes of design number `index`, from 0: different for the first thirty.

    Examples
    --------
    >>> line_style(0)
    {'color': '#0072b2', 'linestyle': '-'}
    """
    return {"color": _COLOURS[index % len(_COLOURS)], "linestyle": _DASHES[index % len(_DASHES)]}


def new_figure(
    title: str, panel_heights_in: Sequence[float], *, labels: Sequence[str] = (), sharex: bool = False
) -> tuple[Figure, list[Axes]]:
    """Make a figure with panels above each other. Call it inside `figure_style`.

    Parameters
    ----------
    title : str
        Of the figure; also stored in the file. A long one breaks into lines, for which the figure is higher.
    panel_heights_in : sequence of float
        Height of each panel in inches, from the top.
    labels : sequence of str
        Names that stand on both sides of the panels: long ones widen the figure, not narrow the panels.
    sharex : bool
        Whether the panels have one axis below them in common.
    """
    beyond = max(0, max(map(len, labels), default=0) - _USUAL_LABEL_LENGTH)
    width_in = FIGURE_WIDTH_IN + 2.0 * _CHARACTER_WIDTH_IN * beyond
    lines = _lines(title, width_in - 2.0 * _MARGIN_IN)
    height_in = sum(panel_heights_in) + _TITLE_LINE_IN * (len(lines) - 1)
    figure = Figure(figsize=(width_in, height_in), layout="constrained")
    figure.suptitle("\n".join(lines), x=_MARGIN_IN / width_in, ha="left", font=_TITLE_FONT)
    count = len(panel_heights_in)
    panels = figure.subplots(count, 1, sharex=sharex, squeeze=False, height_ratios=panel_heights_in)
    return figure, list(panels[:, 0])


def _lines(title: str, width_in: float) -> list[str]:
    """Break a title between words into lines that are no wider."""
    lines = [""]
    for word in title.split():
        longer = f"{lines[-1]} {word}".lstrip()
        points, *_ = text_to_path.get_text_width_height_descent(longer, _TITLE_FONT, ismath=False)
        if lines[-1] and points > width_in * _POINTS_PER_IN:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def legend_beside(axes: Axes, lines: Sequence[Line2D]) -> None:
    """Put the legend of a panel to the right of it, where it covers no curve."""
    axes.legend(handles=lines, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)


def legend_above(axes: Axes) -> None:
    """Put the legend of a panel above it, in one line."""
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2, ncols=4)


def settle(figure: Figure) -> Figure:
    """Lay the panels out once and keep them there, so that saving twice gives the same bytes."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return figure
