"""The identification figure: a measured swing, the fit through it, and what is left.

Not for: fitting; what is drawn comes in as arrays.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.plant.identification import IdentifiedSwing, fitted_values
from swayless.report.sampling import point_count
from swayless.report.style import GREY, INK, figure_style, legend_above, line_style, new_figure, settle

MOST_SAMPLES = 20_000
"""Samples beyond so many are not drawn: every so many-th one is."""


def identification_figure(
    title: str, found: IdentifiedSwing, *, unit: str = "", unit_size: float = 1.0
) -> Figure:
    """Draw a record with its fit and envelope, and the residual below.

    Parameters
    ----------
    title : str
        Name of the record.
    found : IdentifiedSwing
        What was identified.
    unit : str
        For the axes; empty where it is not known.
    unit_size : float
        Size of the unit in that of the record.

    Returns
    -------
    Figure
        For `save_figure`.

    Raises
    ------
    DesignError
        If the record holds more swings than a figure can show.

    Examples
    --------
    >>> from swayless.plant.identification import SwingRecord, identify_swing
    >>> time_s = np.linspace(0.0, 20.0, 401)
    >>> found = identify_swing(SwingRecord(time_s, np.exp(-0.02 * time_s) * np.cos(2.0 * time_s)))
    >>> [axes.get_ylabel() for axes in identification_figure("swing.csv", found).axes]
    ['Swing', 'Left over']
    """
    with figure_style():
        figure, (swing, rest) = new_figure(title, (3.0, 1.5), sharex=True)
        _draw_swing(swing, found, unit_size)
        _draw_rest(rest, found, unit_size)
        of_unit = f" ({unit})" if unit else ""
        swing.set_ylabel(f"Swing{of_unit}")
        rest.set_ylabel(f"Left over{of_unit}")
        rest.set_xlabel("Time (s)")
        rest.set_xlim(found.record.time_s[0], found.record.time_s[-1])
        legend_above(swing)
        legend_above(rest)
        return settle(figure)


def _draw_swing(axes: Axes, found: IdentifiedSwing, unit_size: float) -> None:
    """Draw the samples, the fit at enough points to look smooth, and the envelope of a single mode."""
    record = found.record
    shown = slice(None, None, -(-record.time_s.size // MOST_SAMPLES))
    axes.plot(
        record.time_s[shown],
        record.value[shown] / unit_size,
        label="measured",
        linestyle="none",
        marker=".",
        markersize=2.5,
        color=GREY,
    )
    count = point_count(found.swings, f"a record of {record.duration_s:g} s")
    time_s = np.linspace(record.time_s[0], record.time_s[-1], count)
    fastest = found.modes[0]
    label = f"fit: {fastest.frequency_hz:.5g} Hz, damping ratio {fastest.damping_ratio or 0.0:.3g}"
    axes.plot(time_s, fitted_values(found, time_s) / unit_size, label=label, linewidth=1.0, **line_style(0))
    if len(found.modes) == 1:
        envelope, middle = found.fit.envelope(time_s - time_s[0]), found.middle(time_s)
        for side in (-1.0, 1.0):
            label = "envelope" if side > 0.0 else "_"
            axes.plot(
                time_s, (middle + side * envelope) / unit_size, label=label, linewidth=0.8, **line_style(4)
            )


def _draw_rest(axes: Axes, found: IdentifiedSwing, unit_size: float) -> None:
    """Draw what the fit leaves, with the noise that is stated."""
    record = found.record
    shown = slice(None, None, -(-record.time_s.size // MOST_SAMPLES))
    residual = found.fit.residual / unit_size
    axes.plot(record.time_s[shown], residual[shown], linewidth=0.6, color=INK, label="measured less fit")
    noise = found.noise.rms / unit_size
    axes.axhspan(
        -2.0 * noise,
        2.0 * noise,
        color=line_style(4)["color"],
        alpha=0.25,
        linewidth=0.0,
        label="noise, two standard deviations",
    )
