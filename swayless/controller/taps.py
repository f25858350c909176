"""Taps, rows and banks: impulses on the tick grid in a number type. Not for: finding them; that is design."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType, amplitudes_on_lattice
from swayless.controller.phase_taps import PhaseTaps
from swayless.controller.spaced_taps import SpacedTaps
from swayless.design.residual import residual_vibration
from swayless.design.robustness import worst_residual_promised
from swayless.design.shaper import FloatArray, Guarantee
from swayless.errors import ControllerError

GUARANTEE_SLACK = 1e-4
"""Relative excess of the tolerance that quantised amplitudes may show: a 24-bit lattice moves a residual by
at most n 2**-24, 3e-7 for five taps, against tolerances of 1 % and more."""


@dataclass(frozen=True, eq=False)
class Taps:
    """Impulses on the tick grid, exactly as a controller runs them.

    Parameters
    ----------
    delays_ticks : ndarray of int64, shape (n,)
        Delays, the first 0, strictly increasing.
    amplitudes : ndarray, shape (n,)
        Multiples of ``2**-number.amplitude_bits`` that sum to exactly 1, every partial sum within [0, 1].
    tick_s : float
        Length of a tick, finite and > 0.
    guarantee : Guarantee
        What these very amplitudes hold.
    number : NumberType
        Type the controller calculates in.

    Raises
    ------
    ControllerError
        If an invariant does not hold.
    """

    delays_ticks: NDArray[np.int64]
    amplitudes: FloatArray
    tick_s: float
    guarantee: Guarantee
    number: NumberType

    def __post_init__(self) -> None:
        delays = np.array(self.delays_ticks, dtype=np.int64)
        amplitudes = np.array(self.amplitudes, dtype=np.float64)
        if not 0.0 < self.tick_s < math.inf:
            raise ControllerError(f"taps: tick_s = {self.tick_s!r}: must be finite and > 0")
        if delays.ndim != 1 or delays.shape != amplitudes.shape or delays.size == 0:
            raise ControllerError("taps: delays and amplitudes must be non-empty and of one length")
        if delays[0] != 0 or np.any(np.diff(delays) <= 0):
            raise ControllerError(f"taps: delays must start at 0 and increase, got {delays.tolist()}")
        scaled = amplitudes * 2.0**self.number.amplitude_bits
        partial_sums = np.cumsum(amplitudes)
        if np.any(scaled != np.round(scaled)) or partial_sums[-1] != 1.0:
            raise ControllerError(f"taps: amplitudes do not sum to exactly 1 in {self.number.name}")
        if partial_sums.min() < 0.0 or partial_sums.max() > 1.0:
            raise ControllerError(
                "taps: a step of the command would take the reference from "
                f"{partial_sums.min():.6g} to {partial_sums.max():.6g} times the step; allowed is 0 to 1"
            )
        delays.flags.writeable = amplitudes.flags.writeable = False
        object.__setattr__(self, "delays_ticks", delays)
        object.__setattr__(self, "amplitudes", amplitudes)

    @property
    def lags(self) -> NDArray[np.int64]:
        """What must pass before each tap releases: here ticks."""
        return self.delays_ticks

    @property
    def times_s(self) -> FloatArray:
        """Times of the taps, shape (n,)."""
        return self.delays_ticks.astype(np.float64) * self.tick_s

    @property
    def longest_delay_ticks(self) -> int:
        """Delay of the last tap."""
        return int(self.delays_ticks[-1])

    @property
    def duration_s(self) -> float:
        """Delay of the last tap, in seconds."""
        return self.longest_delay_ticks * self.tick_s

    @property
    def has_negative(self) -> bool:
        """Whether an amplitude is negative: commands must then wait for rest."""
        return bool(self.amplitudes.min() < 0.0)

    @property
    def numerators(self) -> tuple[int, ...]:
        """Amplitudes as whole multiples of ``2**-number.amplitude_bits``."""
        one = 1 << self.number.amplitude_bits
        return tuple(int(a * one) for a in self.amplitudes.tolist())


def quantised_taps(
    delays_ticks: NDArray[np.int64],
    amplitudes: FloatArray,
    tick_s: float,
    guarantee: Guarantee,
    number: NumberType,
) -> Taps:
    """Bring taps into a number type and prove their guarantee again on what results.

    Parameters
    ----------
    delays_ticks, amplitudes : ndarray, shape (n,)
        Taps as designed; the amplitudes sum to 1 but for rounding.
    tick_s : float
        Length of a tick.
    guarantee : Guarantee
        What the taps promise.
    number : NumberType
        Target type.

    Raises
    ------
    ControllerError
        If the quantised taps exceed the promised tolerance, or their partial sums leave [0, 1].
    """
    one = 1 << number.amplitude_bits
    numerators = np.array(amplitudes_on_lattice(amplitudes, number.amplitude_bits))
    kept = numerators != 0
    kept[0] = True
    taps = Taps(delays_ticks[kept], numerators[kept] / one, tick_s, guarantee, number)
    mode = guarantee.mode
    worst = max(
        worst_residual_promised(taps, guarantee),
        float(residual_vibration(taps, mode.frequency_hz, damping_ratio=mode.damping_ratio)),
    )
    if worst > guarantee.tolerance * (1.0 + GUARANTEE_SLACK):
        raise ControllerError(
            f"taps in {number.name} leave {100 * worst:.6g} % "
            f"where {100 * guarantee.tolerance:.6g} % is promised "
            f"between {guarantee.band.low_hz:.6g} and {guarantee.band.high_hz:.6g} Hz"
        )
    return taps


def shaped(taps: Taps, commands: FloatArray) -> FloatArray:
    """Shape a whole record of commands at once: the convolution that the block computes tick by tick.

    Parameters
    ----------
    taps : Taps
        What shapes.
    commands : ndarray, shape (ticks,)
        One command for each tick; before the first the command was 0.

    Returns
    -------
    ndarray, shape (ticks,)
        References in double, summed in the order of the taps.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> from swayless.plant import Band, Mode
    >>> held = Guarantee(0.05, Mode(1.0), Band(0.97, 1.03), 0.05)
    >>> taps = Taps(np.array([0, 2]), np.array([0.5, 0.5]), 0.25, held, number_type("double"))
    >>> shaped(taps, np.array([1.0, 1.0, 1.0, 0.0])).tolist()
    [0.5, 0.5, 1.0, 0.5]
    """
    commands = np.asarray(commands, dtype=np.float64)
    references: FloatArray = taps.amplitudes[0] * commands
    for delay, amplitude in zip(taps.delays_ticks[1:].tolist(), taps.amplitudes[1:].tolist(), strict=True):
        references[delay:] += amplitude * commands[: max(commands.size - delay, 0)]
    return references


@dataclass(frozen=True)
class Row:
    """One position of the knob.

    Parameters
    ----------
    name : str
        What the operator calls it.
    family : str
        Family of the shaper, for reports only.
    taps : Taps, PhaseTaps or SpacedTaps
        What runs.
    """

    name: str
    family: str
    taps: Taps | PhaseTaps | SpacedTaps


@dataclass(frozen=True)
class RopeRows:
    """Which rope lengths each row works on, where the rope chooses the row. Neighbours overlap: hysteresis.

    Parameters
    ----------
    lower, upper : tuple of float or int
        Ends of each row's rope lengths, in the number type, both falling from row to row.

    Raises
    ------
    ControllerError
        If rows are out of order, or neighbours do not overlap.
    """

    lower: tuple[Any, ...]
    upper: tuple[Any, ...]

    def __post_init__(self) -> None:
        for before, after in pairwise(range(len(self.lower))):
            falls = self.lower[after] < self.lower[before] and self.upper[after] < self.upper[before]
            if not falls or not self.lower[before] < self.upper[after]:
                raise ControllerError(
                    f"rows {before + 1} and {after + 1}: "
                    f"{self.lower[before]!r} to {self.upper[before]!r} and "
                    f"{self.lower[after]!r} to {self.upper[after]!r} of rope must fall and overlap"
                )

    def followed(self, row: int, length: Any) -> int:
        """Row for a rope length, from 1, when `row` was the last: it stays as long as the length is its own.

        Examples
        --------
        >>> rows = RopeRows((6.0, 3.0), (9.0, 6.5))
        >>> [rows.followed(1, 6.2), rows.followed(1, 5.9), rows.followed(2, 6.2), rows.followed(2, 6.6)]
        [1, 2, 2, 1]
        """
        while row < len(self.lower) and length < self.lower[row - 1]:
            row += 1
        while row > 1 and length > self.upper[row - 1]:
            row -= 1
        return row


@dataclass(frozen=True)
class Bank:
    """The rows of a machine; position 0, unshaped, is always there and not listed.

    Parameters
    ----------
    rows : tuple of Row
        Rows 1 to n; at least one, at most 254, all on one tick and in one number type.
    by_rope : RopeRows or None
        The rope lengths of the rows, where the measured rope chooses; None where the knob does.

    Raises
    ------
    ControllerError
        If the rows do not fit together.
    """

    rows: tuple[Row, ...]
    by_rope: RopeRows | None = None

    def __post_init__(self) -> None:
        if not 1 <= len(self.rows) <= 254:
            raise ControllerError(f"a bank has 1 to 254 rows, got {len(self.rows)}")
        if len({type(row.taps) for row in self.rows}) != 1:
            raise ControllerError("all rows of a bank must follow one clock")
        if self.longest_delay_ticks == 0:
            raise ControllerError("a bank needs a row with a delay: a single tap shapes nothing")
        if len({(row.taps.tick_s, row.taps.number.name) for row in self.rows}) != 1:
            raise ControllerError("all rows of a bank must have one tick and one number type")
        if self.by_rope is not None and len(self.by_rope.lower) != len(self.rows):
            raise ControllerError(f"{len(self.by_rope.lower)} rope intervals for {len(self.rows)} rows")

    @property
    def tick_s(self) -> float:
        """Length of a tick."""
        return self.rows[0].taps.tick_s

    @property
    def number(self) -> NumberType:
        """Number type of all rows."""
        return self.rows[0].taps.number

    @property
    def longest_delay_ticks(self) -> int:
        """Longest delay of any row: after as many ticks without change, the block has settled."""
        return max(row.taps.longest_delay_ticks for row in self.rows)
