"""The `swayless` program: commands, help, and the exit code of every error. Not for: what commands do."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from swayless import __version__
from swayless.cli.build import build
from swayless.cli.design import design_app
from swayless.cli.generate import generate
from swayless.cli.help_text import help_text
from swayless.cli.identify import IdentifyCommand, identify
from swayless.cli.init import init
from swayless.cli.options import OptionError
from swayless.cli.plot import plot
from swayless.cli.profile import profile_app
from swayless.cli.simulate import simulate
from swayless.cli.verify import verify
from swayless.errors import FileError, SwaylessError, ToolMissingError, VerificationError

EXIT_DIFFERS, EXIT_BAD, EXIT_TOOL_MISSING = 1, 2, 3


class Menu(TyperGroup):
    """The commands in the order of a user's work; groups would come last otherwise."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Give the names of all commands."""
        return sorted(super().list_commands(ctx), key=_ORDER.index)


_ORDER = ("init", "identify", "design", "profile", "plot", "simulate", "generate", "verify", "build")

app = typer.Typer(
    name="swayless",
    cls=Menu,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
)


def _swayless(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version and exit.")] = False,
) -> None:
    """From a crane's rope lengths to proven controller code.

    Exit codes: 0 ok, 1 differs or verification failed, 2 bad usage or bad file, 3 a tool is missing.

    Examples
    --------
    swayless init crane.toml
    swayless build crane.toml
    """
    if version:
        typer.echo(f"swayless {__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


app.callback(invoke_without_command=True, help=help_text(_swayless))(_swayless)
for _command in (init, simulate, generate, verify, build):
    app.command(help=help_text(_command))(_command)
app.command(cls=IdentifyCommand, help=help_text(identify))(identify)
app.command(help=help_text(plot), short_help="Draw sensitivity, a response, a bank, or a trade-off.")(plot)
app.add_typer(design_app, name="design")
app.add_typer(profile_app, name="profile", short_help="Compute a move ahead, to be played from a table.")


def main() -> None:
    """Run the program and turn errors into messages and exit codes."""
    try:
        app()
    except SwaylessError as error:
        problems = error.problems if isinstance(error, FileError | OptionError) else (str(error),)
        for problem in problems:
            typer.echo(f"error: {problem}", err=True)
        sys.exit(_exit_code(error))
    except OSError as error:
        # Files are seen to where they are written; what is left is the machine: a full disk behind a pipe, no
        # temporary folder, a compiler that does not start.
        typer.echo(f"error: {error}", err=True)
        _discard_output()
        sys.exit(EXIT_BAD)


def _discard_output() -> None:
    """Send what standard output still holds nowhere, or Python would write it as it ends, and fail again."""
    with suppress(AttributeError, OSError), Path(os.devnull).open("wb") as nowhere:
        os.dup2(nowhere.fileno(), sys.stdout.fileno())


def _exit_code(error: SwaylessError) -> int:
    if isinstance(error, ToolMissingError):
        return EXIT_TOOL_MISSING
    return EXIT_DIFFERS if isinstance(error, VerificationError) else EXIT_BAD
