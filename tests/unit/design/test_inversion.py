"""Input-output inversion: against numbers of 50 digits, an integrator of its own, and what it refuses."""

from __future__ import annotations

from dataclasses import fields, replace
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from swayless.design.inversion import PolynomialMotion, invert, motion_response
from swayless.design.optimal import Command, LinearPlant, output_at_ticks
from swayless.errors import DesignError
from swayless.plant.elastic_drive import ElasticDrive

DRIVE = ElasticDrive(0.00011, 0.0034, 0.05, 0.2, 1.0, 0.22, 3.05)
MOTION = PolynomialMotion(2.0, 1.0)


def inverse(drive, motion=MOTION):
    """The closed form of the command, as a response to the motion."""
    top, bottom = drive.transfer_function
    return motion_response(bottom, top, motion)


def times(one, other):
    """The product of two polynomials of any numbers."""
    out = [mpmath.mpf(0)] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            out[i + j] += a * b
    return out


def value(polynomial, s):
    total = mpmath.mpf(0)
    for each in polynomial:
        total = total * s + each
    return total


def exact(drive, motion, times_s):
    """Partial fractions in 50 digits: whole powers of s, and one exponential for each of the two zeros."""
    with mpmath.workdps(50):
        inertia, friction, gain, integral, mass, damping, stiffness = (
            mpmath.mpf(getattr(drive, each.name)) for each in fields(drive)
        )
        top = times(
            [integral * inertia, integral * friction, gain * integral, gain], [mass, damping, stiffness]
        )
        bottom = times([gain * integral, gain], [damping, stiffness])
        roots, slope = (-1 / integral, -stiffness / damping), [2 * bottom[0], bottom[1]]
        duration = mpmath.mpf(motion.duration_s)
        y = [mpmath.mpf(int(each)) / duration**i for i, each in enumerate(motion.coefficients)]
        whole, rest = [], top
        while len(rest) >= len(bottom):
            factor = rest[0] / bottom[0]
            whole.insert(0, factor)
            rest = [a - factor * b for a, b in zip(rest, [*bottom, *[0] * len(rest)], strict=False)][1:]

        def derivative(j, t):
            return sum(y[i] * mpmath.ff(i, j) * t ** (i - j) for i in range(j, len(y)))

        def particular(root, t):
            return -sum(derivative(j, t) / root ** (j + 1) for j in range(len(y)))

        def lag(root, t):
            inside = min(t, duration)
            now = particular(root, inside) - particular(root, mpmath.mpf(0)) * mpmath.exp(root * inside)
            return now if t <= duration else (now + 1 / root) * mpmath.exp(root * (t - duration)) - 1 / root

        def command(t):
            held = [1, *[0] * len(whole)]
            return sum(value(rest, root) / value(slope, root) * lag(root, t) for root in roots) + sum(
                each * (derivative(j, t) if t <= duration else held[j]) for j, each in enumerate(whole)
            )

        return np.array([float(command(mpmath.mpf(float(t)))) for t in times_s])


@pytest.mark.parametrize(
    ("drive", "order"),
    [
        (DRIVE, 7),
        (DRIVE, 15),
        (replace(DRIVE, integral_time_s=20.0), 9),  # a zero ten times slower than the motion
        (replace(DRIVE, damping=1e-3), 7),  # and one six thousand times faster
        (replace(DRIVE, integral_time_s=0.22 / 3.05 * (1.0 + 1e-9)), 7),  # and two that nearly meet
    ],
)
def test_the_command_is_the_closed_form_of_polynomials_and_exponentials(drive, order):
    motion = replace(MOTION, order=order)
    ticks = np.array([0, 1, 150, 399, 400, 401, 799, 800, 801, 900, 1599])
    found = inverse(drive, motion).on_grid(0.0, 0.0025, 1600)[ticks]
    # 1e-11: the zero of six thousand times loses four digits of sixteen, order 15 as many.
    assert found == pytest.approx(exact(drive, motion, 0.0025 * ticks), abs=1e-11)


