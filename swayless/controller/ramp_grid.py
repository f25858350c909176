"""The grid of ramp steps, on which a ramp and its closed form are exact. Not for: ramping."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from swayless.controller.number import NumberType


class RampGrid:
    """Whole counts in int32; in float types two units in the last place of the largest command.

    A float that shrinks by a multiple of its last place is not rounded, and multiples of the unit add exactly
    up to twice the largest command: ramps of such steps collect no rounding, however long.

    Parameters
    ----------
    max_command : float or int
        Largest command, > 0, in the number type.
    number : NumberType
        Number type.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> grid = RampGrid(0.5, number_type("double"))
    >>> float(grid.unit) == 2**-52, grid.anchor, grid.unramped_step
    (True, 1.0, 2.0)
    """

    def __init__(self, max_command: Any, number: NumberType) -> None:
        self._number = number
        self.is_whole = number.is_integer
        self._above = 2.0 ** math.frexp(max_command)[1]
        bits = number.significand_bits
        self.unit = Fraction(1) if self.is_whole else Fraction(self._above) / (1 << (bits - 1))

    @property
    def anchor(self) -> Any:
        """Number that, added to a command and taken away again, rounds it to the grid; 0 in int32."""
        return self._number.scalar(0 if self.is_whole else self._above)

    @property
    def unramped_step(self) -> Any:
        """Step that reaches any command from any other."""
        return self._number.scalar(2.0 * self._above)

    def floor(self, command: Any) -> Any:
        """Bring a positive command down to the grid."""
        return self._number.scalar(float(math.floor(Fraction(float(command)) / self.unit) * self.unit))

    def step(self, change: Fraction) -> Any:
        """Bring a change per tick to the grid.

        Rounded down in int32, the safe side; in float types rounded up, by a part in thousands at most, so
        that a ramp takes no tick more than asked.
        """
        whole = (math.floor if self.is_whole else math.ceil)(change / self.unit)
        return self._number.scalar(float(min(whole * self.unit, Fraction(2.0 * self._above))))
