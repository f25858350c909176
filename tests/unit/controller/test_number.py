"""Number types and the lattice of their amplitudes."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller.number import amplitudes_on_lattice, as_written, number_type
from swayless.errors import ControllerError
from tests.properties.strategies import examples

BITS = [24, 30, 53]


@pytest.mark.parametrize("bits", BITS)
@examples(100)
@given(st.lists(st.floats(1e-6, 1.0), min_size=1, max_size=9))
def test_positive_amplitudes_sum_to_exactly_1_and_stay_positive(bits, weights):
    amplitudes = np.array(weights) / np.sum(weights)
    numerators = amplitudes_on_lattice(amplitudes, bits)
    assert sum(numerators) == 1 << bits
    assert min(numerators) >= 0
    # Half a unit for each of the two partial sums, and what the weights are off 1 by.
    assert np.abs(np.array(numerators) / 2.0**bits - amplitudes).max() <= 2.0**-bits + 1e-15


@pytest.mark.parametrize("bits", BITS)
@examples(100)
@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=8))
def test_partial_sums_within_0_and_1_are_so_exactly(bits, inner):
    amplitudes = np.diff([0.0, *inner, 1.0])  # the differences and their sums are rounded
    sums = np.cumsum(np.array(amplitudes_on_lattice(amplitudes, bits), dtype=object))
    assert sums[-1] == 1 << bits
    assert min(sums) >= 0
    assert max(sums) <= 1 << bits


@pytest.mark.parametrize("bits", BITS)
def test_a_partial_sum_below_0_by_rounding_is_0(bits):
    # 1 - 0.9 - 0.1 is 2.8e-17 below 0 in doubles: a unit of the finest lattice would be 1.1e-16.
    numerators = amplitudes_on_lattice([1.0, -0.9, -0.1000000000000003, 1.0], bits)
    assert np.cumsum(numerators).tolist()[2:] == [0, 1 << bits]


def test_a_partial_sum_beyond_1_by_more_than_rounding_is_kept():
    numerators = amplitudes_on_lattice([1.5, -1.0, 0.5], 30)
    assert numerators == [3 << 29, -(1 << 30), 1 << 29]


@pytest.mark.parametrize("amplitudes", [[0.5, 0.4], [1.0, 1e-9], []])
def test_amplitudes_that_do_not_sum_to_1_are_refused(amplitudes):
    with pytest.raises(ControllerError, match="not to 1"):
        amplitudes_on_lattice(amplitudes, 53)


def test_an_unknown_number_type_is_refused_with_those_that_exist():
    with pytest.raises(ControllerError, match="number = 'int16': must be one of double, float, int32"):
        number_type("int16")


@examples(100)
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_as_written_reads_back_to_the_same_float(value):
    assert float(as_written(value)) == value


def test_as_written_is_what_a_person_wrote_also_in_numpy():
    assert as_written(np.float64(0.1)) == Fraction(1, 10)
