"""Options read as the sections of a file are read: the same checks, the same words, every problem at once.

Not for: which options a command has.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from swayless.cli.options import OptionError
from swayless.machine.problems import Place, Report, Table

Texts: TypeAlias = "str | Sequence[Texts]"
"""An option's value as the shell gives it: a text, or several for an array."""

_CALLED = {"family": "FAMILY", "damping_ratio": "--damping"}


@dataclass(frozen=True)
class OptionTable(Table):
    """Options by the keys of a machine file; problems name the option.

    Parameters
    ----------
    called : mapping
        Options by key, where they have another name than in other commands.
    """

    called: Mapping[str, str] = field(default_factory=dict)

    def place(self, key: str) -> Place:
        """Where the value of `key` stands on the command line."""
        usual = _CALLED.get(key, f"--{key.replace('_', '-')}")
        return Place(self.report, self.called.get(key, usual))


def option_table(
    given: Mapping[str, Texts | None], problems: list[str], *, called: Mapping[str, str] | None = None
) -> OptionTable:
    """Make a table of options.

    Parameters
    ----------
    given : mapping
        Texts by key; None where an option was not given. A plain number becomes one, as in a file.
    problems : list of str
        Takes what the checks find.
    called : mapping
        Options by key, where they have another name than in other commands.

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
    present = {key: _plain(value) for key, value in given.items() if value is not None}
    return OptionTable(present, Report("", problems), "", called=called or {})


def the_one_given(given: Mapping[str, object], problems: list[str]) -> str | None:
    """Give the one option that is given; none or several are a problem.

    Parameters
    ----------
    given : mapping
        Values by option; None or empty where it was not given.
    problems : list of str
        Takes what is wrong.

    Examples
    --------
    >>> the_one_given({"--band": [], "--rope-length": "9ft to 29ft"}, [])
    '--rope-length'
    """
    found = [option for option, value in given.items() if value not in (None, [])]
    if len(found) == 1:
        return found[0]
    are = f"{' and '.join(found)} are" if found else "none is"
    problems.append(f"{', '.join(given)}: exactly one of them is needed, {are} given")
    return None


def refuse(problems: list[str]) -> None:
    """Raise an `OptionError` if there are problems."""
    if problems:
        raise OptionError(problems)


def _plain(value: Texts) -> Any:
    """Give the number that a text is, or the text; an array of them for several."""
    if not isinstance(value, str):
        return [_plain(item) for item in value]
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            continue
    return value
