"""Everything a command shaper needs, as constants in its number type. Not for: its state or its text."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from swayless.controller.contactor import check_contactor
from swayless.controller.diagnostics import NO_DIAGNOSTICS, Diagnostics
from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType
from swayless.controller.operator_settings import NO_OPTIONS, OperatorSettings
from swayless.controller.phase_clock import PhaseClock
from swayless.controller.phase_taps import PhaseTaps
from swayless.controller.rope import RopeSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.controller.status import OPTIONAL_BITS, ROPE_BITS, Status
from swayless.controller.taps import Bank
from swayless.errors import ControllerError


@dataclass(frozen=True)
class RowTable:
    """The constants of one row, row 0 (unshaped) included.

    Parameters
    ----------
    name, family : str
        For comments.
    lags : tuple of int
        What must pass before each tap releases: ticks, under the phase clock quanta of phase.
    amplitudes : tuple
        In float types numbers; in int32 numerators over ``2**30``.
    tail : int
        Lag of the last tap: once it has passed without a change, the reference equals the command.
    moment : Fraction
        Sum of amplitude times lag: in ticks, the references still to come per unit of a steady command.
    waits : bool
        Whether new commands wait for rest, because an amplitude is negative.
    residual_bound_ratio : float
        Residual vibration promised.
    """

    name: str
    family: str
    lags: tuple[int, ...]
    amplitudes: tuple[Any, ...]
    tail: int
    moment: Fraction
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
    rope : RopeSettings or None
        What the block knows of a measured rope; the phase clock needs it.
    operator : OperatorSettings
        Steps, switches and whatever else is there only where asked for; none of it unless given.
    diagnostics : Diagnostics
        What the block says of itself besides; nothing unless given.

    Raises
    ------
    ControllerError
        If sums of products could leave 64 bits (int32 only), the phase clock has no rope, or the rows or
        ramps do not suit a contactor drive.
    """

    bank: Bank
    limits: CommandLimits
    rope: RopeSettings | None = None
    operator: OperatorSettings = NO_OPTIONS
    diagnostics: Diagnostics = NO_DIAGNOSTICS

    def __post_init__(self) -> None:
        follows = self.clock is not None or self.bank.by_rope is not None or self.is_spaced
        if self.rope is None and follows:
            raise ControllerError("taps that follow the rope, and rows chosen by it, need a measured rope")
        if self.rope is None and self.operator.rope_offset is not None:
            raise ControllerError("rope_offset_m: needs a measured rope")
        self.diagnostics.check(self.bank, self.rope)
        if self.operator.contactor_commands:
            check_contactor(self.operator, self.bank, self.limits)
        if self.number.is_integer and self.clock is None:
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

    @property
    def is_spaced(self) -> bool:
        """Whether rows follow a spacing: the original or the modified law."""
        return isinstance(self.bank.rows[0].taps, SpacedTaps)

    @property
    def clock(self) -> PhaseClock | None:
        """The phase clock; None where delays are in ticks."""
        taps = self.bank.rows[0].taps
        return taps.clock if isinstance(taps, PhaseTaps) else None

    @property
    def last_selector(self) -> int:
        """Largest selector: the last row, or 1 where the rope chooses the row."""
        return len(self.bank.rows) if self.bank.by_rope is None else 1

    @cached_property
    def longest_lag(self) -> int:
        """Largest lag of any row: once it has passed without a change, the block has settled."""
        return max(table.tail for table in self.row_tables)

    @property
    def status_bits(self) -> tuple[Status, ...]:
        """Bits of the status word that the block can set."""
        absent = Status(0) if self.rope is not None else ROPE_BITS
        absent |= OPTIONAL_BITS & ~(self.operator.status_bits | self.diagnostics.status_bits)
        return tuple(bit for bit in Status if not bit & absent)

    @cached_property
    def row_tables(self) -> tuple[RowTable, ...]:
        """Constants of rows 0 to n."""
        one = (1 << self.number.amplitude_bits) if self.number.is_integer else self.number.scalar(1.0)
        tables = [RowTable("unshaped", "none", (0,), (one,), 0, Fraction(0), False, 1.0)]
        for row in self.bank.rows:
            taps = row.taps
            exact = [Fraction(n, 1 << self.number.amplitude_bits) for n in taps.numerators]
            lags = tuple(taps.lags.tolist())
            tables.append(
                RowTable(
                    name=row.name,
                    family=row.family,
                    lags=lags,
                    amplitudes=taps.numerators
                    if self.number.is_integer
                    else tuple(self.number.scalar(a) for a in taps.amplitudes.tolist()),
                    tail=lags[-1],
                    moment=sum((a * lag for a, lag in zip(exact, lags, strict=True)), Fraction(0)),
                    waits=taps.has_negative,
                    residual_bound_ratio=taps.guarantee.tolerance,
                )
            )
        return tuple(tables)
