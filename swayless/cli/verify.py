"""`swayless verify`: prove generated code against the reference, bit for bit."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from swayless.cli.options import CompilerOption, JsonOption, NumberOption, OptionError, SoakOption

if TYPE_CHECKING:
    from swayless.codegen import GeneratedFile
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile
    from swayless.verify import Verdict

CodeFiles: TypeAlias = "dict[str, tuple[GeneratedFile, ...]]"
"""Files by target."""

SUFFIXES = frozenset({".c", ".h", ".st"})
"""What counts as code in a directory that `build` wrote."""


def verify(
    path: Annotated[
        Path,
        typer.Argument(
            metavar="PATH", help="A directory that `build` wrote, or a design file.", show_default=False
        ),
    ],
    number: NumberOption = None,
    compiler: CompilerOption = None,
    soak_ticks: SoakOption = 1_000_000,
    json: JsonOption = False,
) -> None:
    """Prove that generated code does what its reference does.

    Runs both on the same inputs and compares every output bit for bit. A directory is verified as it stands,
    changes by hand included; for a design file the code is generated first. Exits 1 if anything differs, 3 if
    a compiler or the parser of Structured Text is missing.

    Examples
    --------
    swayless verify out/srtc-gantry
    swayless verify crane.json --number float --compiler zig
    """
    from swayless.cli.block_build import verify_block_at
    from swayless.cli.block_kinds import stored_block, stored_in
    from swayless.cli.console import failure_in_json, print_json, progress
    from swayless.cli.generate import left_out
    from swayless.cli.wiring import wiring_verdicts
    from swayless.machine import load_design
    from swayless.machine.running import shaper_settings

    wired: CodeFiles = {}
    if path.is_dir() and number is not None:
        raise OptionError(["--number: files in a directory have their number type; give a design file"])
    stored = stored_in(path) if path.is_dir() else path
    if stored is not None and (make := stored_block(stored)) is not None:
        verify_block_at(path, make, number=number, compiler=compiler, soak_ticks=soak_ticks, json=json)
        return
    if path.is_dir():
        blocks, wired = _stored(path)
        files = blocks[0][2]
        missing = {
            name: f"not verified, there is none in {path / name}"
            for name in files
            if not all(made[name] for _, _, made in blocks)
        }
        missing |= left_out(blocks[0][1])
    else:
        design = load_design(path)
        settings = shaper_settings(design, number=number and number.value)
        files, missing = generated(design, settings)
        blocks = [(design, settings, files)]
    with progress() as show, failure_in_json(wanted=json):
        verdicts = [
            verdict
            for design, settings, files in blocks
            for verdict in verdicts_of(
                design,
                settings,
                files,
                compiler=compiler,
                soak_ticks=soak_ticks,
                show=show,
                axis=design.name if len(blocks) > 1 else "",
            )
        ]
        verdicts += wiring_verdicts(blocks, wired, compiler=compiler, show=show)
    if json:
        print_json(verdict_document(verdicts, missing))
    else:
        print_verdicts(verdicts, missing)
    if not all_equal(verdicts):
        raise typer.Exit(1)


def generated(design: DesignFile, settings: ShaperSettings) -> tuple[CodeFiles, dict[str, str]]:
    """Generate every language that the number type allows; the reasons why others are left out.

    Parameters
    ----------
    design : DesignFile
        The design.
    settings : ShaperSettings
        Its block, in any number type.
    """
    from swayless.cli.generate import left_out, provenance
    from swayless.codegen import TARGETS
    from swayless.codegen import generate as generate_files

    missing = left_out(settings)
    origin = provenance(design)
    return {name: generate_files(settings, origin, name) for name in TARGETS if name not in missing}, missing


def verdicts_of(
    design: DesignFile,
    settings: ShaperSettings,
    files: CodeFiles,
    *,
    compiler: str | None,
    soak_ticks: int,
    show: Callable[[str], None],
    axis: str = "",
) -> list[Verdict]:
    """Verify generated files against the reference of their design.

    Parameters
    ----------
    design : DesignFile
        The design.
    settings : ShaperSettings
        Its block.
    files : dict
        Files by target.
    compiler : str or None
        Compiler; None for the first one found.
    soak_ticks : int
        Length of the soak of the C.
    show : callable
        Shows progress.
    axis : str
        Which axis the design is of; empty where the machine has only one.
    """
    from swayless.cli.generate import provenance
    from swayless.verify import find_compiler, verify_block

    verdicts = list(
        verify_block(
            settings,
            provenance(design),
            c_files=files.get("c", ()),
            st_files=files.get("st", ()),
            compiler=find_compiler(compiler) if files.get("c") else None,
            soak_ticks=soak_ticks,
            on_start=show,
        )
    )
    return [replace(verdict, code=f"{axis}, {verdict.code}") for verdict in verdicts] if axis else verdicts


def all_equal(verdicts: Sequence[Verdict]) -> bool:
    """Whether no run differs from its reference."""
    return all(verdict.comparison.is_equal for verdict in verdicts)


def print_verdicts(verdicts: Sequence[Verdict], missing: dict[str, str]) -> None:
    """Print every run, and what was found in all of them.

    Parameters
    ----------
    verdicts : sequence of Verdict
        Runs.
    missing : dict
        Why a language was left out, by target.
    """
    from swayless.cli.console import print_table

    rows = [
        (v.code, v.stimulus, f"{v.ticks:,}", v.comparison.first_difference or "equal, bit for bit")
        for v in verdicts
    ]
    print_table("generated code against its reference", ("code", "stimulus", "ticks", "outputs"), rows)
    for line in verdict_lines(verdicts, missing):
        typer.echo(line)


def verdict_lines(verdicts: Sequence[Verdict], missing: dict[str, str]) -> Iterator[str]:
    """Sum up what was found, one line for each piece of code.

    Parameters
    ----------
    verdicts : sequence of Verdict
        Runs.
    missing : dict
        Why a language was left out, by target.
    """
    from swayless.cli.console import counted
    from swayless.cli.generate import LANGUAGES

    for code in dict.fromkeys(verdict.code for verdict in verdicts):
        runs = [verdict for verdict in verdicts if verdict.code == code]
        differing = [run for run in runs if not run.comparison.is_equal]
        if not differing:
            ticks = counted(sum(run.ticks for run in runs), "tick")
            yield f"verified: {code}: every output of {ticks} equals the reference, bit for bit"
        else:
            first = f"{differing[0].stimulus}, {differing[0].comparison.first_difference}"
            yield f"DIFFERS: {code}: {len(differing)} of {counted(len(runs), 'run')}; first: {first}"
    for target, reason in missing.items():
        yield f"{LANGUAGES[target]}: {reason}"


def verdict_document(verdicts: Sequence[Verdict], missing: dict[str, str]) -> dict[str, Any]:
    """Give what was found for machines.

    Parameters
    ----------
    verdicts : sequence of Verdict
        Runs; empty if verification did not run.
    missing : dict
        Why a language was left out, by target.
    """
    state = ("equal" if all_equal(verdicts) else "differs") if verdicts else "not run"
    runs = [
        {
            "code": verdict.code,
            "stimulus": verdict.stimulus,
            "ticks": verdict.ticks,
            "equal": verdict.comparison.is_equal,
            "max_ulp": verdict.comparison.max_ulp,
            "first_difference": verdict.comparison.first_difference,
        }
        for verdict in verdicts
    ]
    return {"verified": state, "runs": runs, "left_out": missing}


def _stored(directory: Path) -> tuple[list[tuple[DesignFile, ShaperSettings, CodeFiles]], CodeFiles]:
    """Read back what `build` wrote: the design of each axis with its code, and the wiring of all."""
    from swayless.cli.block_kinds import ENDINGS
    from swayless.codegen import TARGETS
    from swayless.errors import FileError
    from swayless.machine import load_design
    from swayless.machine.running import shaper_settings

    designs = [load_design(path) for path in sorted(directory.glob("*.design.json"))]
    if not designs:
        found = f"holds 0 files {', '.join(('*.design.json', *ENDINGS))}"
        raise FileError([f"{directory}: {found}; give a directory that `build` wrote, or a design file"])
    files = {name: code_in(directory / name) for name in TARGETS}
    if not any(files.values()):
        raise FileError([f"{directory}: holds no generated code in {' or '.join(TARGETS)}"])
    if len(designs) == 1:
        return [(designs[0], shaper_settings(designs[0]), files)], {}
    wired = files
    blocks = []
    for design in designs:
        own = {target: _of_axis(design.name, made) for target, made in files.items()}
        wired = {
            target: tuple(file for file in made if file not in own[target]) for target, made in wired.items()
        }
        blocks.append((design, shaper_settings(design), own))
    wiring = {target: made for target, made in wired.items() if made}
    if not wiring or not all(any(own.values()) for _, _, own in blocks):
        found = (
            f"holds {len(designs)} files *.design.json, but not the code of all and the wiring of these axes"
        )
        raise FileError([f"{directory}: {found}; give a directory that `build` wrote, or a design file"])
    return blocks, wiring


def _of_axis(name: str, files: tuple[GeneratedFile, ...]) -> tuple[GeneratedFile, ...]:
    """Files of the block of one axis."""
    return tuple(file for file in files if f"{name}_" in file.path)


def code_in(folder: Path) -> tuple[GeneratedFile, ...]:
    """Read the code in a folder that `build` wrote.

    Parameters
    ----------
    folder : Path
        Of one target; none is there where the folder is not.

    Raises
    ------
    FileError
        If a file cannot be read or is not ASCII.
    """
    from swayless.codegen import GeneratedFile
    from swayless.errors import FileError

    files = []
    for path in sorted(path for path in folder.glob("*") if path.suffix in SUFFIXES):
        try:
            files.append(GeneratedFile(path.name, path.read_text(encoding="ascii")))
        except UnicodeDecodeError as error:
            raise FileError([f"{path}: is not ASCII text: byte {error.start}"]) from error
        except OSError as error:
            raise FileError([f"{path}: cannot be read: {error.strerror or error}"]) from error
    return tuple(files)
