"""Visioli and Piazzi (2008): equations 1 to 20, examples 1 and 2, figures 2 to 12, and the paper's page."""

from __future__ import annotations

import importlib.util
import json
import re
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from swayless.design.inversion import (
    PAPER_GAIN,
    PAPER_WEIGHTS,
    MeasuredMove,
    cost,
    gradient,
    motion_response,
    paper_step,
    scaled_step,
)
from swayless.machine.inversion_file import load_inversion
from swayless.plant.elastic_drive import TUNED

PAGE = Path(__file__).parents[2] / "docs" / "papers" / "visioli-piazzi.md"
EXAMPLE = Path(__file__).parents[2] / "examples" / "inverted-servo.toml"


def loaded(path: Path) -> ModuleType:
    """The script that makes the page's tables and figures."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    sys.modules[path.stem] = module  # where dataclasses look their annotations up
    specification.loader.exec_module(module)
    return module


paper = loaded(PAGE.parent / "visioli_piazzi.py")


def test_eq_20_is_the_polynomial_of_order_7():
    assert paper.MOTION.coefficients == tuple(Fraction(each) for each in (0, 0, 0, 0, 35, -84, 70, -20))


def positions(estimate, first_s, step_s, count):
    """What the true load does under the closed form itself, at any times: H H_estimate^-1 of the motion."""
    own, inverse = paper.drive(paper.TRUE).transfer_function, estimate.transfer_function
    top = np.convolve(own.numerator, inverse.denominator)
    bottom = np.convolve(own.denominator, inverse.numerator)
    return MeasuredMove(
        first_s, step_s, motion_response(top, bottom, paper.MOTION).on_grid(first_s, step_s, count)
    )


@pytest.mark.parametrize("example", [1, 2])
def test_eqs_10_and_14_to_19_are_the_gradient_of_the_cost_over_experiments(example):
    """Central differences of eq 8 over commands that are inverses of estimates on both sides."""
    estimate = paper.drive(paper.FIRST[example])
    found = gradient(estimate, paper.MOTION, [positions(estimate, 0.0, 0.001, 4001)])
    for name, slope in zip(TUNED, found, strict=True):
        value = getattr(estimate, name)
        up, down = (
            cost(paper.MOTION, [positions(replace(estimate, **{name: value * by}), 0.0, 0.001, 4001)])
            for by in (1.0001, 0.9999)
        )
        # Straight lines between samples miss the slope by J_m by 0.04 % at 1 ms, by the square of the step.
        assert slope == pytest.approx((up - down) / (0.0002 * value), rel=1e-3)


def test_mass_damping_and_stiffness_show_only_as_ratios():
    here = paper.run(1, "printed", iterations=1)[0]
    by = gradient(here.estimate, paper.MOTION, [here.measured]) * here.estimate.tuned
    # Three terms that cancel, each from some hundred samples: to rounding.
    assert abs(by[2:].sum()) < 1e-9 * np.abs(by[2:]).max()


def test_eq_9_moves_the_inertia_to_0_before_the_stiffness_moves():
    for example, ratio in ((1, 70.0), (2, 101.0)):
        here = paper.run(example, "printed", iterations=1)[0]
        slopes = gradient(here.estimate, paper.MOTION, [here.measured])
        speeds = np.abs(PAPER_WEIGHTS * slopes / here.estimate.tuned)
        assert speeds[0] / speeds[4] == pytest.approx(ratio, rel=0.01)
        stepped = paper_step(here.estimate, paper.MOTION, [here.measured]).drive
        expected = here.estimate.tuned - PAPER_GAIN * np.array(PAPER_WEIGHTS) * slopes
        assert stepped.tuned == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("example", [1, 2])
def test_figs_7_and_12_printed_steps_fall_by_a_percent_and_a_scaled_one_a_hundred_thousand_times(example):
    printed, scaled = (paper.run(example, step) for step in paper.STEPS)
    costs = [each.cost for each in printed]
    assert sorted(costs, reverse=True) == costs
    assert 0.99 * costs[0] < costs[-1] < costs[0]
    assert scaled[1].cost < 1e-5 * scaled[0].cost
    actual = paper.drive(paper.TRUE)
    for each in scaled[1:]:
        # Judged on what a motion shows; the hold of 10 ms leaves 1e-5 of it.
        assert each.estimate.damping / each.estimate.load_mass == pytest.approx(0.22, rel=1e-4)
        assert each.estimate.stiffness / each.estimate.load_mass == pytest.approx(3.05, rel=1e-4)
        assert each.estimate.motor_friction == pytest.approx(actual.motor_friction, rel=1e-3)


@pytest.mark.parametrize("gains", paper.OTHER_GAINS)
def test_figs_7_and_12_other_gains_of_the_loop_change_nothing_of_that(gains):
    for example in paper.FIRST:
        printed, scaled = paper.run(example, "printed", gains), paper.run(example, "scaled", gains, 2)
        assert 0.99 * printed[0].cost < printed[-1].cost < printed[0].cost
        assert scaled[1].cost < 1e-5 * scaled[0].cost


def test_noise_moves_no_parameter_that_the_motion_hardly_shows():
    here = paper.run(1, "printed", iterations=1)[0]
    noise = 1e-3 * np.random.default_rng(7).standard_normal((2, here.measured.position.size))
    moves = [MeasuredMove(0.0, paper.TICK_S, here.measured.position + each) for each in noise]
    found = scaled_step(here.estimate, paper.MOTION, moves)
    # Noise of 0.1 % of the travel: the ratios to some tenths of a percent, the inertia within a factor of 2.
    assert found.drive.damping / found.drive.load_mass == pytest.approx(0.22, rel=0.01)
    assert found.drive.stiffness / found.drive.load_mass == pytest.approx(3.05, rel=0.002)
    assert 0.5 < found.drive.motor_inertia / 0.00011 < 2.0
    # What stays is the noise: half of its variance, from 800 samples.
    assert found.expected_cost == pytest.approx(0.5e-6, rel=0.15)
    assert found.expected_cost < 1e-3 * cost(paper.MOTION, moves)


def test_a_record_between_ticks_from_later_on_is_explained_as_well():
    estimate, actual = paper.drive(paper.FIRST[1]), paper.drive(paper.TRUE)
    found = scaled_step(estimate, paper.MOTION, [positions(estimate, 0.0137, 0.0171, 220)]).drive
    # The record is exact, so that all four are found: to the square root of what the search stops at.
    assert found.tuned[:2] == pytest.approx(actual.tuned[:2], rel=1e-6)
    assert found.tuned[3:] / found.tuned[2] == pytest.approx(actual.tuned[3:], rel=1e-6)


def test_the_example_is_the_true_drive():
    request = load_inversion(EXAMPLE)
    assert request.drive == paper.drive(paper.TRUE)
    assert request.motion == paper.MOTION


def test_every_table_of_the_page_is_what_the_script_prints():
    page = PAGE.read_text(encoding="utf-8")
    for name, table in paper.tables().items():
        assert table in page, f"{name}:\n{table}"


def test_every_figure_of_the_page_was_drawn_from_the_costs_of_today():
    page = PAGE.read_text(encoding="utf-8")
    figures = paper.figures()
    assert {path.stem for path in paper.FOLDER.glob("*")} == set(figures)
    for name, (figure, costs) in figures.items():
        assert f"(visioli_piazzi/{name}.svg)" in page
        assert figure.axes
        svg = (paper.FOLDER / f"{name}.svg").read_text(encoding="utf-8")
        drawn = json.loads(re.findall(r"<!-- (\[.*\]) -->", svg)[-1])
        assert drawn == pytest.approx(costs, abs=1e-6)  # stored to six decimals
        assert "<path" in svg
