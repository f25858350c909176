"""Build, check and verify the directory of one block with its stored file, whatever block it is.

Not for: machines with command shapers (`swayless.cli.build`), which have axes, rows and wiring besides.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import typer

from swayless.cli.options import OptionError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.verify import CodeFiles
    from swayless.codegen import GeneratedFile
    from swayless.verify import Compiler, Verdict

LANGUAGES = ("c", "st")
"""Targets, each with a folder of its own; the number types of these blocks are those of both."""


class Proving(NamedTuple):
    """How code is proved: by which compiler, over how long a soak, and what shows progress."""

    compiler: Compiler | None
    soak_ticks: int
    show: Callable[[str], None]


class Block(NamedTuple):
    """One block as the command line handles it.

    Parameters
    ----------
    name : str
        Machine name.
    stored : tuple of str
        Name and text of the file that it is generated from.
    generate : callable
        From a target to its files.
    prove : callable
        From code, and how it shall be proved, to verdicts.
    figures : mapping
        How to draw each figure, or to write a page with figures, by its path in the output directory.
    facts : mapping
        What `--json` says of it.
    lines : tuple of str
        What is said to people.
    """

    name: str
    stored: tuple[str, str]
    generate: Callable[[str], tuple[GeneratedFile, ...]]
    prove: Callable[[CodeFiles, Proving], Iterator[Verdict]]
    figures: Mapping[str, Callable[[], Figure | str]] = {}
    facts: Mapping[str, Any] = {}
    lines: tuple[str, ...] = ()

    @property
    def code(self) -> CodeFiles:
        """Files of every language."""
        return {target: self.generate(target) for target in LANGUAGES}


def build_block(
    make: Callable[[Callable[[str], None]], Block],
    directory: Path,
    *,
    check: bool,
    prove: bool,
    compiler: str | None,
    soak_ticks: int,
    json: bool,
) -> None:
    """Generate, prove, draw and write a block: all of it, or nothing.

    Parameters
    ----------
    make : callable
        Makes the block; it is given a callable that shows progress.
    directory : Path
        Where to write.
    check : bool
        Write nothing, compare.
    prove : bool
        Compile and compare before writing.
    compiler : str or None
        Compiler; None for the first one found.
    soak_ticks : int
        Length of the soak of the C; 0 leaves it out.
    json : bool
        Print for machines.
    """
    from swayless.cli.console import failure_in_json, progress
    from swayless.cli.output_directory import check_directory, write_files
    from swayless.cli.verify import all_equal

    with progress() as show, failure_in_json(wanted=json):
        block = make(show)
        code = block.code
        files = _files(block, code)
        if check:
            report_check(directory, files, block.figures, json=json)
            return
        paths = [*files, *block.figures]
        check_directory(directory, paths)
        verdicts = _build_proof(block, code, compiler, soak_ticks, show) if prove else []
        equal = all_equal(verdicts)
        if equal:
            show("drawing figures")
            write_files(directory, files | drawn(block.figures))
    _report(block, directory, paths if equal else [], verdicts, json=json)
    if not equal:
        raise typer.Exit(1)


def verify_block_at(
    path: Path,
    make: Callable[[Callable[[str], None]], Block],
    *,
    number: str | None,
    compiler: str | None,
    soak_ticks: int,
    json: bool,
) -> None:
    """Prove the code of a block: as it stands in a directory, or generated first from its stored file.

    Parameters
    ----------
    path : Path
        What `build` wrote, or the stored file.
    make : callable
        Makes the block of the stored file.
    number : str or None
        Another number type, which is refused.
    compiler : str or None
        Compiler; None for the first one found.
    soak_ticks : int
        Length of the soak of the C; 0 leaves it out.
    json : bool
        Print for machines.

    Raises
    ------
    FileError
        If there is no code in the directory.
    """
    from swayless.cli.console import failure_in_json, print_json, progress
    from swayless.cli.verify import all_equal, code_in, print_verdicts, verdict_document
    from swayless.errors import FileError

    refuse_number(path, number)
    with progress() as show, failure_in_json(wanted=json):
        block = make(show)
        folders = path.is_dir()
        code = {target: code_in(path / target) for target in LANGUAGES} if folders else block.code
        if not any(code.values()):
            raise FileError([f"{path}: holds no generated code in {' or '.join(LANGUAGES)}"])
        if lacking := _lacking(path, code, block.code):
            raise FileError(lacking)
        verdicts = _proof(block, code, compiler, soak_ticks, show)
    missing = {
        target: f"not verified, there is none in {path / target}" for target, own in code.items() if not own
    }
    if json:
        print_json(verdict_document(verdicts, missing))
    else:
        print_verdicts(verdicts, missing)
    if not all_equal(verdicts):
        raise typer.Exit(1)


def _lacking(path: Path, found: CodeFiles, made: CodeFiles) -> list[str]:
    """Name every file that a language lacks of which there are others; nothing needs the example."""
    return [
        f"{path / target / file.path}: is not there: `build` wrote it, and other files of {target} need it"
        for target, files in made.items()
        for file in files
        if found[target] and file.path not in {each.path for each in found[target]}
        if "_example." not in file.path
    ]


def refuse_number(path: Path, number: str | None) -> None:
    """Refuse another number type than that of the stored file, for which it is proved.

    Raises
    ------
    OptionError
        If one is given.
    """
    if number is not None:
        raise OptionError([f"--number: {path} is proved for its own number type; build it in another one"])


def drawn(figures: Mapping[str, Callable[[], Figure | str]]) -> dict[str, bytes]:
    """Draw figures, and write pages.

    Parameters
    ----------
    figures : mapping
        How to draw or write each, by its path.
    """
    from swayless.report import figure_bytes

    made = {path: draw() for path, draw in figures.items()}
    return {
        path: each.encode("ascii") if isinstance(each, str) else figure_bytes(each, "svg")
        for path, each in made.items()
    }


def report_check(
    directory: Path, files: Mapping[str, bytes], figures: Mapping[str, Any], *, json: bool
) -> None:
    """Compare a directory with what would be written, say what differs, and exit 1 if anything does.

    Parameters
    ----------
    directory : Path
        What is there.
    files, figures : mapping
        What should be there; of figures only their paths.
    json : bool
        Print for machines.
    """
    from swayless.cli.console import counted, print_json
    from swayless.cli.output_directory import differences

    found = differences(directory, files, present=list(figures))
    if json:
        document = {"directory": str(directory), "checked": True, "files": [*files, *figures]}
        print_json(document | {"differences": found})
    else:
        there = f", {counted(len(figures), 'figure')} there" if figures else ""
        for line in found or [f"{directory}: {counted(len(files), 'file')} as generated{there}"]:
            typer.echo(line)
    if found:
        raise typer.Exit(1)


def _files(block: Block, code: CodeFiles) -> dict[str, bytes]:
    """Give what is written besides figures, by path."""
    path, text = block.stored
    parts = {f"{target}/{file.path}": file.text for target, own in code.items() for file in own}
    return {each: content.encode("ascii") for each, content in ({path: text} | parts).items()}


def _proof(
    block: Block, code: CodeFiles, compiler: str | None, soak_ticks: int, show: Callable[[str], None]
) -> list[Verdict]:
    from swayless.verify import find_compiler

    show("verifying")
    found = find_compiler(compiler) if code.get("c") else None
    return list(block.prove(code, Proving(found, soak_ticks, show)))


def _build_proof(
    block: Block, code: CodeFiles, compiler: str | None, soak_ticks: int, show: Callable[[str], None]
) -> list[Verdict]:
    from swayless.errors import ToolMissingError

    try:
        return _proof(block, code, compiler, soak_ticks, show)
    except ToolMissingError as error:
        raise ToolMissingError(f"{error}; --no-verify builds without the proof") from error


def _report(
    block: Block, directory: Path, written: list[str], verdicts: Sequence[Verdict], *, json: bool
) -> None:
    from swayless.cli.console import counted, print_json
    from swayless.cli.verify import verdict_document, verdict_lines

    if json:
        place = {"directory": str(directory), "files": written}
        print_json({"name": block.name, **block.facts, **place, **verdict_document(verdicts, {})})
        return
    for line in (*block.lines, *verdict_lines(verdicts, {})):
        typer.echo(line)
    if not verdicts:
        typer.echo("verified: not run (--no-verify)")
    typer.echo(f"{directory}: {counted(len(written), 'file') if written else 'nothing'} written")
