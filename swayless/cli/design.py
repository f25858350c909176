"""`swayless design`: a family's name or one of the commands of the group, all of which design shapers.

Not for: what each of them does.
"""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from swayless.cli.design_bank import bank
from swayless.cli.design_family import FAMILY, design_family
from swayless.cli.design_robust import fd, si
from swayless.cli.help_text import help_text
from swayless.cli.ranges import RangeCommand
from swayless.cli.recommend import recommend


class DesignGroup(TyperGroup):
    """A group in which what names no command is left to the command of the families."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Find the command: by its name, or that of the families with all arguments, the first included."""
        if args[0] in self.commands and args[0] != FAMILY:
            return super().resolve_command(ctx, args)
        return FAMILY, self.commands[FAMILY], args

    def collect_usage_pieces(self, ctx: Any) -> list[str]:  # noqa: ARG002 - the caller's signature
        """Give what follows ``swayless design``."""
        return ["FAMILY|COMMAND [OPTIONS]"]


class FamilyCommand(TyperCommand):
    """The command of the families: their name, the first argument, stands in the place of its own."""

    def collect_usage_pieces(self, ctx: Any) -> list[str]:  # noqa: ARG002 - the caller's signature
        """Give what follows ``swayless design FAMILY``."""
        return ["[OPTIONS]"]


def _design() -> None:
    """Design a shaper, or a bank of them, and say what it guarantees.

    FAMILY is a shaper with a fixed recipe, made for one mode: zv zvd zvdd zvddd zvm ei ei2 ei3 mzv; with
    negative amplitudes um-zv um-zvd um-ei oatf. `swayless design zv --help` shows the options.

    The commands take a range and a tolerance instead. What they give is proved: a lower bound says that no
    other shaper of its kind does better.

    Examples
    --------
    swayless design ei --rope-length "24 ft" --tick "10 ms" -o ei.json
    swayless design si --rope-length 9ft 29ft --tolerance "5 %"
    swayless design fd --duration 3.0 --from 29ft --amplitudes bounded
    swayless design bank crane.toml --rows 3 --duration 3.0
    swayless design recommend crane.toml --longest-overtravel "1.5 m"
    """


_RECOMMEND = "Rank all that could serve a machine, and say why."

design_app = typer.Typer(
    cls=DesignGroup,
    help=help_text(_design),
    no_args_is_help=True,
    # Options before the family's name have to reach its command.
    context_settings={"ignore_unknown_options": True},
)
design_app.command(FAMILY, cls=FamilyCommand, help=help_text(design_family))(design_family)
design_app.command(cls=RangeCommand, help=help_text(si))(si)
for _command in (fd, bank):
    design_app.command(help=help_text(_command))(_command)
design_app.command(help=help_text(recommend), short_help=_RECOMMEND)(recommend)
