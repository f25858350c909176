"""The optional diagnostics of a block at work, tick by tick. Not for: any change of a reference."""

from __future__ import annotations

from typing import Any

from swayless.controller.output_units import residual_bounds
from swayless.controller.pins import ShaperOutput
from swayless.controller.rope_bound import RESIDUAL_PPM
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status
from swayless.controller.sway_model import sway_model
from swayless.controller.tables import tables_match
from swayless.controller.tracking import Tracking

ROPE_UNKNOWN = int(Status.ROPE_INVALID | Status.ROPE_OUT_OF_RANGE | Status.ROPE_JUMP | Status.ROPE_FROZEN)
"""Bits that say that the rope length in use is not the one that hangs on the crane."""

_TRACKING = int(Status.TRACKING)
_REFUSED = int(Status.TABLES_INVALID | Status.UNSHAPED)


class Diagnosis:
    """Diagnostics with their state, at rest at 0.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its `diagnostics` say which there are.

    Attributes
    ----------
    tables_match : bool
        Whether the tables are those of the design. Where they are not, the block gives `refusal` for ever.
    design_id : int
        Of the design; 0 where it gives none.
    status : int
        Status bits of this tick.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        asked = settings.diagnostics
        self._bounds, self._rope_bounds = residual_bounds(settings), asked.rope_bounds
        self._zero = settings.number.scalar(0)
        self._everything = settings.number.scalar(RESIDUAL_PPM if settings.number.is_integer else 1)
        self._sway = None if asked.sway is None else sway_model(asked.sway)
        self._tracking = None if asked.tracking is None else Tracking(asked.tracking, settings.number)
        self.tables_match = tables_match(settings)
        self.design_id = 0 if asked.facts is None else asked.facts.design_id
        self.status = 0

    @property
    def refusal(self) -> ShaperOutput:
        """Outputs of a block whose tables are not those of its design: at rest for ever."""
        return ShaperOutput(
            reference=self._zero,
            stop_distance=self._zero,
            stop_time_s=self._zero,
            stop_time_ticks=0,
            residual_bound=self._everything,
            row=0,
            settled=True,
            active=False,
            error=True,
            status=_REFUSED,
            predicted_sway=self._zero,
            design_id=self.design_id,
        )

    def watch(self, reference: Any, actual_speed: Any, *, expected: bool) -> None:
        """Watch whether the drive follows; see `Tracking.watch`."""
        if self._tracking is not None:
            lost = self._tracking.watch(reference, actual_speed, expected=expected)
            self.status = _TRACKING if lost else 0

    def residual_bound(self, row: int, rope_length: Any, status: int) -> Any:
        """Bound of the residual vibration: a ratio, in int32 millionths.

        Parameters
        ----------
        row : int
            Row that shapes; 0 where none does, or a stop is latched.
        rope_length : float or int
            Measured rope, as the block believes it to be.
        status : int
            Status of the tick; where it says that the rope is not known, the bound is 1.
        """
        if row == 0 or self._rope_bounds is None:
            return self._bounds[row]
        return self._everything if status & ROPE_UNKNOWN else self._rope_bounds.at(row, rope_length)

    def predicted_sway(self, reference: Any, row: int, rope_length: Any) -> Any:
        """Deflection of the load in m, in int32 mm, ahead of the trolley; 0 where it is not asked for.

        Parameters
        ----------
        reference : float or int
            What the block puts out from this tick on.
        row : int
            Row in use.
        rope_length : float or int
            Measured rope, as the block believes it to be.
        """
        return self._zero if self._sway is None else self._sway.step(reference, row, rope_length)
