"""The phase clock: how far the swing's phase advances in a tick, over the rope length, as constants.

The phase of a pendulum grows by sqrt(g / L) tick_s in a tick. It is counted in quanta, whole numbers, so that
nothing drifts; the quanta of a tick are read off a table over the rope length, made at design time, by linear
interpolation. What that leaves is a clock that is wrong by a part in 100,000 at most. Not for: the rope's
readings (`rope`), nor for the taps (`phase_filter`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from swayless.controller.number import NumberType
from swayless.controller.rope import MM_PER_M, RopeSettings
from swayless.errors import ControllerError
from swayless.plant import STANDARD_GRAVITY_M_S2

TABLE_ERROR = 1e-5
"""Largest relative error of the phase of a tick, by interpolation; rounding to quanta adds less."""

SMALLEST_TICK_QUANTA = 1 << 10
LARGEST_TICK_QUANTA = 1 << 22
"""Quanta of a tick: whole floats with a bit to spare, and fine enough to be rounded."""

MOST_QUANTA = 1 << 30
"""Phases of taps fit in 31 bits, with room for a tick."""

MOST_CELLS = 4096
FRACTION_BITS = 16
"""In int32 places in the table are counted in this fixed point."""


@dataclass(frozen=True, eq=False)
class PhaseClock:
    """The table of a phase clock.

    Parameters
    ----------
    quantum_rad : float
        Phase of one quantum, a power of two.
    nodes : tuple of int
        Quanta of a tick at equally spaced rope lengths, from the shortest on, falling.
    shortest : float or int
        First of those lengths, in the number type.
    cells_per_unit : float or int
        Cells of the table per m; in int32 per mm, over 2**32.
    number : NumberType
        Number type of the look-up.
    """

    quantum_rad: float
    nodes: tuple[int, ...]
    shortest: Any
    cells_per_unit: Any
    number: NumberType

    def quanta(self, length: Any) -> int:
        """Quanta of a tick at a rope length within the range.

        Examples
        --------
        >>> from swayless.controller.number import number_type
        >>> from swayless.controller.rope import rope_settings
        >>> double = number_type("double")
        >>> rope = rope_settings((3.0, 9.0), 0.3, tick_s=0.01, number=double)
        >>> clock = phase_clock(rope, tick_s=0.01, most_phase_rad=6.3, number=double)
        >>> round(clock.quanta(4.0) * clock.quantum_rad, 6)  # sqrt(9.80665 / 4) 0.01
        0.015658
        """
        last = len(self.nodes) - 2
        if self.number.is_integer:
            place = ((length - self.shortest) * self.cells_per_unit) >> (32 - FRACTION_BITS)
            cell = min(place >> FRACTION_BITS, last)
            share = place - (cell << FRACTION_BITS)
            fall = (self.nodes[cell] - self.nodes[cell + 1]) * share
            return int(self.nodes[cell] - ((fall + (1 << (FRACTION_BITS - 1))) >> FRACTION_BITS))
        scalar = self.number.scalar
        place = (length - self.shortest) * self.cells_per_unit
        cell = min(int(place), last)
        share = place - scalar(cell)
        here, there = scalar(self.nodes[cell]), scalar(self.nodes[cell + 1])
        return int((here - ((here - there) * share)) + scalar(0.5))

    @property
    def fewest_quanta(self) -> int:
        """Quanta of a tick on the longest rope."""
        return self.nodes[-1]

    @property
    def most_quanta(self) -> int:
        """Quanta of a tick on the shortest rope."""
        return self.nodes[0]


def phase_clock(
    rope: RopeSettings,
    *,
    tick_s: float,
    most_phase_rad: float,
    number: NumberType,
) -> PhaseClock:
    """Make the table of a phase clock.

    Parameters
    ----------
    rope : RopeSettings
        Shortest and longest rope.
    tick_s : float
        Length of a tick.
    most_phase_rad : float
        Largest phase of any tap.
    number : NumberType
        Number type of the look-up.

    Raises
    ------
    ControllerError
        If the tick is too coarse or too fine for the rope, or the range too wide for a table.
    """
    units_per_m = MM_PER_M if number.is_integer else 1
    shortest_m, longest_m = float(rope.shortest) / units_per_m, float(rope.longest) / units_per_m
    largest_rad = math.sqrt(STANDARD_GRAVITY_M_S2 / shortest_m) * tick_s
    quantum_rad = 2.0 ** math.ceil(
        math.log2(max(largest_rad / LARGEST_TICK_QUANTA, (most_phase_rad + 2.0 * largest_rad) / MOST_QUANTA))
    )
    # The relative error of a chord of L^(-1/2) over a cell of width h is at most 3/32 (h / L)^2.
    cells = math.ceil((longest_m - shortest_m) / (shortest_m * math.sqrt(TABLE_ERROR * 32.0 / 3.0)))
    if cells > MOST_CELLS:
        raise ControllerError(
            f"rope length {shortest_m:g} to {longest_m:g} m: the table would have {cells} cells, "
            f"allowed are {MOST_CELLS}; a longer shortest rope needs fewer"
        )
    lengths_m = np.linspace(shortest_m, longest_m, cells + 1)
    exact = np.sqrt(STANDARD_GRAVITY_M_S2 / lengths_m) * (tick_s / quantum_rad)
    nodes = tuple(np.rint(exact).astype(int).tolist())
    if nodes[-1] < SMALLEST_TICK_QUANTA:
        raise ControllerError(
            f"tick_s = {tick_s!r}: too fine for a phase of {most_phase_rad:g} rad at {longest_m:g} m of rope"
        )
    span = rope.longest - rope.shortest
    per_unit = (cells << 32) // span if number.is_integer else number.scalar(cells / (longest_m - shortest_m))
    return PhaseClock(quantum_rad, nodes, rope.shortest, per_unit, number)
