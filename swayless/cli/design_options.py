"""Options that the commands of `swayless design` share. Not for: what commands do with them."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from swayless.cli.options import Number

COMMANDS = ("si", "fd", "bank", "recommend")
"""Commands of the group that are not families."""


class AmplitudeRule(StrEnum):
    """Which amplitudes are allowed."""

    positive = "positive"
    bounded = "bounded"
    unity_magnitude = "unity-magnitude"


ToleranceOption = Annotated[
    str, typer.Option(metavar="V", help="Residual vibration allowed, as a part of the unshaped one.")
]
AmplitudesOption = Annotated[
    AmplitudeRule | None,
    typer.Option(
        help="positive, unless given; bounded: their partial sums stay in 0 to 1; unity-magnitude: +1, -1, "
        "..., +1, the only ones for a contactor drive.",
        show_default=False,
    ),
]
ImpulsesOption = Annotated[
    str | None,
    typer.Option(metavar="N", help="For unity-magnitude: exactly so many impulses, odd and at least 3."),
]
TickOption = Annotated[
    str | None,
    typer.Option(
        metavar="S", help="Tick of the controller, such as '10 ms': solve on its grid, for generated code."
    ),
]
ContactorOption = Annotated[
    bool,
    typer.Option(
        "--contactor", help="The drive knows only 0 and full speed: whole ticks, amplitudes +1 and -1."
    ),
]
SpeedOption = Annotated[
    str, typer.Option(metavar="V", help="Largest command of generated code, such as '40 m/min'.")
]
AccelerationOption = Annotated[
    str | None, typer.Option(metavar="A", help="Ramp before the shaper, in m/s2; no ramp unless given.")
]
TypeOption = Annotated[Number, typer.Option(help="Number type of generated code.")]
CountsOption = Annotated[
    str | None,
    typer.Option(
        "--counts-per-m-s",
        metavar="N",
        help="Commands are in counts, and N of them are 1 m/s; needed for int32.",
    ),
]
NameOption = Annotated[
    str | None, typer.Option(metavar="NAME", help="Prefix of generated symbols; the family unless given.")
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE.json", help="Design file to write.")
]
