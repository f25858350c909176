"""Prove generated motion profiles against their reference, bit for bit. Not for: other blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack

from swayless.codegen.profile_files import profile_harness
from swayless.codegen.profile_model import ProfileCode
from swayless.codegen.profile_pins import OUTPUTS
from swayless.codegen.render import GeneratedFile
from swayless.errors import VerificationError
from swayless.verify.c_run import CompiledProgram
from swayless.verify.comparison import compare
from swayless.verify.profile_stimulus import profile_stimuli
from swayless.verify.records import record_of
from swayless.verify.st_run import EvaluatedProgram
from swayless.verify.toolchain import Compiler
from swayless.verify.verification import SOAK_TICKS, ST_TICKS, Verdict


def verify_profile(
    code: ProfileCode,
    *,
    c_files: Sequence[GeneratedFile] = (),
    st_files: Sequence[GeneratedFile] = (),
    compiler: Compiler | None = None,
    soak_ticks: int = SOAK_TICKS,
    on_start: Callable[[str], None] = lambda _: None,
) -> Iterator[Verdict]:
    """Run generated code and its reference over every stimulus and compare all outputs bit for bit.

    Parameters
    ----------
    code : ProfileCode
        The block; the reference of its settings is what generated code is compared with.
    c_files, st_files : sequence of GeneratedFile
        What to verify; an empty sequence leaves the language out.
    compiler : Compiler
        Needed for `c_files`.
    soak_ticks : int
        Length of the soak of the C; 0 leaves it out.
    on_start : callable
        Called with what begins.

    Yields
    ------
    Verdict
        One for each stimulus and language.

    Raises
    ------
    VerificationError
        If the code does not compile or run at all.
    ToolMissingError
        If the Structured Text parser is missing.
    """
    number = code.settings.number
    outputs = record_of(OUTPUTS, number)
    with ExitStack() as stack:
        runs: list[tuple[str, int | None, CompiledProgram | EvaluatedProgram]] = []
        if c_files and compiler is not None:
            on_start(f"compiling with {compiler.name}")
            program = CompiledProgram(c_files, profile_harness(code), compiler, outputs)
            runs.append((f"C by {compiler.name}, {number.name}", None, stack.enter_context(program)))
        for file in st_files:
            runs.append((f"ST by evaluator, {code.st_types.real}", ST_TICKS, _evaluated(file, code)))
        for stimulus in profile_stimuli(code, soak_ticks if c_files else 0):
            on_start(stimulus.name)
            for name, most_ticks, run in runs:
                inputs, expected = stimulus.inputs[:most_ticks], stimulus.expected[:most_ticks]
                yield Verdict(name, stimulus.name, inputs.size, compare(expected, run.run(inputs)))


def _evaluated(file: GeneratedFile, code: ProfileCode) -> EvaluatedProgram:
    """Load a block; what is wrong with its text is said with the name of its file."""
    try:
        return EvaluatedProgram(file.text, record_of(OUTPUTS, code.settings.number))
    except VerificationError as error:
        raise VerificationError(f"{file.path}: {error}") from error
