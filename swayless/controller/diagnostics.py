"""What a block may say of itself, each only where a design asks for it. Not for: running it (`diagnosis`)."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.checksum import Checksum
from swayless.controller.rope import RopeSettings
from swayless.controller.rope_bound import RopeBounds
from swayless.controller.status import Status
from swayless.controller.sway import SwaySettings
from swayless.controller.taps import Bank
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

    def check(self, bank: Bank, rope: RopeSettings | None) -> None:
        """Refuse diagnostics that were made for another block.

        Parameters
        ----------
        bank : Bank
            Rows of the block.
        rope : RopeSettings or None
            Its measured rope.

        Raises
        ------
        ControllerError
            If rows, rope or number type are not those of the block.
        """
        rows, sway, bounds = len(bank.rows), self.sway, self.rope_bounds
        if sway is not None and sway.number.name != bank.number.name:
            raise ControllerError(
                f"predicted sway in {sway.number.name}: the block runs in {bank.number.name}"
            )
        if sway is not None and (sway.rope is None) != (rope is None):
            raise ControllerError("predicted sway follows the measured rope exactly where there is one")
        if sway is not None and sway.rope is None and len(sway.turns) != rows:
            raise ControllerError(f"predicted sway has {len(sway.turns)} turns for {rows} rows")
        if bounds is not None and (rope is None or len(bounds.starts) != rows):
            raise ControllerError(f"residual bounds over the rope need a measured rope, and {rows} rows")

    @property
    def status_bits(self) -> Status:
        """Status bits that these diagnostics set."""
        tracking = Status(0) if self.tracking is None else Status.TRACKING
        return tracking | (Status(0) if self.facts is None else Status.TABLES_INVALID)


NO_DIAGNOSTICS = Diagnostics()
"""A block that says of itself what every block does, and nothing else."""
