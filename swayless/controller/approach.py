"""Coming to rest within a way: how fast the command may be so that what follows does not exceed a sum.

References still to come are what is pending in the shaper and the commands to come, for no shaper gains or
loses anything. So a way is kept by commands alone: the next command and its ramp to 0 must not exceed what
the way leaves. Their sum grows with the command, and after a command that kept within the way its
deceleration does, so that the choice of each tick may be the largest that does. It is made among four: a full
step of the ramp, a step no larger than a deceleration can undo, the same command again, and a deceleration.
What deceleration leaves over is one tick more of the ramp down, where it lies between two others: the way is
used to its end. Not for: directions (commands and ways are >= 0 here), nor for what the way is.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType
from swayless.controller.ramp import Glider, ramped


class Approach:
    """The largest next command that can come to rest within a way.

    Parameters
    ----------
    limits : CommandLimits
        Ramps.
    number : NumberType
        Number type.

    Examples
    --------
    >>> from swayless.controller.limits import SpeedLimits, command_limits
    >>> from swayless.controller.number import number_type
    >>> double = number_type("double")
    >>> approach = Approach(command_limits(SpeedLimits(4.0, 1.0, 2.0), tick_s=1.0, number=double), double)
    >>> [approach.within(3.0, 4.0, way) for way in (10.0, 4.5, 1.5)]
    [4.0, 3.0, 1.0]
    """

    def __init__(self, limits: CommandLimits, number: NumberType) -> None:
        self._limits, self._zero = limits, number.scalar(0)
        self._slow_down = Glider(limits.deceleration_step, limits, number)
        self.gentle_step = min(limits.acceleration_step, limits.deceleration_step)

    def glide(self, command: Any) -> Any:
        """Sum of the commands that follow a command on its ramp to 0."""
        return self._slow_down(command, self._zero).total

    def fits(self, command: Any, way: Any) -> bool:
        """Whether a command and its ramp to 0 keep within a way."""
        return bool(command + self.glide(command) <= way)

    def within(self, command: Any, target: Any, way: Any) -> Any:
        """Next command from `command` towards `target` that keeps within a way, as far as the ramp can.

        Parameters
        ----------
        command, target : float or int
            Both from 0 to the maximum.
        way : float or int
            Sum of the commands that may still come.
        """
        up = ramped(command, target, self._limits)
        if self.fits(up, way):
            return up
        gentle = min(up, command + self.gentle_step)
        if self.fits(gentle, way):
            return gentle
        most = command if command > 0 else gentle
        slower = max(command - self._limits.deceleration_step, self._zero)
        return max(slower, min(way - self.glide(command), most))