@pytest.mark.parametrize("order", [7, 11])
def test_the_loop_driven_by_the_closed_form_moves_the_load_as_the_polynomial(order):
    """The loop as it is drawn (fig 1), integrated by a method that knows nothing of transfer functions."""
    motion = PolynomialMotion(2.0, 1.5, start=-0.5, order=order)
    response, grid_s = inverse(DRIVE, motion), 0.0005
    command = motion.start + response.on_grid(0.0, 0.5 * grid_s, 16001)

    def rates(command_now, state):
        motor, speed, integral, load, load_speed = state
        error = command_now - motor
        torque = DRIVE.gain * (error + integral / DRIVE.integral_time_s)
        force = DRIVE.damping * (speed - load_speed) + DRIVE.stiffness * (motor - load)
        friction = DRIVE.motor_friction * speed
        return np.array(
            [speed, (torque - friction) / DRIVE.motor_inertia, error, load_speed, force / DRIVE.load_mass]
        )

    # Polynomials of degree 7 through 8 neighbours: the command between its samples to 1e-12.
    def between(t):
        place = min(max(int(t / (0.5 * grid_s)) - 3, 0), command.size - 8)
        # Not across the end of the motion, where its derivatives jump.
        place = min(place, 8000 - 7) if t <= 2.0 else max(place, 8000)
        nodes = np.arange(8.0)
        u = t / (0.5 * grid_s) - place
        weights = np.array([np.prod((u - nodes[nodes != i]) / (i - nodes[nodes != i])) for i in range(8)])
        return float(weights @ command[place : place + 8])

    state = np.array([motion.start, 0.0, 0.0, motion.start, 0.0])
    off = []
    for begin, end in pairwise((0.0, 2.0, 3.5)):
        at = np.linspace(begin, end, 60)
        done = solve_ivp(
            lambda t, x: rates(between(t), x), (begin, end), state, "DOP853", at, rtol=1e-12, atol=1e-13
        )
        state = done.y[:, -1]
        off.append(np.abs(done.y[3] - motion.at(at)).max())
    assert max(off) < 1e-9


def test_the_held_command_is_off_by_the_square_of_the_tick_and_ends_at_rest():
    found = [invert(*DRIVE.transfer_function, MOTION, tick_s) for tick_s in (0.02, 0.01, 0.005)]
    # The mean over each tick: halving the tick leaves a quarter.
    assert [a.deviation / b.deviation for a, b in pairwise(found)] == pytest.approx([4.0, 4.0], rel=0.02)
    assert found[-1].deviation < 5e-6
    for each in found:
        assert each.final_error_ratio < 1e-12
        assert each.correction < 2e-7
        output = output_at_ticks(each.plant, each.command, ticks=each.command.values.size + 400)
        assert np.abs(output[each.command.values.size :] - 1.0).max() < 1e-12


def test_each_value_is_the_mean_of_the_closed_form_over_its_tick():
    held = inverse(DRIVE).averages(0.02, 200)
    nodes, weights = np.polynomial.legendre.leggauss(6)
    fine = [inverse(DRIVE).on_grid(0.01 * (1.0 + node), 0.02, 200) for node in nodes]
    # Gauss' rule of order 12 over a hundredth of the motion is exact to rounding.
    assert held == pytest.approx(0.5 * weights @ np.array(fine), abs=1e-13)


@pytest.mark.parametrize("ratio", [1e-3, 1e-6, 1e-9])
def test_what_follows_the_end_stays_within_the_bound(ratio):
    found = invert(*DRIVE.transfer_function, MOTION, 0.005, truncation_ratio=ratio)
    ticks = found.command.values.size
    later = inverse(DRIVE).on_grid(0.005 * ticks, 0.001, 20000) - 1.0
    assert np.abs(later).max() <= found.truncation_bound <= ratio * 1.001
    assert np.abs(found.exact[-1] - 1.0) == pytest.approx(abs(later[0]), abs=1e-14)
    # Not much longer than needed: a tenth of a second earlier more than the tolerance would be left.
    assert np.abs(inverse(DRIVE).on_grid(0.005 * (ticks - 60), 0.005, 1) - 1.0) > 0.1 * ratio


def test_a_cut_command_without_correction_leaves_less_than_the_bound_at_the_load():
    found = invert(*DRIVE.transfer_function, MOTION, 0.005, truncation_ratio=1e-4)
    cut = Command(0.005, inverse(DRIVE).averages(0.005, found.command.values.size), 1.0)
    output = output_at_ticks(found.plant, cut, ticks=2 * cut.values.size)
    assert np.abs(output[cut.values.size :] - 1.0).max() < found.truncation_bound


