"""The tracking monitor: does the drive follow the reference? For a status bit; it changes no reference.

A drive lags, so the actual speed is compared with the range of all references of the last ticks. The range is
kept for two windows, the one that fills and the full one before it: it holds the references of at least
`window_ticks` and of fewer than twice as many ticks, in four numbers. Not for: what the drive should do.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from swayless.controller.limits import CommandLimits
from swayless.controller.number import NumberType, as_written
from swayless.errors import ControllerError

MOST_TICKS = 1 << 20
"""Longest window and longest time: counted in 32 bits with room."""


@dataclass(frozen=True)
class TrackingSettings:
    """When the drive counts as not following, as constants.

    Parameters
    ----------
    tolerance : float or int
        How far outside the range of references the actual speed may be, in command units.
    time_ticks : int
        For so many ticks in a row; from the next on the bit is set.
    window_ticks : int
        References of at least so many ticks, the present one included, count as followed.
    """

    tolerance: Any
    time_ticks: int
    window_ticks: int


def tracking_settings(
    tolerance_m_s: float,
    *,
    time_s: float,
    delay_s: float,
    tick_s: float,
    limits: CommandLimits,
    number: NumberType,
) -> TrackingSettings:
    """Bring the limits of the monitor into ticks and a number type.

    Parameters
    ----------
    tolerance_m_s : float
        How far the actual speed may be from every reference of the window, above 0; in int32 rounded down.
    time_s : float
        For how long, at least 0; rounded up to ticks.
    delay_s : float
        Lag of the drive that is allowed for, at least 0; rounded up to ticks. A drive of first order with a
        time constant T is at most a T away from references that ramp by a: T as delay covers it.
    tick_s, limits, number
        Length of a tick, what commands are in, target type.

    Raises
    ------
    ControllerError
        If a value is out of range, or the tolerance less than one count.

    Examples
    --------
    >>> from swayless.controller import SpeedLimits, command_limits, number_type
    >>> double = number_type("double")
    >>> limits = command_limits(SpeedLimits(0.5, 0.5), tick_s=0.01, number=double)
    >>> tracking_settings(0.05, time_s=0.5, delay_s=0.2, tick_s=0.01, limits=limits, number=double)
    TrackingSettings(tolerance=0.05, time_ticks=50, window_ticks=21)
    """
    finite_m_s = tolerance_m_s if math.isfinite(tolerance_m_s) else 0.0
    units = as_written(finite_m_s) * as_written(limits.units_per_m_s)
    tolerance = math.floor(units) if number.is_integer else number.scalar(float(units))
    if not 0 < tolerance <= limits.max_command:
        raise ControllerError(
            f"tracking_tolerance = {tolerance_m_s!r} m/s: must be at most max_speed, "
            + ("and at least one count" if number.is_integer else "and above 0")
        )
    return TrackingSettings(
        tolerance,
        time_ticks=_ticks("tracking_time", time_s, tick_s),
        window_ticks=_ticks("tracking_delay", delay_s, tick_s) + 1,
    )


def _ticks(name: str, seconds: float, tick_s: float) -> int:
    """Round a time up to ticks."""
    ticks = math.ceil(as_written(seconds) / as_written(tick_s)) if math.isfinite(seconds) else -1
    if not 0 <= ticks < MOST_TICKS:
        raise ControllerError(f"{name} = {seconds!r} s: must be 0 to {(MOST_TICKS - 1) * tick_s:g} s")
    return ticks


class Tracking:
    """The monitor with its state, at rest at 0.

    Parameters
    ----------
    settings : TrackingSettings
        Constants.
    number : NumberType
        Type of the speeds.
    """

    def __init__(self, settings: TrackingSettings, number: NumberType) -> None:
        self._settings = settings
        zero = number.scalar(0)
        self._low = self._high = self._last_low = self._last_high = zero
        self._filled = self._outside = 0

    def watch(self, reference: Any, actual: Any, *, expected: bool) -> bool:
        """Watch one tick.

        Parameters
        ----------
        reference : float or int
            What the block puts out in this tick.
        actual : float or int
            Speed that the drive reports; one that is not finite follows nothing.
        expected : bool
            Whether the drive is to follow at all: not in an emergency stop, nor while it is not ready.

        Returns
        -------
        bool
            The drive has been outside for longer than `time_ticks`.
        """
        settings = self._settings
        if self._filled >= settings.window_ticks:
            self._last_low, self._last_high = self._low, self._high
            self._low = self._high = reference
            self._filled = 0
        self._filled += 1
        self._low, self._high = min(self._low, reference), max(self._high, reference)
        low = min(self._low, self._last_low) - settings.tolerance
        high = max(self._high, self._last_high) + settings.tolerance
        if not expected or low <= actual <= high:
            self._outside = 0
        elif self._outside <= settings.time_ticks:
            self._outside += 1
        return self._outside > settings.time_ticks
