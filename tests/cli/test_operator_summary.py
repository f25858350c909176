"""What a build says of steps, ends and contactors, driven on a trolley that follows its reference."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.cli.operator_summary import operator_document, operator_remarks
from swayless.cli.simulated_control import Press, shaped_reference
from swayless.controller import CommandShaper, Status
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.functions import undisturbed
from swayless.machine.running import shaper_settings

CRANE = """name = "yard"
[crane]
rope_length = [4, 8]
max_speed = 0.5
acceleration = 0.4
quick_stop = 0.8
[controller]
tick = 0.02
number = "int32"
EXTRA
[[row]]
name = "long"
family = "zvd"
rope_length = 7
[[row]]
name = "short"
family = "FAMILY"
rope_length = 5
"""

FUNCTIONS = """start_from_zero = true
[drive]
counts_per_m_s = 777777
feedback = true
[steps]
sizes = ["50 mm", "100 mm", "250 mm"]
speed = 0.2
[limits]
stop_switches = true
slow_speed = 0.1
margin = 0.3
[tuning]
speed_limit = true
"""

CONTACTOR = """name = "hoist"
[crane]
rope_length = [4, 8]
max_speed = 0.5
[drive]
contactor = true
contactor_speeds = [0.1, 0.5]
[controller]
tick = 0.02
[[row]]
name = "one"
family = "um-zv"
rope_length = 6
tolerance = 0.1
"""


def block(folder, text, number=None):
    path = folder / "crane.toml"
    path.write_text(text)
    return shaper_settings(design_machine(load_machine(path)), number=number)


@pytest.fixture(scope="module", params=["zvd", "um-zv"])
def crane(request, tmp_path_factory):
    """The text of a crane whose rows wait, or do not."""
    return CRANE.replace("EXTRA", FUNCTIONS).replace("FAMILY", request.param)


class Runway:
    """A crane that runs forward at full speed, and where it is."""

    def __init__(self, settings, row):
        self.settings, self.shaper, self.position_m = settings, CommandShaper(settings), 0.0
        self.inputs = undisturbed(settings)._replace(selector=row)
        self.shaper.step(self.inputs)
        self.inputs = self.inputs._replace(command=settings.limits.max_command)

    def run(self, ticks, until=lambda out: False, **inputs):
        for _ in range(ticks):
            out = self.shaper.step(self.inputs._replace(**inputs))
            self.position_m += float(out.reference) / self.settings.limits.units_per_m_s * 0.02
            if until(out):
                break
        return out


@pytest.mark.parametrize("number", ["double", "int32"])
@pytest.mark.parametrize("row", [1, 2])
def test_switches_where_the_build_says_end_every_run_before_the_end(crane, row, number, tmp_path):
    settings = block(tmp_path, crane, number)
    told, runway = operator_document(settings), Runway(settings, row)
    runway.run(800)
    slow_at_m = runway.position_m
    while runway.position_m < slow_at_m + told["slow_switch_m"]:
        out = runway.run(1, slow_forward=True)
    # The slow speed is cut to a step of the ramp; the switch was reached within the tick that has just ended.
    assert float(out.reference) / settings.limits.units_per_m_s == pytest.approx(0.1, abs=2e-4)
    stop_at_m = runway.position_m
    runway.run(300, slow_forward=True, stop_forward=True)
    # 1 mm: the stop distance of int32 is in whole mm.
    assert runway.position_m - stop_at_m == pytest.approx(told["stop_switch_m"], abs=1e-3)


def test_distances_slow_down_from_where_the_build_says_and_stop_at_the_margin(crane, tmp_path):
    settings = block(tmp_path, crane, "double")
    told = operator_document(settings)
    for row in (1, 2):
        runway, end_m = Runway(settings, row), 20.0
        for _ in range(6000):
            before_m = end_m - runway.position_m
            out = runway.run(1, distance_forward=before_m, distance_reverse=100.0)
            if not out.status & Status.WAY_LIMITS:
                limited_m = before_m
        # 10 mm are the way of a tick at full speed: one in the tick that still fits, one until the bit.
        assert limited_m <= told["slows_from_m"] + 0.0201
        # From rest nothing moves for less than 10 mm; the sums of double are right to a nanometre.
        assert 0.3 - 1e-9 <= end_m - runway.position_m <= 0.31


def test_steps_are_said_as_exactly_as_they_are(crane, tmp_path):
    settings = block(tmp_path, crane)
    ways_m = operator_document(settings)["steps_m"]
    assert ways_m != [0.05, 0.1, 0.25]
    for size, way_m in enumerate(ways_m, start=1):
        runway = Runway(settings, 1)
        runway.run(1, command=0, step_forward=True, step_size=size)
        runway.run(2000, command=0)
        # Nine digits are printed.
        assert runway.position_m == pytest.approx(way_m, rel=1e-8)


def test_float_blocks_make_the_steps_that_were_asked_for(crane, tmp_path):
    assert operator_document(block(tmp_path, crane, "double"))["steps_m"] == [0.05, 0.1, 0.25]


def test_a_build_says_all_of_it_in_words(crane, tmp_path):
    settings = block(tmp_path, crane)
    told, lines = operator_document(settings), list(operator_remarks(settings))
    one, two, three = told["steps_m"]
    assert lines == [
        f"steps: {one}, {two} and {three} m, at most {told['step_speed_m_s']:.6g} m/s",
        f"slow-down switch: {told['slow_switch_m']:.3f} m before the stop switch or the end, to be at "
        f"{told['slow_speed_m_s']:.6g} m/s there",
        f"stop switch: {told['stop_switch_m']:.3f} m before the end, for the quick stop",
        "distances: stops 0.3 m before an end, and slows down from "
        f"{told['slows_from_m']:.3f} m before it at full speed",
    ]


def test_contactors_have_no_speeds_between_and_their_wait_is_said(tmp_path):
    settings = block(tmp_path, CONTACTOR)
    (*_, line) = operator_remarks(settings)
    assert line == (
        "contactors: 0, 0.1 and 0.5 m/s and nothing between; a new command waits until the last one has "
        "settled, up to 1.64 s"
    )
    assert operator_document(settings)["contactor_wait_s"] == 1.64


def test_a_block_without_functions_says_nothing(tmp_path):
    plain = block(
        tmp_path, CRANE.replace("EXTRA", "[drive]\ncounts_per_m_s = 777777").replace("FAMILY", "zvd")
    )
    assert (list(operator_remarks(plain)), operator_document(plain)) == ([], {})


@pytest.mark.parametrize("first", [0, 3])
def test_functions_that_nobody_touches_leave_a_simulated_move_as_it_is(first, tmp_path):
    """A move may begin in its first tick, also of a block that waits for a 0."""
    full, plain = (
        block(tmp_path, CRANE.replace("EXTRA", extra).replace("FAMILY", "zvd"), "double")
        for extra in (FUNCTIONS, "[drive]\ncounts_per_m_s = 777777\n")
    )
    runs = [
        shaped_reference(each, 1, Press(first, first + 500), 0.4, (None, 6.0)).reference_m_s
        for each in (full, plain)
    ]
    np.testing.assert_array_equal(*runs)
    assert (runs[0][first], runs[0].max()) == (pytest.approx(0.002, rel=0.02), pytest.approx(0.4))
