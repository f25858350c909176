"""From command units and ticks to what a block puts out: metres and seconds, in int32 millimetres.

Not for: the law itself.
"""

from __future__ import annotations

import math
from typing import Any

from swayless.controller.number import as_written
from swayless.controller.rope_bound import RESIDUAL_PPM
from swayless.controller.settings import ShaperSettings
from swayless.errors import ControllerError

TIME_SHIFT = 32
"""In int32 a tick is this fixed-point fraction of a second, rounded down."""


def residual_bounds(settings: ShaperSettings) -> tuple[Any, ...]:
    """Residual bound of every row, row 0 included: a ratio, in int32 millionths rounded up.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    """
    if settings.number.is_integer:
        return tuple(
            math.ceil(as_written(t.residual_bound_ratio) * RESIDUAL_PPM) for t in settings.row_tables
        )
    return tuple(settings.number.scalar(t.residual_bound_ratio) for t in settings.row_tables)


class OutputUnits:
    """The constants that scale a sum of references to a distance, and ticks to a time.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.

    Raises
    ------
    ControllerError
        If a stop distance would not fit its type (int32 only).
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._number = settings.number
        per_unit = as_written(settings.tick_s) / as_written(settings.limits.units_per_m_s)
        if not self._number.is_integer:
            self.metres_per_unit_tick = self._number.scalar(float(per_unit))
            self.tick_s = self._number.scalar(settings.tick_s)
            return
        largest = _largest_sum(settings)
        millimetres = per_unit * 1000
        if largest * millimetres >= 1 << 31:
            raise ControllerError(
                "the longest stop distance exceeds 2^31 mm: check max_speed and counts_per_m_s"
            )
        self.distance_shift = 0
        while (
            self.distance_shift < 60
            and round(millimetres * (1 << (self.distance_shift + 1))) * largest < 1 << 62
        ):
            self.distance_shift += 1
        self.distance_scale = round(millimetres * (1 << self.distance_shift))
        self.time_scale = math.floor(as_written(settings.tick_s) * (1 << TIME_SHIFT))

    def distance(self, total: Any) -> Any:
        """Scale a sum of references to metres; in int32 to millimetres, rounded to the nearest."""
        if not self._number.is_integer:
            return total * self.metres_per_unit_tick
        half = (1 << self.distance_shift) >> 1
        magnitude = (abs(total) * self.distance_scale + half) >> self.distance_shift
        return magnitude if total >= 0 else -magnitude

    def time_s(self, ticks: int) -> Any:
        """Scale ticks to seconds; in int32 rounded up to whole seconds."""
        if not self._number.is_integer:
            return self._number.scalar(ticks) * self.tick_s
        return (ticks * self.time_scale + (1 << TIME_SHIFT) - 1) >> TIME_SHIFT


def _largest_sum(settings: ShaperSettings) -> int:
    """Bound the sum of references of any stop: two ramps, two settlings, a hold at the maximum, and steps."""
    limits, steps = settings.limits, settings.operator.steps
    slowest = min(limits.acceleration_step, limits.deceleration_step, limits.quick_stop_step)
    ramp_ticks = -(-int(limits.max_command) // int(slowest))
    stop = int(limits.max_command) * (2 * ramp_ticks + 4 * settings.longest_delay_ticks + 4)
    return stop if steps is None else stop + int(steps.capacity)
