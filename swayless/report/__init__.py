"""Figures of designs, for datasheets and reports. Not for: design, simulation or reading files."""

from swayless.report.bank import bank_figure
from swayless.report.plotted import PlottedCommand, PlottedShaper
from swayless.report.response import response_figure
from swayless.report.save import FigureFormat, figure_bytes, save_figure
from swayless.report.sensitivity import sensitivity_figure
from swayless.report.tradeoff import tradeoff_figure

__all__ = [
    "FigureFormat",
    "PlottedCommand",
    "PlottedShaper",
    "bank_figure",
    "figure_bytes",
    "response_figure",
    "save_figure",
    "sensitivity_figure",
    "tradeoff_figure",
]
