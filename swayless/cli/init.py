"""`swayless init`: a commented machine file to start from."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


class Example(StrEnum):
    """The machine files that ship with swayless."""

    srtc_gantry = "srtc-gantry"
    workshop_crane = "workshop-crane"
    flexible_arm = "flexible-arm"


def init(
    file: Annotated[
        Path | None,
        typer.Argument(metavar="[FILE]", help="File to write; NAME.toml here unless given.", show_default=False),
    ] = None,
    example: Annotated[Example, typer.Option("--example", help="Which machine to start from.")] = Example.srtc_gantry,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
) -> None:
    """Write a commented machine file to start from.

    Example:  swayless init crane.toml --example workshop-crane
    """
    from swayless.errors import FileError
    from swayless.machine import example_text, write_text_atomically

    path = file or Path(f"{example.value}.toml")
    if path.exists() and not force:
        raise FileError([f"{path}: is there already; choose another name, or replace it with --force"])
    write_text_atomically(path, example_text(example.value))
    typer.echo(f"{path}: written; edit it, then run: swayless build {path}")
