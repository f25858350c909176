"""The machine files that ship with swayless: a commented start for a user, and examples that tests run.

There is one copy of each, in the folder ``examples`` at the top of the source tree, where people look for it.
A wheel carries that folder inside this package.

Not for: the user's own files.
"""

from __future__ import annotations

from pathlib import Path

from swayless.errors import FileError
from swayless.machine.problems import nearest

EXAMPLE_NAMES = (
    "srtc-gantry",
    "workshop-crane",
    "flexible-arm",
    "srtc-gantry-bank",
    "double-pendulum",
    "hoisting-gantry",
    "elbow-arm",
    "two-axis-crane",
)
"""Names of the examples, in the order in which to read them."""

_HERE = Path(__file__).parent
_IN_WHEEL = _HERE / "examples"
_IN_CHECKOUT = _HERE.parents[1] / "examples"


def example_text(name: str) -> str:
    """Give the text of an example machine file.

    Parameters
    ----------
    name : str
        One of `EXAMPLE_NAMES`.

    Raises
    ------
    FileError
        If there is no such example.

    Examples
    --------
    >>> 'name = "srtc_gantry"' in example_text("srtc-gantry")
    True
    """
    if name not in EXAMPLE_NAMES:
        raise FileError([f"example {name!r}: unknown; {nearest(name, EXAMPLE_NAMES)}"])
    folder = _IN_WHEEL if _IN_WHEEL.is_dir() else _IN_CHECKOUT
    return (folder / f"{name}.toml").read_text(encoding="utf-8")
