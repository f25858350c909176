"""The convex program of a command of so many ticks: its limits, and the least share of them it takes.

Every limit (input, rate, tracking) is a linear form that must stay within a half-width of a centre; the
*utilisation* of a command is the largest share of a half-width that it takes. The least utilisation of so
many ticks is a linear program, always feasible for a controllable plant, whose dual proves from below what no
command of that length can do with less: above 1 it is Farkas' proof that the limits cannot be kept.

Not for: how many ticks (`time_optimal`), or the smoothest command (`energy`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from swayless.design.optimal.sampling import convolved, impulse_response, sampled
from swayless.design.optimal.task import MoveTask
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_ROUNDING = 1e-13  # of the sums of magnitudes: more than rows and sums are off by


@dataclass(frozen=True, eq=False)
class Wanted:
    """Outputs to follow.

    Parameters
    ----------
    output : ndarray, shape (n,)
        At ticks 1 .. n, less the start.
    within : float
        Largest difference, > 0.
    """

    output: FloatArray
    within: float


@dataclass(frozen=True, eq=False)
class Program:
    """Commands of `ticks` values, as differences w from the centre of the input's limits.

    Parameters
    ----------
    task : MoveTask
    ticks : int
        >= 1.
    wanted : Wanted or None
        Outputs to follow, one for each tick.
    """

    task: MoveTask
    ticks: int
    wanted: Wanted | None = None

    @cached_property
    def rows(self) -> FloatArray:
        """Conditions at the end, shape (r, n)."""
        return self.task.rest.rows(self.ticks)

    @cached_property
    def final(self) -> FloatArray:
        """Values of the conditions at the end for w, shape (r,)."""
        return np.asarray(self.task.rest.final - self.centre * self.rows.sum(axis=1))

    @property
    def centre(self) -> float:
        """Middle of the input's limits, less the initial input."""
        return 0.5 * sum(self.task.limits) - self.task.initial_input

    @property
    def half(self) -> float:
        """Half of what the input's limits are apart."""
        return 0.5 * (self.task.limits[1] - self.task.limits[0])

    @property
    def reach(self) -> float:
        """How far w can get from 0, by the limits of the input and of its rate."""
        rate = self.task.rate_limit_per_s
        steps = np.inf if rate is None else (self.ticks + 1) * rate * self.task.tick_s
        return float(min(self.half, abs(self.centre) + steps))

    @cached_property
    def orthonormal(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The conditions as rows at right angles (k, n), their values (k,), and what leads there (k, r)."""
        sizes = np.linalg.norm(self.rows, axis=1)
        left, stretch, right = np.linalg.svd(self.rows / sizes[:, np.newaxis], full_matrices=False)
        back = (left / stretch).T / sizes
        return right, back @ self.final, back

    @cached_property
    def limited(self) -> tuple[csr_array[Any, Any], FloatArray, FloatArray]:
        """Limits but those of the input: K, f and half-widths, with abs(K v - f) <= half-width.

        v is w, followed by the states at ticks 1 .. n where outputs are to be followed.
        """
        from scipy import sparse

        n, task = self.ticks, self.task
        widths = (n, 0 if self.wanted is None else n * task.plant.order)
        forms: list[Any] = [sparse.csr_array((0, sum(widths)))]
        centres, halves = [np.empty(0)], [np.empty(0)]
        if task.rate_limit_per_s is not None:
            steps = sparse.diags_array([1.0, -1.0], offsets=[0, -1], shape=(n + 1, n))
            forms.append(sparse.hstack([steps, sparse.csr_array((n + 1, widths[1]))]))
            ends = np.zeros(n + 1)
            ends[0], ends[-1] = -self.centre, task.initial_input + self.centre - task.held_input
            centres.append(ends)
            halves.append(np.full(n + 1, task.rate_limit_per_s * task.tick_s))
        if self.wanted is not None:
            outputs = sparse.kron(sparse.eye_array(n), task.plant.balanced.c[np.newaxis])
            forms.append(sparse.hstack([sparse.csr_array((n, n)), outputs]))
            centres.append(self.wanted.output)
            halves.append(np.full(n, self.wanted.within))
        return sparse.csr_array(sparse.vstack(forms)), np.concatenate(centres), np.concatenate(halves)

    @cached_property
    def equalities(self) -> tuple[csr_array[Any, Any], FloatArray]:
        """Conditions at the end on v, and the steps from state to state where v holds these."""
        from scipy import sparse

        rows, values, _ = self.orthonormal
        if self.wanted is None:
            return sparse.csr_array(rows), values
        n, plant = self.ticks, self.task.plant.balanced
        step = sampled(plant.a, plant.b, self.task.tick_s)
        later = sparse.eye_array(n, k=-1)
        states = sparse.eye_array(n * plant.order) - sparse.kron(later, step.a)
        inputs = -sparse.kron(sparse.eye_array(n), step.b[:, np.newaxis])
        end = sparse.hstack([sparse.csr_array(rows), sparse.csr_array((len(rows), n * plant.order))])
        both = sparse.vstack([end, sparse.hstack([inputs, states])])
        return sparse.csr_array(both), np.concatenate([values, np.tile(self.centre * step.b, n)])

    def utilisation(self, w: FloatArray) -> float:
        """Largest share of any limit that a command takes."""
        shares = [np.abs(w) / self.half]
        rate = self.task.rate_limit_per_s
        if rate is not None:
            inputs = w + self.centre + self.task.initial_input
            steps = np.diff(inputs, prepend=self.task.initial_input, append=self.task.held_input)
            shares.append(np.abs(steps) / (rate * self.task.tick_s))
        if self.wanted is not None:
            shares.append(np.abs(self.outputs(w) - self.wanted.output) / self.wanted.within)
        return float(max(each.max() for each in shares))

    def outputs(self, w: FloatArray) -> FloatArray:
        """Output at ticks 1 .. n, less the start."""
        return convolved(self._response, w + self.centre)[1:]

    @cached_property
    def _response(self) -> FloatArray:
        return impulse_response(self.task.plant, self.task.tick_s, self.ticks)

    def proved_utilisation(self, end_prices: FloatArray, limit_prices: FloatArray) -> float:
        """Give a lower bound of every command's utilisation, from any prices; the dual's are the best.

        With prices p of the conditions at the end, q of the limits K, and g = rows' p + K' q: every command
        has p final + q f = g w - q (K w - f) <= u (half |g|_1 + half-widths |q|), u its utilisation.
        """
        limit_form = self._priced(limit_prices)
        prices = self.orthonormal[2].T @ end_prices
        gain = prices @ self.final + limit_prices @ self._limit_centres
        taken = self.half * np.abs(prices @ self.rows + limit_form).sum()
        taken += self.limited[2] @ np.abs(limit_prices)
        magnitude = np.abs(prices) @ np.abs(self.final) + np.abs(limit_prices) @ np.abs(self._limit_centres)
        magnitude += self.half * (np.abs(prices) @ np.abs(self.rows) + np.abs(limit_form)).sum()
        slack = _ROUNDING * magnitude
        return float(max(0.0, abs(gain) - slack) / (taken + slack)) if taken + slack > 0.0 else 0.0

    @cached_property
    def _limit_centres(self) -> FloatArray:
        """Centres of the limits K for w alone: the centre of the input moves the output too."""
        centres = self.limited[1].copy()
        if self.wanted is not None:
            centres[-self.ticks :] -= convolved(self._response, np.full(self.ticks, self.centre))[1:]
        return centres

    def _priced(self, prices: FloatArray) -> FloatArray:
        """Give K' q for w alone, shape (n,)."""
        form = np.zeros(self.ticks)
        tracked = self.ticks if self.wanted is not None else 0
        steps, outputs = prices[: prices.size - tracked], prices[prices.size - tracked :]
        if steps.size:
            form -= np.diff(steps)
        if outputs.size:
            form += convolved(self._response, outputs[::-1])[:0:-1]
        return form


@dataclass(frozen=True, eq=False)
class LeastUtilisation:
    """The command of a length that takes the least share of its limits, and the proof that none takes less.

    Parameters
    ----------
    w : ndarray, shape (n,)
        The command, less the centre of its limits; of no use where the conditions cannot be met at all.
    v : ndarray
        w and the states where outputs are followed.
    utilisation_ratio : float
        Share of the limits that it takes; infinite where no inputs at all meet the conditions.
    proved_ratio : float
        Lower bound of the share that any command of this length takes.
    """

    w: FloatArray
    v: FloatArray
    utilisation_ratio: float
    proved_ratio: float


def least_utilisation(program: Program) -> LeastUtilisation:
    """Solve the linear program for the command that takes least.

    Maximise s with A v = s b, abs(K v - s f) <= half-width and abs(w) <= half. Dividing by s gives the
    command; 1 / s is its utilisation.

    Raises
    ------
    DesignError
        If HiGHS does not find the optimum.
    """
    from scipy import sparse
    from scipy.optimize import linprog

    impossible = _too_few_inputs(program)
    if impossible is not None:
        return impossible
    (equal, values), (form, centres, halves) = program.equalities, program.limited
    ends, limits, count = values.size, halves.size, equal.shape[1]
    # In units of the limits, v in units of what it can reach, and s in units that make its column 1 at most:
    # the solver's tolerances are absolute. Equalities first, then K v - t - s f = 0 with bounds on t: its
    # duals price the limits.
    reach = program.reach
    column = np.concatenate([-values / reach, -centres / halves])[:, np.newaxis]
    unit = 1.0 / max(1.0, float(np.abs(column).max()))
    both: Any = [equal, sparse.diags_array(reach / halves) @ form]
    apart: Any = [sparse.csr_array((ends, limits)), -sparse.eye_array(limits)]
    columns: Any = [sparse.vstack(both), sparse.vstack(apart), column * unit]
    table: Any = sparse.hstack(columns, format="csr")
    half = np.ones(count + limits)
    half[: program.ticks], half[program.ticks : count] = program.half / reach, np.inf
    bounds: Any = np.vstack([np.column_stack([-half, half]), [[0.0, np.inf]]])
    solved = linprog(
        np.append(np.zeros(count + limits), -1.0),
        A_eq=table,
        b_eq=np.zeros(ends + limits),
        bounds=bounds,
        method="highs-ds",
    )
    if solved.status != 0 or solved.x is None:
        raise DesignError(f"linear program of {program.ticks} ticks: {solved.message}")
    prices = np.append(solved.eqlin.marginals[:ends], solved.eqlin.marginals[ends:] * reach / halves)
    scale = float(solved.x[-1]) * unit / reach
    v = solved.x[:count] / scale if scale > 0.0 else np.zeros(count)
    w = v[: program.ticks]
    return LeastUtilisation(
        w,
        v,
        program.utilisation(w) if scale > 0.0 else np.inf,
        program.proved_utilisation(prices[: len(program.orthonormal[0])], prices[ends:]),
    )


def _too_few_inputs(program: Program) -> LeastUtilisation | None:
    """Prove that fewer inputs than conditions cannot meet these, whatever the limits; None if they can."""
    rows, values, _ = program.orthonormal
    if len(rows) == len(program.final):
        return None
    sizes = np.linalg.norm(program.rows, axis=1)
    missed = (program.final - program.rows @ (rows.T @ values)) / sizes
    share = float(np.linalg.norm(missed) / np.linalg.norm(program.final / sizes))
    if share < 1e-9:
        return None
    nothing = np.zeros(program.ticks)
    return LeastUtilisation(nothing, nothing, np.inf, np.inf)
