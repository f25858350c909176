"""The true mode of every rope below a driven trolley, and back: against eigenvalues of a matrix."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import PlantError
from swayless.plant import DrivenRopes, FreeRopes, ServoDrive, pendulum_mode
from tests.unit.plant.linear_drive import state_matrix

STIFF = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
INTEGRAL = ServoDrive.from_lag(2000.0, 6000.0, 0.1, 0.6)


def swing_pole(drive, rope_m, damping_ratio):
    """Least damped pole of the matrix, upper half, in rad/s."""
    values = np.linalg.eigvals(state_matrix(drive, rope_m, damping_ratio))
    vibrating = values[values.imag > 1e-6 * abs(values)]
    return vibrating[(-vibrating.real / abs(vibrating)).argmin()]


@settings(derandomize=True, deadline=None, max_examples=30)
@given(
    load_ratio=st.floats(0.2, 5.0),
    lag_s=st.floats(0.005, 0.2),
    integral_time_s=st.one_of(st.just(math.inf), st.floats(1.0, 10.0)),
    rope_m=st.floats(2.0, 20.0),
    own=st.floats(0.0, 0.02),
)
def test_a_mode_is_an_eigenvalue_and_its_frequency_leads_back_to_the_rope(
    load_ratio, lag_s, integral_time_s, rope_m, own
):
    drive = ServoDrive.from_lag(1000.0, 1000.0 * load_ratio, lag_s, integral_time_s)
    ropes = DrivenRopes(drive, (2.0, 20.0), own)
    mode, pole = ropes.mode(rope_m), swing_pole(drive, rope_m, own)
    # 1e-9: eigenvalues of a matrix with rates up to 1000/s are right to a few 1e-13 of those.
    assert mode.angular_frequency_rad_s == pytest.approx(abs(pole), rel=1e-9)
    assert mode.damping_ratio == pytest.approx(-pole.real / abs(pole), abs=1e-9)
    # The frequency falls as L^-1/2, so its rounding of 1e-16, and that of the polished root, is doubled.
    assert ropes.rope_length_m(mode.frequency_hz) == pytest.approx(rope_m, rel=1e-11)


def test_a_frequency_has_another_rope_than_a_pendulum_says():
    ropes = DrivenRopes(INTEGRAL, (3.0, 9.0))
    frequency_hz = ropes.mode(6.0).frequency_hz
    assert ropes.rope_length_m(frequency_hz) == pytest.approx(6.0, rel=1e-11)
    assert abs(FreeRopes().rope_length_m(frequency_hz) - 6.0) > 0.1


@pytest.mark.parametrize("drive", [STIFF, INTEGRAL], ids=["P", "PI"])
def test_the_damping_range_holds_every_rope_and_no_more(drive):
    low, high = DrivenRopes(drive, (1.0, 40.0), 0.002).damping_range((1.0, 40.0))
    poles = np.array([swing_pole(drive, rope_m, 0.002) for rope_m in np.geomspace(1.0, 40.0, 2001)])
    ratios = -poles.real / abs(poles)
    # 2001 samples miss an extreme between them by at most a few 1e-6 of it; ends they meet.
    assert (low, high) == pytest.approx((ratios.min(), ratios.max()), rel=1e-5)
    assert low <= ratios.min() * (1 + 1e-12)
    assert high >= ratios.max() * (1 - 1e-12)


def test_an_integral_turns_the_damping_round_between_the_ends():
    """So that the ends of the range would not do."""
    ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 1000.0, 0.4, 2.0), (0.3, 9.0))
    ends = [ropes.mode(end_m).damping_ratio for end_m in (0.3, 9.0)]
    assert ropes.damping_range((0.3, 9.0))[1] > 1.05 * max(ends)


def test_an_ideal_drive_leaves_free_ropes():
    ropes, free = DrivenRopes(ServoDrive.from_lag(1000.0, 3000.0, 1e-7), (2.0, 10.0), 0.01), FreeRopes(0.01)
    assert free.mode(5.0) == pendulum_mode(5.0, 0.01)
    # The shift of both is of the first order in w lag, 1e-7.
    assert ropes.mode(5.0).frequency_hz == pytest.approx(free.mode(5.0).frequency_hz, rel=1e-6)
    assert ropes.rope_length_m(0.25) == pytest.approx(free.rope_length_m(0.25), rel=1e-6)


@pytest.mark.parametrize(
    ("drive", "range_m", "reason"),
    [
        (ServoDrive.from_lag(100.0, 3000.0, 2.5), (2.0, 9.0), r"damps the load on 7\.39\d m of rope so well"),
        (ServoDrive.from_lag(2000.0, 500.0, 0.5, 0.02), (2.0, 9.0), r"two vibrations on 2 m of rope: .*Hz"),
    ],
)
def test_a_rope_without_one_clear_vibration_is_refused(drive, range_m, reason):
    with pytest.raises(PlantError, match=reason):
        DrivenRopes(drive, range_m)


def test_a_frequency_far_beyond_the_ropes_is_refused_with_those_that_have_one():
    ropes = DrivenRopes(STIFF, (3.0, 9.0))
    with pytest.raises(PlantError, match=r"frequency_hz = 0\.01: .*have a rope for 0\.08"):
        ropes.rope_length_m(0.01)
    # Four times beyond the ends is what is still looked up.
    assert ropes.rope_length_m(ropes.modes(36.0)[0]) == pytest.approx(36.0, rel=1e-9)


@pytest.mark.parametrize("rope_m", [6.0, 7.478685709313956])
def test_one_rope_is_a_range_too(rope_m):
    ropes = DrivenRopes(STIFF, (rope_m, rope_m))
    assert ropes.frequency_range_hz((rope_m, rope_m)) == (ropes.mode(rope_m).frequency_hz,) * 2
    assert ropes.damping_range((rope_m, rope_m)) == (ropes.mode(rope_m).damping_ratio,) * 2


def test_ropes_beyond_the_range_count_while_the_swing_is_clear():
    """On a rope of 2 cm the load swings as fast as the loop: there is no telling which is which."""
    ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 1000.0, 0.1, 0.024), (1.0, 9.0))
    frequency_hz, ratio = ropes.modes([1.0, 9.0, 0.02])
    assert np.isnan(frequency_hz).tolist() == np.isnan(ratio).tolist() == [False, False, True]
