"""The table of families, the closed forms, and what a design refuses."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import FAMILIES, design_shaper, residual_vibration, residual_vibration_and_slope
from swayless.design.families.closed_form import LARGEST_ORDER
from swayless.errors import DesignError
from swayless.plant import Mode

SETTINGS = settings(derandomize=True, deadline=None, max_examples=50)
PARAMETERS = {"zvm": {"order": 5}, "oatf": {"delay_s": 0.3}}


def design(name, mode, tolerance=0.05):
    return design_shaper(name, mode, tolerance=tolerance, **PARAMETERS.get(name, {}))


def test_the_families_are_listed_in_the_order_of_the_documentation():
    listed = [
        "zv",
        "zvd",
        "zvdd",
        "zvddd",
        "zvm",
        "ei",
        "ei2",
        "ei3",
        "mzv",
        "um-zv",
        "um-zvd",
        "um-ei",
        "oatf",
    ]
    assert list(FAMILIES) == listed
    assert [family.name for family in FAMILIES.values()] == listed


@pytest.mark.parametrize("damping_ratio", [0.0, 0.004, 0.1])
@pytest.mark.parametrize("name", FAMILIES)
def test_a_design_knows_its_family_and_its_source_and_guarantees_its_mode(name, damping_ratio):
    mode = Mode(0.7, damping_ratio)
    shaper = design(name, mode)
    assert (shaper.family, shaper.source) == (name, FAMILIES[name].source)
    assert (shaper.guarantee.mode, shaper.guarantee.tolerance) == (mode, 0.05)
    assert shaper.guarantee.band.contains(0.7)


@pytest.mark.parametrize("name", FAMILIES)
def test_only_families_that_say_so_have_negative_amplitudes(name):
    delay = (
        {"delay_s": 0.2} if name == "oatf" else {}
    )  # below a quarter period the middle impulse is negative
    shaper = design_shaper(name, Mode(1.0, 0.02), **{**PARAMETERS.get(name, {}), **delay})
    assert bool((shaper.amplitudes < 0.0).any()) == FAMILIES[name].negative


@pytest.mark.parametrize("damping_ratio", [0.0, 0.1, 0.3])
@pytest.mark.parametrize("name", [name for name in FAMILIES if FAMILIES[name].zero_orders is not None])
def test_as_many_derivatives_vanish_at_the_mode_as_the_family_says_and_no_more(name, damping_ratio):
    shaper = design(name, Mode(1.0, damping_ratio), tolerance=0.05)
    phase = 2.0 * math.pi * (damping_ratio + 1j * math.sqrt(1.0 - damping_ratio**2)) * shaper.times_s
    derivatives = [
        abs(np.sum(shaper.amplitudes * phase**order * np.exp(phase))) / np.exp(phase[-1].real)
        for order in range(6)
    ]
    zero_orders = FAMILIES[name].zero_orders
    # Terms of the sum reach (2 pi 2)^order; 1e-14 of that is their rounding.
    for order, derivative in enumerate(derivatives[: zero_orders + 1]):
        assert derivative < 1e-14 * 13.0**order
    assert derivatives[zero_orders + 1] > 1e-3


@SETTINGS
@given(
    name=st.sampled_from(sorted(FAMILIES)),
    frequency_hz=st.floats(1e-3, 1e3),
    damping_ratio=st.floats(0.0, 0.2),
    tolerance=st.floats(0.01, 0.1),
)
def test_a_design_scales_with_the_period(name, frequency_hz, damping_ratio, tolerance):
    parameters = PARAMETERS.get(name, {})
    unit = design_shaper(name, Mode(1.0, damping_ratio), tolerance=tolerance, **parameters)
    if "delay_s" in parameters:
        parameters = {"delay_s": 0.3 / frequency_hz}
    scaled = design_shaper(name, Mode(frequency_hz, damping_ratio), tolerance=tolerance, **parameters)
    assert scaled.times_s * frequency_hz == pytest.approx(unit.times_s, rel=1e-13)
    assert scaled.amplitudes == pytest.approx(unit.amplitudes, rel=1e-12)


@SETTINGS
@given(damping_ratio=st.floats(0.0, 0.95), order=st.integers(0, LARGEST_ORDER))
def test_the_general_order_is_zv_convolved_with_itself(damping_ratio, order):
    mode = Mode(1.0, damping_ratio)
    two = design_shaper("zv", mode).amplitudes
    expected = np.ones(1)
    for _ in range(order + 1):
        expected = np.convolve(expected, two)
    shaper = design_shaper("zvm", mode, order=order)
    assert shaper.amplitudes == pytest.approx(expected, rel=1e-13)
    assert shaper.times_s == pytest.approx(0.5 * mode.damped_period_s * np.arange(order + 2), rel=1e-15)


@pytest.mark.parametrize(("name", "order"), [("zv", 0), ("zvd", 1), ("zvdd", 2), ("zvddd", 3)])
def test_the_named_orders_are_those_of_the_general_family(name, order):
    named, general = design_shaper(name, Mode(1.0, 0.1)), design_shaper("zvm", Mode(1.0, 0.1), order=order)
    assert named.amplitudes.tolist() == general.amplitudes.tolist()
    assert named.times_s.tolist() == general.times_s.tolist()


def test_undamped_zv_has_two_equal_impulses_half_a_period_apart():
    shaper = design_shaper("zv", Mode(0.25))
    assert (shaper.times_s.tolist(), shaper.amplitudes.tolist()) == ([0.0, 2.0], [0.5, 0.5])


@SETTINGS
@given(damping_ratio=st.floats(0.0, 0.95))
def test_mzv_cancels_exactly_at_any_damping(damping_ratio):
    shaper = design_shaper("mzv", Mode(1.0, damping_ratio))
    assert float(residual_vibration(shaper, 1.0, damping_ratio=damping_ratio)) < 1e-15
    assert shaper.times_s[1:] == pytest.approx(
        np.array([0.375, 0.75]) * Mode(1.0, damping_ratio).damped_period_s
    )


def test_undamped_mzv_has_the_known_amplitudes():
    side = 1.0 - 1.0 / math.sqrt(2.0)
    assert design_shaper("mzv", Mode(1.0)).amplitudes == pytest.approx(
        [side, 1.0 - 2.0 * side, side], rel=1e-15
    )


@pytest.mark.parametrize("tolerance", [0.02, 0.05, 0.1])
def test_undamped_ei_has_the_closed_form(tolerance):
    shaper = design_shaper("ei", Mode(1.0), tolerance=tolerance)
    outer, middle = 0.25 * (1.0 + tolerance), 0.5 * (1.0 - tolerance)
    assert shaper.amplitudes == pytest.approx([outer, middle, outer], rel=1e-15)
    assert shaper.times_s == pytest.approx([0.0, 0.5, 1.0], rel=1e-15)


def test_undamped_um_zv_is_a_sixth_and_a_third_of_the_period():
    assert design_shaper("um-zv", Mode(1.0)).times_s == pytest.approx([0.0, 1.0 / 6.0, 1.0 / 3.0], rel=1e-15)


def test_undamped_um_zvd_lasts_73_percent_of_the_period():
    assert design_shaper("um-zvd", Mode(1.0)).duration_s == pytest.approx(0.7325, abs=5e-5)  # digits shown


@pytest.mark.parametrize(
    ("name", "tolerance", "limit"),
    [
        ("ei3", 0.05, 0.2756),
        ("ei3", 0.1, 0.2063),
        ("ei2", 0.1, 0.2903),
        ("ei2", 0.05, 0.4504),
        ("ei", 0.1, 0.5959),
    ],
)
def test_a_branch_that_ends_is_designed_up_to_its_end_and_refused_beyond_with_the_limit(
    name, tolerance, limit
):
    below = design_shaper(name, Mode(1.0, limit - 1e-3), tolerance=tolerance)
    assert below.guarantee.worst_residual_ratio == pytest.approx(tolerance, rel=1e-9)
    with pytest.raises(DesignError) as refused:
        design_shaper(name, Mode(1.0, limit + 1e-3), tolerance=tolerance)
    stated = float(str(refused.value).split("damping_ratio ")[1].split(",")[0])
    assert str(refused.value).startswith(f"{name} at tolerance {tolerance} exists up to damping_ratio ")
    assert str(refused.value).endswith(f"got {limit + 1e-3:.6g}")
    assert stated == pytest.approx(limit, abs=1.5e-4)  # four digits are printed, rounded down


@pytest.mark.parametrize(
    ("name", "tolerance", "damping_ratio"),
    [("ei", 0.999999, 0.1), ("um-zvd", 0.05, 0.9999), ("ei2", 2.4e-5, 0.99)],
)
def test_at_the_extremes_a_design_either_holds_or_names_its_limit(name, tolerance, damping_ratio):
    # Tolerances near 1 and dampings near 1, where impulses merge and the equations become singular.
    with pytest.raises(DesignError, match=r"exists up to damping_ratio 0\.\d{4}, got"):
        design_shaper(name, Mode(1.0, damping_ratio), tolerance=tolerance)


def test_an_unknown_family_names_the_nearest_known_ones():
    with pytest.raises(DesignError, match=r"family 'zvdx' is unknown; did you mean: zvd"):
        design_shaper("zvdx", Mode(1.0))
    with pytest.raises(DesignError, match=r"family 'quux' is unknown; did you mean: zv, zvd, .*oatf\?"):
        design_shaper("quux", Mode(1.0))


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("zv", {"order": 2}, "zv takes no order, got 2"),
        ("ei", {"delay_s": 0.3}, "ei takes no delay_s, got 0.3"),
        ("zvm", {}, "zvm needs order"),
        ("oatf", {}, "oatf needs delay_s"),
    ],
)
def test_parameters_that_a_family_lacks_or_has_no_use_for_are_refused(name, given, message):
    with pytest.raises(DesignError, match=f"^{message}$"):
        design_shaper(name, Mode(1.0), **given)


@pytest.mark.parametrize("order", [-1, LARGEST_ORDER + 1, 1.0, True])
def test_orders_out_of_range_are_refused(order):
    with pytest.raises(DesignError, match=r"order = .*: must be a whole number from 0 to 18"):
        design_shaper("zvm", Mode(1.0), order=order)


def test_the_largest_order_is_the_last_whose_outer_impulses_still_count():
    assert 2.0 ** -(LARGEST_ORDER + 1) >= 1e-6 > 2.0 ** -(LARGEST_ORDER + 2)


@pytest.mark.parametrize("tolerance", [0.0, -0.1, 1.0, 1e-7, math.nan])
@pytest.mark.parametrize("name", ["ei", "ei2", "ei3", "um-ei"])
def test_hump_tolerances_out_of_range_are_refused(name, tolerance):
    with pytest.raises(DesignError, match=r"tolerance = .*: must be at least 1e-06 and below 1"):
        design_shaper(name, Mode(1.0), tolerance=tolerance)


@pytest.mark.parametrize("delay_s", [0.0, -0.1, math.inf, math.nan])
def test_delays_that_are_not_finite_and_positive_are_refused(delay_s):
    with pytest.raises(DesignError, match=r"delay_s = .*: must be finite and > 0"):
        design_shaper("oatf", Mode(1.0), delay_s=delay_s)


@pytest.mark.parametrize("delay_s", [1e-4, 1.0, 2.0003])
def test_delays_near_a_whole_number_of_periods_are_refused(delay_s):
    with pytest.raises(DesignError, match=r"damped periods are too near a whole number .* at least 0\.001"):
        design_shaper("oatf", Mode(1.0), delay_s=delay_s)


@SETTINGS
@given(
    name=st.sampled_from(["ei", "ei2", "ei3", "um-ei"]),
    damping_ratio=st.floats(0.0, 0.2),
    tolerance=st.floats(0.001, 0.1),
)
def test_at_the_mode_a_solved_family_has_its_hump_or_its_zero(name, damping_ratio, tolerance):
    shaper = design_shaper(name, Mode(1.0, damping_ratio), tolerance=tolerance)
    ratio, slope_s = residual_vibration_and_slope(shaper, 1.0, damping_ratio=damping_ratio)
    if FAMILIES[name].zero_orders is None:
        assert float(ratio) == pytest.approx(tolerance, abs=1e-14)
        assert (
            abs(float(slope_s)) < 1e-11
        )  # near the end of the branch the equations are that badly conditioned
    else:
        assert float(ratio) < 1e-14
