"""`swayless verify`: prove generated code against the reference, bit for bit."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from swayless.cli.options import CompilerOption, JsonOption, NumberOption, SoakOption

if TYPE_CHECKING:
    from swayless.codegen import GeneratedFile
    from swayless.machine import DesignFile
    from swayless.verify import Verdict


def verify(
    path: Annotated[
        Path,
        typer.Argument(
            metavar="DIR|FILE.json", help="What `build` wrote, or a design file.", show_default=False
        ),
    ],
    number: NumberOption = None,
    compiler: CompilerOption = None,
    soak_ticks: SoakOption = 1_000_000,
    json: JsonOption = False,
) -> None:
    """Run generated code and its reference on the same inputs and compare every output bit for bit.

    A directory is verified as it stands, hand-made changes included; for a design file the code is generated
    first. Exits 1 if anything differs, 3 if a compiler or the parser is missing.

    Example:  swayless verify out/srtc-gantry
    """
    from swayless.cli.console import progress
    from swayless.codegen import TARGETS
    from swayless.codegen import generate as generate_files
    from swayless.machine import load_design
    from swayless.machine.running import shaper_settings

    from swayless.cli.generate import provenance

    if path.is_dir():
        if number is not None:
            raise typer.BadParameter("files in a directory have their number type; give a design file instead")
        design, files = _stored(path)
    else:
        design = load_design(path)
        settings = shaper_settings(design, number=number and number.value)
        known = [name for name, target in TARGETS.items() if settings.number.name in target.number_types]
        files = {name: generate_files(settings, provenance(design), name) for name in known}
    with progress() as show:
        verdicts = verdicts_of(
            design, files, number=number and number.value, compiler=compiler, soak_ticks=soak_ticks, show=show
        )
    print_verdicts(verdicts, json=json)
    if not all(verdict.comparison.is_equal for verdict in verdicts):
        raise typer.Exit(1)


def verdicts_of(
    design: DesignFile,
    files: dict[str, tuple[GeneratedFile, ...]],
    *,
    number: str | None,
    compiler: str | None,
    soak_ticks: int,
    show: Any,
) -> list[Verdict]:
    """Verify generated files against the reference of their design.

    Parameters
    ----------
    design : DesignFile
        The design.
    files : dict
        Files by target.
    number : str or None
        Number type; None for the design's own.
    compiler : str or None
        Compiler; None for the first one found.
    soak_ticks : int
        Length of the soak of the C.
    show : callable
        Shows progress.
    """
    from swayless.cli.generate import provenance
    from swayless.machine.running import shaper_settings
    from swayless.verify import find_compiler, verify_block

    return list(
        verify_block(
            shaper_settings(design, number=number),
            provenance(design),
            c_files=files.get("c", ()),
            st_files=files.get("st", ()),
            compiler=find_compiler(compiler) if files.get("c") else None,
            soak_ticks=soak_ticks,
            on_start=show,
        )
    )


def print_verdicts(verdicts: Sequence[Verdict], *, json: bool) -> None:
    """Print what verification found, as a table or for machines."""
    from swayless.cli.console import print_json, print_table

    if json:
        print_json({"equal": all(v.comparison.is_equal for v in verdicts), "runs": [_document(v) for v in verdicts]})
        return
    rows = [
        (v.code, v.stimulus, f"{v.ticks}", v.comparison.first_difference or "equal, bit for bit") for v in verdicts
    ]
    print_table("Verification: generated code against its reference", ("code", "stimulus", "ticks", "outputs"), rows)


def _document(verdict: Verdict) -> dict[str, Any]:
    found = verdict.comparison
    return {
        "code": verdict.code,
        "stimulus": verdict.stimulus,
        "ticks": verdict.ticks,
        "equal": found.is_equal,
        "max_ulp": found.max_ulp,
        "first_difference": found.first_difference,
    }


def _stored(directory: Path) -> tuple[DesignFile, dict[str, tuple[GeneratedFile, ...]]]:
    """Read back what `build` wrote: one design file, and the code beside it."""
    from swayless.codegen import GeneratedFile
    from swayless.errors import FileError
    from swayless.machine import load_design

    designs = sorted(directory.glob("*.design.json"))
    if len(designs) != 1:
        raise FileError([f"{directory}: holds {len(designs)} files *.design.json; `swayless build` writes one"])
    design = load_design(designs[0])
    files = {}
    for target in ("c", "st"):
        paths = sorted(path for path in (directory / target).glob("*") if path.suffix in {".c", ".h", ".st"})
        try:
            files[target] = tuple(GeneratedFile(path.name, path.read_text(encoding="ascii")) for path in paths)
        except (OSError, UnicodeDecodeError) as error:
            raise FileError([f"{directory / target}: cannot be read: {error}"]) from error
    if not any(files.values()):
        raise FileError([f"{directory}: holds no generated code in c/ or st/"])
    return design, files
