"""Xu and Meckl (2005): equations 4 to 37, figures 4 to 12, and the paper's page."""

from __future__ import annotations

import importlib.util
import json
import re
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import mpmath
import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import linprog

from swayless.design.optimal import output_at_ticks, residual_amplitude, transform_derivatives
from swayless.design.optimal.robustification import rest_conditions
from swayless.machine.profile_file import load_profile

PAGE = Path(__file__).parents[2] / "docs" / "papers" / "xu-meckl-2005.md"
EXAMPLE = Path(__file__).parents[2] / "examples" / "time-optimal-oscillator.toml"
POLE = 10j
U_SS = 1.0


def loaded(path: Path) -> ModuleType:
    """The script that makes the page's tables and figures."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


paper = loaded(PAGE.parent / "xu_meckl_2005.py")


def chain_states(command, links):
    """Integrate eq 22 for one pole, exactly from tick to tick: q_i' = p q_i + q_(i+1), with u at the end."""
    system = np.zeros((links + 1, links + 1), dtype=complex)
    system[:links, :links] = POLE * np.eye(links) + np.eye(links, k=1)
    system[links - 1, links] = 1.0
    step = expm(system * command.tick_s)
    q = np.zeros(links, dtype=complex)
    for value in command.values:
        q = step[:links, :links] @ q + step[:links, links] * value
    return q


def paper_states(links):
    """Eqs 21, 23, 27, 29, 30, 32: -u/p, u/p^2, -u/p^3, from the last link on."""
    return np.array([-U_SS * (-1.0 / POLE) ** (links - 1 - i) / POLE for i in range(links)])


def test_eqs_4_to_10_no_shorter_input_exists_by_a_program_of_the_whole_trajectory():
    """Eqs 4 and 9 as they stand: states and inputs of each tick as variables of one linear program."""
    plant = paper.oscillator()
    block = np.block([[plant.a, plant.b[:, None]], [np.zeros((1, 3))]])
    exact = expm(block * paper.TICK_S)
    a, b = exact[:2, :2], exact[:2, 2]

    def feasible(ticks):
        equal, right = np.zeros((2 * ticks, 3 * ticks)), np.zeros(2 * ticks)
        for k in range(ticks):
            rows, states = slice(2 * k, 2 * k + 2), slice(ticks + 2 * k, ticks + 2 * k + 2)
            equal[rows, k], equal[rows, states] = -b, np.eye(2)
            if k:
                equal[rows, ticks + 2 * k - 2 : ticks + 2 * k] = -a
        end = np.eye(3 * ticks)[-2:]
        bounds = [(-paper.LIMIT, paper.LIMIT)] * ticks + [(None, None)] * (2 * ticks)
        at_rest = plant.equilibrium(1.0)[0]
        solved = linprog(
            np.zeros(3 * ticks),
            A_eq=np.vstack([equal, end]),
            b_eq=np.append(right, at_rest),
            bounds=bounds,
        )
        return solved.status == 0

    found = paper.fastest(paper.NOMINAL)
    assert feasible(found.ticks)
    assert not feasible(found.ticks - 1)
    assert found.fewer_utilisation_ratio > 1.0


def test_eqs_16_to_18_are_the_derivatives_of_what_stays():
    p, end = mpmath.mpc(0, 10), mpmath.mpf("0.29")

    def stays(s):
        return U_SS / s * mpmath.exp(-s * end)

    decay = mpmath.exp(-p * end)
    printed = [
        U_SS / p * decay,
        -U_SS / p**2 * decay * (1 + p * end),
        U_SS / p**3 * decay * (2 + 2 * end * p + end**2 * p**2),
    ]
    for order, value in enumerate(printed):
        # Numerical differentiation at 15 digits: 1e-8 of a derivative of the second order.
        assert abs(mpmath.diff(stays, p, order) - value) < 1e-8 * abs(value)


@pytest.mark.parametrize(("links", "robustness"), [(1, "NOMINAL"), (2, "FIRST"), (3, "SECOND")])
def test_eqs_21_to_33_the_chain_ends_in_the_states_of_the_paper_and_the_transform_vanishes(links, robustness):
    found = paper.fastest(getattr(paper, robustness))
    missed = np.abs(chain_states(found.command, links) - paper_states(links))
    # 1e-9 of each state, which falls with p: one order of w0 from link to link.
    assert (missed <= 1e-9 * np.abs(paper_states(links))).all()
    derivatives = abs(transform_derivatives(found.command, POLE, links))
    assert derivatives[:links].max() <= 1e-9 * derivatives[links]
    assert derivatives[links] > 0.1


def test_eqs_24_and_30_the_final_states_are_where_the_augmented_plant_rests():
    rest = rest_conditions(paper.oscillator(), paper.TICK_S, 1.0, paper.SECOND)
    # Two states of the plant, then the links 1 and 2, real and imaginary part each, in a unit of ours.
    states = paper_states(3)[:2] * np.array([POLE.imag**3, POLE.imag**2])
    chain = rest.final[2:] / np.abs(rest.final[2:]).max()
    assert chain == pytest.approx([each for q in states for each in (q.real, q.imag)], abs=1e-12)


def test_figs_4_and_5_the_robust_move_leaves_a_fifth_where_w0_is_10_percent_off():
    for ratio in (0.9, 1.1):
        not_robust, robust = (paper.fastest(each).command for each in (paper.NOMINAL, paper.FIRST))
        assert paper.left(robust, ratio) < 0.2 * paper.left(not_robust, ratio)
        # What is left is what the simulated output swings by: the largest of 240 ticks is within 1e-3 of it.
        output = output_at_ticks(paper.oscillator(ratio), robust, ticks=300)[60:]
        assert np.abs(output - 1.0).max() == pytest.approx(paper.left(robust, ratio), rel=1e-3)


