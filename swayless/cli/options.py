"""Options that several commands share. Not for: what commands do."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from swayless.errors import SwaylessError


class OptionError(SwaylessError, ValueError):
    """Options are wrong. Holds every problem found, as `swayless.errors.FileError` does for files.

    Parameters
    ----------
    problems : sequence of str
        One line each: option, value and what is allowed.
    """

    def __init__(self, problems: list[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class Number(StrEnum):
    """Number types."""

    double = "double"
    float = "float"
    int32 = "int32"


class CompilerName(StrEnum):
    """C compilers."""

    gcc = "gcc"
    clang = "clang"
    zig = "zig"


JsonOption = Annotated[
    bool, typer.Option("--json", help="Print one JSON document for machines, nothing else.")
]

CheckOption = Annotated[
    bool, typer.Option("--check", help="Write nothing: print a diff and exit 1 if any file would change.")
]

NumberOption = Annotated[
    Number | None,
    typer.Option("--number", help="Number type, instead of the design's own.", show_default=False),
]

CompilerOption = Annotated[
    CompilerName | None,
    typer.Option("--compiler", help="C compiler; by default the first one found.", show_default=False),
]

SoakOption = Annotated[
    int,
    typer.Option(
        "--soak-ticks",
        metavar="N",
        min=0,
        max=100_000_000,
        help="Ticks of the long random run of the C; 0 leaves it out.",
    ),
]

DesignArgument = Annotated[
    Path, typer.Argument(metavar="FILE.json", help="A design file.", show_default=False)
]

MachineArgument = Annotated[
    Path, typer.Argument(metavar="MACHINE.toml", help="A machine file.", show_default=False)
]

AxisOption = Annotated[
    str | None,
    typer.Option(
        "--axis", metavar="NAME", help="Which axis, of a machine file with axes.", show_default=False
    ),
]
