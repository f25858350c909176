"""Convolved shapers: times add, amplitudes multiply, and the guarantee is proved again."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import convolve, design_shaper, guarantee_of, residual_vibration
from swayless.errors import DesignError
from swayless.plant import Mode

FAMILIES = ["zv", "zvd", "ei", "mzv", "um-zv"]


@settings(derandomize=True, deadline=None, max_examples=30)
@given(
    names=st.lists(st.sampled_from(FAMILIES), min_size=2, max_size=3),
    ratio=st.floats(1.3, 6.0),
    damping_ratio=st.floats(0.0, 0.1),
    frequency_hz=st.floats(0.01, 3.0),
)
def test_the_residual_of_a_convolution_is_the_product_of_residuals(names, ratio, damping_ratio, frequency_hz):
    shapers = [
        design_shaper(name, Mode(0.3 * ratio**place, damping_ratio)) for place, name in enumerate(names)
    ]
    # Unity-magnitude partners amplify elsewhere, so the band is asked for at a tolerance that always holds.
    both = convolve(*shapers, tolerance=0.9)
    product = np.prod(
        [residual_vibration(each, frequency_hz, damping_ratio=damping_ratio) for each in shapers]
    )
    assert float(residual_vibration(both, frequency_hz, damping_ratio=damping_ratio)) == pytest.approx(
        float(product), rel=1e-9, abs=1e-13
    )
    assert both.duration_s == pytest.approx(sum(each.duration_s for each in shapers), rel=1e-14)


def test_every_mode_is_suppressed():
    hook, load = Mode(0.5, 0.01), Mode(0.19, 0.01)
    both = convolve(design_shaper("ei", load), design_shaper("zvd", hook))
    for mode in (hook, load):
        assert guarantee_of(both, mode, tolerance=0.05).band.contains(mode.frequency_hz)


def test_zv_with_itself_is_zvd_with_the_coincident_impulses_merged():
    mode = Mode(0.7, 0.1)
    twice, zvd = convolve(design_shaper("zv", mode), design_shaper("zv", mode)), design_shaper("zvd", mode)
    assert twice.times_s == pytest.approx(zvd.times_s, rel=1e-15)
    assert twice.amplitudes == pytest.approx(zvd.amplitudes, rel=1e-15)


def test_impulses_that_cancel_are_dropped():
    short, long = design_shaper("um-zv", Mode(1.0)), design_shaper("um-zv", Mode(0.5))
    # In sixths of a second, +1 -1 +1 at 0, 1, 2 with +1 -1 +1 at 0, 2, 4: both signs meet at 2 and at 4.
    both = convolve(short, long, tolerance=0.5)
    assert both.times_s * 6.0 == pytest.approx([0.0, 1.0, 3.0, 5.0, 6.0], rel=1e-14)
    assert both.amplitudes.tolist() == [1.0, -1.0, 1.0, -1.0, 1.0]


def test_the_guarantee_is_that_of_the_first_mode_unless_another_is_named():
    first, second = design_shaper("ei", Mode(0.2), tolerance=0.03), design_shaper("zv", Mode(0.5))
    assert convolve(first, second).guarantee.mode == Mode(0.2)
    assert convolve(first, second).guarantee.tolerance == 0.03
    other = convolve(first, second, mode=Mode(0.5), tolerance=0.1).guarantee
    assert (other.mode, other.tolerance) == (Mode(0.5), 0.1)
    assert other.worst_residual_ratio <= 0.1 * (1.0 + 1e-9)


def test_the_convolution_is_named_after_its_factors_and_each_source_once():
    shaper = convolve(
        design_shaper("zv", Mode(0.2)), design_shaper("zvd", Mode(0.5)), design_shaper("ei", Mode(1.0))
    )
    assert shaper.family == "zv*zvd*ei"
    assert shaper.source.count("Magee") == 1
    assert "Singhose" in shaper.source


def test_one_shaper_alone_stays_as_it_is():
    only = design_shaper("ei2", Mode(1.0, 0.05))
    same = convolve(only)
    assert same.times_s.tolist() == only.times_s.tolist()
    assert same.amplitudes.tolist() == only.amplitudes.tolist()
    assert same.guarantee == only.guarantee


def test_a_mode_that_no_factor_suppresses_is_refused():
    pair = design_shaper("zv", Mode(0.2)), design_shaper("zv", Mode(0.5))
    with pytest.raises(DesignError, match="hold no band"):
        convolve(*pair, mode=Mode(0.02))
