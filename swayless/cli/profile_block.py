"""The motion profile as `build`, `generate` and `verify` handle it. Not for: other blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from swayless.cli.block_build import Block, Proving

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.verify import CodeFiles
    from swayless.codegen.profile_model import ProfileCode
    from swayless.machine.profile_design import ProfileDesign
    from swayless.verify import Verdict


def optimal_block(path: Path, directory: Path, show: Callable[[str], None]) -> Block:
    """Find the command that a profile file asks for, and make the block that plays it.

    Parameters
    ----------
    path : Path
        A TOML file with ``[plant]`` and ``[move]``.
    directory : Path
        Where an earlier build may have stored the same block.
    show : callable
        Shows progress.
    """
    from swayless.cli.profile_figures import profile_figures
    from swayless.cli.profile_work import found_with
    from swayless.machine.profile_design import make_profile_design
    from swayless.machine.profile_design_move import ProfileMove
    from swayless.machine.profile_file import load_profile

    request = load_profile(path, {})
    found = found_with(request, show)
    task = request.task
    show("the stops")
    move = ProfileMove(
        task.plant,
        found.command,
        task.limits,
        task.start,
        task.target,
        task.rate_limit_per_s,
        task.robustness,
    )
    fresh = make_profile_design(request.name, path.name, move, request.number)
    return _built(fresh, directory, profile_figures(request, found))


def inverted_block(path: Path, directory: Path, show: Callable[[str], None]) -> Block:
    """Invert the motion that a file asks for, and make the block that plays the command.

    Parameters
    ----------
    path : Path
        A TOML file that asks for an inversion.
    directory : Path
        Where an earlier build may have stored the same block.
    show : callable
        Shows progress.
    """
    from swayless.cli.profile_figures import move_figures, move_title
    from swayless.machine.inversion import inverted_move
    from swayless.machine.profile_design import make_profile_design
    from swayless.machine.profile_design_move import ProfileMove
    from swayless.report.profile import PlottedMove

    show("the inverse")
    plant, command, limits, start, target, name, number = inverted_move(path)
    title = move_title(name, start, target, command)
    drawn = PlottedMove(title, plant, command, start, target, limits)
    show("the stops")
    move = ProfileMove(plant, command, limits, start, target)
    fresh = make_profile_design(name, path.name, move, number)
    return _built(fresh, directory, move_figures(drawn))


def stored_profile_block(path: Path, show: Callable[[str], None]) -> Block:
    """Read a block that `build` has stored.

    Parameters
    ----------
    path : Path
        Of NAME.profile.json.
    show : callable
        Shows progress.
    """
    from swayless.machine.profile_design_file import load_profile_design

    show(f"reading {path.name}")
    return _block(load_profile_design(path))


def _built(fresh: ProfileDesign, directory: Path, figures: Mapping[str, Callable[[], Figure]]) -> Block:
    """Keep the stored numbers where the fresh ones agree with them, so that code does not churn."""
    from swayless.cli.console import counted
    from swayless.errors import FileError
    from swayless.machine.profile_design_file import load_profile_design, same_profile

    path = directory / f"{fresh.name}.profile.json"
    if not path.exists():
        return _block(fresh, figures, origin="new")
    try:
        stored = load_profile_design(path)
    except FileError as error:
        text = f"replaces a stored one that is damaged: {error.problems[0]}"
        return _block(fresh, figures, origin=text)
    changes = same_profile(stored, fresh)
    if not changes:
        return _block(stored, figures, origin="kept as stored")
    text = f"replaces the stored one, {counted(len(changes), 'difference')}, the first: {changes[0]}"
    return _block(fresh, figures, origin=text)


def _block(
    design: ProfileDesign, figures: Mapping[str, Callable[[], Figure]] | None = None, *, origin: str = ""
) -> Block:
    from swayless.cli.profile_summary import profile_facts, profile_lines, profile_origin
    from swayless.codegen.profile_files import generate_profile
    from swayless.codegen.profile_model import ProfileCode
    from swayless.machine.profile_design_file import profile_design_text

    text = profile_design_text(design)
    code = ProfileCode(design.settings, profile_origin(design, text))
    return Block(
        name=design.name,
        stored=(f"{design.name}.profile.json", text),
        generate=partial(generate_profile, code),
        prove=partial(_verdicts, code),
        figures=figures or {},
        facts=profile_facts(design, origin),
        lines=tuple(profile_lines(design, origin)),
    )


def _verdicts(code: ProfileCode, files: CodeFiles, how: Proving) -> Iterator[Verdict]:
    from swayless.verify.profile import verify_profile

    return verify_profile(
        code,
        c_files=files.get("c", ()),
        st_files=files.get("st", ()),
        compiler=how.compiler,
        soak_ticks=how.soak_ticks,
        on_start=how.show,
    )
