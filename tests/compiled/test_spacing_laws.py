"""Generated C of Magee and Book's laws equals the reference in every bit of every output. No tolerance."""

import re
from contextlib import contextmanager
from functools import cache

import numpy as np
import pytest

from swayless.codegen import GeneratedFile, c_harness, generate
from swayless.controller.spacing_filter import spacing_of
from swayless.controller.status import ROPE_BITS
from swayless.verify import compare, find_compiler
from swayless.verify.c_run import CompiledBlock
from swayless.verify.reference_run import run_reference
from swayless.verify.stimulus import soak, stimuli
from tests.compiled.spacing_blocks import BLOCKS
from tests.unit.codegen.test_provenance import ORIGIN

LAWS, NUMBERS = ("original", "modified"), ("double", "float", "int32")
CASES = [
    *(("rope", law, number) for law in LAWS for number in ("double", "int32")),
    *(("arm", law, "float") for law in LAWS),
    ("jumping", "original", "float"),
    ("jumping", "modified", "int32"),
]
RANDOM_TICKS, SOAK_TICKS = 1000, 4000


@contextmanager
def compiled(settings, change=("", "")):
    """The block in C, with one line changed."""
    header, source, example = generate(settings, ORIGIN, "c")
    old, new = change
    assert old in source.text
    made = (
        header,
        GeneratedFile(source.path, source.text.replace(old, new, 1) if old else source.text),
        example,
    )
    with CompiledBlock(made, c_harness(settings, ORIGIN), find_compiler(), settings) as block:
        yield block


@cache
def reference(name, law, number):
    """Settings, and what goes in and comes out."""
    settings = BLOCKS[name](law, number)
    made = [*stimuli(settings, ticks=RANDOM_TICKS), soak(settings, ticks=SOAK_TICKS)]
    return settings, {each.name: (each.inputs, run_reference(settings, each.inputs)) for each in made}


@pytest.mark.parametrize(("name", "law", "number"), CASES)
def test_every_output_equals_the_reference_bit_for_bit(name, law, number):
    settings, runs = reference(name, law, number)
    with compiled(settings) as block:
        found = {stimulus: compare(out, block.run(inputs)) for stimulus, (inputs, out) in runs.items()}
    assert len(found) == 14
    assert [(one, found[one].first_difference) for one in found if not found[one].is_equal] == []


CHANGES = {
    "a run keeps its number": ("original", "(s->run + 1u)", "s->run"),
    "what the base still releases is cut": ("original", "> s->age) {", "> (s->age + 1u)) {"),
    "a new spacing lets a steady command rest": ("original", "&& !crane_equal(s->command, 0.0)", "&& false"),
    "the spacing of the rest is that of now": ("original", "= s->spacing_before;", "= s->spacing;"),
    "a cell that is passed keeps its number": ("original", "s->runs[s->cell] = 0u;", "s->age += 0u;"),
    "a tap asks one sample only": (
        "modified",
        "crane_spacing_then(s, wanted)",
        "crane_spacing_then(s, s->delays[tap])",
    ),
    "a tap forgets its delay": ("modified", "s->delays[i - first] = delay;", "s->lapped = s->lapped;"),
    "a spacing before the run is that of now": ("modified", ": s->start_spacing;", ": s->spacing;"),
    "what is foretold stays": (
        "modified",
        "s->spacing = spacing;\n        s->foretold = false;",
        "s->spacing = spacing;",
    ),
    "the last piece is never found": ("modified", "end = crane_PIECES;", "end = crane_PIECES - 1u;"),
    "a piece begins after its start": ("modified", "(position < crane_PIECE", "(position <= crane_PIECE"),
    "sums of the lap before are forgotten": ("modified", "(s->lap_sum - ", "(s->sums[s->head] - "),
    "time left is that of the widest spacing": ("modified", "(lag - saved)", "lag"),
    "one command too few before the run": ("modified", "((delay - s->head) - 1u)", "(delay - s->head)"),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_changed_line_is_found(change):
    law, *lines = change
    settings, runs = reference("rope", law, "double")
    with compiled(settings, lines) as block:
        assert any(not compare(out, block.run(inputs)).is_equal for inputs, out in runs.values())


def test_runs_may_be_numbered_again_after_as_many_as_the_ring_has_cells():
    settings, runs = reference("jumping", "original", "float")
    new = f"MOST_RUNS = {settings.longest_delay_ticks + 1}u"
    with compiled(settings, ("MOST_RUNS = 1073741824u", new)) as block:
        assert all(compare(out, block.run(inputs)).is_equal for inputs, out in runs.values())


def test_stimuli_shape_through_every_spacing_and_raise_every_bit_of_what_is_measured():
    """What the comparisons above stand on."""
    settings, runs = reference("rope", "modified", "double")
    inputs, outputs = (np.concatenate(each) for each in zip(*runs.values(), strict=True))
    assert int(np.bitwise_or.reduce(outputs["status"])) & int(ROPE_BITS) == int(ROPE_BITS)
    starts = spacing_of(settings).starts
    pieces = np.searchsorted(starts, inputs["rope_length"][~outputs["settled"]], side="right") - 1
    assert set(range(len(starts))) <= set(pieces.tolist())


@pytest.mark.parametrize("law", LAWS)
def test_the_block_divides_nowhere_and_loops_over_taps_and_halvings_only(law):
    for number in NUMBERS:
        source = generate(BLOCKS["rope"](law, number), ORIGIN, "c")[1].text
        code = re.sub(r"/\*.*?\*/|#.*?$", "", source, flags=re.DOTALL | re.MULTILINE)
        assert not re.search(r"[/%]", code)
        # Taps, twice in the original law, and the sum to come; halvings; init forgets the numbers of runs.
        assert len(re.findall(r"\b(?:for|while) \(", code)) == 5 - (law == "modified")
