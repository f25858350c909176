"""Literals read back to the same bits of the target type."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.codegen.literals import ST_LARGEST, c_literal, shortest, st_literal
from swayless.controller import number_type
from swayless.errors import CodegenError
from tests.properties.strategies import examples

DOUBLE, FLOAT, INT32 = (number_type(name) for name in ("double", "float", "int32"))
doubles = st.floats(allow_nan=False, allow_infinity=False)
floats = st.floats(width=32, allow_nan=False, allow_infinity=False).map(np.float32)
C_FLOATING = re.compile(r"-?[0-9]+\.[0-9]+(e[+-][0-9]{2,3})?f?")
ST_REAL = re.compile(r"-?[0-9]+\.[0-9]+(E[+-][0-9]{2,3})?")


def same_bits(value, text, kind):
    return kind(text).tobytes() == kind(value).tobytes()


@examples(500)
@given(doubles)
def test_a_double_in_c_reads_back_to_the_same_bits(value):
    text = c_literal(value, DOUBLE)
    assert C_FLOATING.fullmatch(text)
    assert same_bits(value, text, np.float64)


@examples(500)
@given(floats)
def test_a_float_in_c_reads_back_to_the_same_bits_also_by_way_of_a_double(value):
    text = c_literal(value, FLOAT)
    assert C_FLOATING.fullmatch(text)
    assert text.endswith("f")
    digits = text.removesuffix("f")
    assert same_bits(value, digits, np.float32)
    # A compiler without float literals rounds twice, and must come to the same.
    assert same_bits(value, float(digits), np.float32)


@examples(500)
@given(st.one_of(doubles.map(lambda v: (v, DOUBLE)), floats.map(lambda v: (v, FLOAT))))
def test_a_literal_of_structured_text_has_a_point_and_reads_back_to_the_same_bits(case):
    value, number = case
    if abs(float(value)) >= ST_LARGEST:
        with pytest.raises(CodegenError, match="not portable"):
            st_literal(value, number)
        return
    text = st_literal(value, number)
    assert ST_REAL.fullmatch(text)
    assert same_bits(value, text, np.float64 if number is DOUBLE else np.float32)


@examples(200)
@given(doubles)
def test_no_shorter_text_reads_back_to_the_same_double(value):
    digits = re.sub(r"e.*|[-.]", "", shortest(value, DOUBLE)).strip("0")
    assert len(digits) <= len(re.sub(r"e.*|[-.]", "", repr(value)).strip("0"))


@examples(100)
@given(st.integers(-(2**31), 2**31 - 1))
def test_an_integer_is_printed_as_it_is(value):
    assert c_literal(value, INT32) == str(value)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("number", [DOUBLE, FLOAT])
def test_what_is_not_finite_has_no_literal(value, number):
    with pytest.raises(CodegenError, match="is not finite and has no literal"):
        c_literal(value, number)
