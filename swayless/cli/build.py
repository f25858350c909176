"""`swayless build`: the main job: design, figures, code and proof from one machine file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from swayless.cli.options import CheckOption, CompilerOption, JsonOption, MachineArgument, SoakOption

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.verify import CodeFiles
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile, Machine
    from swayless.machine.machine_file import Axes
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
    """What a build makes of one axis, in memory: design, block, code, and how to draw its figures.

    `axis` is empty where the machine has only one. `origin` says how the design stands to the stored one,
    `missing` why a language is left out. Figures go by their path in the output directory.
    """

    axis: str
    design: DesignFile
    origin: str
    settings: ShaperSettings
    code: CodeFiles
    missing: dict[str, str]
    figures: dict[str, Callable[[], Figure]]


class Products(NamedTuple):
    """What a build makes of all axes; files are designs, code and wiring by path in the output directory."""

    axes: tuple[Product, ...]
    wiring: CodeFiles
    files: dict[str, bytes]

    @property
    def figures(self) -> dict[str, Callable[[], Figure]]:
        """Figures of all axes."""
        return {path: draw for product in self.axes for path, draw in product.figures.items()}

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

    A file of an adaptive shaper, or of a move computed ahead, gives that block: NAME.adaptive.json or
    NAME.profile.json is its design then.

    Examples
    --------
    swayless build crane.toml
    swayless build crane.toml -o out/crane --check
    swayless build time-optimal-oscillator.toml
    """
    from swayless.cli.block_build import build_block, drawn, report_check
    from swayless.cli.block_kinds import described_block
    from swayless.cli.console import failure_in_json, progress
    from swayless.cli.output_directory import check_directory, write_files
    from swayless.cli.verify import all_equal
    from swayless.machine.machine_file import load_axes

    directory = output or Path(machine.stem)
    if (make := described_block(machine, directory)) is not None:
        build_block(
            make,
            directory,
            check=check,
            prove=not no_verify,
            compiler=compiler,
            soak_ticks=soak_ticks,
            json=json,
        )
        return
    described = load_axes(machine)
    with progress() as show, failure_in_json(wanted=json):
        products = _products(described, directory, show)
        if check:
            report_check(directory, products.files, products.figures, json=json)
            return
        check_directory(directory, products.paths)
        verdicts = [] if no_verify else _proof(products, compiler, soak_ticks, show)
        if all_equal(verdicts):
            show("drawing figures")
            write_files(directory, products.files | drawn(products.figures))
    _report(products, directory, verdicts, json=json)
    if not all_equal(verdicts):
        raise typer.Exit(1)


def _products(axes: Axes, directory: Path, show: Callable[[str], None]) -> Products:
    from swayless.cli.wiring import wiring
    from swayless.machine import save_text

    made = tuple(_product(machine, directory, show) for machine in axes.machines)
    wired = wiring(axes.name, [(product.design, product.settings) for product in made])
    files = {
        f"{product.design.name}.design.json": save_text(product.design).encode("ascii") for product in made
    }
    for code in (*(product.code for product in made), wired):
        for target, parts in code.items():
            files |= {f"{target}/{file.path}": file.text.encode("ascii") for file in parts}
    return Products(made, wired, files)


def _product(machine: Machine, directory: Path, show: Callable[[str], None]) -> Product:
    from swayless.cli.verify import generated
    from swayless.machine.running import shaper_settings

    design, origin = _design(machine, directory, show)
    settings = shaper_settings(design)
    code, missing = generated(design, settings)
    return Product(machine.axis, design, origin, settings, code, missing, _figures(design, machine.axis))


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


def _figures(design: DesignFile, axis: str) -> dict[str, Callable[[], Figure]]:
    from swayless.cli.plot import FIGURE_PRESS_S, bank, response, sensitivity

    folder = f"figures/{axis}" if axis else "figures"
    figures: dict[str, Callable[[], Figure]] = {f"{folder}/sensitivity.svg": partial(sensitivity, design)}
    if design.law == "fixed" and design.plant.frequency_hz[0] < design.plant.frequency_hz[1]:
        figures[f"{folder}/bank.svg"] = partial(bank, design)
    for row in range(1, len(design.shapers) + 1):
        figures[f"{folder}/response-{row}.svg"] = partial(response, design, row, FIGURE_PRESS_S)
    return figures


def _proof(
    products: Products, compiler: str | None, soak_ticks: int, show: Callable[[str], None]
) -> list[Verdict]:
    from swayless.cli.verify import verdicts_of
    from swayless.cli.wiring import wiring_verdicts
    from swayless.errors import ToolMissingError

    try:
        verdicts = [
            verdict
            for product in products.axes
            for verdict in verdicts_of(
                product.design,
                product.settings,
                product.code,
                compiler=compiler,
                soak_ticks=soak_ticks,
                show=show,
                axis=product.axis,
            )
        ]
        blocks = [(product.design, product.settings, product.code) for product in products.axes]
        return verdicts + wiring_verdicts(blocks, products.wiring, compiler=compiler, show=show)
    except ToolMissingError as error:
        raise ToolMissingError(f"{error}; --no-verify builds without the proof") from error


def _report(products: Products, directory: Path, verdicts: Sequence[Verdict], *, json: bool) -> None:
    from swayless.cli.console import counted, print_json
    from swayless.cli.summary import print_summary
    from swayless.cli.verify import all_equal, verdict_lines

    written = products.paths if all_equal(verdicts) else []
    if json:
        print_json(_document(products, directory, written, verdicts))
        return
    for product in products.axes:
        print_summary(product.design, product.settings)
    for line in verdict_lines(verdicts, products.axes[0].missing):
        typer.echo(line)
    if not verdicts:
        typer.echo("verified: not run (--no-verify)")
    for product in products.axes:
        if product.origin != "new":
            typer.echo(f"{f'{product.axis} ' if product.axis else ''}design: {product.origin}")
    typer.echo(f"{directory}: {counted(len(written), 'file') if written else 'nothing'} written")


def _document(
    products: Products, directory: Path, written: list[str], verdicts: Sequence[Verdict]
) -> dict[str, Any]:
    """Give the report for machines: of one axis at the top, of several in a list."""
    from swayless.cli.summary import summary_document
    from swayless.cli.verify import verdict_document

    summaries = [
        summary_document(product.design, product.settings) | {"design": product.origin}
        for product in products.axes
    ]
    axes = [{"axis": product.axis} | each for product, each in zip(products.axes, summaries, strict=True)]
    found = summaries[0] if len(summaries) == 1 else {"axes": axes}
    place = {"directory": str(directory), "files": written}
    return found | place | verdict_document(verdicts, products.axes[0].missing)
