"""Stimuli of the operator's functions: only where a block has them, and every bit that they can raise."""

import numpy as np
import pytest

from swayless.controller.status import Status
from swayless.verify.operator_stimulus import habits
from swayless.verify.reference_run import run_reference
from swayless.verify.stimulus import soak, stimuli
from tests.properties.test_operator_everything import everything
from tests.unit.controller.blocks import ZVD, block
from tests.unit.controller.operator_blocks import operator_block


def test_a_block_without_such_functions_is_put_through_what_it_was():
    names = [stimulus.name for stimulus in stimuli(block(ZVD), ticks=50)]
    assert names == ["steps", "pendant jogs", "random joystick", "knob", "stops", "bad input"]


def test_each_function_has_its_stimulus():
    names = [name for name, _ in habits(everything("zvd", "double"))]
    assert names == ["step buttons", "switches at the ends", "ways to the ends", "drive trips", "tuning"]
    assert habits(operator_block("zvd", "float", slow_speed_m_s=0.1))[0][0] == "switches at the ends"
    assert habits(operator_block("zvd", "float", start_from_zero=True)) == []


@pytest.mark.parametrize(("kind", "number"), [("zvd", "double"), ("um-split", "int32"), ("phase", "float")])
def test_stimuli_raise_every_bit_of_the_status_word_that_the_block_can_set(kind, number):
    settings = everything(kind, number)
    absent = Status.BELOW_MINIMUM | Status.INCHING  # no such limits
    if kind != "um-split":
        absent |= Status.COMMAND_WAITS  # no row waits
    if number == "int32":
        absent |= Status.COMMAND_INVALID  # whole numbers are always finite
    made = [*stimuli(settings, ticks=1000), soak(settings, ticks=3000)]
    bits = 0
    for stimulus in made:
        bits |= int(np.bitwise_or.reduce(run_reference(settings, stimulus.inputs)["status"]))
    assert [bit.name for bit in settings.status_bits if not (bits | absent) & bit] == []
    assert {stimulus.inputs.dtype for stimulus in made} == {made[0].inputs.dtype}
