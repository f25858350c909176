"""Moves of rows that take a new command at rest only: a rise, a hold until all has settled, a fall.

Not for: rows with positive amplitudes, which may change their minds on the way (`approach`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.approach import Approach
from swayless.controller.ramp import Glider
from swayless.controller.settings import ShaperSettings

RECIPROCAL_BITS = 30
"""In int32 the reciprocal of the hold is over 2 to this power."""


class PlannedMove:
    """How fast a move may be that has to rise, hold and fall within a way.

    Parameters
    ----------
    settings : ShaperSettings
        Limits, number type and longest delay.
    approach : Approach
        For the way down.
    """

    def __init__(self, settings: ShaperSettings, approach: Approach) -> None:
        limits, number = settings.limits, settings.number
        self._number, self._approach = number, approach
        self._speed_up = Glider(limits.acceleration_step, limits, number)
        self._slow_down = Glider(limits.deceleration_step, limits, number)
        ticks = settings.longest_delay_ticks
        self.hold = number.scalar(ticks)
        self.shortest = number.scalar(ticks + 2)
        self.reciprocal = (
            (1 << RECIPROCAL_BITS) // (ticks + 2) if number.is_integer else number.scalar(1.0 / (ticks + 2))
        )
        self.step_bits = int(limits.max_command // approach.gentle_step).bit_length()

    def needs(self, command: Any, target: Any) -> Any:
        """Sum of the commands from `command` to `target`, held until all has settled, and down to 0."""
        glider = self._speed_up if target > command else self._slow_down
        rise, hold = glider(command, target).total, self.hold * target
        return (rise + hold) + self._approach.glide(target)

    def speed(self, way: Any, most: Any) -> Any:
        """Largest command up to `most`, from rest, whose move keeps within a way, to a step of the ramp.

        Parameters
        ----------
        way : float or int
            Sum of the commands that may come, >= 0; in int32 at least `shortest`, or nothing fits.
        most : float or int
            Largest command, 0 to the maximum.
        """
        slow = min(self._share(min(way, self.shortest * most)), most)
        step = self._approach.gentle_step
        if slow <= step:
            return slow
        if self.needs(self._number.scalar(0), most) <= way:
            return most
        steps = 0
        for bit in range(self.step_bits - 1, -1, -1):
            more = self._number.scalar(steps + (1 << bit)) * step
            if more <= most and self.needs(self._number.scalar(0), more) <= way:
                steps += 1 << bit
        return self._number.scalar(steps) * step

    def _share(self, way: Any) -> Any:
        """Part of a way that each tick of the shortest hold may have."""
        if not self._number.is_integer:
            return way * self.reciprocal
        return max((way * self.reciprocal) >> RECIPROCAL_BITS, int(way >= self.shortest))
