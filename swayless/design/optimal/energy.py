"""The command of least energy of a given length, along a trajectory or free. Not for: how long it must be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.optimal.moves import OptimalCommand, finished
from swayless.design.optimal.program import Program, Wanted, least_utilisation
from swayless.design.optimal.task import LARGEST_TICKS, MoveTask
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

if TYPE_CHECKING:
    from scipy.sparse import csr_array

LARGEST_TRACKED_TICKS = 5_000
"""Longest trajectory: each tick is a limit of its own."""

_ITERATIONS = 60
_GAP = 1e-11  # of the energy: how near the optimum is proved to be
_CENTRING = 0.1
_TO_THE_BORDER = 0.995


def least_energy(task: MoveTask, ticks: int) -> OptimalCommand:
    """Find the command of a length whose sum of squares is least.

    Parameters
    ----------
    task : MoveTask
    ticks : int
        Length, at least what `time_optimal` finds; the longer, the smoother.

    Raises
    ------
    DesignError
        If no command of this length keeps the limits; the message says by how much.

    References
    ----------
    Xu and Meckl (2005), eq 34.

    Examples
    --------
    >>> from swayless.design.optimal import LinearPlant
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> least_energy(MoveTask(mass, 1.0, (-1.0, 1.0), 1.0), 4).command.values.round(9).tolist()
    [0.3, 0.1, -0.1, -0.3]
    """
    if isinstance(ticks, bool) or not 1 <= ticks <= LARGEST_TICKS:
        raise DesignError(f"ticks = {ticks!r}: must be a whole number from 1 to {LARGEST_TICKS}")
    return _least_energy(Program(task, int(ticks)))


def track(task: MoveTask, wanted: ArrayLike, tolerance: float) -> OptimalCommand:
    """Find the command of least energy whose output stays near a trajectory at every tick, and then rests.

    Parameters
    ----------
    task : MoveTask
        Its target is where the trajectory ends.
    wanted : array_like, shape (n,)
        Wanted outputs at ticks 1 .. n: their number is the length of the command.
    tolerance : float
        Largest difference of the nominal output from them, > 0.

    Raises
    ------
    DesignError
        If the trajectory is out of reach of the limits, or of the plant: the message says by how much.

    References
    ----------
    Xu and Meckl (2005), eqs 5-9 and 34 c.

    Examples
    --------
    >>> from swayless.design.optimal import LinearPlant, output_at_ticks
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> found = track(MoveTask(mass, 0.5, (-1.0, 1.0), 1.0), [0.0, 0.1, 0.4, 0.8, 1.0, 1.0], 0.05)
    >>> output = output_at_ticks(mass, found.command)
    >>> bool(abs(output[1:] - [0.0, 0.1, 0.4, 0.8, 1.0, 1.0]).max() <= 0.05)
    True
    """
    outputs = np.asarray(wanted, dtype=np.float64)
    if outputs.ndim != 1 or not 1 <= outputs.size <= LARGEST_TRACKED_TICKS or not np.isfinite(outputs).all():
        raise DesignError(
            f"trajectory of shape {outputs.shape}: must be 1 to {LARGEST_TRACKED_TICKS} finite outputs"
        )
    if not (np.isfinite(tolerance) and tolerance > 0.0):
        raise DesignError(f"tracking tolerance = {tolerance!r}: must be finite and > 0")
    if abs(outputs[-1] - task.target) > tolerance:
        raise DesignError(
            f"trajectory: ends at {outputs[-1]:g}, the target is {task.target:g}: must be {tolerance:g} near"
        )
    if task.plant.d != 0.0:
        raise DesignError("trajectory: the input moves the output at once (d is not 0): give it a lag")
    return _least_energy(Program(task, outputs.size, Wanted(outputs - task.start, float(tolerance))))


def _least_energy(program: Program) -> OptimalCommand:
    """Start where limits are taken least, and go down to the least energy without ever touching one."""
    least = least_utilisation(program)
    if least.utilisation_ratio > 1.0 + 1e-6:
        raise DesignError(_out_of_reach(program, least.proved_ratio))
    w = _descended(program, least.v) if least.utilisation_ratio < 1.0 - 1e-6 else least.w
    found = finished(program, w, least.proved_ratio)
    if found is None:
        raise DesignError(_out_of_reach(program, least.utilisation_ratio))
    return found


def _out_of_reach(program: Program, share: float) -> str:
    """Say by how much limits are passed, and what may be the cause."""
    if share == np.inf:
        return f"ticks = {program.ticks}: so few cannot bring the plant to rest, whatever the limits"
    text = (
        f"{program.ticks} ticks of {program.task.tick_s:g} s: any command takes {share:.6g} times the limits"
    )
    zeros = program.task.plant.zeros_rad_s
    wrong = zeros[zeros.real > 1e-9 * np.abs(zeros).max(initial=0.0)]
    if program.wanted is None or wrong.size == 0:
        return f"{text}; more ticks, or more limit, are needed"
    return (
        f"{text}, its tracking tolerance among them: the plant is not minimum phase (zero at"
        f" {wrong[0].real:.6g}{wrong[0].imag:+.6g}j rad/s), its output first goes the wrong way; a slower"
        " trajectory or a wider tolerance is needed"
    )


@dataclass(frozen=True, eq=False)
class _Barrier:
    """min 1/2 |H (v + g)|^2 with full and banded equalities, abs(G v - f) <= r: what every step needs."""

    ends: FloatArray
    end_values: FloatArray
    steps: csr_array[Any, Any]
    step_values: FloatArray
    form: csr_array[Any, Any]
    centres: FloatArray
    halves: FloatArray
    counted: FloatArray
    offset: float

    def slope(self, v: FloatArray) -> FloatArray:
        """Gradient of the energy."""
        return self.counted * (v + self.offset)


def _descended(program: Program, v: FloatArray) -> FloatArray:
    """Give w of least energy, by a primal-dual barrier method from a v inside all limits.

    References
    ----------
    Nocedal and Wright (2006), "Numerical optimization", section 16.6; its iterates stay inside.
    """
    problem = _barrier(program)
    reach = problem.form @ v - problem.centres
    slacks = np.stack([problem.halves - reach, problem.halves + reach])
    energy = 0.5 * float(problem.slope(v) @ (v + problem.offset))
    prices = max(energy, 1e-12) / (slacks * slacks.size)
    for _ in range(_ITERATIONS):
        gap = float((slacks * prices).sum())
        energy = 0.5 * float(problem.slope(v) @ (v + problem.offset))
        if gap <= _GAP * energy:
            return v[: program.ticks]
        v, prices = _step(problem, v, slacks, prices, _CENTRING * gap / slacks.size)
        reach = problem.form @ v - problem.centres
        slacks = np.stack([problem.halves - reach, problem.halves + reach])
    return v[: program.ticks]


def _step(
    problem: _Barrier, v: FloatArray, slacks: FloatArray, prices: FloatArray, centre: float
) -> tuple[FloatArray, FloatArray]:
    """One Newton step on the optimality conditions with price times slack = `centre`, kept inside."""
    from scipy import sparse
    from scipy.sparse.linalg import splu

    weights = (prices / slacks).sum(axis=0)
    curved = sparse.diags_array(problem.counted) + problem.form.T @ sparse.diags_array(weights) @ problem.form
    steps, ends = problem.steps, problem.ends
    nothing = sparse.csr_array((steps.shape[0], steps.shape[0]))
    solve = splu(sparse.block_array([[curved, steps.T], [steps, nothing]], format="csc")).solve
    wanted = centre / slacks
    pull = -problem.slope(v) - problem.form.T @ (wanted[0] - wanted[1])
    # The few full rows stay out of the banded system, which they would fill.
    free = solve(np.concatenate([pull, problem.step_values - steps @ v]))[: v.size]
    answers = solve(np.vstack([ends.T, np.zeros((steps.shape[0], len(ends)))]))[: v.size]
    move = free - answers @ np.linalg.solve(ends @ answers, ends @ (v + free) - problem.end_values)
    gained = problem.form @ move
    closing = np.stack([gained, -gained])  # what a full step takes off each slack
    dearer = wanted - prices + prices / slacks * closing
    return (
        v + _inside(slacks, closing) * move,
        prices + _inside(prices, -dearer) * dearer,
    )


def _inside(room: FloatArray, taken: FloatArray) -> float:
    """Largest part of a step, at most 1, that leaves some of all the room."""
    return min(1.0, _TO_THE_BORDER / max(float((taken / room).max()), 1e-300))


def _barrier(program: Program) -> _Barrier:
    """Put a program with all its limits, those of the input among them, into the form of the method."""
    from scipy import sparse

    (equal, values), (form, centres, halves) = program.equalities, program.limited
    n, count = program.ticks, equal.shape[1]
    counted = np.zeros(count)
    counted[:n] = 1.0
    inputs = sparse.eye_array(n, count)
    ends = len(program.orthonormal[0])
    return _Barrier(
        equal[:ends].toarray(),
        values[:ends],
        equal[ends:],
        values[ends:],
        sparse.csr_array(sparse.vstack([inputs, form])),
        np.append(np.zeros(n), centres),
        np.append(np.full(n, program.half), halves),
        counted,
        program.centre + program.task.initial_input,
    )
