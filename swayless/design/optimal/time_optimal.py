"""The fewest ticks from rest to rest within limits, proved both ways. Not for: smooth commands (`energy`)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from swayless.design.optimal.moves import (
    FINAL_STATE_TOLERANCE,
    OptimalCommand,
    final_error,
    finished,
    polished,
)
from swayless.design.optimal.program import Program, least_utilisation
from swayless.design.optimal.task import LARGEST_TICKS, MoveTask
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

_UNDECIDED = 1e-6  # of the limits: nearer to all of them the linear program alone does not decide


@dataclass(frozen=True, eq=False)
class _Tried:
    """What one length gave: a command, or the proof that there is none, or neither."""

    ticks: int
    found: OptimalCommand | None
    proved_ratio: float


def time_optimal(task: MoveTask) -> OptimalCommand:
    """Find the command of the fewest ticks; of these, the one that takes the least share of its limits.

    A command of n ticks is proved to exist by running it, and one of n - 1 ticks is proved not to by the dual
    of its linear program: `OptimalCommand.fewer_utilisation_ratio` is above 1. As the plant may wait at its
    start, n ticks are enough where fewer are, so that bisection finds the least.

    Parameters
    ----------
    task : MoveTask

    Raises
    ------
    DesignError
        If no command of up to 20000 ticks keeps the limits.

    References
    ----------
    Xu and Meckl (2005), eqs 4-10; they raise the length tick by tick, with least squares.

    Examples
    --------
    The fastest move of a mass of 1 kg over 1 m with at most 1 N takes 2 s, half of it braking:

    >>> from swayless.design.optimal import LinearPlant, MoveTask
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> found = time_optimal(MoveTask(mass, 0.25, (-1.0, 1.0), 1.0))
    >>> found.ticks, found.command.values.round(9).tolist(), found.fewer_utilisation_ratio > 1.0
    (8, [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0], True)
    """
    below, found = _bracket(task)
    while found.ticks - below.ticks > 1:
        tried = _try(task, (below.ticks + found.ticks) // 2)
        if tried.found is None:
            below = tried
        else:
            found = tried.found
    return replace(found, fewer_utilisation_ratio=_proved(below).proved_ratio)


def _bracket(task: MoveTask) -> tuple[_Tried, OptimalCommand]:
    """Double the length until a command is found; give it with the length before."""
    below, tried = _Tried(0, None, math.inf), _try(task, len(task.rest.final))
    while tried.found is None:
        if tried.ticks >= LARGEST_TICKS:
            raise DesignError(_too_long(task, tried))
        below, tried = tried, _try(task, min(2 * tried.ticks, LARGEST_TICKS))
    return below, tried.found


def _try(task: MoveTask, ticks: int) -> _Tried:
    """Solve one length."""
    program = Program(task, ticks)
    least = least_utilisation(program)
    found = None
    if least.utilisation_ratio <= 1.0 + _UNDECIDED:  # what is left over, the polish and its check decide
        found = finished(program, least.w, least.proved_ratio)
    if found is None and least.utilisation_ratio < 1.0 - _UNDECIDED:
        raise DesignError(_not_resolved(program, least.w, least.utilisation_ratio))
    return _Tried(ticks, found, least.proved_ratio)


def _not_resolved(program: Program, w: FloatArray, share: float) -> str:
    """Say that limits leave enough room, but rounding does not reach the end."""
    nearest = polished(program, w)
    missed, used = final_error(program, nearest), program.utilisation(nearest)
    fails = (
        f"misses rest by {missed:.1g} of the largest state, and {FINAL_STATE_TOLERANCE:g} is promised"
        if missed > FINAL_STATE_TOLERANCE
        else f"takes {used:.4g} of them once it is corrected to rest at the end"
    )
    return (
        f"{program.ticks} ticks of {program.task.tick_s:g} s take {share:.4g} of the limits, but the best"
        f" command {fails}: what is asked of the end can hardly be told apart; less robustness or a coarser"
        " tick is needed"
    )


def _proved(below: _Tried) -> _Tried:
    """Refuse a length of which neither a command nor its absence is proved."""
    if below.proved_ratio <= 1.0:
        raise DesignError(
            f"{below.ticks} ticks take all of the limits, to rounding: neither a command nor its absence can"
            " be proved; another limit, higher or lower by a millionth, decides"
        )
    return below


def _too_long(task: MoveTask, tried: _Tried) -> str:
    """Say why a target is not reached."""
    low, high = task.limits
    at_limit = task.held_input in {low, high}
    why = (
        f"the target needs all of the limit, {task.held_input:.6g}, to stay there"
        if at_limit
        else "more limit, a coarser tick or a nearer target is needed"
    )
    return (
        f"target = {task.target:g}: not reached within {tried.ticks} ticks of {task.tick_s:g} s, which would"
        f" take {tried.proved_ratio:.4g} times the limits: {why}"
    )
