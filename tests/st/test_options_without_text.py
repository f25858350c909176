"""What Structured Text has no code for is refused: a pin that did nothing would be worse than none."""

from dataclasses import replace

import pytest

from swayless.codegen import generate
from swayless.controller.diagnostics import Diagnostics
from swayless.controller.operator_settings import OperatorSettings
from swayless.controller.tracking import TrackingSettings
from swayless.errors import CodegenError
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import ZVD, block


@pytest.mark.parametrize(
    "options",
    [
        {"operator": OperatorSettings(has_stop_switches=True)},
        {"operator": OperatorSettings(starts_from_zero=True)},
        {"diagnostics": Diagnostics(tracking=TrackingSettings(0.05, time_ticks=4, window_ticks=1))},
    ],
)
def test_optional_functions_are_refused(options):
    with pytest.raises(CodegenError, match=r"no code yet for steps, switches, .*; design the block without"):
        generate(replace(block(ZVD), **options), ORIGIN, "st")
