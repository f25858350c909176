"""What is asked of a command: plant, limits, start and target, all checked. Not for: solving it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

from swayless.design.optimal.linear_plant import LinearPlant
from swayless.design.optimal.robustification import Rest, Robustness, rest_conditions
from swayless.errors import DesignError

LARGEST_TICKS = 20_000
"""Longest command: more values are a tick that is too fine, or limits that are too small."""


@dataclass(frozen=True, eq=False)
class MoveTask:
    """A move of a plant's output from rest to rest.

    Parameters
    ----------
    plant : LinearPlant
        Stable (but for poles at 0 and on the imaginary axis) and controllable.
    tick_s : float
        Tick of the controller, > 0.
    limits : tuple of two floats
        Lowest and highest input; ``(-5.0, 5.0)`` allows 5 either way.
    target : float
        Output at the end.
    start : float
        Output before, another one.
    rate_limit_per_s : float or None
        Largest change of the input per second, > 0, the steps at both ends included.
    robustness : Robustness
        Against errors of the plant.

    Raises
    ------
    DesignError
        If a value is out of range, or no command can do it: the message names the cause.

    References
    ----------
    Xu and Meckl (2005), eqs 4, 5 and 9.

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> MoveTask(plant, 0.005, (-5.0, 5.0), 1.0).held_input
    1.0
    """

    plant: LinearPlant
    tick_s: float
    limits: tuple[float, float]
    target: float
    start: float = 0.0
    rate_limit_per_s: float | None = None
    robustness: Robustness = field(default_factory=Robustness)

    def __post_init__(self) -> None:
        low, high = self.limits
        if not (math.isfinite(self.tick_s) and self.tick_s > 0.0):
            raise DesignError(f"tick_s = {self.tick_s!r}: must be finite and > 0")
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise DesignError(f"limit = {low!r} to {high!r}: must be finite and rise; 0 moves nothing")
        rate = self.rate_limit_per_s
        if rate is not None and not (math.isfinite(rate) and rate > 0.0):
            raise DesignError(f"rate_limit = {rate!r}: must be finite and > 0")
        if not (math.isfinite(self.start) and math.isfinite(self.target)) or self.start == self.target:
            raise DesignError(
                f"target = {self.target!r}: must be finite, and differ from start = {self.start!r}"
            )
        self.plant.check()
        for what, output, held in (
            ("start", self.start, self.initial_input),
            ("target", self.target, self.held_input),
        ):
            if not low <= held <= high:
                raise DesignError(
                    f"{what} = {output:g}: needs an input of {held:.6g} to stay there, and the limit is"
                    f" {low:g} to {high:g}: out of reach"
                )

        self._check_rate()

    def _check_rate(self) -> None:
        """Refuse a rate at which the input alone takes longer than any command."""
        rate, change = self.rate_limit_per_s, abs(self.held_input - self.initial_input)
        if rate is not None and change > rate * self.tick_s * (LARGEST_TICKS + 1):
            raise DesignError(
                f"rate_limit = {rate:g}: the input takes {change / rate:.6g} s from {self.initial_input:g} to"
                f" {self.held_input:g}: must take up to {LARGEST_TICKS} ticks of {self.tick_s:g} s"
            )

    @cached_property
    def initial_input(self) -> float:
        """Input under which the plant rests at the start."""
        return self.plant.equilibrium(self.start)[1]

    @cached_property
    def held_input(self) -> float:
        """Input under which the plant rests at the target: u_ss."""
        return self.plant.equilibrium(self.target)[1]

    @cached_property
    def rest(self) -> Rest:
        """Conditions at the end, on inputs less the initial one."""
        return rest_conditions(self.plant, self.tick_s, self.target - self.start, self.robustness)
