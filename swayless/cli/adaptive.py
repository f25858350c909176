"""The adaptive shaper as `build`, `generate` and `verify` handle it. Not for: other blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from swayless.cli.block_build import Block, Proving

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.verify import CodeFiles
    from swayless.codegen.adaptive_model import AdaptiveModel
    from swayless.controller.adaptive import AdaptiveSettings
    from swayless.machine.adaptive_file import AdaptiveMachine
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
        figures={"figures/learning.svg": partial(_figure, machine)},
        facts=_times(machine.settings),
        lines=tuple(_lines(machine.settings)),
    )


def _figure(machine: AdaptiveMachine) -> Figure:
    from swayless.cli.adaptive_learning import simulated_learning
    from swayless.report.adaptive import learning_figure

    return learning_figure(simulated_learning(machine))


def _times(settings: AdaptiveSettings) -> dict[str, float]:
    """Give what rests must last for."""
    tick_s = settings.tick_s
    return {
        "tick_s": tick_s,
        "delay_s": settings.delay_ticks * tick_s,
        "quiet_s": settings.quiet_ticks * tick_s,
        "window_s": settings.window_ticks * tick_s,
    }


def _lines(settings: AdaptiveSettings) -> Iterator[str]:
    """Say what rests must last for, and what was not checked."""
    times = _times(settings)
    yield (
        f"learns from {times['quiet_s']:.4g} s after the command has come to rest, "
        f"by windows of {times['window_s']:.4g} s"
    )
    if settings.mode is None:
        yield "frequency: not given, so that neither the delay nor max_reference is checked against it"


def _verdicts(model: AdaptiveModel, code: CodeFiles, how: Proving) -> Iterator[Verdict]:
    from swayless.verify.adaptive import verify_adaptive

    return verify_adaptive(
        model,
        c_files=code.get("c", ()),
        st_files=code.get("st", ()),
        compiler=how.compiler,
        soak_ticks=how.soak_ticks,
    )
