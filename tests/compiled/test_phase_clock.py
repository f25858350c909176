"""Generated C of the phase clock equals the reference in every bit of every output. No tolerance anywhere."""

import dataclasses
import subprocess
from contextlib import contextmanager

import numpy as np
import pytest

from swayless.codegen import GeneratedFile, c_harness, generate
from swayless.controller import Bank
from swayless.controller.status import ROPE_BITS
from swayless.controller.taps import RopeRows
from swayless.verify import COMPILERS, compare, find_compiler
from swayless.verify.c_run import CompiledBlock
from swayless.verify.reference_run import run_reference
from swayless.verify.stimulus import soak, stimuli
from tests.compiled.phase_blocks import BLOCKS, gantry
from tests.unit.codegen.test_provenance import ORIGIN

PRESENT = [compiler for compiler in COMPILERS if compiler.name == "zig" or compiler.is_installed()]
"""zig comes with the [verify] extra and must be there; gcc and clang are the machine's own."""

RANDOM_TICKS, SOAK_TICKS = 2500, 10_000
NUMBERS = ["double", "float", "int32"]


@contextmanager
def compiled(settings, compiler=None, change=("", "")):
    """The block in C, with one line changed."""
    files = generate(settings, ORIGIN, "c")
    old, new = change
    assert old in files[1].text
    source = GeneratedFile(files[1].path, files[1].text.replace(old, new, 1)) if old else files[1]
    made = (files[0], source, *files[2:])
    with CompiledBlock(made, c_harness(settings, ORIGIN), compiler or find_compiler(), settings) as block:
        yield block


def histories(settings):
    yield from stimuli(settings, ticks=RANDOM_TICKS)
    yield soak(settings, ticks=SOAK_TICKS)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("name", BLOCKS)
def test_every_output_equals_the_reference_bit_for_bit(name, number):
    settings = BLOCKS[name](number)
    with compiled(settings) as block:
        found = {
            stimulus.name: compare(run_reference(settings, stimulus.inputs), block.run(stimulus.inputs))
            for stimulus in histories(settings)
        }
    assert len(found) == 13
    assert [(name, one.first_difference) for name, one in found.items() if not one.is_equal] == []


@pytest.mark.parametrize("number", NUMBERS)
def test_every_compiler_on_this_machine_agrees(number):
    settings = BLOCKS["everything"](number)
    stimulus = soak(settings, ticks=SOAK_TICKS)
    runs = []
    for compiler in PRESENT:
        with compiled(settings, compiler) as block:
            runs.append(block.run(stimulus.inputs))
    assert all(compare(runs[0], run).is_equal for run in runs)


CHANGES = {
    "a kick is shown to the swing": ("flow.release - kick", "flow.release"),
    "what a part lacks is not wanted": ("kick + flow.wanted", "kick"),
    "a kick is not undone": ("flow.wanted = kick", "flow.wanted = 0.0"),
    "an answer does not lean": ("lean = -size;", "lean = 0.0;"),
    "an answer leans the wrong way": ("lean = size;", "lean = -size;"),
    "weights are kept too long": ("s->weighed = false;\n    }\n    s->rate", "}\n    s->rate"),
    "what is late is forgotten": ("s->late = s->late + late;", "s->late = late;"),
    "a changed rope leaves the stop distance": ("s->foretold = false;\n    }\n}", "}\n}"),
    "an answer does not put off rest": ("s->still_quanta = 0u;\n        if", "if"),
    "a tick counts for the next one's quanta": ("elapsed_quanta = s->quanta", "elapsed_quanta = quanta"),
    "a part is weighted for a rope that stays": (
        "s->rate * crane_STRETCH[tap]",
        "0.5 * s->rate * crane_STRETCH[tap]",
    ),
    "a part lacks less": ("foreseen) - 1.0) * 0.5", "foreseen) - 1.0) * 0.25"),
    "nothing is foreseen": ("s->inverse * (1.0 + z)", "s->inverse"),
    "the mass of a lap is all mass": ("s->fresh_mass = s->fresh_mass - part;", "s->fresh_mass -= s->mass;"),
    "a lap's moment is forgotten": ("s->moment = s->fresh;", "s->moment = 0.0;"),
    "idle although the rope is not": ("&& s->rope_still", "&& true"),
    "a jump is believed": ("<= reach", "<= (reach + 1.0)"),
    "a frozen rope counts on": ("s->unmoved = 0.0;\n    } else", "s->unmoved += 0.001;\n    } else"),
    "the swing is not damped": ("(angle * crane_LOSS)", "(0.0 * crane_LOSS)"),
    "the swing moves a tick late": ("s->place + (half * pace)", "s->place + (half * s->pace)"),
    "the swing keeps its place when the rope does not": ("(count * s->inverse)", "(count / count)"),
    "a held length is not counted": ("s->held_ticks += 1u;", "s->held_ticks += 0u;"),
}


