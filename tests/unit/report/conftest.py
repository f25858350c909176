"""Designs to draw, built from closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.design.robustness import guarantee_of
from swayless.design.shaper import Guarantee, Shaper
from swayless.plant import Band, Mode
from swayless.report import PlottedShaper


def plotted(
    label: str, times_s: list[float], amplitudes: list[float], mode: Mode, tick_s: float | None = None
) -> PlottedShaper:
    """Make a design and prove what it holds at 5 %."""
    unproven = Guarantee(0.05, mode, Band(mode.frequency_hz, mode.frequency_hz), 0.05)
    shaper = Shaper(np.array(times_s), np.array(amplitudes), label, unproven, "closed form")
    return PlottedShaper(label, shaper, guarantee_of(shaper, mode, tolerance=0.05), tick_s)


@pytest.fixture
def zv() -> PlottedShaper:
    """0.2 Hz, damping 0.1: K = exp(-pi z / sqrt(1 - z^2))."""
    mode = Mode(0.2, 0.1)
    decay = np.exp(-np.pi * 0.1 / np.sqrt(0.99))
    amplitudes = [1.0 / (1.0 + decay), decay / (1.0 + decay)]
    return plotted("ZV", [0.0, mode.damped_period_s / 2.0], amplitudes, mode)


@pytest.fixture
def ei() -> PlottedShaper:
    """0.25 Hz, undamped, 5 %."""
    return plotted("EI", [0.0, 2.0, 4.0], [0.2625, 0.475, 0.2625], Mode(0.25))


@pytest.fixture
def um_zv() -> PlottedShaper:
    """0.25 Hz, undamped: unity magnitude at 0, T/6 and T/3."""
    return plotted("UM-ZV", [0.0, 4.0 / 6.0, 4.0 / 3.0], [1.0, -1.0, 1.0], Mode(0.25))
