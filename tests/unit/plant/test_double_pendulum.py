"""The small-angle double pendulum, derived again from its matrices of mass and stiffness."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import PlantError
from swayless.plant import (
    STANDARD_GRAVITY_M_S2,
    double_pendulum_modes,
    double_pendulum_participation,
    pendulum_frequency_hz,
)

LENGTHS_M = st.floats(0.1, 100.0)
MASSES_KG = st.floats(1.0, 1e5)
CRANES = [
    (6.0, 3.0, 300.0, 1500.0),
    (3.0, 6.0, 300.0, 60.0),
    (20.0, 1.5, 2000.0, 2000.0),
    (5.0, 5.0, 1.0, 0.01),
]


def matrices(rope_length_m, sling_length_m, hook_mass_kg, load_mass_kg):
    """Mass and stiffness for the horizontal swings of hook and load against the trolley."""
    upper = (hook_mass_kg + load_mass_kg) * STANDARD_GRAVITY_M_S2 / rope_length_m
    lower = load_mass_kg * STANDARD_GRAVITY_M_S2 / sling_length_m
    return np.array([hook_mass_kg, load_mass_kg]), np.array([[upper + lower, -lower], [-lower, lower]])


def solved(crane):
    """Angular frequencies (rad/s), and shares of a trolley step: rows hook and load, columns modes."""
    masses, stiffness = matrices(*crane)
    root = np.sqrt(masses)
    squares, shapes = np.linalg.eigh(stiffness / np.outer(root, root))
    # In coordinates scaled by the roots of the masses, a step of the trolley pushes with those roots.
    return np.sqrt(squares), shapes * (root @ shapes) / root[:, np.newaxis]


def sways_m(crane):
    """How far the load sways in each mode after a step of 1 m/s."""
    angular = [mode.angular_frequency_rad_s for mode in double_pendulum_modes(*crane)]
    return np.abs(double_pendulum_participation(*crane).load_ratio) / angular


@settings(derandomize=True, deadline=None)
@given(crane=st.tuples(LENGTHS_M, LENGTHS_M, MASSES_KG, MASSES_KG))
def test_both_frequencies_are_the_eigenvalues_of_mass_and_stiffness(crane):
    modes = double_pendulum_modes(*crane)
    # The eigenvalue solver is right to some roundings of the larger eigenvalue, so the lower one is compared
    # through the product of both, which the determinant gives exactly.
    masses, stiffness = matrices(*crane)
    assert modes[1].angular_frequency_rad_s == pytest.approx(solved(crane)[0][1], rel=1e-14)
    product = math.prod(mode.angular_frequency_rad_s**2 for mode in modes)
    (rope, sling, hook, load) = crane
    determinant = STANDARD_GRAVITY_M_S2**2 * (hook + load) / (hook * rope * sling)
    assert product == pytest.approx(determinant, rel=1e-14)
    assert np.trace(stiffness / masses[:, np.newaxis]) == pytest.approx(
        sum(mode.angular_frequency_rad_s**2 for mode in modes), rel=1e-14
    )


@pytest.mark.parametrize("crane", CRANES)
def test_singhose_kim_and_kenison_give_the_two_frequencies_as_printed(crane):
    rope, sling, hook, load = crane
    ratio = load / hook
    total = (1.0 + ratio) * (1.0 / rope + 1.0 / sling)
    beta = math.sqrt(total**2 - 4.0 * (1.0 + ratio) / (rope * sling))
    printed = [math.sqrt(0.5 * STANDARD_GRAVITY_M_S2 * (total + sign * beta)) for sign in (-1.0, 1.0)]
    found = [mode.angular_frequency_rad_s for mode in double_pendulum_modes(*crane)]
    # The formula subtracts: for these cranes it loses up to two of sixteen digits.
    assert found == pytest.approx(printed, rel=1e-13)


@settings(derandomize=True, deadline=None)
@given(crane=st.tuples(LENGTHS_M, LENGTHS_M, MASSES_KG, MASSES_KG))
def test_the_lower_mode_is_slower_than_one_pendulum_and_the_upper_one_faster_than_either(crane):
    rope, sling = crane[:2]
    lower, upper = double_pendulum_modes(*crane)
    # Both hang below each other: at most as slow as one rope as long as both. One rounding is left.
    assert lower.frequency_hz >= pendulum_frequency_hz(rope + sling) * (1.0 - 1e-15)
    assert lower.frequency_hz < pendulum_frequency_hz(max(rope, sling))
    assert upper.frequency_hz > pendulum_frequency_hz(min(rope, sling))


@pytest.mark.parametrize(("rope_length_m", "sling_length_m"), [(6.0, 3.0), (3.0, 6.0)])
def test_without_a_load_rope_and_sling_swing_alone(rope_length_m, sling_length_m):
    modes = double_pendulum_modes(rope_length_m, sling_length_m, 1.0, 1e-12)
    alone = [pendulum_frequency_hz(length) for length in (6.0, 3.0)]
    # The frequencies move by the ratio of the masses, to first order, times about one.
    assert [mode.frequency_hz for mode in modes] == pytest.approx(alone, rel=1e-11)


def test_without_a_hook_rope_and_sling_are_one_rope_and_nothing_of_the_upper_mode_is_left():
    crane = (6.0, 3.0, 1e-12, 1.0)
    lower, upper = double_pendulum_modes(*crane)
    assert lower.frequency_hz == pytest.approx(pendulum_frequency_hz(9.0), rel=1e-12)
    assert upper.frequency_hz > 1e5
    assert double_pendulum_participation(*crane).load_ratio == pytest.approx((1.0, 0.0), abs=1e-11)
    # A massless hook stands on the straight line between trolley and load.
    assert double_pendulum_participation(*crane).hook_ratio[0] == pytest.approx(6.0 / 9.0, rel=1e-11)


def test_a_sling_without_length_is_one_pendulum():
    crane = (6.0, 1e-12, 500.0, 1500.0)
    assert double_pendulum_modes(*crane)[0].frequency_hz == pytest.approx(
        pendulum_frequency_hz(6.0), rel=1e-11
    )
    assert double_pendulum_participation(*crane).load_ratio == pytest.approx((1.0, 0.0), abs=1e-11)


@pytest.mark.parametrize("crane", CRANES)
def test_shares_of_a_trolley_step_are_those_of_the_mode_shapes(crane):
    _, shares = solved(crane)
    # Where the two frequencies nearly meet, the solver's mode shapes lose as many digits as they differ by.
    assert np.array(double_pendulum_participation(*crane)) == pytest.approx(shares, rel=1e-12)


@settings(derandomize=True, deadline=None)
@given(crane=st.tuples(LENGTHS_M, LENGTHS_M, MASSES_KG, MASSES_KG))
def test_the_shares_of_hook_and_of_load_sum_to_one(crane):
    hook, load = double_pendulum_participation(*crane)
    # All are made from the load's shares, of opposite signs: their sum is right to some roundings of those.
    assert (sum(hook), sum(load)) == pytest.approx((1.0, 1.0), abs=1e-14 * load[0])


@pytest.mark.parametrize("crane", CRANES)
def test_the_upper_mode_of_the_load_sways_by_the_cube_of_the_frequency_ratio(crane):
    lower, upper = double_pendulum_modes(*crane)
    sways = sways_m(crane)
    assert sways[1] / sways[0] == pytest.approx((lower.frequency_hz / upper.frequency_hz) ** 3, rel=1e-13)


def test_the_swing_after_a_step_is_the_motion_of_the_two_bodies():
    from scipy.integrate import solve_ivp

    crane = (6.0, 3.0, 300.0, 600.0)
    masses, stiffness = matrices(*crane)
    forces = stiffness / masses[:, np.newaxis]
    times_s = np.linspace(0.0, 10.0, 41)
    # Seen from the trolley, a jump of its velocity by 1 m/s throws both bodies backwards by as much.
    motion = solve_ivp(
        lambda _, state: np.concatenate([state[2:], -forces @ state[:2]]),
        (0.0, 10.0),
        [0.0, 0.0, -1.0, -1.0],
        t_eval=times_s,
        method="DOP853",
        rtol=1e-10,
        atol=1e-12,
    )
    angular = np.array([mode.angular_frequency_rad_s for mode in double_pendulum_modes(*crane)])
    shares = np.array(double_pendulum_participation(*crane))
    swing_m = -(shares / angular) @ np.sin(np.outer(angular, times_s))
    assert swing_m == pytest.approx(motion.y[:2], abs=1e-8)  # a hundred times the integrator's own accuracy


def test_both_modes_have_the_damping_given():
    assert [mode.damping_ratio for mode in double_pendulum_modes(6.0, 3.0, 1.0, 1.0, 0.01)] == [0.01, 0.01]


NAMES = ("rope_length_m", "sling_length_m", "hook_mass_kg", "load_mass_kg")


@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
@pytest.mark.parametrize("place", range(4), ids=NAMES)
def test_what_is_not_finite_and_positive_is_refused_by_name(place, value):
    crane = [6.0, 3.0, 300.0, 600.0]
    crane[place] = value
    with pytest.raises(PlantError, match=rf"{NAMES[place]} = .*: must be finite and > 0"):
        double_pendulum_modes(*crane)
    with pytest.raises(PlantError, match=rf"{NAMES[place]} = .*: must be finite and > 0"):
        double_pendulum_participation(*crane)
