"""Moves and hoists as a user says them: ``"12 m at 0.6 m/s from 2 s"``. Not for: checking the quantities."""

from __future__ import annotations

import re
from collections.abc import Mapping

from swayless.machine.quantity import UNITS

HOIST: Mapping[str, str] = {"": "from", "to": "to", "at": "rate", "from": "start"}
WIND: Mapping[str, str] = {"": "push", "from": "start", "for": "duration"}

_MOVE: Mapping[str, str] = {"at": "speed", "from": "start"}
_UNIT = re.compile(r".*?([A-Za-z]+)\s*")


def phrase(text: str, keys: Mapping[str, str], problems: list[str], option: str) -> dict[str, str]:
    """Split a phrase at its words into the values of a section.

    Parameters
    ----------
    text : str
        Values with words between them.
    keys : mapping
        Key of the value behind each word; that of the first value behind "".
    problems : list of str
        Takes a word that stands twice.
    option : str
        What the problem is about.

    Examples
    --------
    >>> phrase("8.84 m to 3.74 m at 0.3 m/s from 1 s", HOIST, [], "--hoist")
    {'from': '8.84 m', 'to': '3.74 m', 'rate': '0.3 m/s', 'start': '1 s'}
    """
    words = "|".join(word for word in keys if word)
    first, *rest = re.split(rf"\s+({words})\s+", text.strip())
    spoken = rest[::2]
    twice = [word for word in dict.fromkeys(spoken) if spoken.count(word) > 1]
    problems += [f'{option} = "{text}": "{word}" stands twice' for word in twice]
    return {keys[""]: first} | {keys[word]: value for word, value in zip(spoken, rest[1::2], strict=True)}


def move_phrase(text: str, problems: list[str]) -> dict[str, str]:
    """Split a move, which begins with its way or with the time of the press.

    Parameters
    ----------
    text : str
        Such as "12 m at 0.6 m/s from 2 s".
    problems : list of str
        Takes what cannot be split.

    Examples
    --------
    >>> move_phrase("12 m at 0.6 m/s", []), move_phrase("8 s", [])
    ({'distance': '12 m', 'speed': '0.6 m/s'}, {'duration': '8 s'})
    """
    first = re.split(r"\s+(?:at|from)\s+", text.strip())[0]
    unit = _UNIT.fullmatch(first)
    key = "duration" if unit and unit[1] in UNITS["time"] else "distance"
    return phrase(text, {"": key, **_MOVE}, problems, "--move")
