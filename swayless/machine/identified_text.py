"""One value in the text of a TOML file exchanged for another; comments, order and blanks stay as they are.

Not for: what the value means.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

_HEADER = re.compile(r"\s*\[\s*([A-Za-z0-9_-]+|\"[^\"]*\")\s*\]\s*(#.*)?")
_ANY_HEADER = re.compile(r"\s*\[")
_KEY = re.compile(r"(\s*)([A-Za-z0-9_-]+)(\s*=\s*)")
_PIECE = re.compile(
    r"\"\"\".*?\"\"\"|'''.*?'''|\"(?:[^\"\\n]|\\.)*\"|'[^'\n]*'|#[^\n]*|[\[{]|[\]}]|\n|[^\"'#\[\]{}\n]+",
    re.DOTALL,
)


class Entry(NamedTuple):
    """A key and its value in a text.

    Parameters
    ----------
    key : str
    start, end : int
        Where its value begins and ends.
    line_start, line_end : int
        Where its first line begins, and where the line in which it ends does, its line end included.
    """

    key: str
    start: int
    end: int
    line_start: int
    line_end: int


def entries(text: str, section: str) -> Iterator[Entry]:
    r"""Find the keys of a section that is written with a head of its own.

    Parameters
    ----------
    text : str
        Valid TOML with line ends of one character.
    section : str
        Such as ``"crane"``.

    Examples
    --------
    >>> text = '[crane]\nrope_length = [2, 10]  # m\n[controller]\ntick = 1\n'
    >>> [(entry.key, text[entry.start : entry.end]) for entry in entries(text, "crane")]
    [('rope_length', '[2, 10]')]
    """
    inside, position = False, 0
    while position < len(text):
        stop = _line_end(text, position)
        line = text[position:stop].rstrip("\n")
        header, key = _HEADER.fullmatch(line), _KEY.match(line)
        if header or _ANY_HEADER.match(line):
            inside = bool(header and header[1].strip('"') == section)
        elif key:
            start = position + key.end()
            end = _value_end(text, start)
            stop = _line_end(text, end)
            if inside:
                yield Entry(key[2], start, end, position, stop)
        position = stop


def replaced(text: str, section: str, values: dict[str, str]) -> str:
    r"""Exchange values of a section; a key that is not there follows the first that is.

    Parameters
    ----------
    text : str
        As for `entries`; a section without any of the keys stays as it is.
    section : str
    values : dict
        TOML values by key.

    Examples
    --------
    >>> print(replaced('[arm]\nfrequency = 4 # Hz\n', "arm", {"frequency": "5", "damping_ratio": "0.1"}))
    [arm]
    frequency = 5 # Hz
    damping_ratio = 0.1
    <BLANKLINE>
    """
    found = {entry.key: entry for entry in entries(text, section) if entry.key in values}
    if not found:
        return text
    place = min(entry.line_end for entry in found.values())
    joint = "" if text[:place].endswith("\n") else "\n"
    new = [f"{joint}{key} = {value}\n" for key, value in values.items() if key not in found]
    pieces = [(entry.start, entry.end, values[key]) for key, entry in found.items()]
    for start, end, value in sorted([*pieces, (place, place, "".join(new))], reverse=True):
        text = text[:start] + value + text[end:]
    return text


def _line_end(text: str, position: int) -> int:
    end = text.find("\n", position)
    return len(text) if end < 0 else end + 1


def _value_end(text: str, start: int) -> int:
    """Find where a value ends: at a comment or a line end outside of its brackets, blanks before it apart."""
    depth, position, end = 0, start, start
    while position < len(text):
        match = _PIECE.match(text, position)
        if match is None or (depth == 0 and match[0][0] in "#\n"):
            break
        depth += (match[0] in "[{") - (match[0] in "]}")
        position = match.end()
        if match[0][0] not in "#\n" and match[0].strip():
            end = position - (len(match[0]) - len(match[0].rstrip()))
    return end
