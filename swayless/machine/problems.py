"""Reading a parsed document while collecting every problem: places, tables and the words of a message.

A *check* takes a value and its place; it gives the value back in the form wanted, or reports what is wrong
and gives None; `plain` makes one from a function that raises `RefusedError`. A table hands its values to
checks and reports the keys that nobody asked for.

Not for: files on disk, or the meaning of any one key.
"""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, TypeVar

T = TypeVar("T")
D = TypeVar("D")

_MAX_SHOWN = 60
_MAX_SHOWN_BITS = 128
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]{1,60}")


def shown(value: object) -> str:
    """Print a value of a document in ASCII, as its file would, and cut it where it gets long.

    Examples
    --------
    >>> shown([True, "29 ft", 1.5]), shown({"a": 1})
    ('[true, "29 ft", 1.5]', '{...}')
    """
    if isinstance(value, list):
        text = f"[{', '.join(_shown_item(item) for item in value[:_MAX_SHOWN])}]"
    else:
        text = _shown_item(value)
    return text if len(text) <= _MAX_SHOWN else f"{text[:_MAX_SHOWN]}..."


def _shown_item(value: object) -> str:
    if isinstance(value, dict | list):
        return "{...}" if isinstance(value, dict) else "[...]"
    if isinstance(value, str):
        return json.dumps(value[: _MAX_SHOWN + 1])
    if isinstance(value, int) and value.bit_length() > _MAX_SHOWN_BITS:
        return f"(an integer of {value.bit_length()} bits)"
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    return str(value)


def nearest(word: str, known: Iterable[str]) -> str:
    """Say which known words are nearest to `word`, and which are known at all.

    Examples
    --------
    >>> nearest("zvv", ["zv", "zvd", "ei"])
    'nearest: zv, zvd; known: zv, zvd, ei'
    >>> nearest("?", [])
    'known: none'
    """
    words = list(dict.fromkeys(known))
    close = difflib.get_close_matches(word[:_MAX_SHOWN], words, n=3, cutoff=0.55)
    return (f"nearest: {', '.join(close)}; " if close else "") + f"known: {', '.join(words) or 'none'}"


@dataclass(frozen=True)
class Report:
    """A file, and every problem found in it so far.

    Parameters
    ----------
    file : str
        What the user called the file.
    problems : list of str
        One line each, in the order found.
    """

    file: str
    problems: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Place:
    """Where a value stands in a file.

    Parameters
    ----------
    report : Report
        The file, and where its problems go.
    path : str
        What leads to the value, such as ``"[crane] rope_length"`` or ``"shapers[0].times_s"``; empty for the
        file.

    Examples
    --------
    >>> place = Place(Report("crane.toml"), "[crane] rope_length")
    >>> place.item(0).wrong(-2.0, "must be > 0")
    >>> place.report.problems
    ['crane.toml: [crane] rope_length[0] = -2.0: must be > 0']
    """

    report: Report
    path: str

    def item(self, index: int) -> Place:
        """Place of one item of the array that stands here."""
        return Place(self.report, f"{self.path}[{index}]")

    def wrong(self, value: object, reason: str) -> None:
        """Report that `value`, which stands here, is wrong."""
        self._add(f"{self.path} = {shown(value)}" if self.path else shown(value), reason)

    def problem(self, reason: str) -> None:
        """Report a problem that is not about one value."""
        self._add(self.path, reason)

    def _add(self, what: str, reason: str) -> None:
        self.report.problems.append(": ".join(part for part in (self.report.file, what, reason) if part))


Check: TypeAlias = Callable[[object, Place], T | None]
"""Takes a value and its place; gives the wanted form of the value, or reports a problem and gives None."""


class RefusedError(ValueError):
    """A value is not what it has to be; `reason` says what that is, without the value."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


def plain(parse: Callable[[object], T]) -> Check[T]:
    """Make a check from a function of the value alone that raises `RefusedError`.

    Examples
    --------
    >>> from swayless.machine.quantity import parse_quantity
    >>> place = Place(Report("crane.toml"), "[controller] tick")
    >>> plain(lambda value: parse_quantity(value, "time"))("10 kg", place)
    >>> place.report.problems
    ['crane.toml: [controller] tick = "10 kg": is not a time: allowed units are s, ms, us, min']
    """

    def check(value: object, place: Place) -> T | None:
        try:
            return parse(value)
        except RefusedError as refused:
            place.wrong(value, refused.reason)
            return None

    return check


@dataclass(frozen=True)
class Table:
    """A table of a document, read key by key.

    Parameters
    ----------
    raw : mapping
        The parsed table.
    report : Report
        The file, and where its problems go.
    prefix : str
        What leads to a key: ``"[crane] "`` or ``"shapers[0]."``; empty at the top of the file.

    Examples
    --------
    >>> table = Table({"order": 2, "ordr": 3}, Report("crane.toml"), "[crane] ")
    >>> table.need("order", lambda value, place: value)
    2
    >>> table.close()
    >>> table.report.problems
    ['crane.toml: [crane] ordr: unknown key; nearest: order; known: order']
    """

    raw: Mapping[str, object]
    report: Report
    prefix: str
    asked: list[str] = field(default_factory=list)

    def place(self, key: str) -> Place:
        """Where the value of `key` stands."""
        return Place(self.report, self.prefix + key)

    def take(self, key: str, check: Check[T], default: D) -> T | D | None:
        """Value of `key` after `check`: the default when it is absent, None when it is wrong."""
        self.asked.append(key)
        return check(self.raw[key], self.place(key)) if key in self.raw else default

    def need(self, key: str, check: Check[T]) -> T | None:
        """Value of `key` after `check`; its absence is a problem."""
        if key not in self.raw:
            self.place(key).problem("missing")
        return self.take(key, check, None)

    def need_one_of(self, *keys: str) -> None:
        """Report unless exactly one of `keys` is present."""
        present = [key for key in keys if key in self.raw]
        if len(present) != 1:
            found = f"{' and '.join(present)} are" if present else "none is"
            self.place(" or ".join(keys)).problem(f"exactly one is needed, {found} given")

    def close(self) -> None:
        """Report every key that was not asked for."""
        for key, value in self.raw.items():
            if key not in self.asked:
                name = key if _BARE_KEY.fullmatch(key) else shown(key)
                what = "section" if isinstance(value, dict) else "key"
                self.place(name).problem(f"unknown {what}; {nearest(key, self.asked)}")
