"""`swayless plot`: figures of designs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.options import JsonOption, quantity

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.machine import DesignFile
    from swayless.report import PlottedShaper


class Kind(StrEnum):
    """Kinds of figures."""

    sensitivity = "sensitivity"
    response = "response"
    bank = "bank"


class Over(StrEnum):
    """Axes of a sensitivity figure."""

    frequency = "frequency"
    rope_length = "rope-length"


class Definition(StrEnum):
    """Definitions of residual vibration."""

    kriikku = "kriikku"
    magee = "magee"


def plot(
    kind: Annotated[Kind, typer.Argument(help="What to draw.", show_default=False)],
    files: Annotated[list[Path], typer.Argument(metavar="FILE.json...", help="Design files.", show_default=False)],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FIG", help="Figure to write: .svg, .png or .pdf.")
    ],
    over: Annotated[Over, typer.Option("--over", help="Axis of sensitivity.")] = Over.frequency,
    span: Annotated[
        tuple[str, str] | None,
        typer.Option("--span", metavar="LOW HIGH", help="Range of the axis, with units if you like.", show_default=False),
    ] = None,
    definition: Annotated[
        Definition,
        typer.Option("--definition", help="Residual vibration as in Kriikku eq 1, or Magee eqs 24-25."),
    ] = Definition.kriikku,
    press: Annotated[
        str, typer.Option("--press", metavar="TIME", help="How long the response's button is held.")
    ] = "6 s",
    row: Annotated[int, typer.Option("--row", min=1, help="Row of the file that the response shows.")] = 1,
    json: JsonOption = False,
) -> None:
    """Draw residual vibration over frequency or rope length, a response, or a whole bank.

    Examples:

      swayless plot sensitivity zv.json zvd.json ei.json -o compare.svg

      swayless plot sensitivity crane.design.json --over rope-length --span "9 ft" "29 ft" -o rope.png

      swayless plot response crane.design.json --press "4 s" -o response.pdf
    """
    from swayless.cli.console import print_json
    from swayless.machine import load_design
    from swayless.report import save_figure, sensitivity_figure

    designs = [load_design(file) for file in files]
    if kind is Kind.sensitivity:
        shapers = [shaper for design in designs for shaper in plotted(design, prefix=len(designs) > 1)]
        dimension = quantity("frequency" if over is Over.frequency else "length")
        limits = None if span is None else (dimension(span[0]), dimension(span[1]))
        axis = "frequency" if over is Over.frequency else "rope_length"
        figure = sensitivity_figure(shapers, over=axis, span=limits, definition=definition.value)  # type: ignore[arg-type]
    else:
        figure = _single(kind, designs, row, quantity("time")(press))
    save_figure(figure, output)
    if json:
        print_json({"figure": str(output), "kind": kind.value})
    else:
        typer.echo(f"{output}: written")


def _single(kind: Kind, designs: list[DesignFile], row: int, press_s: float) -> Figure:
    if len(designs) != 1:
        raise typer.BadParameter(f"plot {kind.value} takes one design file, got {len(designs)}")
    design = designs[0]
    if kind is Kind.bank:
        return bank(design)
    if row > len(design.shapers):
        raise typer.BadParameter(f"--row {row}: the design has {len(design.shapers)} rows")
    return response(design, row, press_s)


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

    impulses = stored_shapers(design) if design.tick_s is None else stored_taps(design)
    labels = [f"{s.name} ({s.family})" if s.name != s.family else s.family for s in design.shapers]
    return [
        PlottedShaper(f"{design.name}: {label}" if prefix else label, item, item.guarantee, design.tick_s)
        for label, item in zip(labels, impulses, strict=True)
    ]


def bank(design: DesignFile) -> Figure:
    """Draw all rows of a design over the range of its machine."""
    from swayless.errors import DesignError
    from swayless.report import bank_figure

    plant = design.plant
    if plant.frequency_hz[0] >= plant.frequency_hz[1]:
        raise DesignError("the design is for one frequency, and a bank figure needs a range: plot sensitivity instead")
    if plant.kind == "crane":
        from swayless.plant import pendulum_rope_length_m

        low_hz, high_hz = plant.frequency_hz
        lengths = plant.rope_length_m or (pendulum_rope_length_m(high_hz), pendulum_rope_length_m(low_hz))
        return bank_figure(plotted(design), rope_length_m=lengths)
    return bank_figure(plotted(design), frequency_hz=plant.frequency_hz)


def response(design: DesignFile, row: int, press_s: float) -> Figure:
    """Draw the response of one row to a press of a button at full speed."""
    import math

    from swayless.report import PlottedCommand, response_figure

    drive = design.drive
    command = PlottedCommand(
        drive.max_speed_m_s, press_s, drive.acceleration_m_s2 or math.inf, drive.deceleration_m_s2 or math.inf
    )
    return response_figure(plotted(design)[row - 1], command=command)
