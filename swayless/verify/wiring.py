"""Prove the wiring of several axes: the outer block in Structured Text, and the example in C.

Not for: the blocks themselves (`verification`).
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.codegen.axes_model import AxisBlock
from swayless.codegen.interface import input_pins
from swayless.codegen.render import GeneratedFile
from swayless.errors import VerificationError
from swayless.verify.builder import Builder
from swayless.verify.comparison import compare
from swayless.verify.operator_stimulus import touched
from swayless.verify.records import output_dtype
from swayless.verify.reference_run import run_reference
from swayless.verify.rope_stimulus import hoisted, misread
from swayless.verify.st_run import of_dint
from swayless.verify.stimulus import bad_input, joystick, knob, stops
from swayless.verify.structured_text import load
from swayless.verify.toolchain import Compiler
from swayless.verify.verification import Verdict

WIRING_TICKS = 400
"""Ticks of each of the stimuli: wires either cross or they do not."""


@dataclass(frozen=True)
class WiredAxis:
    """An axis with the code of its block.

    Parameters
    ----------
    block : AxisBlock
        The axis.
    c_files, st_files : tuple of GeneratedFile
        Its code.
    """

    block: AxisBlock
    c_files: tuple[GeneratedFile, ...]
    st_files: tuple[GeneratedFile, ...]


def compile_wiring(axes: Sequence[WiredAxis], wiring: Sequence[GeneratedFile], compiler: Compiler) -> None:
    """Compile the example that calls all axes, with the warnings of a strict reviewer as errors.

    Raises
    ------
    VerificationError
        If it does not compile.
    """
    with tempfile.TemporaryDirectory(prefix="swayless-", ignore_cleanup_errors=True) as name:
        folder = Path(name)
        for file in (*wiring, *(file for axis in axes for file in axis.c_files)):
            (folder / file.path).write_text(file.text, encoding="ascii", newline="\n")
        blocks = [
            folder / file.path for axis in axes for file in axis.c_files if file.path.endswith("_shaper.c")
        ]
        for file in wiring:
            compiler.build([], [folder / file.path, *blocks], folder / "example.exe")


def verify_st_wiring(axes: Sequence[WiredAxis], wiring: Sequence[GeneratedFile]) -> Iterator[Verdict]:
    """Run the outer block and the references of all axes, each axis with commands of its own.

    Parameters
    ----------
    axes : sequence of WiredAxis
        The axes.
    wiring : sequence of GeneratedFile
        The file of the outer block.

    Yields
    ------
    Verdict
        One for each axis.

    Raises
    ------
    VerificationError
        If the text is not portable Structured Text.
    ToolMissingError
        If the parser is not installed.
    """
    texts = [file.text for axis in axes for file in axis.st_files] + [file.text for file in wiring]
    try:
        outer = load("".join(texts)).instantiate()
    except VerificationError as error:
        raise VerificationError(f"{wiring[0].path}: {error}") from error
    blocks = [axis.block for axis in axes]
    inputs = _inputs(blocks)
    columns = _columns(blocks, inputs)
    records = [output_dtype(block.settings) for block in blocks]
    found = [np.zeros(inputs[0].size, of_dint(record)) for record in records]
    for tick in range(inputs[0].size):
        outputs = outer.step({name: column[tick] for name, column in columns.items()})
        for block, out in zip(blocks, found, strict=True):
            out[tick] = tuple(outputs[block.st_axis + pin.st_name] for pin in block.output_pins)
    for block, own, record, out in zip(blocks, inputs, records, found, strict=True):
        verdict = compare(run_reference(block.settings, own), out.view(record))
        yield Verdict("wiring in ST by evaluator", f"{block.axis}, all inputs moving", out.size, verdict)


def _inputs(blocks: Sequence[AxisBlock]) -> list[NDArray[np.void]]:
    """Give every axis commands of its own, and to all what the first has of the inputs that they share."""
    inputs = [_all_moving(block, seed) for seed, block in enumerate(blocks, start=1)]
    shared: dict[str, NDArray[np.generic]] = {}
    for block, own in zip(blocks, inputs, strict=True):
        for pin in block.shared_pins:
            own[pin.field] = shared.setdefault(pin.field, own[pin.field])
    return inputs


def _all_moving(block: AxisBlock, seed: int) -> NDArray[np.void]:
    """Move every input of a block."""
    build = Builder(block.settings, seed)
    parts = [stimulus(build, WIRING_TICKS).inputs for stimulus in (joystick, knob, stops, bad_input)]
    inputs = touched(build, np.concatenate(parts))
    return inputs if block.settings.rope is None else misread(build, hoisted(build, inputs))


def _columns(blocks: Sequence[AxisBlock], inputs: Sequence[NDArray[np.void]]) -> dict[str, list[Any]]:
    """Give the inputs of the outer block by the name of the pin."""
    columns = {}
    for block, own in zip(blocks, inputs, strict=True):
        for pin in input_pins(block.settings):
            prefix = "" if block.is_shared(pin) else block.st_axis
            columns[prefix + pin.st_name] = own[pin.field].tolist()
    return columns