def test_figs_5_to_7_the_robust_move_takes_less_than_half_of_a_zvd_shaped_step_from_a_limit_of_4_on():
    assert paper.zvd_step().duration_s == pytest.approx(paper.PERIOD_S)
    shares = {
        limit: paper.fastest(paper.FIRST, limit).command.duration_s / paper.PERIOD_S
        for limit in (3.0, 4.0, 5.0)
    }
    assert shares[5.0] < shares[4.0] < 0.5 < shares[3.0]
    zvd = transform_derivatives(paper.zvd_step(), POLE, 1)
    assert abs(zvd).max() < 1e-12  # both have a residual and a slope of 0: the same order of robustness


def test_fig_8_more_time_takes_less_energy_and_swings_less():
    commands = [paper.relaxed(ratio).command for ratio in paper.RELAXED]
    energies = [float(command.values @ command.values) for command in commands]
    assert all(later < 0.7 * before for before, later in pairwise(energies))
    assert paper.peak(commands[0]) > 1.1
    # Nothing passes the target: to the accuracy of the end itself.
    assert max(paper.peak(command) for command in commands[1:]) == pytest.approx(1.0, abs=1e-9)
    assert paper.relaxed(1.0).ticks == paper.fastest(paper.FIRST).ticks


@pytest.mark.parametrize("robustness", ["FIRST", "EXTRA_INSENSITIVE"])
def test_figs_9_and_11_the_output_stays_within_0_02_of_the_trajectory(robustness):
    command = paper.tracked(getattr(paper, robustness)).command
    output = output_at_ticks(paper.oscillator(), command)
    assert np.abs(output[1:] - paper.trajectory()).max() <= paper.TOLERANCE * (1.0 + 1e-9)
    assert np.abs(command.values).max() <= paper.LIMIT


def test_fig_10_extra_insensitive_inputs_hold_a_wider_range_in_the_same_time():
    ratios = np.linspace(0.8, 1.2, 4001)
    held = {}
    for robustness in (paper.FIRST, paper.EXTRA_INSENSITIVE):
        curve = residual_amplitude(paper.fastest(robustness).command, ratios * 10.0 / (2.0 * np.pi))
        inside = ratios[curve <= 0.04]
        held[robustness] = inside[[0, -1]]
        assert curve[(ratios >= 0.9) & (ratios <= 1.1)].max() < 0.04
    # As the page says, to a thousandth; the grid is a tenth of that.
    assert held[paper.FIRST] == pytest.approx([0.890, 1.101], abs=6e-4)
    assert held[paper.EXTRA_INSENSITIVE] == pytest.approx([0.850, 1.141], abs=6e-4)
    assert paper.fastest(paper.FIRST).ticks == paper.fastest(paper.EXTRA_INSENSITIVE).ticks


def test_eqs_35_and_36_the_split_modes_end_at_rest():
    command = paper.fastest(paper.EXTRA_INSENSITIVE).command
    for ratio in (1.0 - paper.SPLIT, 1.0 + paper.SPLIT):
        output = output_at_ticks(paper.oscillator(ratio), command, ticks=300)
        assert output[command.values.size :] == pytest.approx(1.0, abs=1e-9)


def test_fig_12_feedback_around_the_command_removes_what_10_percent_leave():
    for ratio in (0.9, 1.1):
        alone = output_at_ticks(paper.oscillator(ratio), paper.fastest(paper.FIRST).command, ticks=300)
        together = paper.closed_loop(ratio)
        assert np.abs(together[158:] - 1.0).max() < 0.15 * np.abs(alone[158:] - 1.0).max()
        assert paper.largest_input(together) > paper.LIMIT
    # On the plant as designed the feedback has nothing to do.
    assert paper.closed_loop(1.0)[58:] == pytest.approx(1.0, abs=1e-9)


def test_the_example_is_figure_5():
    task = load_profile(EXAMPLE, {}).task
    assert (task.tick_s, task.limits, task.robustness) == (
        paper.TICK_S,
        (-paper.LIMIT, paper.LIMIT),
        paper.FIRST,
    )
    assert np.abs(task.plant.poles_rad_s) == pytest.approx([10.0, 10.0])


def test_every_table_of_the_page_is_what_the_script_prints():
    page = PAGE.read_text(encoding="utf-8")
    for name, table in paper.tables().items():
        assert table in page, f"{name}:\n{table}"


def test_every_figure_of_the_page_was_drawn_from_the_commands_of_today():
    page = PAGE.read_text(encoding="utf-8")
    figures = paper.figures()
    assert {path.stem for path in paper.FOLDER.glob("*")} == set(figures)
    for name, (figure, commands) in figures.items():
        assert f"(xu_meckl_2005/{name}.svg)" in page
        assert figure.axes
        svg = (paper.FOLDER / f"{name}.svg").read_text(encoding="utf-8")
        drawn = json.loads(re.findall(r"<!-- (\[\[.*\]\]) -->", svg)[-1])
        fresh = json.loads(paper.drawn_from(commands))
        assert len(drawn) == len(fresh)
        for stored, computed in zip(drawn, fresh, strict=True):
            assert stored == pytest.approx(computed, abs=2e-3)  # stored to three decimals
        assert "<path" in svg
