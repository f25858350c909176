"""The sensitivity figure: what several designs leave swinging over frequency or rope length.

Not for: a machine's bank as a whole (`bank`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Literal, Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike

from swayless.design.residual import residual_vibration, vibration_error
from swayless.design.shaper import FloatArray, Impulses
from swayless.errors import DesignError
from swayless.report.abscissa import ABSCISSAE, Abscissa, Over
from swayless.report.plotted import PlottedShaper
from swayless.report.ranges import Range
from swayless.report.strip import LANE_HEIGHT_IN, MODE_MARKER, draw_held_bands, draw_mode
from swayless.report.style import TOLERANCE_LINE, figure_style, legend_beside, line_style, new_figure, settle

Definition = Literal["kriikku", "magee"]

_DAMPING_CURVES = 17  # of a range of damping ratios, whose worst is drawn

METRES_PER_FOOT = 0.3048
"""Exact by definition: the international foot of 1959."""

CLOSEUP_TOLERANCES = 8.0
"""Height of a close-up, in tolerances."""


class _Residual(Protocol):
    def __call__(
        self, impulses: Impulses, frequency_hz: ArrayLike, *, damping_ratio: ArrayLike
    ) -> FloatArray: ...


_RESIDUALS: Mapping[Definition, tuple[str, _Residual]] = MappingProxyType(
    {
        "kriikku": ("Residual vibration (%)", residual_vibration),
        "magee": ("Vibration error (%)", vibration_error),
    }
)


def sensitivity_figure(
    shapers: Sequence[PlottedShaper],
    *,
    over: Over = "frequency",
    span: Range | None = None,
    definition: Definition = "kriikku",
) -> Figure:
    """Draw the residual vibration of several designs, the tolerance, and the band that each one holds.

    Parameters
    ----------
    shapers : sequence of PlottedShaper
        At least one, in the order of the legend. Each is drawn at the damping ratio that it
        is promised for; of a range of them at the worst.
    over : {"frequency", "rope_length"}
        Axis: Hz, or the rope length in m with feet above.
    span : (low, high), optional
        Range of that axis, 0 < low < high, with the whole curves. By default a close-up: every held band
        with a margin beside it, up to `CLOSEUP_TOLERANCES` times the tolerance.
    definition : {"kriikku", "magee"}
        `residual_vibration`, or `vibration_error`, which may exceed 100 % and is drawn to its full height.

    Returns
    -------
    Figure
        For `save_figure`.

    Raises
    ------
    DesignError
        If there is no shaper, or the span is out of range.

    References
    ----------
    Kriikku, Singer and Singhose (1997), eq 1 and fig 4. Magee and Book, eqs 24 and 25.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> zvd = design_shaper("zvd", Mode(0.25))
    >>> figure = sensitivity_figure([PlottedShaper("ZVD", zvd, zvd.guarantee)])
    >>> [axes.get_xlabel() for axes in figure.axes]
    ['', 'Frequency (Hz)']
    """
    if not shapers:
        raise DesignError("sensitivity figure: needs at least one design, got none")
    with figure_style():
        return settle(_drawn(shapers, ABSCISSAE[over], span, definition))


def _drawn(
    shapers: Sequence[PlottedShaper], abscissa: Abscissa, span: Range | None, definition: Definition
) -> Figure:
    """Draw the panel with the curves and the strip with the bands."""
    shown = abscissa.span(shapers) if span is None else span
    points = abscissa.samples(shown, shapers)
    title = f"{_RESIDUALS[definition][0].removesuffix(' (%)')} over {abscissa.title.lower()}"
    heights_in = (3.4, 0.6 + LANE_HEIGHT_IN * len(shapers))
    labels = [shaper.label for shaper in shapers]
    figure, (curves, strip) = new_figure(title, heights_in, labels=labels, sharex=True)
    draw_residuals(curves, shapers, abscissa, points, definition)
    if span is None and definition == "kriikku":
        show_near_tolerance(curves, shapers)
    draw_held_bands(strip, shapers, abscissa)
    strip.set_title("residual vibration held within the tolerance")
    strip.set_xlim(*shown)
    return figure


def draw_residuals(
    axes: Axes,
    shapers: Sequence[PlottedShaper],
    abscissa: Abscissa,
    points: FloatArray,
    definition: Definition = "kriikku",
) -> None:
    """Draw a curve per design in %, its mode, and the tolerance lines, with the legend beside them."""
    title, residual = _RESIDUALS[definition]
    frequencies_hz = abscissa.to_frequency_hz(points)
    lines: list[Line2D] = []  # named to the legend one by one: it would leave a name like "_a" out
    for number, shaper in enumerate(shapers):
        mode = shaper.guarantee.mode
        percent = 100.0 * np.max(
            [residual(shaper.impulses, frequencies_hz, damping_ratio=ratio) for ratio in _dampings(shaper)],
            axis=0,
        )
        lines += axes.plot(points, percent, label=shaper.label, **line_style(number))
        at_mode = 100.0 * max(
            residual(shaper.impulses, mode.frequency_hz, damping_ratio=ratio) for ratio in _dampings(shaper)
        )
        if points[0] <= abscissa.position(mode.frequency_hz) <= points[-1]:
            draw_mode(axes, abscissa.position(mode.frequency_hz), float(at_mode), clip_on=False)
    for tolerance in sorted({shaper.guarantee.tolerance for shaper in shapers}):
        name = f"tolerance {100.0 * tolerance:.3g} %"
        lines.append(axes.axhline(100.0 * tolerance, label=name, linewidth=1.2, **TOLERANCE_LINE))
    lines.append(Line2D([], [], label="mode designed for", **MODE_MARKER))
    legend_beside(axes, lines)
    axes.set_ylabel(title)
    axes.set_ylim(bottom=0.0)
    if abscissa.unit == "m":
        _add_feet(axes)


def _dampings(shaper: PlottedShaper) -> list[float]:
    """Damping ratios of which a curve shows the worst: those of the range that is promised."""
    lowest, highest = shaper.guarantee.damping_ratios
    return [lowest] if lowest == highest else np.linspace(lowest, highest, _DAMPING_CURVES).tolist()


def show_near_tolerance(axes: Axes, shapers: Sequence[PlottedShaper]) -> None:
    """Cut the curves off above `CLOSEUP_TOLERANCES` tolerances, so that what is promised can be read."""
    most = 100.0 * CLOSEUP_TOLERANCES * max(shaper.guarantee.tolerance for shaper in shapers)
    axes.set_ylim(top=min(axes.get_ylim()[1], most))


def _add_feet(axes: Axes) -> None:
    """Add a second axis above, in feet."""
    feet = axes.secondary_xaxis("top", functions=(_feet, _metres))
    feet.xaxis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 5, 10]))
    feet.set_xlabel("Rope length (ft)")


def _feet(length_m: ArrayLike) -> FloatArray:
    return np.asarray(length_m, dtype=np.float64) / METRES_PER_FOOT


def _metres(length_ft: ArrayLike) -> FloatArray:
    return np.asarray(length_ft, dtype=np.float64) * METRES_PER_FOOT
