"""What is still to come: the sum of the references, and the ticks until 0, if the command is 0 from now on.

Both are closed forms, and exact. Not for: metres and seconds (`output_units`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.motion import Motion
from swayless.controller.ramp import Glide, Glider
from swayless.controller.settings import ShaperSettings
from swayless.controller.step_mode import StepMode
from swayless.controller.stops import Stops
from swayless.controller.travel import Travel


class Foretelling:
    """Closed forms of every way to rest.

    Parameters
    ----------
    settings : ShaperSettings
        Rows, limits and number type.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        limits, number = settings.limits, settings.number
        self._number, self._tables, self._last = number, settings.row_tables, settings.longest_lag
        self._zero = number.scalar(0)
        self._speed_up = Glider(limits.acceleration_step, limits, number)
        self._slow_down = Glider(limits.deceleration_step, limits, number)
        self._quick_down = Glider(limits.quick_stop_step, limits, number)

    def foretell(
        self,
        motion: Motion,
        stops: Stops,
        steps: StepMode | None,
        wanted_row: int,
        travel: Travel | None = None,
    ) -> Glide:
        """Sum of the references to come, and ticks until 0.

        Parameters
        ----------
        motion : Motion
            Where the block is.
        stops : Stops
            Which stops are latched.
        steps : StepMode or None
            Steps to come; the ticks leave them out.
        wanted_row : int
            Row that takes over at rest.
        travel : Travel or None
            The ways to the ends, which may keep a row from taking over while the crane moves.
        """
        if stops.is_halted:
            return Glide(0, self._zero)
        if stops.is_quick:
            return self._quick_down(motion.reference, self._zero)
        if steps is not None and steps.is_running:
            return self._steps(motion, steps)
        if motion.waits and not motion.is_settled and motion.target != 0:
            return self._waiting(motion, wanted_row, travel)
        return self._release(motion, wanted_row if travel is None else travel.next_row)

    def _steps(self, motion: Motion, steps: StepMode) -> Glide:
        """Let steps run out: every command to come is part of what is left of them."""
        tail = self._tables[motion.row].tail
        ticks = self._slow_down(motion.command, self._zero).ticks + motion.filter.ticks_of(tail)
        return Glide(ticks + 1, motion.pending + (steps.left + steps.queued))

    def _release(self, motion: Motion, wanted_row: int) -> Glide:
        """Ramp down, and what is pending."""
        row = self._row_at_rest(motion, motion.command, wanted_row) if motion.is_settled else motion.row
        tail = self._tables[row].tail
        down = self._slow_down(motion.command, self._zero)
        still = 0 if down.ticks > 0 else min(motion.still, tail)
        ticks = down.ticks + motion.filter.ticks_of(tail - still)
        return Glide(ticks, motion.filter.pending(row) + down.total)

    def _waiting(self, motion: Motion, wanted_row: int, travel: Travel | None) -> Glide:
        """Foretell a stop that waits: the ramp completes, the shaper settles, only then the 0 is accepted.

        With it the wanted row takes over, unless its stop, seen from here, exceeds the ways.
        """
        target = motion.target
        glider = self._speed_up if abs(target) > abs(motion.command) else self._slow_down
        rise = glider(motion.command, target)
        hold = self._last if rise.ticks > 0 else self._last - motion.still
        down = self._slow_down(target, self._zero)
        settled = (motion.pending + rise.total) + (self._number.scalar(hold) * target)
        row = self._row_at_rest(motion, target, wanted_row)
        total = (settled + self._row_change(motion, target, row)) + down.total
        if travel is not None and row == wanted_row and travel.will_exceed(total, motion.reference):
            row = motion.row
            total = (settled + self._row_change(motion, target, row)) + down.total
        return Glide(rise.ticks + hold + down.ticks + self._tables[row].tail, total)

    def _row_change(self, motion: Motion, command: Any, row: int) -> Any:
        """Give how much more is pending at rest at a command in another row."""
        return motion.filter.rest_sum(command, row) - motion.filter.rest_sum(command, motion.row)

    def _row_at_rest(self, motion: Motion, command: Any, wanted_row: int) -> int:
        """Row that takes over if the command becomes 0 when settled at `command`."""
        return 0 if motion.inches(command, self._zero) else wanted_row
