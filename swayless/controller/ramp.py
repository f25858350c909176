"""The ramp before the shaper, and in closed form what it still has to do. Not for: shaping."""

from __future__ import annotations

from typing import Any, NamedTuple

from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType


def ramped(command: Any, target: Any, limits: CommandLimits) -> Any:
    """Move a command one tick towards its target.

    The magnitude grows by at most `acceleration_step` and shrinks by at most `deceleration_step` a tick. A tick
    that passes 0 keeps both: what is left of its deceleration, but no more than an acceleration.

    Parameters
    ----------
    command, target : float or int
        Both within the maximum, in the number type.
    limits : CommandLimits
        Steps and the margin within which a ramp lands on its target.

    Examples
    --------
    >>> from swayless.controller.limits import SpeedLimits, command_limits
    >>> from swayless.controller.number import number_type
    >>> limits = command_limits(SpeedLimits(1.0, 1.0, 4.0), tick_s=0.25, number=number_type("double"))
    >>> ramped(0.5, 1.0, limits), ramped(0.75, -1.0, limits)
    (0.75, -0.25)
    """
    if target > command:
        reach = _raised(command, limits)
        return target if reach >= (target - limits.landing_margin) else reach
    if target < command:
        reach = _lowered(command, limits)
        return target if reach <= (target + limits.landing_margin) else reach
    return target


def _raised(command: Any, limits: CommandLimits) -> Any:
    """Return `command` one tick further up."""
    if command >= 0:
        return command + limits.acceleration_step
    reach = command + limits.deceleration_step
    return min(reach, limits.acceleration_step)


def _lowered(command: Any, limits: CommandLimits) -> Any:
    """Return `command` one tick further down."""
    if command <= 0:
        return command - limits.acceleration_step
    reach = command - limits.deceleration_step
    return max(reach, -limits.acceleration_step)


class Glide(NamedTuple):
    """What a ramp still has to do: ticks to its target, and the sum of the commands of those ticks."""

    ticks: int
    total: Any


class Glider:
    """Closed form of a ramp with one step size, in O(1) and without a division.

    Parameters
    ----------
    step : float or int
        Step per tick.
    limits : CommandLimits
        For the landing margin.
    number : NumberType
        Number type.
    """

    RECIPROCAL_BITS = 30

    def __init__(self, step: Any, limits: CommandLimits, number: NumberType) -> None:
        self._number = number
        self._step = step
        self._margin = limits.landing_margin
        self.shift = self.RECIPROCAL_BITS + int(step).bit_length() if number.is_integer else 0
        self.reciprocal = -((-1 << self.shift) // step) if number.is_integer else number.scalar(1) / step

    def __call__(self, start: Any, target: Any) -> Glide:
        """Ticks from `start` to `target`, not passing 0, and the sum of the commands on the way."""
        gap = start - target if start > target else target - start
        ticks = self._ticks(gap)
        if ticks == 0:
            return Glide(0, self._number.scalar(0))
        before = ticks - 1
        if self._number.is_integer:
            fall = self._step * ((before * (before + 1)) // 2)
            count: Any = before
        else:
            count = self._number.scalar(before)
            fall = self._step * ((count * (count + 1)) * self._number.scalar(0.5))
        run = count * start
        return Glide(ticks, ((run - fall) if start > target else (run + fall)) + target)

    def _ticks(self, gap: Any) -> int:
        if self._number.is_integer:
            return 0 if gap <= 0 else (((gap - 1) * self.reciprocal) >> self.shift) + 1
        if gap <= self._margin:
            return 1 if gap > 0 else 0
        return int((gap - self._margin) * self.reciprocal) + 1
