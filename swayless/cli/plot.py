"""`swayless plot`: figures of designs."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from swayless.cli.options import AxisOption, JsonOption

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.design import Shaper
    from swayless.design.grid_shaper import GridShaper
    from swayless.machine import DesignFile, ShaperRecord
    from swayless.report import PlottedShaper


FIGURE_PRESS_S = 6.0
"""Press of a response figure; cranes are often judged by six seconds at full speed."""


class Kind(StrEnum):
    """Kinds of figures."""

    sensitivity = "sensitivity"
    response = "response"
    bank = "bank"
    tradeoff = "tradeoff"


class Over(StrEnum):
    """Axes of a sensitivity figure."""

    frequency = "frequency"
    rope_length = "rope-length"


class Definition(StrEnum):
    """Definitions of residual vibration."""

    kriikku = "kriikku"
    magee = "magee"


KindArgument = Annotated[
    Kind,
    typer.Argument(
        metavar="KIND",
        help="sensitivity: what designs leave over frequency or rope length, and the range each one holds; "
        "response: command, reference and swing of one press at full speed; bank: all rows of a machine; "
        "tradeoff: what robustness costs on a machine, with the proven limit.",
        show_default=False,
    ),
]
FilesArgument = Annotated[
    list[Path],
    typer.Argument(
        metavar="FILE.json",
        help="Design file; several for sensitivity; for tradeoff a machine file instead.",
        show_default=False,
    ),
]
FigureOption = Annotated[
    Path, typer.Option("-o", "--output", metavar="FIG", help="Figure to write: .svg, .png or .pdf.")
]
OverOption = Annotated[
    Over | None, typer.Option("--over", help="sensitivity: the axis; frequency unless given.")
]
SpanOption = Annotated[
    tuple[str, str] | None,
    typer.Option(metavar="LOW HIGH", help="sensitivity: range of the axis, in Hz or m, or with units."),
]
DefinitionOption = Annotated[
    Definition | None,
    typer.Option(help="sensitivity: residual as in Kriikku eq 1 (unless given), or Magee eqs 24-25."),
]
PressOption = Annotated[
    str | None, typer.Option(metavar="TIME", help="response: how long the button is held; 6 s unless given.")
]
RowOption = Annotated[
    str | None, typer.Option(metavar="N", help="response: row of the design; 1 unless given.")
]


def plot(
    kind: KindArgument,
    files: FilesArgument,
    output: FigureOption,
    over: OverOption = None,
    span: SpanOption = None,
    definition: DefinitionOption = None,
    press: PressOption = None,
    row: RowOption = None,
    axis: AxisOption = None,
    json: JsonOption = False,
) -> None:
    """Draw sensitivity, a response, a whole bank, or what robustness costs.

    Taps are drawn where a design has them, since they are what runs.

    Examples
    --------
    swayless plot sensitivity zv.json ei.json -o compare.svg
    swayless plot sensitivity crane.json --over rope-length --span 3 9 -o r.png
    swayless plot response crane.json --press "4 s" --row 2 -o response.pdf
    swayless plot bank crane.json -o bank.svg
    swayless plot tradeoff crane.toml -o tradeoff.svg
    """
    from swayless.cli.console import print_json
    from swayless.report import save_figure
    from swayless.report.save import check_place

    check_place(output)
    _refuse_strangers(
        kind,
        {
            Kind.sensitivity: {"over": over, "span": span, "definition": definition},
            Kind.response: {"press": press, "row": row},
            Kind.tradeoff: {"axis": axis},
        },
    )
    if kind is Kind.tradeoff:
        from swayless.cli.tradeoff import tradeoff

        figure = tradeoff(_only(kind, files), axis)
    elif kind is Kind.sensitivity:
        figure = _sensitivity(_loaded(files), over or Over.frequency, span, definition or Definition.kriikku)
    else:
        figure = _single(kind, _loaded([_only(kind, files)])[0], row, press)
    save_figure(figure, output)
    if json:
        print_json({"figure": str(output), "kind": kind.value, "designs": [str(file) for file in files]})
    else:
        typer.echo(f"{output}: written")


def _refuse_strangers(kind: Kind, owners: dict[Kind, dict[str, Any]]) -> None:
    """Refuse options that belong to another kind of figure: they would change nothing."""
    from swayless.cli.option_table import refuse

    refuse(
        [
            f"--{name}: belongs to plot {owner.value}, not to plot {kind.value}"
            for owner, options in owners.items()
            for name, value in options.items()
            if owner is not kind and value is not None
        ]
    )


def _loaded(files: list[Path]) -> list[DesignFile]:
    """Load every file, or report the problems of all."""
    from swayless.errors import FileError
    from swayless.machine import load_design

    designs: list[DesignFile] = []
    problems: list[str] = []
    for file in files:
        try:
            designs.append(load_design(file))
        except FileError as error:
            problems += error.problems
    if problems:
        raise FileError(problems)
    return designs


def _sensitivity(
    designs: list[DesignFile], over: Over, span: tuple[str, str] | None, definition: Definition
) -> Figure:
    from swayless.cli.option_table import option_table, refuse
    from swayless.machine.plant_section import FREQUENCY, LENGTH
    from swayless.report import sensitivity_figure

    problems: list[str] = [
        f"--over rope-length: the design {design.name} is of an arm, which hangs on no rope"
        for design in designs
        if over is Over.rope_length and design.plant.kind == "arm"
    ] + [
        f"--over rope-length: the design {design.name} is for a drive that feels the load, below which no"
        " rope has the frequency of a pendulum: plot over frequency"
        for design in designs
        if over is Over.rope_length and design.drive.speed_loop is not None
    ]
    limits = None
    if span is not None:
        check = FREQUENCY if over is Over.frequency else LENGTH
        low, high = (option_table({"span": end}, problems).take("span", check, None) for end in span)
        if low is not None and high is not None and low >= high:
            problems.append(f"--span {span[0]} {span[1]}: must be the lower end, then the higher one")
        limits = (low or 0.0, high or 0.0)
    refuse(problems)
    shapers = [shaper for design in designs for shaper in plotted(design, prefix=len(designs) > 1)]
    if over is Over.frequency:
        return sensitivity_figure(shapers, over="frequency", span=limits, definition=definition.value)
    return sensitivity_figure(shapers, over="rope_length", span=limits, definition=definition.value)


def _only(kind: Kind, files: list[Path]) -> Path:
    """Take the one file of a figure that draws one."""
    from swayless.cli.option_table import refuse

    if len(files) != 1:
        what = "machine" if kind is Kind.tradeoff else "design"
        refuse([f"FILE.json: plot {kind.value} draws one {what}, {len(files)} are given"])
    return files[0]


def _single(kind: Kind, design: DesignFile, row: str | None, press: str | None) -> Figure:
    from swayless.cli.option_table import option_table, refuse
    from swayless.machine.checks import integer, quantity

    if kind is Kind.bank:
        return bank(design)
    problems: list[str] = []
    table = option_table({"row": row, "press": press}, problems)
    position = table.take("row", integer(1, len(design.shapers)), 1)
    press_s = table.take("press", quantity("time", 1e-3, 1e4), FIGURE_PRESS_S)
    refuse(problems)
    return response(design, position or 1, press_s or FIGURE_PRESS_S)


def plotted(design: DesignFile, *, prefix: bool = False) -> list[PlottedShaper]:
    """Shapers of a design for figures: the taps where there are some, since they are what runs.

    Parameters
    ----------
    design : DesignFile
        Any design.
    prefix : bool
        Whether labels name the design too.
    """
    from swayless.machine.running import stored_shapers, stored_taps
    from swayless.report import PlottedShaper

    impulses: Sequence[Shaper | GridShaper] = stored_taps(design)
    if design.tick_s is None:
        impulses = stored_shapers(design)
    labels = [_label(design, shaper) for shaper in design.shapers]
    return [
        PlottedShaper(f"{design.name}: {label}" if prefix else label, item, item.guarantee, design.tick_s)
        for label, item in zip(labels, impulses, strict=True)
    ]


def _label(design: DesignFile, shaper: ShaperRecord) -> str:
    """Name a row; one that follows the machine is drawn where that is slowest."""
    label = f"{shaper.name} ({shaper.family})" if shaper.name != shaper.family else shaper.family
    if design.law == "fixed":
        return label
    rope_m = shaper.mode.rope_length_m
    return f"{label} at " + (f"{shaper.mode.frequency_hz:.4g} Hz" if rope_m is None else f"{rope_m:.4g} m")


def sensitivity(design: DesignFile) -> Figure:
    """Draw what the rows of a design leave, on the axis of its machine."""
    from swayless.report import sensitivity_figure

    over: Literal["frequency", "rope_length"] = "rope_length" if _hangs_free(design) else "frequency"
    return sensitivity_figure(plotted(design), over=over)


def _hangs_free(design: DesignFile) -> bool:
    """Whether ropes have the frequencies of pendulums, by which figures turn one into the other."""
    return design.plant.kind == "crane" and design.drive.speed_loop is None


def bank(design: DesignFile) -> Figure:
    """Draw all rows of a design over the range of its machine."""
    from swayless.errors import DesignError
    from swayless.report import bank_figure

    plant = design.plant
    if design.law != "fixed":
        raise DesignError(
            f'law = "{design.law}": each row works on all of the range, and a bank figure compares rows for '
            "parts of it: plot sensitivity shows them where the machine is slowest"
        )
    if plant.frequency_hz[0] >= plant.frequency_hz[1]:
        raise DesignError(
            "the design is for one frequency, and a bank figure needs a range: plot sensitivity instead"
        )
    switches_hz = () if design.bank is None else design.bank.switching_frequency_hz
    if _hangs_free(design):
        from swayless.plant import pendulum_rope_length_m

        low_hz, high_hz = plant.frequency_hz
        lengths = plant.rope_length_m or (pendulum_rope_length_m(high_hz), pendulum_rope_length_m(low_hz))
        return bank_figure(plotted(design), rope_length_m=lengths, switching_hz=switches_hz)
    return bank_figure(plotted(design), frequency_hz=plant.frequency_hz, switching_hz=switches_hz)


def response(design: DesignFile, row: int, press_s: float) -> Figure:
    """Draw the response of one row to a press of a button at full speed."""
    import math

    from swayless.report import PlottedCommand, response_figure

    drive = design.drive
    command = PlottedCommand(
        drive.max_speed_m_s, press_s, drive.acceleration_m_s2 or math.inf, drive.deceleration_m_s2 or math.inf
    )
    return response_figure(plotted(design)[row - 1], command=command)
