"""The ramp before the shaper, and in closed form what it still has to do. Not for: shaping.

Both are exact, so that what is foretold is what happens. The steps of a ramp are multiples of a grid no finer
than the last bit of the largest command; a command that shrinks by such steps is never rounded, and one that
grows is first rounded to the grid.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType


def ramped(command: Any, target: Any, limits: CommandLimits) -> Any:
    """Move a command one tick towards its target.

    The magnitude grows by at most `acceleration_step` and shrinks by at most `deceleration_step` a tick. A
    tick that passes 0 keeps both: what is left of its deceleration, but no more than an acceleration.

    Parameters
    ----------
    command, target : float or int
        Both within the maximum, in the number type.
    limits : CommandLimits
        Steps of the ramp, and the anchor of their grid.

    Examples
    --------
    >>> from swayless.controller.limits import SpeedLimits, command_limits
    >>> from swayless.controller.number import number_type
    >>> limits = command_limits(SpeedLimits(1.0, 1.0, 4.0), tick_s=0.25, number=number_type("double"))
    >>> ramped(0.5, 1.0, limits), ramped(0.75, -1.0, limits)
    (0.75, -0.25)
    """
    if target > command:
        return min(target, _raised(command, limits))
    if target < command:
        return max(target, _lowered(command, limits))
    return target


def _raised(command: Any, limits: CommandLimits) -> Any:
    """Return `command` one tick further up."""
    if command >= 0:
        return on_grid(command, limits) + limits.acceleration_step
    return min(command + limits.deceleration_step, limits.acceleration_step)


def _lowered(command: Any, limits: CommandLimits) -> Any:
    """Return `command` one tick further down."""
    if command <= 0:
        return on_grid(command, limits) - limits.acceleration_step
    return max(command - limits.deceleration_step, -limits.acceleration_step)


def on_grid(command: Any, limits: CommandLimits) -> Any:
    """Round a command to the grid of the ramp steps: next to the anchor, floats are no finer than that."""
    anchor = -limits.ramp_anchor if command < 0 else limits.ramp_anchor
    return (command + anchor) - anchor


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
        For the grid.
    number : NumberType
        Number type.
    """

    RECIPROCAL_BITS = 30

    def __init__(self, step: Any, limits: CommandLimits, number: NumberType) -> None:
        self._number = number
        self._step = step
        self._limits = limits
        self.shift = self.RECIPROCAL_BITS + int(step).bit_length() if number.is_integer else 0
        self.reciprocal = -((-1 << self.shift) // step) if number.is_integer else number.scalar(1) / step

    def __call__(self, start: Any, target: Any) -> Glide:
        """Ticks from `start` to `target`, not passing 0, and the sum of the commands on the way."""
        if start == target:
            return Glide(0, self._number.scalar(0))
        if abs(target) > abs(start):
            start = on_grid(start, self._limits)
        step = -self._step if start > target else self._step
        whole = self._whole_steps(start, target, step)
        if self._number.is_integer:
            return Glide(whole + 1, (whole * start + step * ((whole * (whole + 1)) // 2)) + target)
        count = self._number.scalar(whole)
        way = step * ((count * (count + 1)) * self._number.scalar(0.5))
        return Glide(whole + 1, ((count * start) + way) + target)

    def _whole_steps(self, start: Any, target: Any, step: Any) -> int:
        """Count the steps before the one that lands on the target."""
        gap = abs(start - target)
        if self._number.is_integer:
            return int(((gap - 1) * self.reciprocal) >> self.shift)
        nearest = int((gap * self.reciprocal) + self._number.scalar(0.5))
        position = start + (self._number.scalar(nearest) * step)
        has_landed = position <= target if step < 0 else position >= target
        return nearest - 1 if has_landed and nearest > 0 else nearest
