"""What a block measures: names of pins, words of texts, and which ranges a rope and an arm may have."""

import pytest

from swayless.controller import Status, explain, number_type
from swayless.controller.measured import ARM_ANGLE, ARM_POSITION, ROPE
from swayless.controller.rope import Rope, rope_settings
from swayless.controller.status import ROPE_BITS
from swayless.errors import ControllerError

ARMS = [ARM_POSITION, ARM_ANGLE]


def read(shortest, longest, measured, number="double"):
    return rope_settings((shortest, longest), 0.5, tick_s=0.01, number=number_type(number), measured=measured)


def test_pins_in_both_languages_and_both_kinds_of_numbers():
    names = {
        measured: (
            *(f(is_integer=whole) for whole in (False, True) for f in (measured.c_value, measured.c_speed)),
        )
        for measured in (ROPE, *ARMS)
    }
    assert names[ROPE] == ("rope_length_m", "hoist_speed_m_s", "rope_length_mm", "hoist_speed_mm_s")
    assert names[ARM_POSITION] == ("position_m", "position_speed_m_s", "position_mm", "position_speed_mm_s")
    assert names[ARM_ANGLE] == (
        "position_rad",
        "position_speed_rad_s",
        "position_mrad",
        "position_speed_mrad_s",
    )
    assert (ROPE.c_valid, ROPE.st_valid) == ("rope_length_valid", "RopeLengthValid")
    assert {(arm.c_valid, arm.st_valid) for arm in ARMS} == {("position_valid", "PositionValid")}


def test_texts_of_an_arm_name_neither_rope_nor_hoist_and_those_of_a_rope_stay():
    for bit in Status:
        assert ROPE.explain(bit) == explain(bit)
        if bit & ROPE_BITS:
            assert not {"rope", "hoist"} & set(ARM_POSITION.explain(bit).split())


@pytest.mark.parametrize(("low", "high"), [(0.0, 3.0), (-1.0, 3.0), (3.0, 3.0), (4.0, 3.0)])
def test_a_rope_is_above_0_and_has_a_range(low, high):
    with pytest.raises(ControllerError, match=r"rope length .*: a measured rope needs two lengths"):
        read(low, high, ROPE)


@pytest.mark.parametrize("arm", ARMS)
def test_an_arm_may_stand_at_0_and_below_but_has_a_range(arm):
    assert (read(-0.5, 0.5, arm).shortest, read(-0.5, 0.0, arm, "int32").shortest) == (-0.5, -500)
    for low, high in ((0.5, 0.5), (0.5, -0.5)):
        with pytest.raises(ControllerError, match=r"position .*: must be two places, the lower one first"):
            read(low, high, arm)


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_positions_below_0_are_read_as_any_others(number):
    kind = number_type(number)
    rope = Rope(read(-0.5, 0.5, ARM_POSITION, number), kind)
    scale = 1000 if kind.is_integer else 1
    taken = []
    for place in (-0.2, 0.0, -0.7, 0.3):
        bits = rope.read(kind.scalar(place * scale), kind.scalar(0), valid=True, at_rest=True)
        taken.append((float(rope.length) / scale, Status(bits)))
    clamped = Status.ROPE_OUT_OF_RANGE
    expected = [(-0.2, Status(0)), (0.0, Status(0)), (-0.5, clamped), (0.3, Status(0))]
    assert taken == [(pytest.approx(place, abs=1e-7), bits) for place, bits in expected]  # float32
