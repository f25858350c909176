"""TOML files that a person wrote: read with a limit, and syntax errors shown with their line.

Not for: what stands in them.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from swayless.errors import FileError
from swayless.machine.source import read_source

MAX_BYTES = 1_000_000
"""Largest file that is read."""

_AT_LINE = re.compile(r"(.*) \(at line (\d+), column (\d+)\)")
_NAKED_QUANTITY = re.compile(r"=[^\"'#]*[0-9.]\s*[A-Za-z%]")


def read_toml(path: Path) -> dict[str, object]:
    """Read a TOML file.

    Parameters
    ----------
    path : Path
        The file; at most `MAX_BYTES`.

    Raises
    ------
    FileError
        If it cannot be read, or is no TOML; the message shows the line.
    """
    text = read_source(path, max_bytes=MAX_BYTES)
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise FileError([f"{path}: not valid TOML: nested too deeply"]) from error
    except ValueError as error:
        raise FileError([f"{path}: {_syntax_problem(text, f'{error}')}"]) from error


def _syntax_problem(text: str, message: str) -> str:
    """Put the line and its text beside what the parser says."""
    match = _AT_LINE.fullmatch(message)
    if match is None:
        return f"not valid TOML: {message}"
    line = text.split("\n")[int(match[2]) - 1].strip()
    hint = '; a quantity with a unit stands in quotes: "29 ft"' if _NAKED_QUANTITY.search(line) else ""
    return f"line {match[2]}, column {match[3]}: {line[:60]!a}: not valid TOML: {match[1]}{hint}"
