"""One value in the text of a TOML file exchanged for another; comments, order and blanks stay as they are.

Not for: what the value means.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

_HEADER = re.compile(r"\s*\[\s*([A-Za-z0-9_-]+|\"[^\"]*\")\s*\]\s*(#.*)?")
_ANY_HEADER = re.compile(r"\s*\[")
_KEY = re.compile(r"(\s*)([A-Za-z0-9_-]+)(\s*=\s*)")
_PIECE = re.compile(
    r"\"\"\".*?\"\"\"|'''.*?'''|\"(?:[^\"\\n]|\\.)*\"|'[^'\n]*'|#[^\n]*|[\[{]|[\]}]|\n|[^\"'#\[\]{}\n]+",
    re.DOTALL,
)
_ITEM = re.compile(r"\"(?:[^\"\\\n]|\\.)*\"|'[^'\n]*'|#[^\n]*|[^\s,\[\]#\"']+")

NO_NOTES: Mapping[str, str] = MappingProxyType({})


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


def replaced(
    text: str, section: str, values: Mapping[str, str | Sequence[str]], notes: Mapping[str, str] = NO_NOTES
) -> str:
    r"""Exchange values of a section; a key that is not there follows the first that is.

    Parameters
    ----------
    text : str
        As for `entries`; a section without any of the keys stays as it is.
    section : str
    values : mapping
        TOML values by key. The items of an array, as a sequence, go into the places of those that are there:
        comments and lines between them stay.
    notes : mapping
        Comments to put behind values that are there, by key.

    Examples
    --------
    >>> print(replaced('[arm]\nfrequency = 4 # Hz\n', "arm", {"frequency": "5", "damping_ratio": "0.1"}))
    [arm]
    frequency = 5 # Hz
    damping_ratio = 0.1
    <BLANKLINE>
    >>> replaced('[arm]\nfrequency = [4, 5]\n', "arm", {"frequency": ("5", "6")}, {"frequency": "Hz"})
    '[arm]\nfrequency = [5, 6]  # Hz\n'
    """
    found = {entry.key: entry for entry in entries(text, section) if entry.key in values}
    if not found:
        return text
    place = min(entry.line_end for entry in found.values())
    joint = "" if text[:place].endswith("\n") else "\n"
    new = [f"{joint}{key} = {_new('', value)}\n" for key, value in values.items() if key not in found]
    pieces = [
        (entry.start, entry.end, _new(text[entry.start : entry.end], values[key]) + _note(notes.get(key)))
        for key, entry in found.items()
    ]
    for start, end, value in sorted([*pieces, (place, place, "".join(new))], reverse=True):
        text = text[:start] + value + text[end:]
    return text


def written(text: str, section: str, key: str) -> tuple[str, str]:
    r"""Give the value of a key as it is written, and the rest of its line; empty where it is not there.

    Parameters
    ----------
    text, section
        As for `entries`.
    key : str

    Examples
    --------
    >>> written('[crane]\nrope_length = [2, 10]  # m\n', "crane", "rope_length")
    ('[2, 10]', '# m')
    """
    for entry in entries(text, section):
        if entry.key == key:
            return text[entry.start : entry.end], text[entry.end : entry.line_end].strip()
    return "", ""


def _new(old: str, value: str | Sequence[str]) -> str:
    """Give a value as it is, or put its items into the places of those in an old array."""
    if isinstance(value, str):
        return value
    spans = [match.span() for match in _ITEM.finditer(old) if match[0][0] != "#"]
    if not old.startswith("[") or len(spans) not in {1, len(value)}:
        return f"[{', '.join(value)}]"
    items = value if len(spans) == len(value) else [", ".join(value)]
    for (start, end), item in reversed(list(zip(spans, items, strict=True))):
        old = old[:start] + item + old[end:]
    return old


def _note(comment: str | None) -> str:
    return "" if comment is None else f"  # {comment}"


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
