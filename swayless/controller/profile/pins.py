"""The pins of the motion profile: what it reads and writes each tick. Not for: what it does with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class ProfileInput:
    """Inputs of one tick.

    Parameters
    ----------
    execute : bool
        Its rising edge starts a move.
    abort : bool
        True in any tick of a move brings it to rest; while it is true none starts.
    start : float or numpy.float32
        Position from which to move, in units of the plant's output; read when a move starts, and before the
        first move also where the block holds.
    target : float or numpy.float32
        Position to move to; read when a move starts.
    """

    execute: bool
    abort: bool
    start: Any
    target: Any


@dataclass(frozen=True)
class ProfileOutput:
    """Outputs of one tick.

    Parameters
    ----------
    reference : float or numpy.float32
        For the drive, in units of the plant's input.
    position : float or numpy.float32
        Where the plant is when the tick begins, by its model: the reference of a feedback.
    busy : bool
        A move or a stop plays.
    done : bool
        The target is reached; true while `execute` is, and for one tick at least.
    aborted : bool
        It rests after an abort, at the end of a stop, or of the move where that is sooner; as long.
    status : int
        Sum of the bits of `ProfileStatus`.
    """

    reference: Any
    position: Any
    busy: bool
    done: bool
    aborted: bool
    status: int
