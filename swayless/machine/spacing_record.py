"""What Magee and Book's laws follow, as a design file holds it: an arm's positions, and a table of spacings.

Not for: the taps at multiples of a spacing (`swayless.machine.design_document`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from swayless.machine.arm_positions import ArmPositions, PositionUnit
from swayless.machine.design_members import FREQUENCIES, PLACES, POSITIVE, SPACINGS, word
from swayless.machine.record import Record, optional

Floats: TypeAlias = tuple[float, ...]


@dataclass(frozen=True)
class PositionRecord(Record):
    """Frequencies of an arm at some of its positions, straight between; the fields of `ArmPositions`."""

    unit: Annotated[PositionUnit, word("unit", ("m", "rad"))]
    places: Annotated[Floats, PLACES]
    frequency_hz: Annotated[Floats, FREQUENCIES]
    speed_per_s: Annotated[float | None, optional(POSITIVE)]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one frequency for each of two places or more."""
        if len(self.places) < 2 or len(self.places) != len(self.frequency_hz):
            yield (
                "frequency_hz",
                f"has {len(self.frequency_hz)} values, places {len(self.places)}: as many, and two or more",
            )

    @property
    def positions(self) -> ArmPositions:
        """The same as the machine file's section has it."""
        return ArmPositions(self.unit, self.places, self.frequency_hz, self.speed_per_s)


@dataclass(frozen=True)
class SpacingRecord(Record):
    """Ticks between impulses, over the rope in m or the position in its unit."""

    starts: Annotated[Floats, PLACES]
    ticks: Annotated[tuple[int, ...], SPACINGS]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one spacing from each start on."""
        if len(self.starts) != len(self.ticks):
            yield "ticks", f"has {len(self.ticks)} values, starts has {len(self.starts)}"
