"""A command computed ahead: one value a tick, and what stays when it ends. Not for: how it is found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

Hold: TypeAlias = Literal["zero-order", "first-order"]
"""What the command does between ticks: keep the value of the tick, or go straight to the next one."""


@dataclass(frozen=True, eq=False)
class Command:
    """Values of an input, one a tick, played once.

    Parameters
    ----------
    tick_s : float
        Time from one value to the next, > 0.
    values : ndarray, shape (n,)
        One for each tick, in units of the input; n >= 1, finite.
    final_value : float
        What the input is from tick n on.
    hold : {"zero-order", "first-order"}
        Between the ticks.
    initial_value : float
        What the input was before tick 0.

    Raises
    ------
    DesignError
        If an invariant does not hold.

    Examples
    --------
    >>> command = Command(0.5, [1.0, -1.0], 0.0)
    >>> command.duration_s, command.times_s.tolist(), command.increments.amplitudes.tolist()
    (1.0, [0.0, 0.5], [1.0, -2.0, 1.0])
    """

    tick_s: float
    values: FloatArray
    final_value: float
    hold: Hold = "zero-order"
    initial_value: float = 0.0

    def __post_init__(self) -> None:
        values = np.array(self.values, dtype=np.float64)
        if not (np.isfinite(self.tick_s) and self.tick_s > 0.0):
            raise DesignError(f"tick_s = {self.tick_s!r}: must be finite and > 0")
        if values.ndim != 1 or values.size == 0:
            raise DesignError(f"command of shape {values.shape}: must be (n,), n >= 1")
        if not np.isfinite([*values, self.final_value, self.initial_value]).all():
            raise DesignError("command: every value must be finite")
        values.flags.writeable = False
        object.__setattr__(self, "values", values)

    @property
    def times_s(self) -> FloatArray:
        """Time of each value, shape (n,), from 0."""
        return self.tick_s * np.arange(self.values.size, dtype=np.float64)

    @property
    def duration_s(self) -> float:
        """Time from which the final value stays."""
        return self.tick_s * self.values.size

    @property
    def increments(self) -> Increments:
        """Its changes from tick to tick: what the command does to a plant at rest."""
        steps = np.diff(self.values, prepend=self.initial_value, append=self.final_value)
        return Increments(self.tick_s * np.arange(steps.size, dtype=np.float64), steps)


@dataclass(frozen=True, eq=False)
class Increments:
    """Changes of a zero-order command: impulses, as those of a shaper, whose sum is what the command gains.

    Parameters
    ----------
    times_s, amplitudes : ndarray, shape (n + 1,)
        When, and by how much.
    """

    times_s: FloatArray
    amplitudes: FloatArray
