"""The small-angle pendulum, both ways."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import PlantError
from swayless.plant import (
    STANDARD_GRAVITY_M_S2,
    pendulum_frequency_hz,
    pendulum_mode,
    pendulum_rope_length_m,
)


def test_a_rope_of_g_over_four_pi_squared_swings_once_a_second():
    rope_length_m = STANDARD_GRAVITY_M_S2 / (4.0 * math.pi**2)
    assert pendulum_frequency_hz(rope_length_m) == pytest.approx(1.0, rel=1e-15)


@settings(derandomize=True, deadline=None)
@given(rope_length_m=st.floats(1e-3, 1e3))
def test_rope_length_and_frequency_are_inverses(rope_length_m):
    again_m = pendulum_rope_length_m(pendulum_frequency_hz(rope_length_m))
    assert again_m == pytest.approx(rope_length_m, rel=1e-14)  # a root and a square, a few roundings


def test_four_times_the_rope_swings_half_as_often():
    assert pendulum_frequency_hz(8.0) == pytest.approx(0.5 * pendulum_frequency_hz(2.0), rel=1e-15)


def test_the_mode_of_a_rope_has_its_frequency_and_the_damping_given():
    mode = pendulum_mode(5.0, 0.004)
    assert (mode.frequency_hz, mode.damping_ratio) == (pendulum_frequency_hz(5.0), 0.004)


@pytest.mark.parametrize("value", [0.0, -2.0, math.inf, math.nan])
def test_lengths_and_frequencies_that_are_not_finite_and_positive_are_refused(value):
    with pytest.raises(PlantError, match=r"rope_length_m = .*: must be finite and > 0"):
        pendulum_frequency_hz(value)
    with pytest.raises(PlantError, match=r"frequency_hz = .*: must be finite and > 0"):
        pendulum_rope_length_m(value)
