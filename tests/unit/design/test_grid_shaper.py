"""The shaper on whole ticks as data: its invariants, and the decimal lattice of its amplitudes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from swayless.design.grid_shaper import GridShaper, decimal_amplitudes
from swayless.design.shaper import Guarantee
from swayless.errors import DesignError
from swayless.plant import Band, Mode

GUARANTEE = Guarantee(0.05, Mode(1.0), Band(0.97, 1.03), 0.05)


def test_times_are_whole_ticks():
    taps = GridShaper(np.array([0, 10]), np.array([0.5, 0.5]), 0.05, GUARANTEE)
    assert taps.times_s.tolist() == [0.0, 0.5]
    assert taps.duration_s == 0.5


def test_arrays_are_copied_and_frozen():
    delays_ticks, amplitudes = np.array([0, 10]), np.array([0.5, 0.5])
    taps = GridShaper(delays_ticks, amplitudes, 0.05, GUARANTEE)
    delays_ticks[1], amplitudes[1] = 11, 0.6
    assert taps.delays_ticks.tolist() == [0, 10]
    assert taps.amplitudes.tolist() == [0.5, 0.5]
    with pytest.raises(ValueError, match="read-only"):
        taps.amplitudes[0] = 1.0


@pytest.mark.parametrize(
    ("delays_ticks", "amplitudes", "tick_s", "reason"),
    [
        ([0, 1], [0.5, 0.25, 0.25], 0.01, r"must be non-empty and of one length"),
        ([], [], 0.01, r"must be non-empty and of one length"),
        ([[0, 1]], [[0.5, 0.5]], 0.01, r"must be non-empty and of one length"),
        ([1, 2], [0.5, 0.5], 0.01, r"whole ticks from 0 and increase, got \[1, 2\]"),
        ([0, 0], [0.5, 0.5], 0.01, r"whole ticks from 0 and increase, got \[0, 0\]"),
        ([0, 1.5], [0.5, 0.5], 0.01, r"whole ticks from 0 and increase"),
        ([0, 1], [0.5, 0.6], 0.01, r"multiples of 1e-12 with sum 1, got \[0\.5, 0\.6\]"),
        ([0, 1, 2], [1 / 3, 1 / 3, 1 / 3], 0.01, r"multiples of 1e-12 with sum 1"),
        ([0, 1], [math.nan, 0.5], 0.01, r"multiples of 1e-12 with sum 1, got \[nan, 0\.5\]"),
        ([0, 1], [0.5, 0.5], 0.0, r"tick_s = 0\.0: must be finite and > 0"),
    ],
)
def test_what_is_no_shaper_on_ticks_is_refused(delays_ticks, amplitudes, tick_s, reason):
    with pytest.raises(DesignError, match=reason):
        GridShaper(np.array(delays_ticks), np.array(amplitudes), tick_s, GUARANTEE)


def test_limits_of_partial_sums_survive_the_lattice():
    third = 1.0 / 3.0
    rounded = decimal_amplitudes(np.array([1.0, -third, third - 1.0, 1.0]))
    assert np.cumsum(np.rint(rounded * 1e12)).tolist() == [1e12, 666666666667.0, 0.0, 1e12]


def test_symmetric_amplitudes_stay_symmetric():
    outer, inner = 0.1597972012345678, 0.3402027987654322
    rounded = decimal_amplitudes(np.array([outer, inner, inner, outer]))
    assert rounded.tolist() == rounded[::-1].tolist()
