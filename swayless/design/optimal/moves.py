"""Commands that are found: polished, checked by running them, and with what is proved of them.

Not for: finding them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.design.optimal.command import Command
from swayless.design.optimal.program import Program
from swayless.design.shaper import FloatArray

FINAL_STATE_TOLERANCE = 1e-9
"""How far states may be from rest at the end, of the largest one: what is promised of every command."""

LIMIT_TOLERANCE = 1e-9
"""How far the share of a limit may exceed 1, where only one command is left and rounding decides."""

_SATURATED = 1e-6  # of the half-width: inputs nearer to what the command takes are not moved by the polish
_ROUNDS = 4


@dataclass(frozen=True, eq=False)
class OptimalCommand:
    """A command with what it takes and what is proved.

    Parameters
    ----------
    command : Command
        The values, zero-order.
    utilisation_ratio : float
        Largest share of a limit (input, rate, tracking) that it takes, at most 1.
    final_error_ratio : float
        How far the conditions at the end are missed, of the largest state there.
    proved_utilisation_ratio : float
        What any command of this length takes at least.
    fewer_utilisation_ratio : float or None
        What any command of one tick less would take at least: above 1, so that no shorter one keeps the
        limits. None where the length was given.
    """

    command: Command
    utilisation_ratio: float
    final_error_ratio: float
    proved_utilisation_ratio: float
    fewer_utilisation_ratio: float | None = None

    @property
    def ticks(self) -> int:
        """Length of the command."""
        return self.command.values.size


def finished(
    program: Program, w: FloatArray, proved: float, fewer: float | None = None
) -> OptimalCommand | None:
    """Polish a command and check it; None where it does not keep what is promised.

    Parameters
    ----------
    program : Program
    w : ndarray, shape (n,)
        A solution, less the centre of the limits.
    proved, fewer : float
        Lower bounds of the utilisation, of this length and of one tick less.
    """
    task, inside = program.task, polished(program, w)
    error, used = final_error(program, inside), program.utilisation(inside)
    if error > FINAL_STATE_TOLERANCE or used > 1.0 + LIMIT_TOLERANCE:
        return None
    values = np.clip(inside + program.centre + task.initial_input, *task.limits)
    command = Command(task.tick_s, values, task.held_input, initial_value=task.initial_input)
    return OptimalCommand(command, min(used, 1.0), error, proved, fewer)


def final_error(program: Program, w: FloatArray) -> float:
    """Give the largest miss of a condition at the end, of the largest value that one has."""
    missed = program.rows @ (w + program.centre) - program.task.rest.final
    return float(np.abs(missed).max() / np.abs(program.task.rest.final).max())


def polished(program: Program, w: FloatArray) -> FloatArray:
    """Solve the conditions at the end again by the least change, within the limits of the input.

    On the inputs that are not saturated; or on all, where that takes less of the limits: a mode that dies out
    within a few ticks is brought to rest by the last inputs alone, which may all be saturated.
    """
    unsaturated = np.abs(w) < np.abs(w).max() - _SATURATED * program.half
    tried = [_corrected(program, w, free) for free in (unsaturated, np.ones(w.size, dtype=bool))]
    return min(
        tried,
        key=lambda each: (final_error(program, each) > FINAL_STATE_TOLERANCE, program.utilisation(each)),
    )


def _corrected(program: Program, w: FloatArray, free: NDArray[np.bool_]) -> FloatArray:
    """Solve the conditions at the end again on some inputs, and keep all within their limits.

    References
    ----------
    Golub and Van Loan (2013), "Matrix computations", section 5.6: iterative refinement.
    """
    rows, values, _ = program.orthonormal
    inverse = np.linalg.pinv(rows[:, free])
    for _ in range(_ROUNDS):
        w = w.copy()
        w[free] += inverse @ (values - rows @ w)
    return np.clip(w, -program.half, program.half)
