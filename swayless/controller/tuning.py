"""What may be set on site, within ranges of the design: the largest speed, and an offset of the rope length.

Not for: the rope itself (`rope`).
"""

from __future__ import annotations

from typing import Any

from swayless.controller.finite import clamped
from swayless.controller.pins import ShaperInput
from swayless.controller.ramp import on_grid
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

_SPEED_LIMIT_INVALID = int(Status.SPEED_LIMIT_INVALID)
_ROPE_OFFSET_INVALID = int(Status.ROPE_OFFSET_INVALID)


class Tuning:
    """Speed limit and rope length of a tick, and the status bits that they set.

    Parameters
    ----------
    settings : ShaperSettings
        Limits, number type and ranges.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._limits, self._number = settings.limits, settings.number
        self._on_grid = settings.clock is not None
        self._has_limit = settings.operator.has_speed_limit
        self._range = settings.operator.rope_offset
        self._zero = settings.number.scalar(0)
        self.speed_limit = settings.limits.max_command
        self.status = 0

    def read(self, inputs: ShaperInput) -> ShaperInput:
        """Take the inputs of a tick; returns them with the rope length as it is."""
        self.status = 0
        if self._has_limit:
            limit = clamped(inputs.speed_limit, self._zero, self._limits.max_command, self._number)
            if limit != inputs.speed_limit:
                self.status |= _SPEED_LIMIT_INVALID
            self.speed_limit = on_grid(limit, self._limits) if self._on_grid else limit
        if self._range is None:
            return inputs
        offset = clamped(inputs.rope_offset, *self._range, self._number)
        if offset != inputs.rope_offset:
            self.status |= _ROPE_OFFSET_INVALID
        return inputs._replace(rope_length=inputs.rope_length + offset)

    def limited(self, command: Any) -> Any:
        """Keep a command within the speed limit."""
        return min(max(command, self._zero - self.speed_limit), self.speed_limit)
