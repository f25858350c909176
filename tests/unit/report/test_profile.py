from __future__ import annotations

import numpy as np
import pytest

from swayless.design.optimal import Command, LinearPlant
from swayless.report.profile import OFF, PlottedLoop, PlottedMove, loop_figure, move_figure
from swayless.report.save import figure_bytes

OSCILLATOR = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
TWO_HALVES = Command(np.pi / 50.0, [0.5] * 5, 1.0)
"""Half of the step half a period before the whole: nothing is left at 10 rad/s."""

MOVE = PlottedMove("two halves", OSCILLATOR, TWO_HALVES, 0.0, 1.0, (-1.0, 2.0))


def test_a_move_shows_its_command_its_limits_and_its_output():
    inputs, outputs, _ = move_figure(MOVE).axes
    command, low, high = inputs.lines
    assert command.get_ydata().tolist() == [0.0] + [0.5] * 5 + [1.0] * 2
    assert [line.get_ydata()[0] for line in (low, high)] == [-1.0, 2.0]
    nominal = outputs.lines[0]
    times_s, output = nominal.get_xdata(), nominal.get_ydata()
    # A cosine about 0.5 until the second half arrives, also between the ticks; then rest at 1.
    swinging = times_s <= TWO_HALVES.duration_s
    np.testing.assert_allclose(output[swinging], 0.5 - 0.5 * np.cos(10.0 * times_s[swinging]), atol=1e-12)
    np.testing.assert_allclose(output[~swinging], 1.0, atol=1e-12)


def test_what_is_left_is_drawn_over_the_actual_frequency():
    (curve,) = move_figure(MOVE).axes[2].lines
    ratios, left = 0.01 * curve.get_xdata(), 0.01 * curve.get_ydata()
    # Two halves, half a period of r w apart: |cos(pi r / 2)|.
    np.testing.assert_allclose(left, np.abs(np.cos(0.5 * np.pi * ratios)), atol=1e-12)


def test_a_plant_that_does_not_ring_has_no_sensitivity_and_is_not_off():
    mass = LinearPlant.from_transfer_function([1.0], [1.0, 0.0, 0.0])
    figure = move_figure(PlottedMove("mass", mass, Command(0.5, [1.0, -1.0], 0.0), 2.0, 2.25))
    inputs, outputs = figure.axes
    assert len(inputs.lines) == 1
    drawn = [line.get_label() for line in outputs.lines if not line.get_label().startswith("_")]
    assert drawn == ["output"]
    assert outputs.lines[0].get_ydata()[[0, -1]] == pytest.approx([2.0, 2.25])


def test_a_loop_shows_what_is_asked_of_the_actuator_and_both_outputs():
    loops = [PlottedLoop(f"at {ratio:g}", np.full(9, ratio), np.full(9, -ratio)) for ratio in OFF]
    inputs, alone, together = loop_figure(MOVE, loops[:1], loops).axes
    assert [line.get_ydata()[0] for line in inputs.lines] == [-1.0, 2.0, -0.9, -1.1]
    assert [len(axes.lines) for axes in (alone, together)] == [3, 4]
    assert len(loop_figure(MOVE, loops, []).axes) == 2


def test_the_same_figure_has_the_same_bytes():
    first, second = (figure_bytes(move_figure(MOVE), "svg") for _ in range(2))
    assert first == second
