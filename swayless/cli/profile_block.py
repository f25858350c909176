"""The motion profile as `build`, `generate` and `verify` handle it. Not for: other blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from swayless.cli.block_build import Block, Proving

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.verify import CodeFiles
    from swayless.codegen.profile_model import ProfileCode
    from swayless.machine.profile_design import ProfileDesign
    from swayless.report.profile import PlottedMove
    from swayless.verify import Verdict

Tables: TypeAlias = "Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]]"
"""Title, heads and rows of each table."""


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
    from swayless.cli.profile_figures import plotted
    from swayless.cli.profile_output import found_tables
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
    return _built(fresh, directory, plotted(request, found.command), found_tables(request, found))


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
    from swayless.cli.profile_figures import move_title
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
    return _built(fresh, directory, drawn, [])


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
    return _block(load_profile_design(path), "as stored")


def _built(fresh: ProfileDesign, directory: Path, move: PlottedMove, tables: Tables) -> Block:
    """Make the block with its figure and its page; `tables` hold what is known of the command."""
    from swayless.cli.profile_figures import move_figures

    design, origin = _kept(fresh, directory / f"{fresh.name}.profile.json")
    block = _block(design, origin)
    figures: dict[str, Callable[[], Figure | str]] = {**move_figures(move)}
    figures["figures/move.html"] = partial(_page, move, tables, design)
    return block._replace(figures=figures)


def _kept(fresh: ProfileDesign, path: Path) -> tuple[ProfileDesign, str]:
    """Keep the stored numbers where the fresh ones agree with them, so that code does not churn."""
    from swayless.cli.console import counted
    from swayless.errors import FileError
    from swayless.machine.profile_design_file import load_profile_design, same_profile

    if not path.exists():
        return fresh, "new"
    try:
        stored = load_profile_design(path)
    except FileError as error:
        return fresh, f"replaces a stored one that is damaged: {error.problems[0]}"
    changes = same_profile(stored, fresh)
    if not changes:
        return stored, "kept as stored"
    return fresh, f"replaces the stored one, {counted(len(changes), 'difference')}, the first: {changes[0]}"


def _page(move: PlottedMove, tables: Tables, design: ProfileDesign) -> str:
    """Write the page on a move and the block that plays it: the same, however often it is built."""
    from swayless.cli.profile_summary import profile_lines
    from swayless.report.profile import move_figure
    from swayless.report.profile_page import PageTable, page_text

    remarks = list(profile_lines(design, "new"))
    return page_text(move.title, [PageTable(*table) for table in tables], remarks, move_figure(move))


def _block(design: ProfileDesign, origin: str) -> Block:
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
