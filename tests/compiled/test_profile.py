"""Generated motion profiles equal the reference in every bit: C and Structured Text, double and float."""

import dataclasses
import re
import sys

import numpy as np
import pytest

from swayless.codegen.profile_files import generate_profile, profile_harness
from swayless.codegen.profile_model import ProfileOrigin
from swayless.codegen.profile_pins import OUTPUTS
from swayless.controller.profile import ProfileStatus
from swayless.errors import CodegenError, VerificationError
from swayless.verify import COMPILERS, find_compiler
from swayless.verify.c_run import CompiledProgram
from swayless.verify.profile import verify_profile
from swayless.verify.profile_stimulus import Operator, profile_stimuli, soak
from swayless.verify.records import record_of
from swayless.verify.toolchain import Compiler
from tests.compiled.profile_blocks import BLOCKS, block

PRESENT = [compiler for compiler in COMPILERS if compiler.name == "zig" or compiler.is_installed()]
SOAK = 4_000
"""Ticks of some hundred moves; a build runs a million."""

CASES = [(name, "double") for name in BLOCKS] + [(name, "float") for name in list(BLOCKS)[-2:]]


def files_of(code):
    return {target: generate_profile(code, target) for target in ("c", "st")}


@pytest.mark.parametrize(("name", "number"), CASES)
def test_every_bit_of_every_output_is_the_reference_s(name, number):
    code = block(name, number)
    files = files_of(code)
    verdicts = verify_profile(
        code, c_files=files["c"], st_files=files["st"], compiler=find_compiler(), soak_ticks=SOAK
    )
    found = [(each.code, each.stimulus, each.comparison.first_difference) for each in verdicts]
    assert len(found) == 12
    assert [difference for *_, difference in found] == [None] * 12


@pytest.mark.parametrize("compiler", PRESENT, ids=lambda compiler: compiler.name)
def test_every_compiler_accepts_the_code_without_a_warning(compiler):
    code = block("switching, its stop in lines", "float")
    verdicts = verify_profile(code, c_files=files_of(code)["c"], compiler=compiler, soak_ticks=0)
    assert all(each.comparison.is_equal for each in verdicts)


@pytest.mark.parametrize("name", BLOCKS)
def test_the_stimuli_end_moves_and_stops_and_reach_every_status_bit(name):
    seen, done, aborted = 0, 0, 0
    code = block(name, "double")
    for stimulus in profile_stimuli(code, 0):
        seen |= int(np.bitwise_or.reduce(stimulus.expected["status"]))
        done += int(stimulus.expected["done"].sum())
        aborted += int(stimulus.expected["aborted"].sum())
    assert min(done, aborted) >= 20
    # A plant that stays by itself may start anywhere, and a wide limit comes before the longest travel.
    spared = ProfileStatus.TRAVEL_TOO_LONG
    spared |= ProfileStatus(0) if code.holds_with_input else ProfileStatus.START_ELSEWHERE
    assert sum(ProfileStatus) & ~seen & ~spared == 0


WRONG = {
    "a sign": ("(HoldRatio * MoveStart) + (Travel", "(HoldRatio * MoveStart) - (Travel"),
    "a tick of a stop": ("PieceTick >= StopLengths", "PieceTick > StopLengths"),
    "a limit": ("AtRest + (Distance * ShapeLow)", "AtRest + (Distance * ShapeHigh)"),
    "the end of a range": ("MoveTick > StopLast", "MoveTick >= StopLast"),
    "its beginning": ("MoveTick >= StopFirst", "MoveTick > StopFirst"),
    "an edge": ("Execute AND (NOT Executed)", "Execute"),
}


