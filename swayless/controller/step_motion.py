"""The commands of steps: each is taken from what is left of them, and the last takes the rest.

Not for: presses (`step_mode`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.approach import Approach
from swayless.controller.ends import Switches
from swayless.controller.motion import Motion
from swayless.controller.planned_move import PlannedMove
from swayless.controller.ramp import ramped
from swayless.controller.settings import ShaperSettings
from swayless.controller.step_mode import StepMode
from swayless.controller.travel import Travel

ROUNDING_BITS = 8
"""In float types a ramp to rest may miss its way by rounding, by 2 to this power of units of its sum."""


class StepMotion:
    """The next command of a block that makes steps.

    Parameters
    ----------
    settings : ShaperSettings
        With Step Mode.
    travel : Travel or None
        Ways to the ends: steps beyond them are cut off.
    """

    def __init__(self, settings: ShaperSettings, travel: Travel | None) -> None:
        steps, number = settings.operator.steps, settings.number
        assert steps is not None  # noqa: S101 - only a block with Step Mode asks
        self._limits, self._travel = settings.limits, travel
        self._approach = approach = Approach(settings.limits, number)
        self._plan = PlannedMove(settings, approach)
        self._most, self._zero = steps.command, number.scalar(0)
        share = number.scalar(2.0 ** (ROUNDING_BITS - number.significand_bits))
        self.rounding = self._zero if number.is_integer else approach.glide(steps.command) * share
        self._speed = self._zero
        self._falls = False

    def command(self, motion: Motion, steps: StepMode, switches: Switches | None, limit: Any) -> Any:
        """Give the next command, and take it from what is left.

        Parameters
        ----------
        motion : Motion
            Where the block is.
        steps : StepMode
            What is left; presses that wait are taken over where the row allows.
        switches : Switches or None
            For the largest command towards a slow-down switch.
        limit : float or int
            Largest command of this tick.
        """
        rests = motion.is_settled and motion.command == 0
        if rests or not motion.waits:
            steps.take_over()
        forward = bool(motion.command > 0 or (motion.command == 0 and steps.left > 0))
        command = motion.command if forward else self._zero - motion.command
        way = steps.left if forward else self._zero - steps.left
        most = min(self._most, limit)
        if switches is not None:
            most = min(most, switches.most(forward=forward))
        if motion.is_settled or not motion.waits:
            if most == 0:
                way = min(way, self._approach.glide(command))
            if self._travel is not None:
                way = self._travel.cut(motion, way, forward=forward)
        after = self._after(motion, command, way, most)
        way = way - after
        if after == 0 and (command == 0 or abs(way) <= self.rounding):
            way = self._zero
        steps.left = way if forward else self._zero - way
        return after if forward else self._zero - after

    def _after(self, motion: Motion, command: Any, way: Any, most: Any) -> Any:
        """Next command, all being >= 0; rows that wait rise, hold and fall, and never turn in between."""
        if not motion.waits:
            return self._approach.within(command, most, way)
        if motion.is_settled:
            self._falls = bool(command > 0)
            self._speed = command if self._falls else self._plan.speed(way, most)
        if self._falls:
            return self._approach.within(command, command, way)
        return ramped(command, self._speed, self._limits)
