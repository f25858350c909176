"""A move by inversion, as a motion profile block plays it. Not for: the keys of its file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from swayless.design.optimal import Command, LinearPlant
from swayless.machine.inversion_file import load_inversion


class InvertedMove(NamedTuple):
    """A move that is ready to be played.

    Parameters
    ----------
    plant : LinearPlant
        From command to load.
    command : Command
        Zero-order; the plant rests before and after it.
    limits : tuple of two floats
        Lowest and highest command: those of the file, or else what the command takes and a tenth of its range
        on either side.
    start, target : float
        Of the load.
    name : str
    number : str
        Number type of the block.
    """

    plant: LinearPlant
    command: Command
    limits: tuple[float, float]
    start: float
    target: float
    name: str
    number: str


def asks_for_inversion(document: Mapping[str, object]) -> bool:
    """Whether a parsed TOML file is one of a move by inversion: no machine, and its move has a duration.

    Examples
    --------
    >>> [asks_for_inversion({"move": move}) for move in ({"duration": "2 s"}, {"limit": 5})]
    [True, False]
    """
    move = document.get("move")
    no_machine = {"crane", "arm", "axis"}.isdisjoint(document)
    return no_machine and isinstance(move, dict) and "duration" in move


def inverted_move(path: Path) -> InvertedMove:
    """Load a file, and find its command.

    Parameters
    ----------
    path : Path
        A TOML file; ``docs/profile-invert.md`` says what stands in it.

    Raises
    ------
    FileError
        With every problem found in the file.
    DesignError
        If there is no such command; the message names the file and the cause.
    """
    request = load_inversion(path)
    found, motion = request.found, request.motion
    return InvertedMove(
        found.plant,
        found.command,
        request.played_limits,
        motion.start,
        motion.target,
        request.name,
        request.number,
    )
