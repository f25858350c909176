"""Rows chosen by the measured rope: with hysteresis, at rest only, never by a reading that cannot be true."""

import dataclasses

import pytest

from swayless.controller import CommandShaper, ShaperInput
from swayless.controller.status import Status
from swayless.controller.taps import RopeRows
from swayless.errors import ControllerError
from tests.compiled.phase_blocks import chosen_by_rope
from tests.unit.controller.blocks import command_of

NUMBERS = ["double", "float", "int32"]


def at(settings, length_m, ratio=0.0, **fields):
    """Inputs on a rope."""
    whole = settings.number.is_integer
    length = round(1000 * length_m) if whole else settings.number.scalar(length_m)
    fields.setdefault("selector", 1)
    return ShaperInput(command_of(settings, ratio), rope_length=length, **fields)


@pytest.mark.parametrize("number", NUMBERS)
def test_the_row_follows_the_rope_with_hysteresis(number):
    settings = chosen_by_rope(number)
    shaper = CommandShaper(settings)
    seen = [shaper.step(at(settings, length)).row for length in (9, 6.6, 6.4, 6.9, 7.1, 3.5, 4.4, 4.6, 8.9)]
    assert seen == [1, 1, 2, 2, 1, 3, 3, 2, 1]


@pytest.mark.parametrize("number", NUMBERS)
def test_a_row_changes_at_rest_only_and_says_that_it_waits(number):
    settings = chosen_by_rope(number)
    shaper = CommandShaper(settings)
    shaper.step(at(settings, 8.0))
    length, moving = 8.0, []
    while length > 5.0:
        moving.append(shaper.step(at(settings, length, 1.0 if length % 0.2 < 0.1 else 0.5)))
        length -= 0.019
    assert {out.row for out in moving} == {1}
    assert moving[-1].status & Status.ROW_WAITS
    for _ in range(200):
        still = shaper.step(at(settings, length))
    assert still.row == 2
    assert not still.status & Status.ROW_WAITS


@pytest.mark.parametrize("number", NUMBERS)
def test_a_reading_that_cannot_be_true_chooses_no_row(number):
    settings = chosen_by_rope(number)
    shaper = CommandShaper(settings)
    shaper.step(at(settings, 8.0))
    out = shaper.step(at(settings, 3.2, rope_length_valid=False))
    assert (out.row, bool(out.status & Status.ROPE_INVALID)) == (1, True)


@pytest.mark.parametrize("number", NUMBERS)
def test_the_selector_only_says_whether_to_shape(number):
    settings = chosen_by_rope(number)
    shaper = CommandShaper(settings)
    assert shaper.step(at(settings, 5.0)).row == 2
    assert shaper.step(at(settings, 5.0, selector=0)).row == 0
    out = shaper.step(at(settings, 5.0, selector=2))
    assert (out.row, bool(out.status & Status.SELECTOR_INVALID)) == (0, True)
    assert shaper.step(at(settings, 5.0, enable=False)).row == 0


@pytest.mark.parametrize(
    ("lower", "upper"), [((6.0, 3.0), (9.0, 6.0)), ((3.0, 6.0), (6.5, 9.0)), ((6.0, 3.0), (9.0, 9.5))]
)
def test_rows_that_do_not_fall_and_overlap_are_refused(lower, upper):
    with pytest.raises(ControllerError, match="must fall and overlap"):
        RopeRows(lower, upper)


def test_a_bank_without_a_measured_rope_is_refused():
    with pytest.raises(ControllerError, match="chosen by it, need a measured rope"):
        dataclasses.replace(chosen_by_rope("double"), rope=None)
