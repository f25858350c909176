"""What a block may say of itself, each only where a design asks for it. Not for: running it (`diagnosis`)."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.checksum import Checksum
from swayless.controller.rope_bound import RopeBounds
from swayless.controller.sway import SwaySettings
from swayless.controller.tracking import TrackingSettings
from swayless.errors import ControllerError

MOST_DESIGN_ID = (1 << 32) - 1


@dataclass(frozen=True)
class DesignFacts:
    """Facts of the design, read on the machine.

    Parameters
    ----------
    design_id : int
        CRC-32 of the design file's canonical text, 32 bits.
    checksum : Checksum
        Of every table of the block; other tables are refused at `init`.

    Raises
    ------
    ControllerError
        If the identifier has more than 32 bits.
    """

    design_id: int
    checksum: Checksum

    def __post_init__(self) -> None:
        if not 0 <= self.design_id <= MOST_DESIGN_ID:
            raise ControllerError(f"design_id = {self.design_id}: must be 0 to {MOST_DESIGN_ID}")


@dataclass(frozen=True)
class Diagnostics:
    """Optional diagnostics of a block; None leaves a block as it is without, to the bit.

    Parameters
    ----------
    sway : SwaySettings or None
        Output `predicted_sway`.
    rope_bounds : RopeBounds or None
        `residual_bound` at the rope length of now, in the place of the row's tolerance.
    tracking : TrackingSettings or None
        Input `actual_speed`, status bit TRACKING.
    facts : DesignFacts or None
        Output `design_id`; tables that do not match are refused, status bit TABLES_INVALID.
    """

    sway: SwaySettings | None = None
    rope_bounds: RopeBounds | None = None
    tracking: TrackingSettings | None = None
    facts: DesignFacts | None = None
