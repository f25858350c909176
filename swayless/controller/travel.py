"""Commands that keep within the ways to both ends of the travel. Not for: the ways themselves (`ends`)."""

from __future__ import annotations

from typing import Any

from swayless.controller.approach import Approach
from swayless.controller.contactor import quantised
from swayless.controller.ends import Distances
from swayless.controller.motion import Motion
from swayless.controller.pins import ShaperInput
from swayless.controller.planned_move import PlannedMove
from swayless.controller.ramp import on_grid, ramped
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

_WAY_LIMITS, _WAY_TOO_SHORT = int(Status.WAY_LIMITS), int(Status.WAY_TOO_SHORT)


class Travel:
    """What the ways to the ends leave of a command.

    Parameters
    ----------
    settings : ShaperSettings
        With distance inputs.

    Attributes
    ----------
    next_row : int
        Row that may take over in the next tick while the crane moves.
    status : int
        Status bits of this tick.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._limits, self._zero = settings.limits, settings.number.scalar(0)
        self._contactor = settings.operator.contactor_commands
        self._approach = Approach(settings.limits, settings.number)
        self._plan = PlannedMove(settings, self._approach)
        self._distances = Distances(settings)
        self.next_row = 0
        self.status = 0

    def read(self, inputs: ShaperInput, motion: Motion) -> None:
        """Take the distances of a tick."""
        self.status = self._distances.read(inputs, motion.reference)
        glide = self._approach.glide(abs(motion.command))
        total = motion.pending + (glide if motion.command > 0 else self._zero - glide)
        if self._distances.exceeds(total, self._limits.max_command):
            self.status |= _WAY_TOO_SHORT

    def look_ahead(self, motion: Motion, wanted_row: int) -> None:
        """Find which row may shape from the next tick on: the wanted one if its stop keeps within the ways.

        A row takes over at rest, but rest may be a constant speed, and the stop of another row a longer one.
        """
        self.next_row = motion.row
        if motion.is_settled:
            glide = self._approach.glide(abs(motion.command))
            total = motion.filter.pending(wanted_row) + (glide if motion.command > 0 else self._zero - glide)
            if not self.will_exceed(total, motion.reference):
                self.next_row = wanted_row

    def will_exceed(self, total: Any, reference: Any) -> bool:
        """Whether a sum of references to come exceeds the ways that the reference of this tick leaves."""
        return self._distances.will_exceed(total, reference)

    def cut(self, motion: Motion, way: Any, *, forward: bool) -> Any:
        """Cut what is left of steps down to the way to the end, but not below what stopping takes."""
        left = self._distances.left(motion, forward=forward)
        left = max(left, self._approach.glide(abs(motion.command)))
        if left >= way:
            return way
        self.status |= _WAY_LIMITS
        return left

    def wanted(self, motion: Motion, command: Any) -> Any:
        """Command that a row which waits may accept at rest."""
        if not (motion.waits and motion.is_settled):
            return command
        forward = bool(motion.command > 0 or (motion.command == 0 and command > 0))
        now, wanted = self._ahead(motion.command, command, forward=forward)
        left = self._distances.left(motion, forward=forward)
        reachable = self._reachable(now, wanted, left)
        if reachable == wanted:
            return command
        self.status |= _WAY_LIMITS
        return reachable if forward else self._zero - reachable

    def next(self, motion: Motion) -> Any:
        """Next command on the ramp to the target; of a row that does not wait, within the way."""
        if motion.waits:
            return motion.ramp()
        forward = bool(motion.command > 0 or (motion.command == 0 and motion.target > 0))
        now, target = self._ahead(motion.command, motion.target, forward=forward)
        left = self._distances.left(motion, forward=forward)
        after = self._approach.within(now, target, left)
        if after != ramped(now, target, self._limits):
            self.status |= _WAY_LIMITS
            after = on_grid(after, self._limits)
        return after if forward else self._zero - after

    def _ahead(self, now: Any, then: Any, *, forward: bool) -> tuple[Any, Any]:
        """Turn commands so that the motion is >= 0; what points the other way is 0 first."""
        if forward:
            return now, max(then, self._zero)
        return self._zero - now, max(self._zero - then, self._zero)

    def _reachable(self, now: Any, wanted: Any, left: Any) -> Any:
        """Largest of: the wanted command, the present one, 0; from rest, what a planned move may have."""
        if now == 0:
            speed = self._plan.speed(max(left, self._zero), wanted)
            return quantised(speed, self._contactor, self._zero) if self._contactor else speed
        if wanted != now and self._plan.needs(now, wanted) <= left:
            return wanted
        return now if wanted >= now and self._approach.fits(now, left) else self._zero
