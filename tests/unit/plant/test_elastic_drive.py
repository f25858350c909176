"""A motor under a PI loop, and a load behind a spring."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from swayless.errors import PlantError
from swayless.plant.elastic_drive import TUNED, ElasticDrive

DRIVE = ElasticDrive(0.00011, 0.0034, 0.05, 0.2, 1.0, 0.22, 3.05)
S = np.array([0.3j, 2j, 1.0 + 5j, 40j])


def at(ratio, s=S):
    return np.polyval(ratio.numerator, s) / np.polyval(ratio.denominator, s)


def test_the_transfer_functions_are_eqs_1_to_5_of_visioli_and_piazzi():
    motor = (1.0 / DRIVE.motor_friction) / (S * (DRIVE.motor_inertia / DRIVE.motor_friction * S + 1.0))
    controller = DRIVE.gain * (1.0 + 1.0 / (DRIVE.integral_time_s * S))
    loop = controller * motor / (1.0 + controller * motor)
    transmission = (0.22 * S + 3.05) / (S**2 + 0.22 * S + 3.05)
    # 1e-13: some ten roundings of terms of one size.
    assert at(DRIVE.loop) == pytest.approx(loop, rel=1e-13)
    assert at(DRIVE.transmission) == pytest.approx(transmission, rel=1e-13)
    assert at(DRIVE.transfer_function) == pytest.approx(loop * transmission, rel=1e-13)


@pytest.mark.parametrize("name", TUNED)
def test_sensitivities_are_the_slopes_of_ln_h(name):
    value = getattr(DRIVE, name)
    step = 1e-5 * value
    up, down = (
        np.log(at(replace(DRIVE, **{name: value + sign * step}).transfer_function)) for sign in (1, -1)
    )
    # Central differences: 1e-10 of the second derivative's size, and rounding over a step of 1e-5.
    assert at(DRIVE.sensitivities[TUNED.index(name)]) * value == pytest.approx(
        (up - down) / 2e-5, rel=1e-7, abs=1e-9
    )


def test_load_mass_damping_and_stiffness_show_only_as_ratios():
    twice = replace(DRIVE, load_mass=2.0, damping=0.44, stiffness=6.1)
    assert at(twice.transfer_function) == pytest.approx(at(DRIVE.transfer_function), rel=1e-14)


def test_the_loop_is_stable_where_its_integral_time_is_above_the_motors_lag():
    lag_s = DRIVE.motor_inertia / DRIVE.motor_friction
    for gain in (1e-3, 0.05, 10.0):
        poles = np.roots(replace(DRIVE, gain=gain, integral_time_s=1.001 * lag_s).loop.denominator)
        assert poles.real.max() < 0.0
        with pytest.raises(PlantError, match=r"must be above motor_inertia / motor_friction = 0\.0323529 s"):
            replace(DRIVE, gain=gain, integral_time_s=lag_s)


@pytest.mark.parametrize(
    ("name", "value"),
    [(name, value) for name in (*TUNED, "gain", "integral_time_s") for value in (-1.0, np.nan, np.inf)]
    + [("stiffness", 0.0), ("load_mass", 0.0), ("motor_friction", 0.0), ("gain", 0.0)],
)
def test_values_out_of_range_are_refused_by_name(name, value):
    with pytest.raises(PlantError, match=f"{name} = .*: must be finite and >"):
        replace(DRIVE, **{name: value})


def test_no_damping_is_a_transmission_without_zero():
    assert replace(DRIVE, damping=0.0).transmission.numerator.tolist() == [3.05]
