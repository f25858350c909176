"""`swayless identify`: frequency and damping from a measured swing, with their uncertainty."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from swayless.cli.options import JsonOption

MANY = ("--periods", "--rope-length")
"""Options after which several values may stand."""

_VALUE = re.compile(r"[+-]?(?:[0-9]+[.,]?[0-9]*|\.[0-9]+)(?:\s*[A-Za-z]+)?")


class IdentifyCommand(TyperCommand):
    """A command some of whose options take all the numbers that follow."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Repeat those options before each of their values, then parse."""
        return super().parse_args(ctx, spread(args))


def spread(args: Sequence[str]) -> list[str]:
    """Repeat an option before each of the numbers that follow it.

    Examples
    --------
    >>> spread(["--periods", "6.1", "6.0", "--json", "a.csv"])
    ['--periods', '6.1', '--periods', '6.0', '--json', 'a.csv']
    """
    result: list[str] = []
    option = None
    for arg in args:
        if arg.startswith("--"):
            name = arg.partition("=")[0]
            option = name if name in MANY else None
            result.append(arg)
        elif option is not None and _VALUE.fullmatch(arg):
            result += [arg] if result[-1] == option else [option, arg]
        else:
            option = None
            result.append(arg)
    return result


RecordsArgument = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="RECORD.csv", help="Records of a free swing, one for each rope length.", show_default=False
    ),
]
PeriodsOption = Annotated[
    list[str] | None,
    typer.Option("--periods", metavar="S", help="Readings of a stopwatch: 6.1 6.0 6.2.", show_default=False),
]
SwingsOption = Annotated[
    int, typer.Option("--swings", metavar="N", min=1, max=10_000, help="Swings that each reading lasts.")
]
AmplitudeOption = Annotated[
    str | None,
    typer.Option("--amplitude", metavar="ANGLE", help="How far it swung, of --periods: '10 deg'."),
]
PeaksOption = Annotated[
    bool, typer.Option("--peaks", help="The values are heights of peaks, over times or counts of swings.")
]
BothSidesOption = Annotated[
    bool, typer.Option("--both-sides", help="Of --peaks over times: two peaks a swing were read.")
]
RateOption = Annotated[
    str | None, typer.Option("--rate", metavar="HZ", help="Samples per second, of a file without times.")
]
TimeOption = Annotated[
    str | None, typer.Option("--time", metavar="COLUMN", help="Column of the times: its head or number.")
]
ColumnOption = Annotated[
    str | None, typer.Option("--column", metavar="COLUMN", help="Column of the values: its head or number.")
]
RopeColumnOption = Annotated[
    str | None, typer.Option("--rope-column", metavar="COLUMN", help="Column of the rope length, in m.")
]
UnitOption = Annotated[
    str | None, typer.Option("--unit", metavar="UNIT", help="Of the values: deg, rad, mm, m, m/s2, g, ...")
]
RopeOption = Annotated[
    list[str] | None,
    typer.Option(
        "--rope-length",
        metavar="L",
        help="Rope that the crane shows, one for each record.",
        show_default=False,
    ),
]
StartOption = Annotated[
    str | None, typer.Option("--start", metavar="S", help="Leave out what comes before: a moving crane.")
]
EndOption = Annotated[str | None, typer.Option("--end", metavar="S", help="Leave out what comes after.")]
PendulumOption = Annotated[
    bool | None,
    typer.Option(
        "--pendulum/--linear",
        help="A load on a rope, slower the farther it swings; angles of slow swings unless told otherwise.",
        show_default=False,
    ),
]
ModesOption = Annotated[
    int | None,
    typer.Option(
        "--modes", metavar="N", min=1, max=2, help="1 or 2; as many as the record shows unless given."
    ),
]
IntoOption = Annotated[
    Path | None,
    typer.Option(
        "--into", metavar="MACHINE.toml", help="Machine file to write the result into, or a new one."
    ),
]
PlotOption = Annotated[
    Path | None, typer.Option("--plot", metavar="FIG", help="Draw the fit: .svg, .png or .pdf; one record.")
]


def identify(
    records: RecordsArgument = None,
    periods: PeriodsOption = None,
    swings: SwingsOption = 1,
    amplitude: AmplitudeOption = None,
    peaks: PeaksOption = False,
    both_sides: BothSidesOption = False,
    rate: RateOption = None,
    time: TimeOption = None,
    column: ColumnOption = None,
    rope_column: RopeColumnOption = None,
    unit: UnitOption = None,
    rope_length: RopeOption = None,
    start: StartOption = None,
    end: EndOption = None,
    pendulum: PendulumOption = None,
    modes: ModesOption = None,
    into: IntoOption = None,
    plot: PlotOption = None,
    json: JsonOption = False,
) -> None:
    """Find frequency and damping from a measured swing.

    Let the load swing freely and record it: time and angle, position or acceleration. Or give a stopwatch's
    readings, or the heights of peaks. What is found has its standard deviation, and what cannot be seen is
    said.

    Examples
    --------
    swayless identify swing.csv
    swayless identify swing.csv --column "angle [deg]" --start 12 --into crane.toml
    swayless identify low.csv high.csv --rope-length 3 9
    swayless identify --periods 6.1 6.0 6.2
    """
    from swayless.cli.console import print_json
    from swayless.cli.identify_input import Asked, identified
    from swayless.cli.identify_output import document, draw, print_found, write_into

    asked = Asked(
        records=tuple(records or ()),
        periods=tuple(periods or ()),
        swings=swings,
        amplitude=amplitude,
        peaks=peaks,
        both_sides=both_sides,
        rate=rate,
        time=time,
        column=column,
        rope_column=rope_column,
        unit=unit,
        rope_length=tuple(rope_length or ()),
        start=start,
        end=end,
        pendulum=pendulum,
        modes=modes,
    )
    found = identified(asked, plot=plot)
    said = {} if into is None else {"into": str(into), "written": write_into(into, found)}
    if plot is not None:
        draw(plot, found)
        said["plot"] = str(plot)
    if json:
        print_json(document(found) | said)
        return
    print_found(found)
    for line in ([f"{into}: {said['written']}"] if into else []) + ([f"{plot}: written"] if plot else []):
        typer.echo(line)
