"""Tables in pieces: what they play, how small they are found, and what they refuse."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.controller.number import number_type
from swayless.controller.profile import Pieces
from swayless.controller.profile.compression import TOLERANCE_RATIO, compressed, raw_pieces
from swayless.controller.profile.table import TablePlayer
from swayless.errors import ControllerError

NUMBERS = ("double", "float")
numbers = st.sampled_from(NUMBERS).map(number_type)


@st.composite
def tables(draw):
    """Pieces of any degree and length, numbers of the type; of numbers or of rows."""
    number, degree = draw(numbers), draw(st.integers(0, 9))
    lengths = draw(st.lists(st.integers(1, 40), min_size=1, max_size=6))
    columns = draw(st.sampled_from([(), (3,)]))
    seed = draw(st.integers(0, 2**32 - 1))
    values = np.random.default_rng(seed).normal(size=(len(lengths), degree + 1, *columns))
    return number, Pieces(lengths, values.astype(np.float32))


@settings(derandomize=True, deadline=None, max_examples=40)
@given(table=tables())
def test_tick_by_tick_and_all_at_once_play_the_same_bits(table):
    number, pieces = table
    player, scalar = TablePlayer(pieces, number), number.scalar
    if pieces.coefficients.ndim == 2:
        assert [player.next() for _ in range(pieces.ticks)] == pieces.values(number).tolist()
    else:
        # Rows are multiplied before the polynomial is evaluated, in the order in which the block does it.
        factors = [scalar(0.5), scalar(-0.25), scalar(1.5)]
        rows = pieces.coefficients
        summed = np.array([[(r[0] * 0.5 + r[1] * -0.25) + r[2] * 1.5 for r in piece] for piece in rows])
        played = [float(player.next(factors)) for _ in range(pieces.ticks)]
        expected = Pieces(pieces.lengths, summed).values(number)
        # In double the same bits; in float the sums here are not rounded on the way.
        assert played == pytest.approx(expected.tolist(), abs=0.0 if number.name == "double" else 1e-5)
    assert player.is_over


def test_the_local_variable_goes_from_minus_one_to_one():
    line = Pieces([5, 1], [[10.0, 2.0], [10.0, 2.0]])
    assert line.values(number_type("double")).tolist() == [8.0, 9.0, 10.0, 11.0, 12.0, 8.0]


@settings(derandomize=True, deadline=None, max_examples=40)
@given(table=tables())
def test_what_is_found_is_within_the_tolerance_and_no_larger_than_the_plain_table(table):
    number, pieces = table
    values = pieces.values(number)
    found = compressed(values, number, TOLERANCE_RATIO[number.name])
    near = TOLERANCE_RATIO[number.name] * np.abs(values).max()
    assert (np.abs(found.values(number) - values) <= near).all()
    assert found.stored_bytes(number) <= raw_pieces(values).stored_bytes(number)


@pytest.mark.parametrize("number", NUMBERS)
def test_switch_times_are_found_bit_by_bit(number):
    values = np.repeat([0.75, -0.25, 0.5], [300, 1, 700])
    found = compressed(values, number_type(number), TOLERANCE_RATIO[number])
    assert found.lengths.tolist() == [300, 1, 700]
    assert found.degree == 0
    assert (found.values(number_type(number)) == values).all()


@pytest.mark.parametrize(("number", "expected"), [("double", 74), ("float", 38)])
def test_a_polynomial_of_degree_7_over_4000_ticks_is_one_piece(number, expected):
    time = np.linspace(0.0, 1.0, 4000)
    values = 35.0 * time**4 - 84.0 * time**5 + 70.0 * time**6 - 20.0 * time**7
    found = compressed(
        values.astype(np.float32) if number == "float" else values,
        number_type(number),
        TOLERANCE_RATIO[number],
    )
    assert (found.degree, found.lengths.tolist()) == (7, [4000])
    assert found.stored_bytes(number_type(number)) == expected  # 8 coefficients, a step and a length


def test_noise_is_kept_as_it_is():
    values = np.random.default_rng(5).normal(size=500)
    found = compressed(values, number_type("double"), TOLERANCE_RATIO["double"])
    assert found.is_raw
    assert (found.values(number_type("double")) == values).all()


def test_pieces_that_do_not_keep_what_is_promised_are_not_taken():
    values = np.repeat([1.0, -1.0], 50)
    double = number_type("double")
    assert compressed(values, double, 1e-12).degree == 0
    assert compressed(values, double, 1e-12, lambda pieces: pieces.degree != 0).degree == 1
    assert compressed(values, double, 1e-12, lambda pieces: False).is_raw


@pytest.mark.parametrize(
    ("lengths", "coefficients", "message"),
    [
        ([1, 2], [[1.0]], "pieces: lengths of shape (2,), coefficients of shape (1, 1): must be"),
        ([], np.zeros((0, 1)), "p >= 1"),
        ([0], [[1.0]], "pieces: lengths 0 to 0: must be 1 to 65535"),
        ([65536], [[1.0]], "pieces: lengths 65536 to 65536: must be 1 to 65535"),
        ([2], [[0.0] * 11], "pieces: 11 coefficients each: must be 1 to 10"),
        ([2], [[np.inf]], "pieces: every coefficient must be finite"),
    ],
)
def test_what_are_no_pieces_is_refused(lengths, coefficients, message):
    with pytest.raises(ControllerError) as refused:
        Pieces(lengths, coefficients)
    assert message in str(refused.value)


def test_int32_is_refused_with_the_reason():
    with pytest.raises(ControllerError, match="profile: number = 'int32': must be double or float; shapes"):
        Pieces([1], [[1.0]]).values(number_type("int32"))