def test_any_plant_without_zeros_to_the_right_is_inverted():
    """A crane's load on its rope: an integrator, a swing, and a fast zero; the command is a speed."""
    numerator, denominator = np.array([0.02, 2.0]), np.array([1.0, 0.02, 2.0, 0.0])
    found = invert(numerator, denominator, PolynomialMotion(4.0, 3.0, start=1.0, order=9), 0.02)
    assert found.command.final_value == pytest.approx(0.0, abs=1e-15)
    assert found.deviation < 1e-4
    output = output_at_ticks(found.plant, found.command, start=1.0, ticks=found.command.values.size + 200)
    assert output[-200:] == pytest.approx(3.0, abs=1e-11)


def test_a_plant_without_zeros_has_no_post_action():
    found = invert(np.array([1.0]), np.array([0.01, 0.02, 1.0]), PolynomialMotion(1.0, 1.0), 0.01)
    assert (found.post_action_s, found.truncation_bound) == (0.0, 0.0)
    assert found.final_error_ratio < 1e-12


REFUSED = [
    ([-0.1, 1.0], [1.0, 2.0, 1.0], {}, "zero at 10 rad/s, right of the imaginary axis"),
    ([1.0, 0.0, 9.0], [1.0, 4.0, 5.0, 2.0, 1.0], {}, r"zero at .*3j rad/s, on the imaginary axis"),
    ([1.0, 0.0], [1.0, 2.0, 1.0], {}, "zero at 0 rad/s, on the imaginary axis"),
    ([1.0], [1.0, -1.0], {}, "unstable, pole at 1 rad/s"),
    (
        [1.0],
        [1.0, 4.0, 6.0, 4.0, 1.0],
        {},
        "order = 7: .* derivative 3, and a plant of relative degree 4 needs order 9",
    ),
    ([1.0], np.poly([-1.0] * 8).tolist(), {}, "relative degree 8 is more than order 15 can do"),
    ([1e-4, 1.0], [1.0, 2.0, 1.0], {"duration_s": 0.009}, "9 ticks of 0.001 s: must be 10 to 20000 ticks"),
    (
        [1.0],
        [1.0, 1.0],
        {"duration_s": 0.0205},
        r"must be a whole number of ticks of 0\.001 s; nearest: 0\.02 s",
    ),
    ([1000.0, 1.0], [1.0, 2.0, 1.0], {}, r"zero at -0\.001 rad/s dies out slowly"),
    ([1e-9, 1.0], [1.0, 2.0, 1.0], {}, "a double does not resolve"),
]


@pytest.mark.parametrize(("numerator", "denominator", "changes", "message"), REFUSED)
def test_what_cannot_be_inverted_is_refused_with_the_cause(numerator, denominator, changes, message):
    motion = replace(PolynomialMotion(1.0, 1.0), **changes)
    with pytest.raises(DesignError, match=message):
        invert(np.array(numerator), np.array(denominator), motion, 0.001)


def test_a_transmission_without_damping_needs_a_smoother_motion():
    undamped = replace(DRIVE, damping=0.0).transfer_function
    with pytest.raises(DesignError, match="relative degree 4 needs order 9"):
        invert(*undamped, MOTION, 0.005)
    assert invert(*undamped, replace(MOTION, order=9), 0.005).final_error_ratio < 1e-12


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"order": 8}, "order = 8: must be an odd number from 3 to 15"),
        ({"order": 17}, "order = 17"),
        ({"duration_s": np.nan}, "duration_s = nan: must be finite and > 0"),
        ({"target": 0.0}, "target = 0.0: must be finite, and differ from start = 0.0"),
    ],
)
def test_motions_out_of_range_are_refused(changes, message):
    with pytest.raises(DesignError, match=message):
        replace(MOTION, **changes)


@pytest.mark.parametrize("order", range(3, 17, 2))
def test_a_motion_rests_at_both_ends_as_smooth_as_its_order_allows(order):
    motion = replace(MOTION, order=order)
    for place, rest in ((0, 0), (1, 1)):
        taylor = motion.taylor(type(motion.coefficients[0])(place))
        assert taylor[0] == rest
        assert not taylor[1 : motion.smoothness + 1].any()
        assert taylor[motion.smoothness + 1] != 0.0


def test_a_truncation_out_of_range_is_refused():
    with pytest.raises(DesignError, match=r"truncation_ratio = 1\.0: must be above 0 and below 1"):
        invert(*DRIVE.transfer_function, MOTION, 0.01, truncation_ratio=1.0)


def test_the_plant_of_the_command_is_that_of_the_transfer_function():
    found = invert(*DRIVE.transfer_function, MOTION, 0.01)
    assert isinstance(found.plant, LinearPlant)
    assert found.plant.equilibrium(1.0)[1] == pytest.approx(1.0, rel=1e-12)
