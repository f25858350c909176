"""Commands computed ahead: against closed forms, independent linear programs, and exact simulation."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.optimize import linprog
from scipy.signal import tf2ss

from swayless.design.optimal import (
    LinearPlant,
    MoveTask,
    Robustness,
    least_energy,
    output_at_ticks,
    residual_amplitude,
    time_optimal,
    track,
    transform_derivatives,
)
from swayless.design.optimal.program import Program, Wanted, least_utilisation

MASS = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
OSCILLATOR = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
TWO_MASSES = LinearPlant.from_transfer_function([1.0], [0.01, 0.002, 1.0, 0.0, 0.0])
NO_MINIMUM_PHASE = LinearPlant.from_transfer_function([-1.0, 1.0], [1.0, 1.0, 1.0])
STATE = 1e-9  # what is promised of states at the end, relative to the largest


def stepped(plant, tick_s):
    """Matrices from tick to tick, by the matrix exponential of the textbook and not by the package."""
    block = np.block([[plant.a, plant.b[:, None]], [np.zeros((1, plant.order + 1))]])
    exact = expm(block * tick_s)
    return exact[:-1, :-1], exact[:-1, -1]


def states(plant, command):
    """Every state at ticks 0 .. n, step by step."""
    a, b = stepped(plant, command.tick_s)
    found = [plant.equilibrium(1.0)[0] * 0.0]
    for value in command.values - command.initial_value:
        found.append(a @ found[-1] + b * value)
    return np.array(found)


def independent_ticks(task, most):
    """The fewest ticks by a linear program of its own: all states as variables, tried one length by one."""
    a, b = stepped(task.plant, task.tick_s)
    state = task.plant.equilibrium(task.target)[0] - task.plant.equilibrium(task.start)[0]
    low, high = task.limits
    for ticks in range(1, most + 1):
        columns = [b]
        for _ in range(ticks - 1):
            columns.append(a @ columns[-1])
        rows = np.array(columns[::-1]).T
        limits, right = np.empty((0, ticks)), np.empty(0)
        if task.rate_limit_per_s is not None:
            step = task.rate_limit_per_s * task.tick_s
            steps = np.eye(ticks + 1, ticks) - np.eye(ticks + 1, ticks, k=-1)
            ends = np.zeros(ticks + 1)
            ends[-1] = task.held_input - task.initial_input
            limits = np.vstack([steps, -steps])
            right = np.concatenate([step - ends, step + ends])
        solved = linprog(
            np.zeros(ticks),
            A_ub=limits,
            b_ub=right,
            A_eq=rows,
            b_eq=state,
            bounds=(low - task.initial_input, high - task.initial_input),
            method="highs-ipm",
        )
        if solved.status == 0:
            return ticks
    raise AssertionError(f"not within {most} ticks")


@pytest.mark.parametrize(("distance", "force"), [(1.0, 1.0), (0.37, 2.5), (4.1, 0.3)])
def test_a_mass_takes_the_bang_bang_time_of_its_closed_form_to_a_tick(distance, force):
    tick_s = 0.02
    best_s = 2.0 * math.sqrt(distance / force)
    found = time_optimal(MoveTask(MASS, tick_s, (-force, force), distance))
    assert 0 <= found.ticks - math.ceil(best_s / tick_s - 1e-9) <= 1


@pytest.mark.parametrize("force", [1.5, 2.0, 5.0, 20.0])
def test_an_oscillator_takes_the_bang_bang_time_of_its_closed_form_to_a_tick(force):
    """From rest at 0 to rest at 1 with +F, -F: arcs about F and -F in the phase plane, angles by cosines.

    The first arc has radius F, the second, which ends at 1, radius F + 1; they meet where both are.
    """
    w, tick_s = 10.0, 0.002
    meeting = ((force + 1.0) ** 2 - force**2) / (4.0 * force)
    first = math.acos((force - meeting) / force)
    second = math.acos((meeting + force) / (force + 1.0))
    found = time_optimal(MoveTask(OSCILLATOR, tick_s, (-force, force), 1.0))
    assert 0 <= found.ticks - math.ceil((first + second) / (w * tick_s) - 1e-9) <= 1


TASKS = {
    "mass": MoveTask(MASS, 0.1, (-1.0, 1.0), 1.0),
    "mass with a rate limit": MoveTask(MASS, 0.1, (-1.0, 1.0), 1.0, rate_limit_per_s=3.0),
    "uneven limits": MoveTask(MASS, 0.1, (-2.0, 0.5), 1.0),
    "oscillator": MoveTask(OSCILLATOR, 0.01, (-1.3, 1.7), 1.0, start=0.2),
    "oscillator with a rate limit": MoveTask(OSCILLATOR, 0.02, (-2.0, 2.0), -1.0, rate_limit_per_s=10.0),
    "two masses": MoveTask(TWO_MASSES, 0.05, (-3.0, 3.0), 1.0, start=-0.5),
    "no minimum phase": MoveTask(NO_MINIMUM_PHASE, 0.1, (-2.0, 2.0), 1.0),
}


@pytest.mark.parametrize("name", TASKS)
def test_the_ticks_are_those_of_an_independent_linear_program_and_one_less_is_proved_too_few(name):
    task = TASKS[name]
    found = time_optimal(task)
    assert found.ticks == independent_ticks(task, found.ticks)
    assert found.fewer_utilisation_ratio > 1.0
    # The dual proves the optimum: both agree to what HiGHS solves to.
    assert found.proved_utilisation_ratio == pytest.approx(found.utilisation_ratio, rel=1e-7)
    assert found.proved_utilisation_ratio <= found.utilisation_ratio * (1.0 + 1e-12)


@pytest.mark.parametrize("name", TASKS)
def test_the_plant_rests_at_the_target_and_no_limit_is_exceeded(name):
    task = TASKS[name]
    command = time_optimal(task).command
    at_start, at_end = (task.plant.equilibrium(y)[0] for y in (task.start, task.target))
    missed = states(task.plant, command)[-1] - (at_end - at_start)
    assert np.abs(missed).max() <= STATE * np.abs(at_end - at_start).max()
    assert command.values.min() >= task.limits[0]
    assert command.values.max() <= task.limits[1]
    assert command.final_value == pytest.approx(task.plant.equilibrium(task.target)[1], abs=1e-15)
    if task.rate_limit_per_s is not None:
        largest = np.abs(command.increments.amplitudes).max()
        assert largest <= task.rate_limit_per_s * task.tick_s * (1.0 + 1e-12)


def test_the_output_stays_at_the_target_once_the_command_has_ended():
    command = time_optimal(TASKS["two masses"]).command
    output = output_at_ticks(TWO_MASSES, command, ticks=3 * command.values.size, start=-0.5)
    # 1e-8: what the promised 1e-9 of a velocity of some 10 per s drifts in the time looked at.
    assert output[command.values.size :] == pytest.approx(1.0, abs=1e-8)


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_the_transform_and_its_derivatives_vanish_at_the_poles_to_1e_9(order):
    found = time_optimal(MoveTask(OSCILLATOR, 0.005, (-5.0, 5.0), 1.0, robustness=Robustness(order)))
    increments = found.command.increments
    with mpmath.workdps(40):
        for derivative in range(order + 1):
            terms = [
                mpmath.mpf(d)
                * mpmath.power(-10 * mpmath.mpf(t), derivative)
                * mpmath.expj(-10 * mpmath.mpf(t))
                for d, t in zip(increments.amplitudes.tolist(), increments.times_s.tolist(), strict=True)
            ]
            # Of the increments' own sum, in units in which each later derivative is weighted the same.
            weight = sum(abs(term) for term in terms)
            assert abs(mpmath.fsum(terms)) <= 1e-9 * weight
    ours = abs(transform_derivatives(found.command, 10j, order + 1))
    assert ours[: order + 1].max() < 1e-9 * ours[order + 1]
    assert ours[order + 1] > 0.1


def test_a_mode_that_dies_out_in_a_tick_is_brought_to_rest_by_last_inputs_that_are_saturated():
    bottom = [4.002035059235815e-06, 0.0001202891677754509, 0.0043532280029896205, 0.02217294331465508]
    plant = LinearPlant.from_transfer_function(
        [2.479], [*bottom, 0.6675590581003976, 0.03327012010513358, 1.0]
    )
    half = 6.694336425978216
    found = time_optimal(
        MoveTask(plant, 0.2689, (-half, half), 2.651, rate_limit_per_s=8.1723, robustness=Robustness(2))
    )
    # As a program of 60 digits finds it.
    assert found.ticks == 25
    assert found.fewer_utilisation_ratio > 1.3


def test_a_damped_mode_beside_a_rigid_body_is_robust_too():
    task = MoveTask(TWO_MASSES, 0.02, (-4.0, 4.0), 1.0, robustness=Robustness(1))
    found = time_optimal(task)
    (pole,) = TWO_MASSES.ringing_poles_rad_s
    derivatives = abs(transform_derivatives(found.command, pole, 2))
    assert derivatives[:2].max() < 1e-9 * derivatives[2]
    assert states(TWO_MASSES, found.command)[-1] == pytest.approx(TWO_MASSES.equilibrium(1.0)[0], abs=1e-8)


def test_split_poles_leave_nothing_on_either_side_and_little_between():
    split = 0.1
    task = MoveTask(OSCILLATOR, 0.005, (-5.0, 5.0), 1.0, robustness=Robustness(split_ratio=split))
    left = residual_amplitude(time_optimal(task).command, np.array([0.9, 1.0, 1.1]) * 10.0 / (2.0 * np.pi))
    assert left[[0, 2]] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert 0.001 < left[1] < 0.1


DAMPED = LinearPlant.from_transfer_function([2.0], [0.04, 0.01, 1.0])
ROBUST = {
    "first order, with a rate limit": (OSCILLATOR, Robustness(1), 40.0),
    "second order, damped": (DAMPED, Robustness(2), None),
    "split, damped, with a rate limit": (DAMPED, Robustness(split_ratio=0.12), 30.0),
}


def transform_feasible(task, ticks):
    """Whether a program without any chain has a solution: U and its derivatives vanish at the poles.

    Nothing but the transform of the command is in it, so that these plants have no poles besides.
    """
    change = task.held_input - task.initial_input
    since = task.tick_s * np.arange(-ticks, 1.0)
    (pole,) = task.plant.ringing_poles_rad_s
    split, rows, right = task.robustness.split_ratio, [], []
    for factor in [1.0] if split is None else [1.0 - split, 1.0 + split]:
        for derivative in range(task.robustness.order + 1):
            weights = (abs(pole) * since) ** derivative * np.exp(-pole * factor * since)
            # The increments of u, the last one to what stays.
            for part in (np.real, np.imag):
                rows.append(part(weights[:-1] - weights[1:]))
                right.append(-change * part(weights[-1]))
    low, high = (limit - task.initial_input for limit in task.limits)
    steps = np.eye(ticks + 1, ticks) - np.eye(ticks + 1, ticks, k=-1)
    ends = change * np.eye(ticks + 1)[-1]
    step = np.inf if task.rate_limit_per_s is None else task.rate_limit_per_s * task.tick_s
    solved = linprog(
        np.zeros(ticks),
        A_ub=np.vstack([steps, -steps]) if step < np.inf else None,
        b_ub=np.concatenate([step - ends, step + ends]) if step < np.inf else None,
        A_eq=np.array(rows),
        b_eq=right,
        bounds=(low, high),
    )
    return solved.status == 0


@pytest.mark.parametrize("name", ROBUST)
def test_robust_moves_take_the_ticks_of_a_program_in_which_only_the_transform_vanishes(name):
    plant, robustness, rate = ROBUST[name]
    task = MoveTask(plant, 0.02, (-2.5, 3.0), -1.2, start=0.4, robustness=robustness, rate_limit_per_s=rate)
    ticks = time_optimal(task).ticks
    assert transform_feasible(task, ticks)
    assert not transform_feasible(task, ticks - 1)


def test_least_energy_is_that_of_an_independent_solution_where_no_limit_is_met():
    task = MoveTask(OSCILLATOR, 0.005, (-5.0, 5.0), 1.0)
    a, b = stepped(OSCILLATOR, 0.005)
    rows = np.array([np.linalg.matrix_power(a, 59 - k) @ b for k in range(60)]).T
    least = np.linalg.pinv(rows) @ OSCILLATOR.equilibrium(1.0)[0]
    # The barrier method stops within 1e-11 of the energy: 3e-6 of the values.
    assert least_energy(task, 60).command.values == pytest.approx(least, abs=1e-5)


def test_more_time_takes_less_energy_and_every_command_rests_within_its_limits():
    task = MoveTask(OSCILLATOR, 0.005, (-5.0, 5.0), 1.0, robustness=Robustness(1), rate_limit_per_s=2000.0)
    shortest = time_optimal(task)
    commands = [least_energy(task, round(shortest.ticks * factor)) for factor in (1.0, 1.1, 1.3, 1.7)]
    energies = [float(found.command.values @ found.command.values) for found in commands]
    assert energies == sorted(energies, reverse=True)
    assert energies[0] <= float(shortest.command.values @ shortest.command.values)
    for found in commands:
        assert found.utilisation_ratio <= 1.0
        assert abs(transform_derivatives(found.command, 10j, 1)).max() < 1e-9 * 10.0


@settings(derandomize=True, deadline=None, max_examples=30)
@given(st.integers(0, 2**32 - 1), st.booleans(), st.booleans())
def test_no_prices_prove_more_than_the_optimum_whatever_limits_there_are(seed, with_rate, with_trajectory):
    rng = np.random.default_rng(seed)
    rate = 400.0 if with_rate else None
    task = MoveTask(OSCILLATOR, 0.02, (-3.0, 5.0), 1.0, start=-0.3, rate_limit_per_s=rate)
    wanted = Wanted(np.linspace(0.05, 1.3, 25), 0.2) if with_trajectory else None
    program = Program(task, 25, wanted)
    least = least_utilisation(program)
    ends, limits = len(program.orthonormal[0]), program.limited[2].size
    for _ in range(5):
        proved = program.proved_utilisation(
            rng.normal(size=ends), rng.normal(size=limits) * rng.integers(0, 2)
        )
        assert proved <= least.utilisation_ratio * (1.0 + 1e-9)
    assert least.proved_ratio == pytest.approx(least.utilisation_ratio, rel=1e-7)


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_units_of_input_output_and_states_change_no_command(unit):
    """A rigid body with a mode of 500 rad/s, in the textbook's canonical form: its states differ by 1e8."""
    w = 500.0
    transfer = [1.0], [1.0 / w**2, 0.02 / w, 1.0, 0.0, 0.0]
    a, b, c, _ = tf2ss(*transfer)
    plant, other = LinearPlant.from_transfer_function(*transfer), LinearPlant(a, b[:, 0] / unit, c[0])
    options = {"tick_s": 0.2 / w, "target": 1.0, "robustness": Robustness(1)}
    expected = time_optimal(MoveTask(plant, limits=(-2e4, 2e4), **options))
    found = time_optimal(MoveTask(other, limits=(-2e4 * unit, 2e4 * unit), **options))
    assert found.ticks == expected.ticks
    assert found.command.values / unit == pytest.approx(expected.command.values, abs=1e-4)
    # Far below what is promised: states that are measured in fitting units lose nothing.
    assert max(found.final_error_ratio, expected.final_error_ratio) < 1e-12


