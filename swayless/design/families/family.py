"""What a family of shapers is. Not for: the families themselves (`registry`)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from swayless.errors import DesignError

TimesAndAmplitudes: TypeAlias = tuple[Sequence[float], Sequence[float]]


@dataclass(frozen=True)
class Family:
    """A named set of constraint equations, and how they are solved.

    Parameters
    ----------
    name : str
        As typed on the command line, such as ``"zvd"``.
    title : str
        In words.
    source : str
        Where the constraint equations come from: author, year, equation.
    solve : callable
        ``solve(mode, **parameters)`` returns times in seconds and amplitudes.
    parameters : frozenset of str
        Which of ``"tolerance"``, ``"order"`` and ``"delay_s"`` shape the impulses.
    negative : bool
        Whether amplitudes may be negative.
    zero_orders : int or None
        Highest derivative of the vibration over frequency that vanishes at the mode (0: the vibration itself,
        1: also its slope, ...). None if the vibration at the mode is not 0, or if the order is a parameter.
    """

    name: str
    title: str
    source: str
    solve: Callable[..., TimesAndAmplitudes]
    parameters: frozenset[str] = frozenset()
    negative: bool = False
    zero_orders: int | None = None

    def check_parameters(self, given: dict[str, float | int | None]) -> dict[str, float | int]:
        """Keep the parameters that the family takes; refuse those it does not, or that are missing.

        Raises
        ------
        DesignError
            If a parameter is missing, or given to a family that has no use for it.
        """
        for name, value in given.items():
            if value is None and name in self.parameters:
                raise DesignError(f"{self.name} needs {name}")
            if value is not None and name not in self.parameters:
                raise DesignError(f"{self.name} takes no {name}, got {value!r}")
        return {name: value for name, value in given.items() if value is not None}
