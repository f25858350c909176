"""The measured rope: what a block makes of its length and hoist speed, tick by tick. Not for: shaping.

A length is taken only where it can be true: a reading that is not valid, not finite or farther from the last
one than the hoist could have moved is not taken, and the last one holds. The position of an arm is read in
the same way (`measured`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from swayless.controller.measured import ROPE, Measured
from swayless.controller.number import NumberType, as_written
from swayless.controller.status import Status
from swayless.errors import ControllerError

MM_PER_M = 1000
"""In int32 lengths are in mm and hoist speeds in mm/s, angles in mrad and mrad/s."""

PLAUSIBLE_JUMP_M = 0.05
"""Difference of two readings that no hoist explains and that is taken all the same: stretch and sensors.

Of angles, 0.05 rad.
"""

MOST_HELD_TICKS = 1 << 20
"""The ticks for which a reading is held are counted up to here; by then the hoist may be anywhere."""

_INVALID, _JUMP = int(Status.ROPE_INVALID), int(Status.ROPE_JUMP)
_OUT_OF_RANGE, _FROZEN = int(Status.ROPE_OUT_OF_RANGE), int(Status.ROPE_FROZEN)
_HOIST_INVALID = int(Status.HOIST_SPEED_INVALID)


@dataclass(frozen=True)
class RopeSettings:
    """What a block knows of its rope, as constants in its number type: m and m/s, in int32 mm and mm/s.

    Parameters
    ----------
    shortest, longest : float or int
        Range of the rope length, 0 < shortest < longest; of the position of an arm, shortest < longest.
    hoist_speed : float or int
        Fastest change of the rope length.
    jump : float or int
        Difference of two readings that is always taken.
    way_per_tick : float or int
        Farthest that the rope can move in one tick; in int32 rounded up.
    tick_s : float or int
        Length of a tick; in int32 in microseconds.
    measured : Measured
        What is measured: a rope, or the position of an arm in m or rad.

    Raises
    ------
    ControllerError
        If a range is empty, a rope is not above 0, or nothing moves it.
    """

    shortest: Any
    longest: Any
    hoist_speed: Any
    jump: Any
    way_per_tick: Any
    tick_s: Any
    measured: Measured = ROPE

    def __post_init__(self) -> None:
        span = f"{self.measured.title} {self.shortest!r} to {self.longest!r}"
        if self.measured.is_length and not 0 < self.shortest < self.longest:
            raise ControllerError(f"{span}: a measured rope needs two lengths, the shorter above 0")
        if not self.shortest < self.longest:
            raise ControllerError(f"{span}: must be two places, the lower one first")
        if not self.hoist_speed > 0:
            name = self.measured.c_speed_name
            raise ControllerError(f"{name} = {self.hoist_speed!r}: must be above 0")


def rope_settings(
    rope_length_m: tuple[float, float],
    hoist_speed_m_s: float,
    *,
    tick_s: float,
    number: NumberType,
    measured: Measured = ROPE,
) -> RopeSettings:
    """Bring the range of a rope, or of the position of an arm, into a number type.

    Parameters
    ----------
    rope_length_m : tuple of float
        Shortest and longest; of an arm the lowest and highest position, in m or rad.
    hoist_speed_m_s : float
        Fastest change of the rope length, or of the position, > 0.
    tick_s : float
        Length of a tick.
    number : NumberType
        Target type.
    measured : Measured
        What is measured.

    Raises
    ------
    ControllerError
        If a value is out of range.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> rope_settings((3.0, 9.0), 0.3, tick_s=0.01, number=number_type("int32")).way_per_tick
    3
    """
    shortest_m, longest_m = rope_length_m
    way_m = as_written(hoist_speed_m_s) * as_written(tick_s)
    if number.is_integer:
        return RopeSettings(
            shortest=math.ceil(as_written(shortest_m) * MM_PER_M),
            longest=math.floor(as_written(longest_m) * MM_PER_M),
            hoist_speed=math.ceil(as_written(hoist_speed_m_s) * MM_PER_M),
            jump=round(PLAUSIBLE_JUMP_M * MM_PER_M),
            way_per_tick=math.ceil(way_m * MM_PER_M),
            tick_s=math.ceil(as_written(tick_s) * 1_000_000),
            measured=measured,
        )
    scalar = number.scalar
    return RopeSettings(
        scalar(shortest_m),
        scalar(longest_m),
        scalar(hoist_speed_m_s),
        scalar(PLAUSIBLE_JUMP_M),
        scalar(float(way_m)),
        scalar(tick_s),
        measured,
    )


class Rope:
    """The rope as the block believes it to be; after power-on the longest.

    Parameters
    ----------
    settings : RopeSettings
        Range and speed.
    number : NumberType
        Number type.
    """

    def __init__(self, settings: RopeSettings, number: NumberType) -> None:
        self._settings, self._number = settings, number
        self._half = None if number.is_integer else number.scalar(0.5)
        self.length = settings.longest
        self.speed = number.scalar(0)
        self._held_ticks = 0
        self._unmoved = number.scalar(0)

    def read(self, length: Any, speed: Any, *, valid: bool, at_rest: bool) -> int:
        """Take the readings of one tick.

        Parameters
        ----------
        length, speed : float or int
            Rope length, and its change per second: positive when the load sinks.
        valid : bool
            False: the length is not to be believed.
        at_rest : bool
            Nothing is pending, so that a length far from the last one may be taken.

        Returns
        -------
        int
            Status bits.
        """
        status = self._read_speed(speed)
        before = self.length
        if valid and self._is_finite(length):
            status |= self._read_length(length, at_rest=at_rest)
        else:
            status |= _INVALID
            self._hold()
        return status | self._watch(before)

    def _read_speed(self, speed: Any) -> int:
        limit = self._settings.hoist_speed
        if not self._is_finite(speed):
            self.speed = self._number.scalar(0)
            return _HOIST_INVALID
        self.speed = min(max(speed, -limit), limit)
        return 0

    def _read_length(self, length: Any, *, at_rest: bool) -> int:
        settings = self._settings
        clamped = min(max(length, settings.shortest), settings.longest)
        status = _OUT_OF_RANGE if clamped != length else 0
        reach = settings.jump + (self._number.scalar(self._held_ticks + 1) * settings.way_per_tick)
        if at_rest or abs(clamped - self.length) <= reach:
            self.length = clamped
            self._held_ticks = 0
            return status
        self._hold()
        return status | _JUMP

    def _hold(self) -> None:
        self._held_ticks = min(self._held_ticks + 1, MOST_HELD_TICKS)

    def _watch(self, before: Any) -> int:
        """Watch for a length that stays while the hoist says that it moves, within the range."""
        settings = self._settings
        inside = settings.shortest < self.length < settings.longest
        if self.length != before or self.speed == 0 or not inside:
            self._unmoved = self._number.scalar(0)
            return 0
        limit = self._frozen_way
        self._unmoved = min(self._unmoved + (abs(self.speed) * settings.tick_s), limit)
        return _FROZEN if self._unmoved >= limit else 0

    @property
    def _frozen_way(self) -> Any:
        """Way that the hoist says it has gone, from which on a length that stays is frozen."""
        return self._settings.jump * 1_000_000 if self._number.is_integer else self._settings.jump

    def _is_finite(self, value: Any) -> bool:
        """Whether a value is a number: only what is finite and not 0 shrinks when halved."""
        return bool(self._half is None or value == 0 or abs(value) * self._half < abs(value))
