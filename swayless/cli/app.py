"""The `swayless` program: its commands, and the exit code of every error. Not for: what commands do."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from swayless import __version__
from swayless.cli.build import build
from swayless.cli.design import design
from swayless.cli.generate import generate
from swayless.cli.init import init
from swayless.cli.plot import plot
from swayless.cli.verify import verify
from swayless.errors import SwaylessError, ToolMissingError, VerificationError

EXIT_DIFFERS, EXIT_BAD, EXIT_TOOL_MISSING = 1, 2, 3

app = typer.Typer(
    name="swayless",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
)


@app.callback(invoke_without_command=True)
def _swayless(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version and exit.")] = False,
) -> None:
    """From a crane's rope lengths to proven controller code.

    Start with:  swayless init crane.toml --example srtc-gantry

    then:  swayless build crane.toml

    Exit codes: 0 ok, 1 differs or verification failed, 2 bad usage or bad file, 3 a tool is missing.
    """
    if version:
        typer.echo(f"swayless {__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


for _command in (init, design, plot, generate, verify, build):
    app.command()(_command)


def main() -> None:
    """Run the program and turn errors into messages and exit codes."""
    try:
        app()
    except SwaylessError as error:
        typer.echo(f"error: {error}", err=True)
        sys.exit(_exit_code(error))


def _exit_code(error: SwaylessError) -> int:
    if isinstance(error, ToolMissingError):
        return EXIT_TOOL_MISSING
    return EXIT_DIFFERS if isinstance(error, VerificationError) else EXIT_BAD
