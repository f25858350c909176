"""Figures and files of moves computed ahead. Not for: drawing them, or finding the command."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from swayless.cli.console import counted
from swayless.errors import FileError
from swayless.machine.writing import write_text_atomically

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.design.optimal import Command, OptimalCommand
    from swayless.machine.profile_file import ProfileRequest
    from swayless.report.profile import PlottedMove

TABLE, PAGE, *FIGURES = (".csv", ".html", ".svg", ".png", ".pdf")
"""What suffixes become."""


def profile_figures(request: ProfileRequest, found: OptimalCommand) -> dict[str, Callable[[], Figure]]:
    """Tell how to draw the figures of a request, by their paths in the directory of its build."""
    return move_figures(plotted(request, found.command))


def move_figures(move: PlottedMove) -> dict[str, Callable[[], Figure]]:
    """Tell how to draw the figures of any move, by their paths in the directory of its build."""
    from swayless.report.profile import move_figure

    return {"figures/move.svg": partial(move_figure, move)}


def draw_move(request: ProfileRequest, found: OptimalCommand) -> Figure:
    """Draw what was found."""
    from swayless.report.profile import move_figure

    return move_figure(plotted(request, found.command))


def write_page(request: ProfileRequest, found: OptimalCommand) -> str:
    """Write the page on what was found: facts, proof and figure."""
    from swayless.cli.profile_output import found_remarks, found_tables
    from swayless.report.profile_page import PageTable, page_text

    title = move_title(request.name, request.task.start, request.task.target, found.command)
    tables = [PageTable(*table) for table in found_tables(request, found)]
    return page_text(title, tables, found_remarks(request, found), draw_move(request, found))


def plotted(request: ProfileRequest, command: Command) -> PlottedMove:
    """Give a move as figures show it."""
    from swayless.report.profile import PlottedMove

    task = request.task
    return PlottedMove(
        move_title(request.name, task.start, task.target, command),
        task.plant,
        command,
        task.start,
        task.target,
        task.limits,
    )


def move_title(name: str, start: float, target: float, command: Command) -> str:
    """Name a move.

    Examples
    --------
    >>> from swayless.design.optimal import Command
    >>> move_title("crane", 0.0, 2.0, Command(0.5, [1.0, 1.0], 0.0))
    'crane: 0 to 2 in 2 ticks, 1 s'
    """
    lasts = f"{counted(command.values.size, 'tick')}, {command.duration_s:.6g} s"
    return f"{name}: {start:g} to {target:g} in {lasts}"


def check_places(paths: Sequence[Path], *, page: bool = False) -> None:
    """Refuse a place in which nothing can be written, before anything is computed.

    Parameters
    ----------
    paths : sequence of Path
        Where to write.
    page : bool
        Whether a page can be written.

    Raises
    ------
    FileError
        If a suffix is not known, or a folder is missing.
    """
    known = (TABLE, *([PAGE] if page else []), *FIGURES)
    of_page = f"{PAGE} for a page, " if page else ""
    allowed = f"must be {TABLE} for a table, {of_page}or a figure's: {', '.join(FIGURES)}"
    wrong = [
        f"{path}: suffix {path.suffix!r}: {allowed}" for path in paths if path.suffix.lower() not in known
    ]
    absent = [
        f"{path}: cannot be written: there is no folder {path.parent}"
        for path in paths
        if not path.parent.exists()
    ]
    if wrong or absent:
        raise FileError([*wrong, *absent])


def check_apart(outputs: Sequence[Path], inputs: Sequence[Path]) -> None:
    """Refuse to write over what is read, or two things to one place, before anything is computed.

    Parameters
    ----------
    outputs, inputs : sequence of Path
        What is written, and what is read; a file that is corrected in its place is left out of the inputs.

    Raises
    ------
    FileError
        Naming each output.

    Examples
    --------
    >>> check_apart([Path("a.csv"), Path("./b.csv")], [Path("b.csv")])
    Traceback (most recent call last):
    swayless.errors.FileError: b.csv: would be written over, and it is read: choose another output
    """
    read = {os.path.realpath(path) for path in inputs}
    places = [os.path.realpath(path) for path in outputs]
    problems = [
        f"{path}: would be written over, and it is read: choose another output"
        for path, place in zip(outputs, places, strict=True)
        if place in read
    ]
    problems += [
        f"{path}: would be written twice: choose another output"
        for index, path in enumerate(outputs)
        if places[index] in places[:index]
    ]
    if problems:
        raise FileError(problems)


def write_by_suffix(
    paths: Sequence[Path],
    table: Callable[[], str],
    draw: Callable[[], Figure],
    page: Callable[[], str] | None = None,
) -> None:
    """Write a table, a figure or a page to each path, after its suffix.

    Raises
    ------
    FileError
        If a file cannot be written.
    """
    texts = {TABLE: table, PAGE: page}
    for path in paths:
        text = texts.get(path.suffix.lower())
        if text is not None:
            write_text_atomically(path, text())
        else:
            from swayless.report import save_figure

            save_figure(draw(), path)
