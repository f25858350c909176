"""The checksum of tables: exact digits, and no changed bit that passes."""

import struct

import numpy as np
import pytest

from swayless.controller.checksum import MODULUS, Checksum, checksum, real_table, whole_table
from swayless.controller.number import number_type
from swayless.errors import ControllerError

DOUBLE, FLOAT = number_type("double"), number_type("float")


def doubles_with_one_bit_changed(value):
    (bits,) = struct.unpack("<Q", struct.pack("<d", value))
    return [struct.unpack("<d", struct.pack("<Q", bits ^ (1 << bit)))[0] for bit in range(64)]


def floats_with_one_bit_changed(value):
    bits = np.float32(value).view(np.uint32)
    return [(bits ^ np.uint32(1 << bit)).view(np.float32) for bit in range(32)]


def wholes_with_one_bit_changed(value):
    return [int(np.uint32(value & 0xFFFFFFFF ^ (1 << bit)).astype(np.int32)) for bit in range(32)]


def changed(table, flips):
    """The table with each bit of each number changed."""
    for place, number in enumerate(table.numbers):
        for other in flips(number):
            numbers = (*table.numbers[:place], other, *table.numbers[place + 1 :])
            yield type(table)(table.name, numbers, table.limit, table.digits)


@pytest.mark.parametrize(
    ("table", "flips"),
    [
        (real_table("a", [1.0, 0.2625, -0.7, 2.0**-53], DOUBLE), doubles_with_one_bit_changed),
        (real_table("b", [3.0, 0.0, 8.8392, 3e-5, 1e-12], DOUBLE), doubles_with_one_bit_changed),
        (
            real_table("c", [np.float32(x) for x in (1.0, 0.1, 0.0, 8.84, -3e-5)], FLOAT),
            floats_with_one_bit_changed,
        ),
        (
            whole_table("d", [0, 1, 65535, 65536, 1 << 30, -1, -65536, -(1 << 31)]),
            wholes_with_one_bit_changed,
        ),
    ],
    ids=["double", "double, wide", "float", "whole"],
)
def test_no_single_bit_of_any_number_changes_unseen(table, flips):
    found = checksum([table])
    for other in changed(table, flips):
        assert checksum([other]) != found or other.numbers == table.numbers  # the sign of a 0 is none


def test_the_digits_of_a_real_are_exact_and_so_a_sum_is_the_same_in_both_real_types():
    numbers = [0.25, 0.75, -0.5, 3.0]
    single = real_table("a", [np.float32(x) for x in numbers], FLOAT)
    assert checksum([real_table("a", numbers, DOUBLE)]) == checksum([single])


def test_the_order_of_numbers_and_of_tables_counts():
    one, two = whole_table("a", [1, 2]), whole_table("b", [2, 5])
    assert checksum([one, two]) != checksum([two, one])
    assert checksum([one]) != checksum([whole_table("a", [2, 1])])


def test_a_long_table_is_summed_as_fletcher_would():
    numbers = [(k * 40503) % 65536 for k in range(5000)]
    sums = (1 + np.cumsum(numbers)) % MODULUS
    # Each whole number is two digits, the higher one 0 here: every first sum counts twice but for the shift.
    before = np.concatenate([[1], sums[:-1]])
    second = int((sums + before).sum() % MODULUS)
    assert checksum([whole_table("a", numbers)]) == Checksum(int(sums[-1]), second)


def test_numbers_that_do_not_fit_are_refused():
    with pytest.raises(ControllerError, match="table a: 2147483648 has more than 32 bits"):
        whole_table("a", [1 << 31])
    with pytest.raises(ControllerError, match="table b: every number must be finite"):
        real_table("b", [float("nan")], DOUBLE)
    with pytest.raises(ControllerError, match="table c: 1e-60 and 1 are too far apart in size"):
        real_table("c", [1.0, 1e-60], DOUBLE)
