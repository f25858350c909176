"""The constraint equations of the solved families: their derivatives, and that designs satisfy them."""

import numpy as np
import pytest

from swayless.design.families import insensitive, unity_magnitude
from swayless.design.families.constraints import AtMode, Constraints

SYSTEMS = {
    "ei": insensitive.ONE_HUMP,
    "ei2": insensitive.TWO_HUMP,
    "ei3": insensitive.THREE_HUMP,
    "um-zv": unity_magnitude.ZERO,
    "um-zvd": unity_magnitude.DOUBLE_ZERO,
    "um-ei": unity_magnitude.HUMP,
}


def some_point(system):
    """Unknowns near nothing in particular, with rising times."""
    count = system.impulses
    logs = [] if system.fixed_amplitudes else np.log(np.linspace(0.5, 0.1, count))
    return np.concatenate(
        [
            logs,
            np.linspace(0.4, 1.7, count - 1),
            np.linspace(0.8, 1.6, system.zeros),
            np.linspace(0.7, 1.4, system.humps),
        ]
    )


@pytest.mark.parametrize("name", SYSTEMS)
def test_there_are_as_many_equations_as_unknowns(name):
    unknowns = some_point(SYSTEMS[name])
    residuals, jacobian, decay_slope = SYSTEMS[name].linearise(unknowns, 0.1, 0.05)
    assert residuals.shape == decay_slope.shape == unknowns.shape
    assert jacobian.shape == (unknowns.size, unknowns.size)


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_jacobian_and_the_slope_over_damping_are_the_derivatives(name):
    system, unknowns, step = SYSTEMS[name], some_point(SYSTEMS[name]), 1e-6
    _, jacobian, decay_slope = system.linearise(unknowns, 0.1, 0.05)

    def difference(change, decay_change):
        ahead = system.linearise(unknowns + change, 0.1 + decay_change, 0.05)[0]
        return (ahead - system.linearise(unknowns - change, 0.1 - decay_change, 0.05)[0]) / (2.0 * step)

    columns = [difference(step * unit, 0.0) for unit in np.eye(unknowns.size)]
    # Central differences: third derivatives of order (2 pi 2)^3 times step^2, and 1e-16 / step of rounding.
    assert np.stack(columns, axis=1) == pytest.approx(jacobian, abs=1e-7)
    assert difference(0.0, step) == pytest.approx(decay_slope, abs=1e-7)


def test_order_is_lost_when_times_fall_or_a_frequency_is_not_positive():
    system = Constraints(impulses=3, at_mode=AtMode.HUMP, zeros=2)
    good = np.array([-1.0, -1.0, -1.0, 0.5, 1.0, 0.9, 1.1])
    assert system.holds_order(good)
    for place, value in ((3, 1.2), (3, 0.0), (5, 0.0), (6, -1.0)):
        bad = good.copy()
        bad[place] = value
        assert not system.holds_order(bad)
