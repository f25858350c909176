"""Everything a command shaper needs, as constants in its number type. Not for: its state or its text."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType
from swayless.controller.taps import Bank
from swayless.errors import ControllerError


@dataclass(frozen=True)
class RowTable:
    """The constants of one row, row 0 (unshaped) included.

    Parameters
    ----------
    name, family : str
        For comments.
    delays_ticks : tuple of int
        Delays of the taps.
    amplitudes : tuple
        In float types numbers; in int32 numerators over ``2**30``.
    tail_ticks : int
        Delay of the last tap: after as many equal commands the reference equals the command.
    moment_ticks : Fraction
        Sum of amplitude times delay: the references still to come per unit of a steady command.
    waits : bool
        Whether new commands wait for rest, because an amplitude is negative.
    residual_bound_ratio : float
        Residual vibration promised.
    """

    name: str
    family: str
    delays_ticks: tuple[int, ...]
    amplitudes: tuple[Any, ...]
    tail_ticks: int
    moment_ticks: Fraction
    waits: bool
    residual_bound_ratio: float


@dataclass(frozen=True)
class ShaperSettings:
    """A command shaper as constants.

    Parameters
    ----------
    bank : Bank
        The rows.
    limits : CommandLimits
        Ramps and maxima, in the bank's number type.

    Raises
    ------
    ControllerError
        If sums of products could leave 64 bits (int32 only).
    """

    bank: Bank
    limits: CommandLimits

    def __post_init__(self) -> None:
        if self.number.is_integer:
            peak = max(sum(abs(a) for a in table.amplitudes) for table in self.row_tables)
            if peak * self.limits.max_command >= (1 << 62) - (
                1 << 30
            ):  # and room for the carry and for rounding
                raise ControllerError(
                    "amplitudes times the largest command exceed 64 bits: lower counts_per_m_s"
                )

    @property
    def number(self) -> NumberType:
        """Number type of every constant."""
        return self.bank.number

    @property
    def tick_s(self) -> float:
        """Length of a tick."""
        return self.bank.tick_s

    @property
    def longest_delay_ticks(self) -> int:
        """Longest delay of any row."""
        return self.bank.longest_delay_ticks

    @cached_property
    def row_tables(self) -> tuple[RowTable, ...]:
        """Constants of rows 0 to n."""
        one = (1 << self.number.amplitude_bits) if self.number.is_integer else self.number.scalar(1.0)
        tables = [RowTable("unshaped", "none", (0,), (one,), 0, Fraction(0), False, 1.0)]
        for row in self.bank.rows:
            taps = row.taps
            exact = [Fraction(n, 1 << self.number.amplitude_bits) for n in taps.numerators]
            delays = tuple(taps.delays_ticks.tolist())
            tables.append(
                RowTable(
                    name=row.name,
                    family=row.family,
                    delays_ticks=delays,
                    amplitudes=taps.numerators
                    if self.number.is_integer
                    else tuple(self.number.scalar(a) for a in taps.amplitudes.tolist()),
                    tail_ticks=taps.longest_delay_ticks,
                    moment_ticks=sum((a * d for a, d in zip(exact, delays, strict=True)), Fraction(0)),
                    waits=taps.has_negative,
                    residual_bound_ratio=taps.guarantee.tolerance,
                )
            )
        return tuple(tables)
