"""How much work the phase clock does in a tick, for C and Structured Text alike. Not for: doing it."""

from __future__ import annotations

from swayless.controller.phase_clock import PhaseClock


def most_cells_a_tick(clock: PhaseClock) -> int:
    """Bound the cells of the ring that a tap passes in a tick.

    A tap passes a cell while less than the quanta of the tick lie ahead, and each cell adds the quanta of its
    own tick: no fewer than on the longest rope. It starts with what a tick before has left, 0 or more, and so
    passes n cells only if n - 1 of the shortest fit in less than the longest tick.

    Parameters
    ----------
    clock : PhaseClock
        The clock.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> most_cells_a_tick(PhaseClock(1e-7, (3000, 2000, 1499), 3.0, 1.0, number_type("double")))
    3
    >>> most_cells_a_tick(PhaseClock(1e-7, (3000, 2000, 1500), 3.0, 1.0, number_type("double")))
    2
    """
    return -(-clock.most_quanta // clock.fewest_quanta)
