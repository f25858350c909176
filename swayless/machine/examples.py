"""The files that ship with swayless: a commented start for a user, and examples that tests run.

There is one copy of each, in the folder ``examples`` at the top of the source tree, where people look for it.
A wheel carries that folder inside this package.

Not for: the user's own files.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Literal, TypeAlias

from swayless.errors import FileError
from swayless.machine.problems import nearest

ExampleKind: TypeAlias = Literal["machine", "adaptive", "move", "inversion"]
"""What an example describes: a machine, an adaptive shaper, the fastest move, or one by inversion."""

EXAMPLES: Mapping[str, ExampleKind] = MappingProxyType(
    {
        "srtc-gantry": "machine",
        "workshop-crane": "machine",
        "flexible-arm": "machine",
        "srtc-gantry-bank": "machine",
        "double-pendulum": "machine",
        "hoisting-gantry": "machine",
        "elbow-arm": "machine",
        "two-axis-crane": "machine",
        "adaptive-robot": "adaptive",
        "time-optimal-oscillator": "move",
        "inverted-servo": "inversion",
    }
)
"""Names of the examples, in the order in which to read them, and what each one describes."""

EXAMPLE_NAMES = tuple(name for name, kind in EXAMPLES.items() if kind == "machine")
"""Names of those that describe a machine."""

_HERE = Path(__file__).parent
_IN_WHEEL = _HERE / "examples"
_IN_CHECKOUT = _HERE.parents[1] / "examples"


def example_text(name: str) -> str:
    """Give the text of an example.

    Parameters
    ----------
    name : str
        One of `EXAMPLES`.

    Raises
    ------
    FileError
        If there is no such example.

    Examples
    --------
    >>> 'name = "srtc_gantry"' in example_text("srtc-gantry")
    True
    """
    return example_path(name).read_text(encoding="utf-8")


def example_path(name: str) -> Path:
    """Give the file of an example.

    Raises
    ------
    FileError
        If there is no such example.

    Examples
    --------
    >>> example_path("inverted-servo").name
    'inverted-servo.toml'
    """
    if name not in EXAMPLES:
        raise FileError([f"example {name!r}: unknown; {nearest(name, tuple(EXAMPLES))}"])
    folder = _IN_WHEEL if _IN_WHEEL.is_dir() else _IN_CHECKOUT
    return folder / f"{name}.toml"
