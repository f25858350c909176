from __future__ import annotations

import numpy as np
import pytest

from swayless.report.save import figure_bytes
from swayless.report.simulation import SimulatedRun, simulation_figure
from swayless.report.style import GREY

TIME_S = np.linspace(0.0, 20.0, 201)
COMMAND_M_S = np.where(TIME_S < 10.0, 0.5, 0.0)
RUNS = [
    SimulatedRun("unshaped", COMMAND_M_S, 0.3 * np.sin(TIME_S), 0.3, shaped=False),
    SimulatedRun("1 zvd", 0.9 * COMMAND_M_S, 0.01 * np.sin(TIME_S), 0.01),
]


def drawn(**options):
    return simulation_figure("Crane: 5 m", TIME_S, COMMAND_M_S, RUNS, **options)


def test_the_figure_draws_what_was_asked_for_and_told_and_the_sway_in_mm():
    speeds, sways = drawn().axes
    assert [np.array_equal(line.get_ydata(), COMMAND_M_S) for line in speeds.lines[:2]] == [True, True]
    np.testing.assert_array_equal(speeds.lines[2].get_ydata(), 0.9 * COMMAND_M_S)
    # 1e-12: the same product in another order.
    np.testing.assert_allclose(sways.lines[1].get_ydata(), 10.0 * np.sin(TIME_S), atol=1e-12)


def test_what_moves_unshaped_is_grey_and_rows_are_not():
    sways = drawn().axes[1]
    assert [line.get_color() == GREY for line in sways.lines] == [True, False]


def test_one_legend_names_what_is_left_and_the_tolerance():
    legend = drawn(tolerance=("5 % of an unshaped step", 0.0151)).axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [
        "command",
        "unshaped: 300.0 mm left",
        "1 zvd: 10.0 mm left",
        "5 % of an unshaped step",
    ]


def test_the_tolerance_is_drawn_on_both_sides_in_mm():
    sways = drawn(tolerance=("5 %", 0.0151)).axes[1]
    ends = [float(line.get_ydata()[0]) for line in sways.lines[-2:]]
    assert sorted(ends) == pytest.approx([-15.1, 15.1], rel=1e-12)


def test_a_rope_that_is_hoisted_gets_a_panel():
    rope_m = np.interp(TIME_S, [1.0, 11.0], [8.0, 5.0])
    assert len(drawn().axes) == 2
    panel = drawn(places=("Rope (m)", rope_m)).axes[2]
    np.testing.assert_array_equal(panel.lines[0].get_ydata(), rope_m)


def test_a_figure_is_the_same_bytes_each_time():
    assert figure_bytes(drawn(), "svg") == figure_bytes(drawn(), "svg")
