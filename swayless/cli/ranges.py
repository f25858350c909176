"""Ranges on the command line: ``--damping 0.02``, ``--damping 0 0.05`` and ``--damping "0 to 0.05"``.

A click option takes a fixed number of values. Here the values that follow an option of a range are joined
into one text before click sees them, and a text is split into the ends of the range again.

Not for: checking what a range holds.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from typer.core import TyperCommand

RANGE_OPTIONS = ("--band", "--rope-length", "--damping")

_NO_OPTION = re.compile(r"[^-].*|-[0-9.].*", re.DOTALL)
# A hyphen separates what stands around it unless it is the sign of a number or of its exponent.
_SEPARATOR = re.compile(r"\s+to\s+|\s*(?:\.\.|:)\s*|(?<=[0-9a-z%])(?<![0-9.][eE])\s*-\s*")
_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_BARE, _WITH_UNIT = re.compile(_NUMBER), re.compile(rf"{_NUMBER}\s*([A-Za-z%]+)")


class RangeCommand(TyperCommand):
    """A command without arguments, whose options of ranges take one value or two."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Join the values of ranges, then parse."""
        return super().parse_args(ctx, joined(args))


def joined(args: Sequence[str]) -> list[str]:
    """Join the values that follow an option of a range.

    Examples
    --------
    >>> joined(["--band", "0.17", "0.30", "--tick", "10 ms", "--damping=0", "0.05"])
    ['--band', '0.17 to 0.30', '--tick', '10 ms', '--damping=0 to 0.05']
    """
    result: list[str] = []
    open_range = needs_first = False
    for arg in args:
        name, _, value = arg.partition("=")
        if open_range and (needs_first or _NO_OPTION.fullmatch(arg)):
            result = [*result, arg] if needs_first else [*result[:-1], f"{result[-1]} to {arg}"]
            needs_first = False
            continue
        open_range, needs_first = name in RANGE_OPTIONS, not value
        result.append(arg)
    return result


def ends(text: str) -> str | list[str]:
    """Split a range into its ends, for both of which a unit counts that stands once; a single value stays.

    Examples
    --------
    >>> ends("9 ft to 29 ft"), ends("0-0.05"), ends("0..5 %"), ends("1e-3 to -2"), ends("-1")
    (['9 ft', '29 ft'], ['0', '0.05'], ['0 %', '5 %'], ['1e-3', '-2'], '-1')
    """
    parts = _SEPARATOR.split(text.strip())
    if len(parts) < 2:
        return text
    units = {found[1] for part in parts if (found := _WITH_UNIT.fullmatch(part))}
    bare = [bool(_BARE.fullmatch(part)) for part in parts]
    shared = f" {units.pop()}" if len(units) == 1 else ""
    return [part + shared if is_bare else part for part, is_bare in zip(parts, bare, strict=True)]
