"""Prove generated code against the reference: the same stimuli through both, all outputs bit for bit.

Not for: generating or finding files.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.codegen.provenance import Provenance
from swayless.codegen.render import GeneratedFile
from swayless.codegen.targets import c_harness
from swayless.controller.settings import ShaperSettings
from swayless.errors import VerificationError
from swayless.verify.c_run import CompiledBlock
from swayless.verify.comparison import Comparison, compare
from swayless.verify.reference_run import run_reference
from swayless.verify.st_run import EvaluatedBlock
from swayless.verify.stimulus import Stimulus, soak, stimuli
from swayless.verify.toolchain import Compiler

STIMULUS_TICKS = 20_000
"""Length of each random stimulus."""

SOAK_TICKS = 1_000_000
"""Length of the soak of the C; nearly three hours of a crane at 10 ms."""

ST_TICKS = 10_000
"""Most ticks of each stimulus that the evaluator runs: it is some hundred times slower than C."""


@dataclass(frozen=True)
class Verdict:
    """What became of one stimulus in one piece of generated code.

    Parameters
    ----------
    code : str
        What ran, such as ``"C by gcc, double"``.
    stimulus : str
        Through what it was put.
    ticks : int
        For how long.
    comparison : Comparison
        What was found.
    """

    code: str
    stimulus: str
    ticks: int
    comparison: Comparison


def verify_block(
    settings: ShaperSettings,
    origin: Provenance,
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
    settings : ShaperSettings
        The block; its reference is what generated code is compared with.
    origin : Provenance
        For the names in the harness.
    c_files, st_files : sequence of GeneratedFile
        What to verify; an empty sequence leaves the language out.
    compiler : Compiler
        Needed for `c_files`.
    soak_ticks : int
        Length of the soak of the C; 0 leaves it out.
    on_start : callable
        Called with the name of each stimulus before it runs.

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
    number = settings.number
    with ExitStack() as stack:
        runs: list[tuple[str, int | None, Callable[[NDArray[np.void]], NDArray[np.void]]]] = []
        if c_files and compiler is not None:
            on_start(f"compiling with {compiler.name}")
            block = CompiledBlock(c_files, c_harness(settings, origin), compiler, settings)
            runs.append((f"C by {compiler.name}, {number.name}", None, stack.enter_context(block).run))
        for file in st_files:
            kind = "LREAL" if number.name == "double" else "REAL"
            runs.append((f"ST by evaluator, {kind}", ST_TICKS, _evaluated(file, settings).run))
        for stimulus in _stimuli(settings, soak_ticks if c_files else 0):
            on_start(stimulus.name)
            expected = run_reference(settings, stimulus.inputs)
            for code, most_ticks, run in runs:
                inputs = stimulus.inputs[:most_ticks]
                yield Verdict(code, stimulus.name, inputs.size, compare(expected[:most_ticks], run(inputs)))


def _evaluated(file: GeneratedFile, settings: ShaperSettings) -> EvaluatedBlock:
    """Load a block; what is wrong with its text is said with the name of its file."""
    try:
        return EvaluatedBlock(file.text, settings)
    except VerificationError as error:
        raise VerificationError(f"{file.path}: {error}") from error


def _stimuli(settings: ShaperSettings, soak_ticks: int) -> Iterator[Stimulus]:
    yield from stimuli(settings, ticks=STIMULUS_TICKS)
    if soak_ticks:
        yield soak(settings, ticks=soak_ticks)
