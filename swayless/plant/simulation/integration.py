"""Fixed steps through the ticks of a controller: one set of equations, for one case or for many at once.

Not for: adaptive steps, events inside a tick, or what any plant does.

A plant writes its equations once, in terms of `xp`: the module `math` when there is one case, whose values
are then plain floats, and `numpy` when there are many, whose values are arrays with one element a case.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import ModuleType
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from swayless.errors import PlantError

Value: TypeAlias = "float | NDArray[np.float64]"
"""One number of one case, or of every case: shape (cases,)."""

State: TypeAlias = Sequence[Value]
"""The numbers that make up a state, or their rates of change."""

LARGEST_PHASE_RAD = 0.1
"""Phase of the fastest vibration in one step, which errs by 8e-8 rad and 7e-9 of the amplitude."""

LARGEST_DECAY = 0.5
"""Time constants of the fastest decay in one step, which errs by 3e-4 of what decays."""

Tick: TypeAlias = Any
"""A named tuple of each plant's own: the inputs of a tick."""


class Equations(Protocol):
    """How a plant moves through one tick."""

    def kick(self, xp: ModuleType, tick: Tick, state: State) -> State:
        """State just after the impulses that act as the tick begins."""
        ...

    def rates(self, xp: ModuleType, tick: Tick, time_s: float, state: State) -> State:
        """Rates of change of the state, `time_s` after the beginning of the tick."""
        ...


def steps_per_tick(tick_s: float, vibration_rad_s: float, decay_per_s: float = 0.0) -> int:
    """Least number of steps within a tick that follows the fastest vibration and the fastest decay.

    Examples
    --------
    A crane on 10 ms needs one step, a robot arm of 5.5 Hz on 20 ms seven:

    >>> steps_per_tick(0.01, 2.0), steps_per_tick(0.02, 34.6)
    (1, 7)
    """
    return max(
        1,
        math.ceil(tick_s * vibration_rad_s / LARGEST_PHASE_RAD),
        math.ceil(tick_s * decay_per_s / LARGEST_DECAY),
    )


def integrate(
    equations: Equations,
    start: Sequence[float],
    ticks: Tick,
    tick_s: float,
    steps: int,
) -> NDArray[np.float64]:
    """States at the beginning of the first tick and at the end of every tick.

    The classical Runge-Kutta method of order 4, which never steps across the end of a tick: inputs may jump
    there.

    Parameters
    ----------
    equations : Equations
        The plant.
    start : sequence of float
        Before the first tick; finite numbers, the same for all cases.
    ticks : named tuple of ndarray, each of shape (ticks,) or (cases, ticks)
        The inputs.
    tick_s : float
        Duration of a tick, > 0.
    steps : int
        Steps within each tick, >= 1.

    Returns
    -------
    ndarray, shape (numbers of the state, ticks + 1) or (numbers of the state, cases, ticks + 1)

    Raises
    ------
    PlantError
        If the plant does not start from a finite state.

    References
    ----------
    E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), table II.1.2.
    """
    if not np.isfinite(start).all():
        raise PlantError(f"state at the beginning = {tuple(start)!r}: must be finite")
    columns = np.asarray(ticks)
    xp = np if columns.ndim == 3 else math
    rows = columns.transpose(2, 0, 1).copy() if xp is np else columns.T.tolist()
    state: State = [number + np.zeros(columns.shape[1]) for number in start] if xp is np else list(start)
    step_s = tick_s / steps
    states = [state]
    for row in rows:
        tick = ticks._make(row)
        state = equations.kick(xp, tick, state)
        for step in range(steps):
            state = _runge_kutta_step(equations, xp, tick, step * step_s, step_s, state)
        states.append(state)
    return np.moveaxis(np.array(states), 0, -1)


def _runge_kutta_step(
    equations: Equations, xp: ModuleType, tick: Tick, time_s: float, step_s: float, state: State
) -> State:
    half_s = 0.5 * step_s
    first = equations.rates(xp, tick, time_s, state)
    middle = time_s + half_s
    second = equations.rates(xp, tick, middle, [x + half_s * k for x, k in zip(state, first, strict=True)])
    third = equations.rates(xp, tick, middle, [x + half_s * k for x, k in zip(state, second, strict=True)])
    last = equations.rates(
        xp, tick, time_s + step_s, [x + step_s * k for x, k in zip(state, third, strict=True)]
    )
    sixth_s = step_s / 6.0
    return [
        x + sixth_s * (k1 + 2.0 * (k2 + k3) + k4)
        for x, k1, k2, k3, k4 in zip(state, first, second, third, last, strict=True)
    ]
