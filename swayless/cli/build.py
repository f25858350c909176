"""`swayless build`: the main job: design, figures, code and proof from one machine file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from swayless.cli.options import CheckOption, CompilerOption, JsonOption, MachineArgument, SoakOption

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.verify import CodeFiles
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile, Machine
    from swayless.verify import Verdict

DirectoryOption = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="DIR",
        help="Directory; it belongs to the generator. The file's name without .toml unless given.",
    ),
]
NoVerifyOption = Annotated[bool, typer.Option("--no-verify", help="Do not compile and compare; say so.")]


class Product(NamedTuple):
    """What a build makes, all of it in memory: the design, its block, its code, and how to draw its figures.

    `origin` says how the design stands to the stored one, `missing` why a language is left out. Files are the
    design and the code; both they and the figures go by their path in the output directory.
    """

    design: DesignFile
    origin: str
    settings: ShaperSettings
    code: CodeFiles
    missing: dict[str, str]
    files: dict[str, bytes]
    figures: dict[str, Callable[[], Figure]]

    @property
    def paths(self) -> list[str]:
        """Paths of everything that is written."""
        return [*self.files, *self.figures]


def build(
    machine: MachineArgument,
    output: DirectoryOption = None,
    check: CheckOption = False,
    no_verify: NoVerifyOption = False,
    compiler: CompilerOption = None,
    soak_ticks: SoakOption = 1_000_000,
    json: JsonOption = False,
) -> None:
    """Design a machine, draw it, generate its code and prove it.

    Writes NAME.design.json, c/, st/ and figures/ into the output directory: all of them, once the proof has
    passed, or nothing. A stored design that agrees with the fresh one to 1e-9 is kept, so that its code stays
    the same. With --check nothing is written or proved: figures apart, every file is compared with what would
    be written.

    Examples
    --------
    swayless build crane.toml
    swayless build crane.toml -o out/crane --check
    """
    from swayless.cli.console import failure_in_json, progress
    from swayless.cli.output_directory import check_directory, write_files
    from swayless.cli.verify import all_equal
    from swayless.machine import load_machine

    described = load_machine(machine)
    directory = output or Path(machine.stem)
    with progress() as show, failure_in_json(wanted=json):
        product = _product(described, directory, show)
        if check:
            _check(directory, product, json=json)
            return
        check_directory(directory, product.paths)
        verdicts = [] if no_verify else _proof(product, compiler, soak_ticks, show)
        if all_equal(verdicts):
            show("drawing figures")
            write_files(directory, product.files | _drawn(product.figures))
    _report(product, directory, verdicts, json=json)
    if not all_equal(verdicts):
        raise typer.Exit(1)


def _product(machine: Machine, directory: Path, show: Callable[[str], None]) -> Product:
    from swayless.cli.verify import generated
    from swayless.machine import save_text
    from swayless.machine.running import shaper_settings

    design, origin = _design(machine, directory, show)
    settings = shaper_settings(design)
    code, missing = generated(design, settings)
    files = {f"{design.name}.design.json": save_text(design).encode("ascii")}
    for target, made in code.items():
        files |= {f"{target}/{file.path}": file.text.encode("ascii") for file in made}
    return Product(design, origin, settings, code, missing, files, _figures(design))


def _design(machine: Machine, directory: Path, show: Callable[[str], None]) -> tuple[DesignFile, str]:
    """Design the machine; keep the stored numbers where they agree, so that code does not churn."""
    from swayless.cli.console import counted
    from swayless.errors import FileError
    from swayless.machine import load_design, same_design
    from swayless.machine.designing import design_machine

    fresh = design_machine(machine, on_row=lambda name: show(f"designing {name}"))
    path = directory / f"{machine.name}.design.json"
    if not path.exists():
        return fresh, "new"
    try:
        stored = load_design(path)
    except FileError as error:
        return fresh, f"replaces a stored one that is damaged: {error.problems[0]}"
    changes = same_design(stored, fresh)
    if not changes:
        return stored, "kept as stored"
    return fresh, f"replaces the stored one, {counted(len(changes), 'difference')}, the first: {changes[0]}"


def _figures(design: DesignFile) -> dict[str, Callable[[], Figure]]:
    from swayless.cli.plot import FIGURE_PRESS_S, bank, response, sensitivity

    figures: dict[str, Callable[[], Figure]] = {"figures/sensitivity.svg": partial(sensitivity, design)}
    if design.law == "fixed" and design.plant.frequency_hz[0] < design.plant.frequency_hz[1]:
        figures["figures/bank.svg"] = partial(bank, design)
    for row in range(1, len(design.shapers) + 1):
        figures[f"figures/response-{row}.svg"] = partial(response, design, row, FIGURE_PRESS_S)
    return figures


def _drawn(figures: dict[str, Callable[[], Figure]]) -> dict[str, bytes]:
    from swayless.report import figure_bytes

    return {path: figure_bytes(draw(), "svg") for path, draw in figures.items()}


def _proof(
    product: Product, compiler: str | None, soak_ticks: int, show: Callable[[str], None]
) -> list[Verdict]:
    from swayless.cli.verify import verdicts_of
    from swayless.errors import ToolMissingError

    try:
        return verdicts_of(
            product.design,
            product.settings,
            product.code,
            compiler=compiler,
            soak_ticks=soak_ticks,
            show=show,
        )
    except ToolMissingError as error:
        raise ToolMissingError(f"{error}; --no-verify builds without the proof") from error


def _check(directory: Path, product: Product, *, json: bool) -> None:
    from swayless.cli.console import counted, print_json
    from swayless.cli.output_directory import differences

    found = differences(directory, product.files, present=product.figures)
    if json:
        document = {"directory": str(directory), "checked": True, "files": product.paths}
        print_json(document | {"differences": found})
    else:
        files, figures = counted(len(product.files), "file"), counted(len(product.figures), "figure")
        for line in found or [f"{directory}: {files} as generated, {figures} there"]:
            typer.echo(line)
    if found:
        raise typer.Exit(1)


def _report(product: Product, directory: Path, verdicts: Sequence[Verdict], *, json: bool) -> None:
    from swayless.cli.console import counted, print_json
    from swayless.cli.summary import print_summary, summary_document
    from swayless.cli.verify import all_equal, verdict_document, verdict_lines

    written = product.paths if all_equal(verdicts) else []
    if json:
        place = {"directory": str(directory), "files": written, "design": product.origin}
        verdict = verdict_document(verdicts, product.missing)
        print_json(summary_document(product.design, product.settings) | place | verdict)
        return
    print_summary(product.design, product.settings)
    for line in verdict_lines(verdicts, product.missing):
        typer.echo(line)
    if not verdicts:
        typer.echo("verified: not run (--no-verify)")
    if product.origin != "new":
        typer.echo(f"design: {product.origin}")
    typer.echo(f"{directory}: {counted(len(written), 'file') if written else 'nothing'} written")
