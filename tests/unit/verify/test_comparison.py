"""Comparison is bit for bit: it sees one bit, the sign of zero and NaN, and says where."""

import numpy as np
import pytest

from swayless.verify.comparison import Comparison, compare

KIND = np.dtype([("reference", np.float64), ("row", np.uint8)])


def outputs(*rows):
    return np.array(list(rows), dtype=KIND)


def test_equal_runs_have_no_difference():
    run = outputs((0.1, 1), (np.nan, 2))
    assert compare(run, run.copy()) == Comparison(0, 0.0, None)
    assert compare(run, run.copy()).is_equal


@pytest.mark.parametrize("value", [1.0, -1.0, 5e-324, -5e-324, 1e308, 0.1])
def test_one_bit_is_one_ulp(value):
    found = compare(outputs((value, 0)), outputs((np.nextafter(value, np.inf), 0)))
    assert found.max_ulp == 1
    assert not found.is_equal


def test_the_sign_of_zero_is_a_difference():
    found = compare(outputs((0.0, 0)), outputs((-0.0, 0)))
    assert (found.max_ulp, found.max_abs) == (1, 0.0)
    assert found.first_difference == "tick 0, reference: expected 0.0, got -0.0"


def test_the_first_difference_names_tick_and_field():
    found = compare(outputs((0.0, 1), (0.0, 1), (0.0, 1)), outputs((0.0, 1), (0.0, 2), (1.0, 1)))
    assert found.first_difference == "tick 1, row: expected 1, got 2"
    assert found.max_abs == 1.0


def test_a_nan_for_a_number_is_an_infinite_difference():
    assert compare(outputs((1.0, 0)), outputs((np.nan, 0))).max_abs == np.inf


def test_a_missing_tick_is_a_difference():
    assert (
        compare(outputs((0.0, 0), (0.0, 0)), outputs((0.0, 0))).first_difference == "expected 2 ticks, got 1"
    )
