"""A million ticks with every input flapping: no undefined behaviour, and every output finite and in range."""

import sys

import numpy as np
import pytest

from swayless.codegen import GeneratedFile, c_harness, generate
from swayless.errors import VerificationError
from swayless.verify.builder import Builder
from swayless.verify.c_run import CompiledBlock
from swayless.verify.operator_stimulus import touched
from swayless.verify.rope_stimulus import hoisted, misread
from swayless.verify.stimulus import bad_input, soak
from swayless.verify.toolchain import Compiler, find_compiler
from tests.compiled.operated_blocks import BLOCKS
from tests.unit.codegen.test_provenance import ORIGIN

QUICKLY = ("-std=c99", "-O1", "-ffp-contract=off")
FLOATS = "float-divide-by-zero,float-cast-overflow"
GCC = Compiler("gcc", ("gcc", f"-fsanitize=address,undefined,{FLOATS}", "-fno-sanitize-recover=all"), QUICKLY)
INTEGERS = "implicit-conversion,unsigned-integer-overflow"
ZIG_FLAGS = (f"-fsanitize=undefined,{INTEGERS},{FLOATS}", "-fsanitize-trap=all")
ZIG = Compiler("zig", (sys.executable, "-m", "ziglang", "cc", *ZIG_FLAGS), QUICKLY)
"""Of clang, also what C defines and nobody means: unsigned numbers that wrap, conversions that lose a bit."""

SANITIZERS = [ZIG, GCC] if find_compiler().name == "gcc" else [ZIG]
CASES = [("mixed", "double", 250_000), ("mixed", "int32", 250_000), ("by rope", "float", 60_000)]
CASES += [("phase", "int32", 60_000), ("original", "double", 60_000), ("contactor", "int32", 60_000)]
WILD = 0.02
"""Part of the ticks in which an input is any number that its type has."""


def flapping(settings, ticks, seed):
    """Every input at random, some of them any number."""
    build = Builder(settings, seed)
    inputs = bad_input(build, ticks).inputs
    if settings.rope is not None:
        inputs = misread(build, hoisted(build, inputs))
    inputs, random = touched(build, inputs), build.random
    for name in inputs.dtype.names:
        wild, kind = random.random(ticks) < WILD, inputs.dtype[name]
        if kind.kind == "b":
            inputs[name] ^= wild
        elif kind.kind == "i":
            inputs[name] = np.where(wild, random.integers(-(2**31), 2**31, ticks), inputs[name])
        elif kind.kind == "f":
            largest = np.finfo(kind).maxexp * 0.28
            any_number = random.normal(0.0, 1.0, ticks) * 10.0 ** random.uniform(-largest, largest, ticks)
            inputs[name] = np.where(wild, any_number, inputs[name])
    return inputs


def sanitized(settings, compiler, change=("", "")):
    """The block, compiled to stop at undefined behaviour, with one line changed."""
    header, source, _ = generate(settings, ORIGIN, "c")
    assert change[0] in source.text
    files = (header, GeneratedFile(source.path, source.text.replace(*change, 1)))
    return CompiledBlock(files, c_harness(settings, ORIGIN), compiler, settings)


@pytest.mark.parametrize("compiler", SANITIZERS, ids=lambda compiler: compiler.name)
@pytest.mark.parametrize(("name", "number", "ticks"), CASES)
def test_nothing_undefined_happens_and_every_output_is_finite_and_in_range(name, number, ticks, compiler):
    settings = BLOCKS[name](number)
    with sanitized(settings, compiler) as made:
        for seed in (1, 2):
            for inputs in (soak(settings, ticks=ticks, seed=seed).inputs, flapping(settings, ticks, seed)):
                outputs = made.run(inputs)
                assert np.abs(outputs["reference"].astype(float)).max() <= settings.limits.max_command
                for field in outputs.dtype.names:
                    assert np.isfinite(outputs[field]).all(), field


UNDEFINED = {
    "a loop that goes on": ("i < end; ++i", "i <= (end + 900u); ++i"),
    "a sum of 32 bits": ("(int64_t)distance - crane_WAY_MARGIN", "distance - (int32_t)crane_WAY_MARGIN"),
}


@pytest.mark.parametrize("compiler", SANITIZERS, ids=lambda compiler: compiler.name)
@pytest.mark.parametrize("change", UNDEFINED.values(), ids=UNDEFINED)
def test_what_is_undefined_is_found(change, compiler):
    settings = BLOCKS["mixed"]("int32")
    with sanitized(settings, compiler, change) as made, pytest.raises(VerificationError):
        made.run(flapping(settings, 60_000, 1))
