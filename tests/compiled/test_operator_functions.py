"""Generated C of the operator's functions and diagnostics equals the reference in every bit. No tolerance."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from swayless.codegen import GeneratedFile, c_harness, generate
from swayless.controller.diagnostics import Diagnostics
from swayless.controller.operator_settings import NO_OPTIONS
from swayless.controller.tables import design_facts
from swayless.verify import COMPILERS, compare, find_compiler
from swayless.verify.c_run import CompiledBlock
from swayless.verify.operator_stimulus import habits
from swayless.verify.reference_run import run_reference
from swayless.verify.stimulus import soak, stimuli
from tests.compiled.operated_blocks import ALONE, BLOCKS, DESIGN_ID, alone
from tests.unit.codegen.test_provenance import ORIGIN

PRESENT = [compiler for compiler in COMPILERS if compiler.name == "zig" or compiler.is_installed()]
"""zig comes with the [verify] extra and must be there; gcc and clang are the machine's own."""

NUMBERS = ["double", "float", "int32"]
RANDOM_TICKS, SOAK_TICKS, CHANGED_TICKS = 300, 2000, 4000
CASES = [
    *(("mixed", number) for number in NUMBERS),
    *(("phase", number) for number in NUMBERS),
    *(("by rope", "double"), ("by rope", "int32")),
    *(("contactor", "float"), ("contactor", "int32")),
    *(("modified", "float"), ("original", "int32")),
]
"""Each law, each number type, each function; the laws by themselves are proven in the other tests."""


def compiled(settings, compiler=None):
    """The block in C."""
    files, harness = generate(settings, ORIGIN, "c"), c_harness(settings, ORIGIN)
    return CompiledBlock(files, harness, compiler or find_compiler(), settings)


def finds(settings, change, runs):
    """Whether runs tell a source with one line changed from the reference; compiled in haste."""
    header, source, _ = generate(settings, ORIGIN, "c")
    old, new = change
    assert old in source.text
    changed = GeneratedFile(source.path, source.text.replace(old, new, 1))
    hasty = replace(find_compiler(), strict=("-std=c99", "-O0", "-ffp-contract=off"))
    with CompiledBlock((header, changed), c_harness(settings, ORIGIN), hasty, settings) as made:
        return any(not compare(out, made.run(inputs)).is_equal for inputs, out in runs)


@cache
def reference(name, number):
    """Settings, and inputs and outputs of every stimulus."""
    settings = BLOCKS[name](number)
    made = [*stimuli(settings, ticks=RANDOM_TICKS), soak(settings, ticks=SOAK_TICKS)]
    return settings, {each.name: (each.inputs, run_reference(settings, each.inputs)) for each in made}


@pytest.mark.parametrize(("name", "number"), CASES)
def test_every_output_equals_the_reference_bit_for_bit(name, number):
    settings, runs = reference(name, number)
    with compiled(settings) as made:
        found = {stimulus: compare(out, made.run(inputs)) for stimulus, (inputs, out) in runs.items()}
    assert "everything at once" in found
    assert [(stimulus, one.first_difference) for stimulus, one in found.items() if not one.is_equal] == []


@pytest.mark.parametrize("compiler", PRESENT[1:], ids=lambda compiler: compiler.name)
@pytest.mark.parametrize("case", [("mixed", "int32"), ("by rope", "double")], ids=str)
def test_every_compiler_on_this_machine_agrees(case, compiler):
    settings, runs = reference(*case)
    with compiled(settings, compiler) as made:
        assert all(compare(out, made.run(inputs)).is_equal for inputs, out in runs.values())


@pytest.mark.parametrize("number", ["double", "int32"])
@pytest.mark.parametrize("name", ALONE)
def test_each_function_by_itself_equals_the_reference(name, number):
    settings = alone(name, number)
    stimulus = soak(settings, ticks=1000)
    with compiled(settings) as made:
        assert compare(run_reference(settings, stimulus.inputs), made.run(stimulus.inputs)).is_equal


def only(settings, name):
    """The block with one of its diagnostics."""
    asked = Diagnostics(**{name: getattr(settings.diagnostics, name)})
    bare = replace(settings, diagnostics=asked)
    facts = None if asked.facts is None else design_facts(bare, 7)
    return replace(bare, diagnostics=replace(asked, facts=facts))


