"""`build` and `verify` for a machine file with a section ``[adaptive]``. Not for: other machines."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from swayless.codegen import GeneratedFile
    from swayless.codegen.adaptive_model import AdaptiveModel
    from swayless.machine.adaptive_file import AdaptiveMachine
    from swayless.verify import Verdict

LEFT_OUT: dict[str, str] = {}
"""No language is left out: the number types of the block are those of both."""


def stored_adaptive(directory: Path) -> Path | None:
    """Give the stored machine of an adaptive shaper, if `build` wrote one here."""
    return next(iter(sorted(directory.glob("*.adaptive.json"))), None)


def build_adaptive(
    path: Path, directory: Path, *, check: bool, prove: bool, compiler: str | None, json: bool
) -> None:
    """Generate and prove an adaptive shaper.

    Parameters
    ----------
    path, directory : Path
        Machine file, and where to write.
    check : bool
        Write nothing, compare.
    prove : bool
        Compile and compare before writing.
    compiler : str or None
        Compiler; None for the first one found.
    json : bool
        Print for machines.
    """
    from swayless.cli.console import counted, failure_in_json, print_json, progress
    from swayless.cli.output_directory import check_directory, differences, write_files
    from swayless.cli.verify import all_equal, verdict_document
    from swayless.machine.adaptive_file import adaptive_text, load_adaptive

    machine = load_adaptive(path)
    model = _model(machine)
    code = _generated(model)
    files = {
        f"{target}/{file.path}": file.text.encode("ascii") for target, own in code.items() for file in own
    }
    files[f"{machine.name}.adaptive.json"] = adaptive_text(machine).encode("ascii")
    if check:
        _report_differences(directory, differences(directory, files), len(files), json=json)
        return
    with progress() as show, failure_in_json(wanted=json):
        check_directory(directory, list(files))
        show("verifying")
        verdicts = _proof(model, code, compiler) if prove else []
        equal = all_equal(verdicts)
        if equal:
            write_files(directory, files)
    if json:
        place = {"directory": str(directory), "files": list(files) if equal else []}
        print_json({"name": machine.name, **place, **verdict_document(verdicts, LEFT_OUT)})
    else:
        _say(verdicts)
        typer.echo(f"{directory}: {counted(len(files), 'file') if equal else 'nothing'} written")
    if not equal:
        raise typer.Exit(1)


def verify_adaptive_directory(directory: Path, stored: Path, *, compiler: str | None, json: bool) -> None:
    """Prove the code of an adaptive shaper as it stands in a directory.

    Parameters
    ----------
    directory : Path
        What `build` wrote.
    stored : Path
        The stored machine in it.
    compiler : str or None
        Compiler; None for the first one found.
    json : bool
        Print for machines.
    """
    from swayless.cli.console import failure_in_json, print_json, progress
    from swayless.cli.verify import all_equal, code_in, verdict_document
    from swayless.machine.adaptive_file import load_adaptive

    model = _model(load_adaptive(stored))
    with progress() as show, failure_in_json(wanted=json):
        show("verifying")
        verdicts = _proof(model, {name: code_in(directory / name) for name in ("c", "st")}, compiler)
    if json:
        print_json(verdict_document(verdicts, LEFT_OUT))
    else:
        _say(verdicts)
    if not all_equal(verdicts):
        raise typer.Exit(1)


def _model(machine: AdaptiveMachine) -> AdaptiveModel:
    from swayless.codegen.adaptive_model import AdaptiveModel

    return AdaptiveModel(machine.settings, machine.name, machine.generator, machine.source)


def _generated(model: AdaptiveModel) -> dict[str, tuple[GeneratedFile, ...]]:
    from swayless.codegen.adaptive_files import generate_adaptive

    return {target: generate_adaptive(model, target) for target in ("c", "st")}


def _proof(
    model: AdaptiveModel, code: dict[str, tuple[GeneratedFile, ...]], compiler: str | None
) -> list[Verdict]:
    from swayless.verify import find_compiler
    from swayless.verify.adaptive import verify_adaptive

    found = find_compiler(compiler) if code["c"] else None
    return list(verify_adaptive(model, c_files=code["c"], st_files=code["st"], compiler=found))


def _report_differences(directory: Path, found: list[str], count: int, *, json: bool) -> None:
    from swayless.cli.console import counted, print_json

    if json:
        print_json({"directory": str(directory), "checked": True, "differences": found})
    else:
        for line in found or [f"{directory}: {counted(count, 'file')} as generated"]:
            typer.echo(line)
    if found:
        raise typer.Exit(1)


def _say(verdicts: Sequence[Verdict]) -> None:
    from swayless.cli.verify import verdict_lines

    for line in verdict_lines(verdicts, LEFT_OUT):
        typer.echo(line)
    if not verdicts:
        typer.echo("verified: not run (--no-verify)")