def smooth(ticks):
    k = np.arange(1, ticks + 1) / ticks
    return 10.0 * k**3 - 15.0 * k**4 + 6.0 * k**5


def test_a_trajectory_is_followed_within_its_tolerance_and_ends_at_rest():
    task = MoveTask(OSCILLATOR, 0.01, (-5.0, 5.0), 1.0, robustness=Robustness(1))
    found = track(task, smooth(150), 0.02)
    output = output_at_ticks(OSCILLATOR, found.command, ticks=400)
    assert np.abs(output[1:151] - smooth(150)).max() <= 0.02 * (1.0 + 1e-9)
    assert output[150:] == pytest.approx(1.0, abs=1e-9)


@settings(derandomize=True, deadline=None, max_examples=25)
@given(
    st.floats(0.0, 0.6),
    st.floats(1.0, 40.0),
    st.integers(0, 2),
    st.floats(1.05, 10.0),
    st.booleans(),
)
def test_any_vibration_is_brought_to_rest_with_both_proofs(damping, speed, order, limit, rigid):
    denominator = [1.0 / speed**2, 2.0 * damping / speed, 1.0] + ([0.0] if rigid else [])
    plant = LinearPlant.from_transfer_function([1.0], denominator)
    task = MoveTask(plant, 0.25 / speed, (-limit, limit), 1.0, robustness=Robustness(order))
    found = time_optimal(task)
    missed = states(plant, found.command)[-1] - plant.equilibrium(1.0)[0]
    assert np.abs(missed).max() <= 2.0 * STATE * np.abs(plant.equilibrium(1.0)[0]).max()
    assert np.abs(found.command.values).max() <= limit
    assert found.fewer_utilisation_ratio > 1.0
