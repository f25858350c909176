"""`swayless profile invert`: the command under which a load moves as a polynomial."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from swayless.cli.options import JsonOption

FileArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE.toml", help="A drive or a plant, and the motion of its load.", show_default=False
    ),
]
OutputOption = Annotated[
    list[Path] | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        help="Write command and trajectory, one line a tick (.csv), or draw them (.svg, .png, .pdf); may be"
        " given several times.",
    ),
]


def invert(file: FileArgument, output: OutputOption = None, json: JsonOption = False) -> None:
    """Find the command under which a load moves as a polynomial from rest to rest, without a swing.

    The plant is a motor under a PI loop that moves its load through a spring and a damper, or any transfer
    function without zeros in the right half plane. The command is a closed form of polynomials and
    exponentials, held for a tick each; it goes on after the load has arrived, until it has died out.

    Examples
    --------
    swayless profile invert servo.toml -o move.csv -o move.svg
    """
    from swayless.cli.console import print_json
    from swayless.cli.profile_figures import check_apart, check_places, write_by_suffix
    from swayless.cli.profile_inversion_output import document, draw, print_found, trajectory_text
    from swayless.machine.inversion_file import load_inversion

    outputs = output or []
    check_places(outputs)
    check_apart(outputs, [file])
    request = load_inversion(file)
    write_by_suffix(outputs, lambda: trajectory_text(request), lambda: draw(request))
    if json:
        print_json(document(request))
        return
    print_found(request)
    note = "note: give -o to write the command and the output that it should make, one line a tick"
    for line in [f"{path}: written" for path in outputs] or [note]:
        typer.echo(line)