@pytest.fixture(scope="module")
def reference():
    settings = gantry("double")
    made = [stimulus.inputs for stimulus in histories(settings)]
    return settings, [(inputs, run_reference(settings, inputs)) for inputs in made]


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_changed_line_is_found(reference, change):
    settings, runs = reference
    with compiled(settings, PRESENT[0], change) as block:
        assert any(not compare(expected, block.run(inputs)).is_equal for inputs, expected in runs)


def test_memory_is_bounded_by_the_longest_lag_on_the_longest_rope():
    settings = gantry("double")
    header = generate(settings, ORIGIN, "c")[0].text
    assert f"SHAPER_RING ({settings.longest_delay_ticks + 2})" in header
    assert "SHAPER_LATER_TAPS (2)" in header
    with compiled(settings) as block:  # which does not compile if the state is larger than the header says
        assert block is not None


def test_stimuli_shape_on_still_and_moving_ropes_and_raise_every_bit_of_the_rope(reference):
    """What the comparisons above stand on."""
    _, runs = reference
    inputs, outputs = (np.concatenate(each) for each in zip(*runs, strict=True))
    every = int(np.bitwise_or.reduce(outputs["status"]))
    assert every & int(ROPE_BITS) == int(ROPE_BITS)
    shaping, moving = ~outputs["settled"], inputs["hoist_speed"] != 0
    assert min(np.sum(shaping & ~moving), np.sum(shaping & moving)) > 10_000


@pytest.mark.parametrize("number", NUMBERS)
def test_the_example_program_arrives_and_comes_to_rest(number, tmp_path):
    for file in generate(gantry(number), ORIGIN, "c"):
        (tmp_path / file.path).write_text(file.text)
    command = [*find_compiler().command, "-std=c99", "-o", tmp_path / "example.exe"]
    subprocess.run([*command, *sorted(tmp_path.glob("*.c"))], check=True)
    done = subprocess.run([tmp_path / "example.exe"], check=True, capture_output=True, text=True)
    lines = [[float(value) for value in line.split()] for line in done.stdout.splitlines()]
    assert lines[-1][1:] == [0.0, 0.0, 0.0]
    assert max(line[2] for line in lines) == max(line[1] for line in lines)


def test_settings_of_other_ropes_give_other_code():
    settings = gantry("double")
    other = dataclasses.replace(settings, rope=dataclasses.replace(settings.rope, hoist_speed=0.5))
    assert generate(settings, ORIGIN, "c")[1].text != generate(other, ORIGIN, "c")[1].text


@pytest.mark.parametrize("number", NUMBERS)
def test_a_bank_of_one_row_that_the_rope_could_choose_compiles_and_equals_the_reference(number):
    three = BLOCKS["chosen by rope"](number)
    rows = RopeRows(three.bank.by_rope.lower[-1:], three.bank.by_rope.upper[:1])
    settings = dataclasses.replace(three, bank=Bank(three.bank.rows[:1], rows))
    stimulus = soak(settings, ticks=SOAK_TICKS)
    with compiled(settings) as block:
        assert compare(run_reference(settings, stimulus.inputs), block.run(stimulus.inputs)).is_equal
