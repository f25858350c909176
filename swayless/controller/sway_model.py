"""The load beside the reference: predicted sway, tick by tick, in three number types.

The state is (pace, place): what the load's speed against the trolley and its deflection times w would be, in
command units. On a still rope a turn with its rounding shrinks it, so it is bounded for ever; pumped beyond
what a linear model means, it ends at `SwaySettings.largest`. When the rope changes, the angle of the rope and
the moment of momentum L^2 times its rate stay: place goes with the root of L, pace with 1 / L. Not for: where
the constants come from (`sway`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.hoist_int32 import shifted
from swayless.controller.sway import INTEGER_ONE, RopeTurn, SwaySettings, Turn

RATIO_BITS = 24
"""In int32 ratios of rope lengths are in this fixed point: ropes of 1 to 43, squared, fit beside a place."""


def sway_model(settings: SwaySettings) -> FloatSway | IntegerSway:
    """Make the model for the settings' number type, the load hanging still.

    Parameters
    ----------
    settings : SwaySettings
        Constants.
    """
    return IntegerSway(settings) if settings.number.is_integer else FloatSway(settings)


class FloatSway:
    """The load in double or float.

    Rounding changes the size of (pace, place) by less than 4 units of the last place in a turn, and a turn is
    smaller than 1 by `sway.HELD_UNITS` of them: at a steady reference the size falls in every tick.

    Parameters
    ----------
    settings : SwaySettings
        Constants.
    """

    def __init__(self, settings: SwaySettings) -> None:
        scalar = settings.number.scalar
        self._settings, self._scalar = settings, scalar
        self._zero, self._half, self._one = scalar(0.0), scalar(0.5), scalar(1.0)
        self._sixth, self._twelfth = scalar(1.0 / 6.0), scalar(1.0 / 12.0)
        self._pace = self._place = self._reference = self._zero
        self._quanta = self._inverse = self._one
        if settings.rope is None:
            self._turn = settings.turns[0]
        else:
            self._turn = self._turn_at(settings.rope, scalar(settings.rope.clock.fewest_quanta))

    def step(self, reference: Any, row: int, length: Any) -> Any:
        """Run one tick.

        Parameters
        ----------
        reference : float
            What the block puts out, from this tick on.
        row : int
            Row in use; row 0 leaves the mode of the last other one, after power-on that of row 1.
        length : float
            Measured rope, within its range; not read where none is measured.

        Returns
        -------
        float
            Deflection of the load as the tick begins, in m: positive when it is ahead of the trolley.
        """
        if self._settings.rope is not None:
            self._follow(self._settings.rope, length)
        elif row > 0:
            self._turn = self._settings.turns[row - 1]
        change = reference - self._reference
        self._reference = reference
        if change == 0 and self._is_forgotten:
            self._pace = self._place = self._zero
        cosine, sine, metres = self._turn
        pace, place = self._pace - change, self._place
        self._pace = self._within((pace * cosine) - (place * sine))
        self._place = self._within((place * cosine) + (pace * sine))
        return place * metres

    @property
    def _is_forgotten(self) -> bool:
        least = self._settings.forgotten
        return bool(abs(self._pace) < least and abs(self._place) < least)

    def _within(self, swing: Any) -> Any:
        largest = self._settings.largest
        return min(max(swing, -largest), largest)

    def _follow(self, rope: RopeTurn, length: Any) -> None:
        """Turn as the rope's length says. Divides where the quanta change."""
        quanta, before = self._scalar(rope.clock.quanta(length)), self._quanta
        if quanta != before:
            shorter = quanta * self._inverse
            self._turn = self._turn_at(rope, quanta)
            self._place = self._within(self._place * (before * self._inverse))
            self._pace = self._within(self._pace * (shorter * shorter))

    def _turn_at(self, rope: RopeTurn, quanta: Any) -> Turn:
        self._quanta, self._inverse = quanta, self._one / quanta
        angle = quanta * rope.quantum
        square = angle * angle
        sine = angle * (self._one - (square * self._sixth))
        cosine = self._one - ((square * self._half) * (self._one - (square * self._twelfth)))
        kept = self._settings.held - (angle * rope.loss)
        return Turn(cosine * kept, sine * kept, rope.metres * self._inverse)


class IntegerSway:
    """The load in int32: the law of `FloatSway` in whole numbers, every quotient cut towards 0.

    A turn, cut, is shorter than before. Squares of whole numbers that fall reach 0: the load comes to rest.

    Parameters
    ----------
    settings : SwaySettings
        Constants.
    """

    SIXTH = round(INTEGER_ONE / 6)
    TWELFTH = round(INTEGER_ONE / 12)

    def __init__(self, settings: SwaySettings) -> None:
        self._settings = settings
        self._half = (1 << settings.metres_shift) >> 1
        self._pace = self._place = self._reference = 0
        self._quanta = 1
        if settings.rope is None:
            self._turn = settings.turns[0]
        else:
            self._turn = self._turn_at(settings.rope, settings.rope.clock.fewest_quanta)

    def step(self, reference: int, row: int, length: int) -> int:
        """Run one tick.

        Parameters
        ----------
        reference : int
            What the block puts out, from this tick on, in counts.
        row : int
            As for `FloatSway`.
        length : int
            Measured rope in mm.

        Returns
        -------
        int
            Deflection of the load as the tick begins, in mm.
        """
        if self._settings.rope is not None:
            self._follow(self._settings.rope, length)
        elif row > 0:
            self._turn = self._settings.turns[row - 1]
        change = (reference - self._reference) << self._settings.command_shift
        self._reference = reference
        cosine, sine, metres = self._turn
        pace, place = self._pace - change, self._place
        self._pace = self._within(shifted((pace * cosine) - (place * sine), 30))
        self._place = self._within(shifted((place * cosine) + (pace * sine), 30))
        magnitude = ((abs(place) * metres) + self._half) >> self._settings.metres_shift
        return int(magnitude if place >= 0 else -magnitude)

    def _within(self, swing: int) -> int:
        largest: int = self._settings.largest
        return min(max(swing, -largest), largest)

    def _follow(self, rope: RopeTurn, length: int) -> None:
        """Turn as the rope's length says. Divides where the quanta change."""
        quanta, before = rope.clock.quanta(length), self._quanta
        if quanta != before:
            shorter, longer = (quanta << RATIO_BITS) // before, (before << RATIO_BITS) // quanta
            self._turn = self._turn_at(rope, quanta)
            self._place = self._within(shifted(self._place * longer, RATIO_BITS))
            self._pace = self._within(shifted(self._pace * ((shorter * shorter) >> RATIO_BITS), RATIO_BITS))

    def _turn_at(self, rope: RopeTurn, quanta: int) -> Turn:
        self._quanta = quanta
        angle = (quanta * rope.quantum) >> (rope.quantum_shift - 30)
        square = (angle * angle) >> 30
        sine = (angle * (INTEGER_ONE - ((square * self.SIXTH) >> 30))) >> 30
        cosine = INTEGER_ONE - (((square >> 1) * (INTEGER_ONE - ((square * self.TWELFTH) >> 30))) >> 30)
        kept = self._settings.held - ((angle * rope.loss) >> 30)
        return Turn((cosine * kept) >> 30, (sine * kept) >> 30, rope.metres // quanta)