@pytest.mark.parametrize("number", ["double", "int32"])
def test_each_diagnostic_by_itself_equals_the_reference(number):
    by_rope = replace(reference("by rope", number)[0], operator=NO_OPTIONS)
    for name in ("sway", "rope_bounds", "tracking", "facts"):
        one = only(by_rope, name)
        stimulus = soak(one, ticks=500)
        with compiled(one) as made:
            assert compare(run_reference(one, stimulus.inputs), made.run(stimulus.inputs)).is_equal


def test_the_identifier_of_the_design_is_an_output_and_a_macro():
    settings, runs = reference("mixed", "double")
    assert f"CRANE_SHAPER_DESIGN_ID ((uint32_t)0x{DESIGN_ID:08X}u)" in generate(settings, ORIGIN, "c")[0].text
    assert {int(out) for _, outs in runs.values() for out in np.unique(outs["design_id"])} == {DESIGN_ID}


CHANGES = {
    "a press counts while held": ("s->armed_forward = !input->step_forward;", "s->armed_forward = true;"),
    "a refusal is forgotten": ("s->refusal = 0u;\n    } else {", "} else { s->refusal = 0u;"),
    "presses begin a new sum": ("s->queued = s->queued + way;", "s->queued = way;"),
    "a press is lost": ("s->left = s->left + s->queued;", "s->left = s->left;"),
    "the row changes under steps": ("!s->row_locked && ", ""),
    "a stop leaves steps": ("    s->left = 0.0;\n    s->queued = 0.0;\n", ""),
    "a command moves after steps": ("s->locked = true;", "s->locked = false;"),
    "a way is not used to its end": ("over = way - crane_way_down(command);", "over = 0.0;"),
    "a step up that cannot be undone": ("(crane_fits(up, way))", "(crane_fits(gentle, way))"),
    "a planned move holds too short": ("(crane_HOLD_TICKS * target)", "(0.5 * crane_HOLD_TICKS * target)"),
    "a way is not counted down": ("s->way_forward - s->reference", "s->way_forward"),
    "a trembling distance moves the crane": ("(left < crane_LEAST_WAY)", "(left < (0.0 * crane_LEAST_WAY))"),
    "a far way is short": ("s->way_reverse + crane_MAX_COMMAND", "s->way_reverse"),
    "steps pass the end": ("if (left < way) {", "if (left > way) {"),
    "a switch opens the way": ("(s->locked_forward || s->shut_forward)", "s->shut_forward"),
    "pending motion passes a switch": ("if (crane_shut(s, s->reference)) {", "if (false) {"),
    "a drive comes back at once": ("        s->quick = true;\n        s->reference", "        s->reference"),
    "a drive comes back from 0": ("s->drive_off && input->drive_ready;", "false && input->drive_ready;"),
    "a slow switch is forgotten": ("s->most_reverse = input->slow_reverse", "s->most_reverse = false"),
    "a speed limit is not clamped": ("s->speed_limit = limit;", "s->speed_limit = input->speed_limit;"),
    "the drive is watched too shortly": ("> crane_TRACKING_TICKS) {", ">= crane_TRACKING_TICKS) {"),
    "a window is forgotten": ("s->last_low = s->low;", "s->last_low = s->reference;"),
    "the sway is a tick late": ("return place * metres;", "return s->sway_place * metres;"),
    "steps are left out of the stop": (" + (s->left + s->queued);", " + s->left;"),
}


@cache
def hurried(name):
    """Settings, and long runs of each of the functions."""
    settings = BLOCKS[name]("double")
    asked = {"everything at once", *(name for name, _ in habits(settings))}
    made = [each.inputs for each in stimuli(settings, ticks=CHANGED_TICKS) if each.name in asked]
    return settings, [(inputs, run_reference(settings, inputs)) for inputs in made]


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_changed_line_is_found(change):
    settings, runs = hurried("mixed")
    assert finds(settings, change, runs)


AT_REST = {
    "a hit is seen in motion only": ("motion = crane_pending(s, s->row);", "motion = s->reference;"),
    "a speed between is taken": ("reach = crane_known(reach);", "reach = 0.9 * crane_known(reach);"),
    "a command between is taken": (
        "crane_known(crane_abs(command))",
        "(crane_known(0.1) + crane_abs(command))",
    ),
}


@pytest.mark.parametrize("change", AT_REST.values(), ids=AT_REST)
def test_a_changed_line_is_found_where_a_reference_is_0_while_more_is_pending(change):
    settings, runs = hurried("contactor")
    assert finds(settings, change, runs)
