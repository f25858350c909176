"""Options that several commands share, and how their values are read. Not for: what commands do."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from swayless.machine.quantity import Dimension


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


def quantity(dimension: Dimension) -> Callable[[str], float]:
    """Make a parser of option values: a number in SI, or a number with a unit.

    Parameters
    ----------
    dimension : str
        What the value must be, such as ``"length"``.
    """

    def parse(text: str | float) -> float:
        from swayless.machine.quantity import QuantityError, parse_quantity

        try:
            return parse_quantity(text, dimension)
        except QuantityError as error:
            raise typer.BadParameter(str(error)) from error

    parse.__name__ = dimension.upper()
    return parse


JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON document for machines, nothing else.")]

CheckOption = Annotated[
    bool, typer.Option("--check", help="Write nothing: print a diff and exit 1 if any file would change.")
]

NumberOption = Annotated[
    Number | None, typer.Option("--number", help="Number type, instead of the design's own.", show_default=False)
]

CompilerOption = Annotated[
    CompilerName | None,
    typer.Option("--compiler", help="C compiler; by default the first one found.", show_default=False),
]

SoakOption = Annotated[
    int, typer.Option("--soak-ticks", min=0, max=100_000_000, help="Ticks of the long random run of the C.")
]

DesignArgument = Annotated[
    Path, typer.Argument(metavar="FILE.json", help="A design file.", show_default=False)
]