@pytest.mark.parametrize("change", WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_found(change):
    code = block("polynomial, four states", "double")
    (file,) = generate_profile(code, "st")
    assert change[0] in file.text
    wrong = dataclasses.replace(file, text=file.text.replace(*change))
    assert any(not each.comparison.is_equal for each in verify_profile(code, st_files=[wrong]))


def test_text_that_cannot_be_run_is_named():
    code = block("switching, a mass", "double")
    (file,) = generate_profile(code, "st")
    wrong = dataclasses.replace(file, text=file.text.replace("END_IF;", "END_IF", 1))
    with pytest.raises(VerificationError, match=r"FB_cart_Profile\.st: "):
        list(verify_profile(code, st_files=[wrong]))


QUICKLY = ("-std=c99", "-O1", "-ffp-contract=off")
FLOATS = "float-divide-by-zero,float-cast-overflow"
INTEGERS = "implicit-conversion,unsigned-integer-overflow"
ZIG = Compiler(
    "zig",
    (
        sys.executable,
        *("-m", "ziglang", "cc", f"-fsanitize=undefined,{INTEGERS},{FLOATS}", "-fsanitize-trap=all"),
    ),
    QUICKLY,
)
GCC = Compiler("gcc", ("gcc", f"-fsanitize=address,undefined,{FLOATS}", "-fno-sanitize-recover=all"), QUICKLY)
SANITIZERS = [ZIG, GCC] if find_compiler().name == "gcc" else [ZIG]


@pytest.mark.parametrize("compiler", SANITIZERS, ids=lambda compiler: compiler.name)
def test_nothing_undefined_happens_and_every_output_is_finite_and_in_range(compiler):
    code = block("polynomial, four states", "float")
    inputs = np.tile(soak(Operator(code, 9), 2_000).inputs, 20)
    random = np.random.default_rng(3)
    for name in ("start", "target"):
        wild = random.random(inputs.size) < 0.05
        inputs[name][wild] = random.integers(0, 2**32, wild.sum(), dtype=np.uint32).view(np.float32)
    for name in ("execute", "abort"):
        inputs[name] ^= random.random(inputs.size) < 0.05
    with CompiledProgram(
        generate_profile(code, "c"), profile_harness(code), compiler, record_of(OUTPUTS, code.settings.number)
    ) as made:
        outputs = made.run(inputs)
    low, high = code.settings.limits
    assert ((outputs["reference"] >= low) & (outputs["reference"] <= high)).all()
    assert np.isfinite(outputs["position"]).all()


def test_a_table_says_which_ticks_each_piece_is_for():
    source = generate_profile(block("switching, a mass", "double"), "c")[1].text
    assert "    -1.1, /* ticks 5 to 7, 0.05 s */\n    0.7, /* tick 8, 0.08 s */\n" in source
    text = generate_profile(block("plain, one state", "double"), "st")[0].text
    assert "(* ticks 6 to 11, 0.06 s *)" in text


def test_the_header_states_memory_and_facts_and_a_smaller_state_is_refused():
    header, source, example = generate_profile(block("switching, a mass", "double"), "c")
    assert "#define CART_PROFILE_RAM (112u)" in header.text
    assert " * One line of facts.\n" in header.text
    assert "state is larger than the header says" in source.text
    assert "input = { false, false, 0.5, 1.5 }" in example.text


@pytest.mark.parametrize("name", BLOCKS)
def test_structured_text_declares_nothing_that_it_does_not_use(name):
    text = generate_profile(block(name, "double"), "st")[0].text
    declared = re.findall(r"^  (\w+) : ", text, re.MULTILINE)
    assert len(declared) > 30
    code = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
    assert [each for each in declared if len(re.findall(rf"\b{each}\b", code)) < 2] == []


def test_a_plant_that_stays_by_itself_starts_anywhere():
    assert "START_ELSEWHERE" not in generate_profile(block("switching, a mass", "double"), "c")[1].text


def test_reserved_names_and_targets_are_refused():
    code = block("switching, a mass", "double")
    with pytest.raises(CodegenError, match="reserved"):
        dataclasses.replace(code, origin=ProfileOrigin("int", "swayless"))
    with pytest.raises(CodegenError, match="target 'ada': must be one of c, st"):
        generate_profile(code, "ada")
