"""The wiring of several axes for `build` and `verify`: generated, and proved. Not for: single blocks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import takewhile
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swayless.cli.verify import CodeFiles
    from swayless.codegen.axes_model import AxisBlock
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile
    from swayless.verify import Verdict


def wiring(name: str, blocks: Sequence[tuple[DesignFile, ShaperSettings]]) -> CodeFiles:
    """Generate the wiring of several axes in every language that the number type allows.

    Parameters
    ----------
    name : str
        What the names of all designs begin with.
    blocks : sequence of (DesignFile, ShaperSettings)
        The axes. A machine without axes needs no wiring: then nothing is generated.
    """
    from swayless.cli.generate import left_out
    from swayless.codegen import TARGETS
    from swayless.codegen.axes_model import generate_axes

    if len(blocks) == 1 and blocks[0][0].name == name:
        return {}
    axes = [_axis_block(name, design, settings) for design, settings in blocks]
    missing = left_out(blocks[0][1])
    return {target: generate_axes(name, axes, target) for target in TARGETS if target not in missing}


def wiring_verdicts(
    blocks: Sequence[tuple[DesignFile, ShaperSettings, CodeFiles]],
    code: CodeFiles,
    *,
    compiler: str | None,
    show: Callable[[str], None],
) -> list[Verdict]:
    """Run the wiring in C and in Structured Text, and compare it with the references of all axes.

    Parameters
    ----------
    blocks : sequence of (DesignFile, ShaperSettings, CodeFiles)
        The axes with their code.
    code : dict
        The wiring by target; empty for a machine without axes.
    compiler : str or None
        Compiler; None for the first one found.
    show : callable
        Shows progress.
    """
    from swayless.verify import find_compiler
    from swayless.verify.wiring import WiredAxis, verify_c_wiring, verify_st_wiring

    if not code:
        return []
    name = _name([design.name for design, _, _ in blocks])
    axes = [
        WiredAxis(_axis_block(name, design, settings), files.get("c", ()), files.get("st", ()))
        for design, settings, files in blocks
    ]
    show("wiring of all axes")
    verdicts: list[Verdict] = []
    if "c" in code:
        verdicts += verify_c_wiring(name, axes, code["c"], find_compiler(compiler))
    if "st" in code:
        verdicts += verify_st_wiring(axes, code["st"])
    return verdicts


def _name(designs: Sequence[str]) -> str:
    """Name of the machine: what the names of all axes begin with, up to an underscore.

    Examples
    --------
    >>> _name(["yard_bridge_left", "yard_bridge_right"]), _name(["yard_bridge"])
    ('yard_bridge', 'yard')
    """
    words = zip(*(design.split("_") for design in designs), strict=False)
    common = [each[0] for each in takewhile(lambda each: len(set(each)) == 1, words)]
    return "_".join(common if len(designs) > 1 else common[:-1])


def _axis_block(name: str, design: DesignFile, settings: ShaperSettings) -> AxisBlock:
    from swayless.cli.generate import provenance
    from swayless.codegen.axes_model import AxisBlock

    return AxisBlock(design.name.removeprefix(f"{name}_"), settings, provenance(design))
