"""Predicted sway: constants of the linear model of the load that a block runs beside its reference.

The deflection u of a load of frequency w and damping d follows u'' + 2 d w u' + w^2 u = -x'', with x the
trolley. References hold for a tick, so one tick of the model is exact: a step of the speed, then a turn of
(pace, place) by w sqrt(1 - d^2) tick_s that shrinks by exp(-d w tick_s). Where the rope is measured the turn
follows it. Not for: running the model (`sway_model`), wind, or loads that swing in two modes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType
from swayless.controller.phase_clock import PhaseClock, phase_clock
from swayless.controller.phase_taps import PhaseTaps
from swayless.controller.rope import MM_PER_M, RopeSettings
from swayless.controller.taps import Bank
from swayless.errors import ControllerError
from swayless.plant import Mode

HELD_UNITS = 16
"""A turn is made smaller by so many units of the number type, more than its rounding can add: what is left of
a swing falls and never grows. 16 units of 2**-24 are a part in a million a tick."""

MOST_ADDED_DAMPING = 0.002
"""Damping ratio that those units may come to; a tick that is finer is refused."""

LARGEST_TURN_RAD = 0.5
"""Largest turn in a tick on a measured rope: the series of its sine and cosine are then right to 3e-4."""

LARGEST_SWING = 8
"""The model ends at so many times the swing of a jump to full speed: an angle beyond its law."""

FORGOTTEN = 2.0**-24
"""Part of the largest command: in float types a smaller swing at a steady reference counts as none."""

INTEGER_BITS = 28
"""In int32 commands are scaled up to so many bits."""

INTEGER_ONE = 1 << 30
"""In int32 sines and cosines are over 2**30."""

_FACTOR_BITS = 30
_MOST_SHIFT = 60


class Turn(NamedTuple):
    """One tick of the swing.

    Parameters
    ----------
    cosine, sine : float or int
        Of the turn, made smaller by damping; in int32 over 2**30.
    metres : float or int
        Deflection in m per unit of the model's place; in int32 in mm, over 2**metres_shift.
    """

    cosine: Any
    sine: Any
    metres: Any


class RopeTurn(NamedTuple):
    """What makes the turn of a measured rope.

    Parameters
    ----------
    clock : PhaseClock
        Phase of an undamped tick over the rope length, in quanta.
    quantum : float or int
        Turn of one quantum in rad; in int32 its factor over 2**(quantum_shift - 30).
    quantum_shift : int
        In int32 only, else 0.
    loss : float or int
        Shrinking per rad of the turn; in int32 over 2**30.
    metres : float or int
        Metres of a turn, times its quanta.
    """

    clock: PhaseClock
    quantum: Any
    quantum_shift: int
    loss: Any
    metres: Any


@dataclass(frozen=True)
class SwaySettings:
    """The model of the load, as constants in a number type.

    Parameters
    ----------
    number : NumberType
        Type of every number.
    turns : tuple of Turn
        Turn of rows 1 to n; empty where the rope is measured.
    rope : RopeTurn or None
        What makes the turn where the rope is measured.
    held : float or int
        How much of a turn is kept at no damping: just below 1; in int32 over 2**30.
    largest : float or int
        Where pace and place end.
    forgotten : float or int
        Where they count as 0 at a steady reference; 0 in int32, whose rounding forgets by itself.
    command_shift, metres_shift : int
        In int32 commands are scaled by 2**command_shift, mm by 2**metres_shift; else 0.
    """

    number: NumberType
    turns: tuple[Turn, ...]
    rope: RopeTurn | None
    held: Any
    largest: Any
    forgotten: Any
    command_shift: int
    metres_shift: int


def sway_settings(bank: Bank, limits: CommandLimits, rope: RopeSettings | None = None) -> SwaySettings:
    """Make the model of the load from the rows of a block.

    Parameters
    ----------
    bank : Bank
        Rows, each with the mode it was designed for.
    limits : CommandLimits
        What the commands are in.
    rope : RopeSettings or None
        A measured rope: its pendulum is the model, damped as the rows are. None: a row's mode is.

    Raises
    ------
    ControllerError
        If the load does not swing in one mode that the block knows, or the tick is too fine or too coarse.

    Examples
    --------
    >>> import numpy as np
    >>> from swayless.controller import Row, SpeedLimits, Taps, command_limits, number_type
    >>> from swayless.design import design_shaper
    >>> double, held = number_type("double"), design_shaper("zv", Mode(0.5)).guarantee
    >>> zv = Taps(np.array([0, 20]), np.array([0.5, 0.5]), 0.05, held, double)
    >>> limits = command_limits(SpeedLimits(0.5, 0.5), tick_s=0.05, number=double)
    >>> turn = sway_settings(Bank((Row("sling", "zv", zv),)), limits).turns[0]
    >>> round(turn.cosine, 6), round(turn.sine, 6), round(turn.metres, 6)  # of 9 degrees, and 1 / w
    (0.987688, 0.156434, 0.31831)
    """
    for row in bank.rows:
        if row.taps.guarantee.further_bands:
            raise ControllerError(
                f'row "{row.name}": holds several modes; predicted sway needs a load that swings in one'
            )
    if rope is None:
        return _of_rows([row.taps.guarantee.mode for row in bank.rows], bank, limits)
    if not rope.measured.is_length:
        raise ControllerError(
            f"a measured {rope.measured.title} says nothing of a load: predicted sway needs a rope"
        )
    dampings = sorted({row.taps.guarantee.mode.damping_ratio for row in bank.rows})
    if len(dampings) > 1:
        raise ControllerError(f"damping ratios {dampings} of rows: predicted sway on a rope needs one")
    return _of_rope(rope, dampings[0], bank, limits)


def _of_rows(modes: Sequence[Mode], bank: Bank, limits: CommandLimits) -> SwaySettings:
    made = _Made(bank, limits)
    metres = [made.metres(1.0 / made.damped_rad_s(mode)) for mode in modes]
    shift = made.metres_shift(max(metres))
    turns = []
    for mode, each in zip(modes, metres, strict=True):
        turn_rad = made.damped_rad_s(mode) * bank.tick_s
        made.check_fine(turn_rad)
        kept = made.held * math.exp(-mode.damping_ratio * mode.angular_frequency_rad_s * bank.tick_s)
        turns.append(
            Turn(
                made.ratio(kept * math.cos(turn_rad)),
                made.ratio(kept * math.sin(turn_rad)),
                made.scaled(each, shift),
            )
        )
    return made.settings(tuple(turns), None, shift)


def _of_rope(rope: RopeSettings, damping_ratio: float, bank: Bank, limits: CommandLimits) -> SwaySettings:
    made, root = _Made(bank, limits), math.sqrt(1.0 - damping_ratio**2)
    taps = bank.rows[0].taps
    clock = (
        taps.clock
        if isinstance(taps, PhaseTaps)
        else phase_clock(rope, tick_s=bank.tick_s, most_phase_rad=2.0 * math.pi, number=bank.number)
    )
    quantum_rad = clock.quantum_rad * root
    made.check_fine(clock.fewest_quanta * quantum_rad)
    largest_rad = clock.most_quanta * quantum_rad
    if largest_rad > LARGEST_TURN_RAD:
        raise ControllerError(
            f"tick_s = {bank.tick_s!r}: the load turns by {largest_rad:.3g} rad in a tick on the shortest "
            f"rope; predicted sway allows {LARGEST_TURN_RAD:g}"
        )
    metres = made.metres(bank.tick_s / quantum_rad)
    shift = made.metres_shift(metres / clock.fewest_quanta)
    quantum_shift = _FACTOR_BITS - math.frexp(quantum_rad)[1] if bank.number.is_integer else 0
    turn = RopeTurn(
        clock,
        made.scaled(quantum_rad, quantum_shift),
        quantum_shift,
        made.ratio(damping_ratio / root),
        made.scaled(metres, shift),
    )
    return made.settings((), turn, shift)


class _Made:
    """Numbers of the model in a number type."""

    def __init__(self, bank: Bank, limits: CommandLimits) -> None:
        self._number, self._limits = bank.number, limits
        self._unit = 2.0**-bank.number.amplitude_bits
        self.held = 1.0 - HELD_UNITS * self._unit
        bits = int(limits.max_command).bit_length() if bank.number.is_integer else INTEGER_BITS
        self._command_shift = INTEGER_BITS - bits

    @staticmethod
    def damped_rad_s(mode: Mode) -> float:
        return 2.0 * math.pi / mode.damped_period_s

    def check_fine(self, turn_rad: float) -> None:
        added = HELD_UNITS * self._unit / turn_rad
        if added > MOST_ADDED_DAMPING:
            raise ControllerError(
                f"predicted sway: a tick turns the load by {turn_rad:.3g} rad, too little for "
                f"{self._number.name}: it would damp by {added:.3g}, allowed is {MOST_ADDED_DAMPING:g}"
            )

    def ratio(self, value: float) -> Any:
        """Bring a ratio into the type; in int32 cut to 0, so that no turn grows."""
        return int(value * INTEGER_ONE) if self._number.is_integer else self._number.scalar(value)

    def metres(self, seconds: float) -> float:
        """Give m, in int32 mm, per unit of place, before the shift."""
        per_unit = seconds / self._limits.units_per_m_s
        return per_unit * MM_PER_M / 2.0**self._command_shift if self._number.is_integer else per_unit

    def metres_shift(self, largest: float) -> int:
        if not self._number.is_integer:
            return 0
        return min(_FACTOR_BITS - math.frexp(largest)[1], _MOST_SHIFT)

    def scaled(self, value: float, shift: int) -> Any:
        return round(value * 2.0**shift) if self._number.is_integer else self._number.scalar(value)

    def settings(self, turns: tuple[Turn, ...], rope: RopeTurn | None, metres_shift: int) -> SwaySettings:
        number, most = self._number, self._limits.max_command
        whole = number.is_integer
        return SwaySettings(
            number=number,
            turns=turns,
            rope=rope,
            held=self.ratio(self.held),
            largest=number.scalar(LARGEST_SWING) * (most << self._command_shift if whole else most),
            forgotten=0 if whole else number.scalar(FORGOTTEN) * most,
            command_shift=self._command_shift,
            metres_shift=metres_shift,
        )
