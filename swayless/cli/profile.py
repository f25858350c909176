"""`swayless profile`: moves computed ahead, to be played from a table. Not for: what each one does."""

from __future__ import annotations

import typer

from swayless.cli.help_text import help_text
from swayless.cli.profile_invert import invert
from swayless.cli.profile_optimal import optimal
from swayless.cli.profile_simulate import simulate
from swayless.cli.profile_tune import tune


def _profile() -> None:
    """Compute a move ahead: a command with one value a tick, from rest to rest.

    Examples
    --------
    swayless profile optimal move.toml
    swayless profile optimal crane.toml --rope-length "6 m" --target 12 -o move.csv
    swayless profile simulate move.toml --feedback "2 0.15"
    swayless profile invert servo.toml -o move.csv
    """


profile_app = typer.Typer(help=help_text(_profile), no_args_is_help=True)


@profile_app.callback()
def _group() -> None:
    """Make it a group, though it may have one command only."""


profile_app.command(help=help_text(optimal), short_help="The fewest ticks, or the least energy, in limits.")(
    optimal
)
profile_app.command(help=help_text(simulate), short_help="A move on plants that are off, with a feedback.")(
    simulate
)
profile_app.command(
    help=help_text(invert), short_help="A load along a polynomial, by inversion of its plant."
)(invert)
profile_app.command(help=help_text(tune), short_help="Parameters of a drive from a measured move.")(tune)
