"""The numbers by which a motion profile keeps its limits: one changed a little by hand is found."""

import re

import pytest

from swayless.codegen.profile_files import generate_profile
from swayless.codegen.profile_pins import OUTPUTS
from swayless.verify.comparison import compare
from swayless.verify.profile_stimulus import Operator, limits
from swayless.verify.records import record_of
from swayless.verify.st_run import EvaluatedProgram
from tests.compiled.profile_blocks import block

NAME = "polynomial, four states"


def is_found(code, text):
    """Whether the stimulus of the limits tells this text from the reference."""
    stimulus = limits(Operator(code, 5))
    found = EvaluatedProgram(text, record_of(OUTPUTS, code.settings.number)).run(stimulus.inputs)
    return not compare(stimulus.expected, found).is_equal


@pytest.mark.parametrize("constant", ["LowestReference", "HighestReference", "ShapeLow", "ShapeHigh"])
def test_a_limit_that_is_off_by_a_millionth_is_found(constant):
    code = block(NAME, "double")
    (file,) = generate_profile(code, "st")
    line = re.compile(rf"({constant} : LREAL := )(-?[\d.E+-]+)")
    changed, count = line.subn(lambda found: f"{found[1]}{float(found[2]) * (1.0 + 1e-6)!r}", file.text)
    assert count == 1
    assert is_found(code, changed)
    assert not is_found(code, file.text)
