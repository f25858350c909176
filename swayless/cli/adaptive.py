"""The adaptive shaper as `build`, `generate` and `verify` handle it. Not for: other blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from swayless.cli.block_build import Block, Proving

if TYPE_CHECKING:
    from swayless.cli.verify import CodeFiles
    from swayless.codegen.adaptive_model import AdaptiveModel
    from swayless.verify import Verdict


def adaptive_block(path: Path, show: Callable[[str], None]) -> Block:
    """Read a machine with a section ``[adaptive]``.

    Parameters
    ----------
    path : Path
        Its machine file, or what `build` stored of it.
    show : callable
        Shows progress.
    """
    from swayless.codegen.adaptive_files import generate_adaptive
    from swayless.codegen.adaptive_model import AdaptiveModel
    from swayless.machine.adaptive_file import adaptive_text, load_adaptive

    show(f"reading {path.name}")
    machine = load_adaptive(path)
    model = AdaptiveModel(machine.settings, machine.name, machine.generator, machine.source)
    return Block(
        name=machine.name,
        stored=(f"{machine.name}.adaptive.json", adaptive_text(machine)),
        generate=partial(generate_adaptive, model),
        prove=partial(_verdicts, model),
    )


def _verdicts(model: AdaptiveModel, code: CodeFiles, how: Proving) -> Iterator[Verdict]:
    from swayless.verify.adaptive import verify_adaptive

    c_files, st_files = code.get("c", ()), code.get("st", ())
    return verify_adaptive(model, c_files=c_files, st_files=st_files, compiler=how.compiler)
