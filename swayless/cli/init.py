"""`swayless init`: a commented file to start from."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from swayless.cli.options import JsonOption


class Example(StrEnum):
    """The files that ship with swayless."""

    srtc_gantry = "srtc-gantry"
    workshop_crane = "workshop-crane"
    flexible_arm = "flexible-arm"
    srtc_gantry_bank = "srtc-gantry-bank"
    double_pendulum = "double-pendulum"
    hoisting_gantry = "hoisting-gantry"
    elbow_arm = "elbow-arm"
    two_axis_crane = "two-axis-crane"
    adaptive_robot = "adaptive-robot"
    time_optimal_oscillator = "time-optimal-oscillator"
    inverted_servo = "inverted-servo"


def init(
    file: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help="File to write; EXAMPLE.toml unless given.", show_default=False),
    ] = None,
    example: Annotated[
        Example,
        typer.Option("--example", metavar="NAME", help=f"Where to start from: {', '.join(Example)}."),
    ] = Example.srtc_gantry,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
    json: JsonOption = False,
) -> None:
    """Write a commented machine file to start from.

    The examples: a 15-ton gantry crane (double, for C and Structured Text), a workshop crane with a joystick
    (float), a flexible arm (int32, for C only), the gantry crane with a bank that covers all its ropes, a
    crane whose load hangs on a sling below the hook, one that hoists while it travels, an arm whose elbow
    turns, a crane with two axes; a robot that learns its vibration; and two moves computed
    ahead, the fastest of an oscillator and one of a servo drive by inversion.

    Examples
    --------
    swayless init crane.toml
    swayless init crane.toml --example workshop-crane
    """
    from swayless.cli.console import print_json
    from swayless.errors import FileError
    from swayless.machine import example_text, write_text_atomically

    path = file or Path(f"{example.value}.toml")
    if path.exists() and not force:
        raise FileError([f"{path}: is there already; choose another name, or replace it with --force"])
    write_text_atomically(path, example_text(example.value))
    if json:
        print_json({"file": str(path), "example": example.value})
    else:
        typer.echo(f"{path}: written; edit it, then run: swayless build {path}")
