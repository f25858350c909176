"""`swayless build`: the main job: design, figures, code and proof from one machine file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from swayless.cli.options import CheckOption, CompilerOption, JsonOption, SoakOption

if TYPE_CHECKING:
    from swayless.codegen import GeneratedFile
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile, Machine

FIGURE_PRESS_S = 6.0
"""Press of the response figures; cranes are often judged by six seconds at full speed."""


def build(
    machine: Annotated[Path, typer.Argument(metavar="MACHINE.toml", help="A machine file.", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="DIR",
            help="Directory; it belongs to the generator. The file's name without .toml unless given.",
            show_default=False,
        ),
    ] = None,
    check: CheckOption = False,
    no_verify: Annotated[bool, typer.Option("--no-verify", help="Do not compile and compare; say so.")] = False,
    compiler: CompilerOption = None,
    soak_ticks: SoakOption = 1_000_000,
    json: JsonOption = False,
) -> None:
    """Design every row of a machine, draw it, generate C and Structured Text, and prove them.

    Writes NAME.design.json, c/, st/ and figures/ into the output directory, but nothing before the proof has
    passed. With --check nothing is written: figures apart, every file is compared with what would be.

    Example:  swayless build examples/srtc-gantry.toml -o out/srtc-gantry
    """
    from swayless.cli.console import progress
    from swayless.cli.output_directory import write_files
    from swayless.machine import load_machine, save_text
    from swayless.machine.running import shaper_settings

    described = load_machine(machine)
    directory = output or Path(machine.stem)
    with progress() as show:
        design = _design(described, directory, show)
        settings = shaper_settings(design)
        code = _code(design, settings)
        texts = {f"{design.name}.design.json": save_text(design).encode("ascii")}
        for target, made in code.items():
            texts |= {f"{target}/{file.path}": file.text.encode("ascii") for file in made}
        if check:
            _check(directory, texts, design, json=json)
            return
        verdicts = []
        if not no_verify:
            from swayless.cli.verify import verdicts_of

            verdicts = verdicts_of(design, code, number=None, compiler=compiler, soak_ticks=soak_ticks, show=show)
        differs = [verdict for verdict in verdicts if not verdict.comparison.is_equal]
        if not differs:
            show("drawing figures")
            write_files(directory, texts | _figures(design))
    _report(described, design, settings, directory, verdicts, json=json)
    if differs:
        raise typer.Exit(1)


def _design(machine: Machine, directory: Path, show: Callable[[str], None]) -> DesignFile:
    """Design the machine; keep the stored numbers where they agree, so that code does not churn."""
    from swayless.errors import FileError
    from swayless.machine import load_design, same_design
    from swayless.machine.designing import design_machine

    fresh = design_machine(machine, on_row=lambda name: show(f"designing {name}"))
    path = directory / f"{machine.name}.design.json"
    if not path.exists():
        return fresh
    try:
        stored = load_design(path)
    except FileError:
        return fresh  # a damaged design is replaced, and --check shows it
    return fresh if same_design(stored, fresh) else stored


def _code(design: DesignFile, settings: ShaperSettings) -> dict[str, tuple[GeneratedFile, ...]]:
    from swayless.cli.generate import provenance
    from swayless.codegen import TARGETS
    from swayless.codegen import generate as generate_files

    origin, number = provenance(design), settings.number.name
    return {
        name: generate_files(settings, origin, name)
        for name, target in TARGETS.items()
        if number in target.number_types
    }


def figure_names(design: DesignFile) -> list[str]:
    """Paths of the figures of a design."""
    names = ["figures/sensitivity.svg"]
    if design.plant.frequency_hz[0] < design.plant.frequency_hz[1]:
        names.append("figures/bank.svg")
    return names + [f"figures/response-{row}.svg" for row in range(1, len(design.shapers) + 1)]


def _figures(design: DesignFile) -> dict[str, bytes]:
    from swayless.cli.plot import bank, plotted, response
    from swayless.report import figure_bytes, sensitivity_figure

    files = {}
    for path in figure_names(design):
        if path.endswith("sensitivity.svg"):
            over: Any = "rope_length" if design.plant.kind == "crane" else "frequency"
            figure = sensitivity_figure(plotted(design), over=over)
        elif path.endswith("bank.svg"):
            figure = bank(design)
        else:
            figure = response(design, int(path.rsplit("-", 1)[1].removesuffix(".svg")), FIGURE_PRESS_S)
        files[path] = figure_bytes(figure, "svg")
    return files


def _check(directory: Path, texts: dict[str, bytes], design: DesignFile, *, json: bool) -> None:
    from swayless.cli.console import print_json
    from swayless.cli.output_directory import differences, unknown_files

    figures = figure_names(design)
    expected = texts | dict.fromkeys(figures, b"")
    found = [text for text in differences(directory, texts) if not text.endswith("does not make it")]
    found += [f"{path}: too much, the generator does not make it" for path in unknown_files(directory, expected)]
    found += [f"{path}: missing" for path in figures if not (directory / path).is_file()]
    if json:
        print_json({"directory": str(directory), "files": [*texts, *figures], "differences": found})
    else:
        for line in found or [f"{directory}: {len(texts)} files as generated, {len(figures)} figures there"]:
            typer.echo(line)
    if found:
        raise typer.Exit(1)


def _report(
    machine: Machine,
    design: DesignFile,
    settings: ShaperSettings,
    directory: Path,
    verdicts: list[Any],
    *,
    json: bool,
) -> None:
    from swayless.cli.console import print_json, print_table
    from swayless.cli.summary import gap_lines, stop_rows, summary_document

    if json:
        print_json(summary_document(design, settings, directory, verdicts))
        return
    columns, rows = stop_rows(design, settings)
    print_table(f"{design.name}: what each row guarantees, from {machine.source}", columns, rows)
    for line in gap_lines(design):
        typer.echo(line)
    if verdicts:
        bad = [v for v in verdicts if not v.comparison.is_equal]
        for verdict in bad:
            typer.echo(f"DIFFERS: {verdict.code}, {verdict.stimulus}: {verdict.comparison.first_difference}")
        codes = sorted({verdict.code for verdict in verdicts})
        for code in codes:
            ticks = sum(verdict.ticks for verdict in verdicts if verdict.code == code)
            state = "DIFFERS" if any(v.code == code for v in bad) else "equal to the reference, bit for bit"
            typer.echo(f"verified: {code}: {ticks} ticks, {state}")
    else:
        typer.echo("verified: not run (--no-verify)")
    if not any(not verdict.comparison.is_equal for verdict in verdicts):
        typer.echo(f"{directory}: written")
