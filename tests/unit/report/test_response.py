"""The response figure shows the exact swing, and what is left of it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.lines import Line2D

from swayless.design.residual import residual_vibration
from swayless.errors import DesignError
from swayless.plant import Mode
from swayless.report import PlottedCommand, PlottedShaper, response_figure


def _lines(shaper: PlottedShaper, command: PlottedCommand, mode: Mode | None = None) -> list[Line2D]:
    speeds, swings = response_figure(shaper, command=command, mode=mode).axes
    return [*speeds.lines, *swings.lines]


@pytest.mark.parametrize("frequency_hz", [0.15, 0.2, 0.31])
@pytest.mark.parametrize("speed_m_s", [0.2, 1.0])
def test_the_residual_of_a_step_is_the_residual_vibration(
    zv: PlottedShaper, frequency_hz: float, speed_m_s: float
) -> None:
    *_, unshaped, shaped = _lines(zv, PlottedCommand(speed_m_s), Mode(frequency_hz, 0.1))
    percent = 100.0 * float(residual_vibration(zv.impulses, frequency_hz, damping_ratio=0.1))
    assert unshaped.get_label() == "without shaper: residual 100.00 %"
    assert shaped.get_label() == f"with shaper: residual {percent:.2f} %"


def test_the_drawn_swing_after_the_last_impulse_stays_at_the_residual(ei: PlottedShaper) -> None:
    *_, shaped = _lines(ei, PlottedCommand())
    time_s, percent = np.asarray(shaped.get_xdata()), np.asarray(shaped.get_ydata())
    # Of a sine with at least 64 points a period the crest is missed by at most 1 - cos(pi / 64) = 0.12 %.
    assert abs(percent[time_s >= ei.duration_s]).max() == pytest.approx(5.0, rel=2e-3)


def test_the_unshaped_swing_of_a_jump_is_a_damped_sine(zv: PlottedShaper) -> None:
    unshaped = _lines(zv, PlottedCommand(0.5))[2]
    time_s = np.asarray(unshaped.get_xdata())
    omega = 2.0 * math.pi * 0.2
    expected = 100.0 * np.exp(-0.1 * omega * time_s) * np.sin(omega * math.sqrt(0.99) * time_s)
    # A few roundings of 100, and of phases up to 30 rad.
    np.testing.assert_allclose(unshaped.get_ydata(), np.where(time_s >= 0.0, expected, 0.0), atol=1e-11)


def test_command_and_reference_are_drawn_corner_by_corner(ei: PlottedShaper) -> None:
    command, reference, *_ = _lines(ei, PlottedCommand(0.5))
    assert np.asarray(command.get_ydata()).tolist() == [0.0, 0.0, 0.5, 0.5]
    assert np.asarray(reference.get_xdata())[1:-1].tolist() == [0.0, 0.0, 2.0, 2.0, 4.0, 4.0]
    expected = 0.5 * np.array([0.0, 0.0, 0.2625, 0.2625, 0.7375, 0.7375, 1.0, 1.0])
    np.testing.assert_allclose(reference.get_ydata(), expected, atol=1e-15)  # sums of three amplitudes


def test_a_release_that_waits_for_rest_is_said(um_zv: PlottedShaper) -> None:
    assert _lines(um_zv, PlottedCommand(hold_s=0.5))[0].get_label() == "command, release waits for rest"
    assert _lines(um_zv, PlottedCommand(hold_s=5.0))[0].get_label() == "command"


def test_the_mode_of_the_design_swings_unless_another_is_given(ei: PlottedShaper) -> None:
    assert response_figure(ei).axes[0].get_title(loc="right") == "0.25 Hz, damping ratio 0"
    other = response_figure(ei, mode=Mode(0.3, 0.02)).axes[0]
    assert other.get_title(loc="right") == "0.3 Hz, damping ratio 0.02"


def test_a_move_of_too_many_oscillations_is_refused(ei: PlottedShaper) -> None:
    with pytest.raises(DesignError, match="oscillations: a figure shows at most 3125"):
        response_figure(ei, command=PlottedCommand(hold_s=1e5))
