"""Prove the wiring of several axes: the outer block in Structured Text, and the example in C.

Not for: the blocks themselves (`verification`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.codegen.axes_model import AxisBlock, axes_harness
from swayless.codegen.interface import input_pins
from swayless.codegen.render import GeneratedFile
from swayless.errors import VerificationError
from swayless.verify.builder import Builder
from swayless.verify.c_run import CompiledProgram
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


def verify_c_wiring(
    name: str, axes: Sequence[WiredAxis], wiring: Sequence[GeneratedFile], compiler: Compiler
) -> Iterator[Verdict]:
    """Run the example's function for all axes and the references of all, each axis with commands of its own.

    The example is compiled as it stands, with the warnings of a strict reviewer as errors.

    Parameters
    ----------
    name : str
        Name of the whole machine.
    axes : sequence of WiredAxis
        The axes.
    wiring : sequence of GeneratedFile
        The file of the example.
    compiler : Compiler
        What compiles it.

    Yields
    ------
    Verdict
        One for each axis.

    Raises
    ------
    VerificationError
        If it does not compile, or its program fails.
    """
    blocks = [axis.block for axis in axes]
    inputs = _inputs(blocks)
    outputs = np.dtype([(block.axis, output_dtype(block.settings)) for block in blocks], align=True)
    files = [file for axis in axes for file in axis.c_files if not file.path.endswith("_example.c")]
    with CompiledProgram([*files, *wiring], axes_harness(name, blocks), compiler, outputs) as program:
        found = program.run(_pendants(blocks, inputs))
    for block, own in zip(blocks, inputs, strict=True):
        verdict = compare(run_reference(block.settings, own), found[block.axis])
        yield Verdict(
            f"wiring in C by {compiler.name}", f"{block.axis}, all inputs moving", own.size, verdict
        )


def _pendants(blocks: Sequence[AxisBlock], inputs: Sequence[NDArray[np.void]]) -> NDArray[np.void]:
    """Lay the inputs of all axes out as the pendant of the example: shared ones first, each once."""
    columns = {
        pin.field: own[pin.field]
        for block, own in zip(blocks, inputs, strict=True)
        for pin in block.shared_pins
    }
    columns |= {
        f"{block.axis} {pin.field}": own[pin.field]
        for block, own in zip(blocks, inputs, strict=True)
        for pin in block.own_pins
    }
    layout = np.dtype([(name, column.dtype) for name, column in columns.items()], align=True)
    pendants = np.zeros(inputs[0].size, layout)
    for name, column in columns.items():
        pendants[name] = column
    return pendants


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
