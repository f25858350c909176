"""What is left on ropes whose damping changes: against sums over the eigenvalues of a matrix, densely."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.design import design_shaper, solve_on_grid
from swayless.design.along_ropes import held_ropes, highest_hump, residual_on_ropes, worst_on_ropes
from swayless.errors import DesignError
from swayless.plant import DrivenRopes, ServoDrive, pendulum_mode
from tests.unit.plant.linear_drive import state_matrix

DRIVE = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
ROPES = DrivenRopes(DRIVE, (3.0, 9.0))
FAMILIES = ["zv", "zvd", "ei", "ei2", "um-zv"]


def left_by(impulses, rope_m, drive=DRIVE):
    """|sum A_i exp(s (t_i - t_n))| at the least damped eigenvalue: exp(-s t) decays the impulses before."""
    values = np.linalg.eigvals(state_matrix(drive, rope_m, 0.0))
    values = values[values.imag > 1e-6]
    pole = values[(-values.real / abs(values)).argmin()]
    before_s = impulses.times_s[-1] - impulses.times_s
    return abs(np.dot(impulses.amplitudes, np.exp(pole * before_s)))


@pytest.mark.parametrize("family", FAMILIES)
def test_the_residual_is_that_of_the_eigenvalue(family):
    shaper = design_shaper(family, ROPES.mode(6.0))
    lengths_m = np.array([2.0, 5.0, 6.0, 8.0, 20.0])
    expected = [left_by(shaper, rope_m) for rope_m in lengths_m]
    # 1e-9: eigenvalues right to 1e-13 of the fastest, 40/s, over 10 s of impulses.
    np.testing.assert_allclose(residual_on_ropes(shaper, ROPES, lengths_m), expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("family", FAMILIES)
def test_ropes_held_hold_and_the_next_ones_do_not(family):
    taps = solve_on_grid(design_shaper(family, ROPES.mode(6.0), tolerance=0.045), 0.01)
    held = held_ropes(taps, ROPES, 6.0, tolerance=0.05)
    low_m, high_m = held.range_m
    inside = [left_by(taps, rope_m) for rope_m in np.linspace(low_m, high_m, 400)]
    assert max(inside) <= 0.05 + 1e-9
    # 400 ropes miss a maximum between them by less than a thousandth of it.
    assert max(inside) == pytest.approx(held.worst_residual_ratio, rel=1e-3)
    assert left_by(taps, low_m * (1 - 1e-6)) > 0.05 - 1e-9
    assert left_by(taps, high_m * (1 + 1e-6)) > 0.05 - 1e-9
    assert low_m < 6.0 < high_m


def test_ropes_held_are_not_those_of_the_band():
    """A zvd row that holds 5 % at the damping of 6 m leaves more on the long ropes of its band."""
    shaper = design_shaper("zvd", ROPES.mode(6.0))
    longest_m = ROPES.rope_length_m(shaper.guarantee.band.low_hz)
    assert left_by(shaper, longest_m) > 0.0501
    assert held_ropes(shaper, ROPES, 6.0, tolerance=0.05).range_m[1] < longest_m - 0.01


def test_the_worst_of_a_range_is_found_between_and_at_its_ends():
    shaper = design_shaper("ei2", ROPES.mode(6.0))
    for range_m in ((3.5, 9.0), (2.0, 4.0)):
        dense = max(left_by(shaper, rope_m) for rope_m in np.linspace(*range_m, 1001))
        assert worst_on_ropes(shaper, ROPES, range_m) == pytest.approx(dense, rel=1e-4)
        assert worst_on_ropes(shaper, ROPES, range_m) >= dense * (1 - 1e-9)


def test_a_hump_at_the_tolerance_stands_above_it_on_ropes_of_other_damping():
    shaper = design_shaper("ei2", ROPES.mode(6.0), tolerance=0.05)
    hump = highest_hump(shaper, ROPES, 6.0, shaper.guarantee.band)
    lengths_m = np.linspace(4.0, 11.0, 2001)
    left = np.array([left_by(shaper, rope_m) for rope_m in lengths_m])
    humps = left[1:-1][(left[1:-1] > left[:-2]) & (left[1:-1] > left[2:])]
    assert hump == pytest.approx(humps.max(), rel=1e-5)
    assert hump > 0.0515
    zvd = design_shaper("zvd", ROPES.mode(6.0))
    assert highest_hump(zvd, ROPES, 6.0, zvd.guarantee.band) == 0.0


def test_a_rope_on_which_too_much_is_left_holds_nothing():
    with pytest.raises(DesignError, match=r"leave 0\.07\d+ on 6 m of rope: more than the tolerance 0\.05"):
        held_ropes(design_shaper("zv", pendulum_mode(6.0)), ROPES, 6.0, tolerance=0.05)


def test_ropes_on_which_nothing_vibrates_are_not_held():
    ropes = DrivenRopes(ServoDrive.from_lag(100.0, 3000.0, 0.8), (5.0, 9.0))
    shaper = design_shaper("zvd", ropes.mode(7.0))
    assert residual_on_ropes(shaper, ropes, np.array([1.2])) == np.inf
    assert held_ropes(shaper, ropes, 7.0, tolerance=0.2).range_m[0] > 1.2


@pytest.mark.parametrize(("lag_s", "zv", "zvd"), [(0.1, 0.06, 0.003), (0.05, 0.03, 0.0008)])
def test_a_lag_of_100_ms_leaves_6_per_cent_of_zv_and_a_third_of_one_of_zvd(lag_s, zv, zvd):
    """Designed for the pendulum of 10 m: V = pi d / 2 and its square, with d = 3/4 w lag / 2."""
    drive = ServoDrive.from_lag(2000.0, 6000.0, lag_s)
    ropes, rope_m = DrivenRopes(drive, (3.0, 10.0)), 10.0
    first_order = 0.5 * np.pi * 0.75 * pendulum_mode(rope_m).angular_frequency_rad_s * lag_s / 2.0
    for family, power, rounded in (("zv", 1, zv), ("zvd", 2, zvd)):
        naive = design_shaper(family, pendulum_mode(rope_m))
        left = float(residual_on_ropes(naive, ropes, np.array(rope_m)))
        # 12 %: the next order, pi d, of each of one or two factors.
        assert left == pytest.approx(first_order**power, rel=0.12 * power)
        assert left == pytest.approx(rounded, rel=0.15)
        true = design_shaper(family, ropes.mode(rope_m))
        assert float(residual_on_ropes(true, ropes, np.array(rope_m))) < 1e-9
