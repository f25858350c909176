"""Options read as the sections of a file are read: the same checks, the same words, every problem at once.

Not for: which options a command has.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swayless.cli.options import OptionError
from swayless.machine.problems import Place, Report, Table

_CALLED = {"family": "FAMILY", "damping_ratio": "--damping"}


class OptionTable(Table):
    """Options by the keys of a machine file; problems name the option."""

    def place(self, key: str) -> Place:
        """Where the value of `key` stands on the command line."""
        return Place(self.report, _CALLED.get(key, f"--{key.replace('_', '-')}"))


def option_table(given: Mapping[str, str | None], problems: list[str]) -> OptionTable:
    """Make a table of options.

    Parameters
    ----------
    given : mapping
        Texts by key; None where an option was not given. A plain number becomes one, as in a file.
    problems : list of str
        Takes what the checks find.

    Examples
    --------
    >>> from swayless.machine.plant_section import LENGTH
    >>> problems = []
    >>> option_table({"rope_length": "24 ft"}, problems).take("rope_length", LENGTH, None)
    7.3152
    >>> option_table({"rope_length": "-1"}, problems).take("rope_length", LENGTH, None)
    >>> problems
    ['--rope-length = -1: must be > 0']
    """
    present = {key: _plain(text) for key, text in given.items() if text is not None}
    return OptionTable(present, Report("", problems), "")


def refuse(problems: list[str]) -> None:
    """Raise an `OptionError` if there are problems."""
    if problems:
        raise OptionError(problems)


def _plain(text: str) -> Any:
    """Give the number that a text is, or the text."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
