"""What the controller computes in: the ``[controller]`` section of a machine file.

Not for: what the controller does; see `swayless.controller`.
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.limits import MAX_COUNTS
from swayless.controller.number import NUMBER_TYPES
from swayless.machine.checks import choice, quantity
from swayless.machine.drive_section import DriveSection
from swayless.machine.problems import Table

TICK = quantity("time", 1e-6, 1.0)
LAWS = ("fixed", "phase", "original", "modified")


@dataclass(frozen=True)
class ControllerSection:
    """Tick, number type and law of the controller.

    Parameters
    ----------
    tick_s : float
        Time between two calls of the block, at least 1 us and at most 1 s.
    number : {"double", "float", "int32"}
        Number type of the generated code.
    law : {"fixed", "phase", "original", "modified"}
        Controller law: the taps keep their delays in ticks; in phases of the pendulum, which follow a
        measured rope; or as multiples of a spacing, looked up each tick over a measured rope or position.
    """

    tick_s: float
    number: str
    law: str


def read_controller(table: Table) -> ControllerSection | None:
    """Read the section; None where its tick is missing or a value is wrong."""
    tick_s = table.need("tick", TICK)
    number = table.take("number", choice("number type", NUMBER_TYPES), "double")
    law = table.take("law", choice("law", LAWS), "fixed")
    if tick_s is None or number is None or law is None:
        return None
    return ControllerSection(tick_s, number, law)


def law_of(table: Table) -> str | None:
    """Give the law that the section asks for, whatever else is wrong in it; None for one that is unknown."""
    law = table.raw.get("law", "fixed")
    return law if isinstance(law, str) and law in LAWS else None


def check_counts(table: Table, drive: DriveSection) -> None:
    """Report a drive whose commands int32 cannot hold; `table` is the ``[drive]`` section."""
    place = table.place("counts_per_m_s")
    if drive.counts_per_m_s is None:
        if "counts_per_m_s" not in table.raw:
            place.problem('missing: number = "int32" computes in counts')
        return
    full_speed = drive.max_speed_m_s * drive.counts_per_m_s
    if not 1.0 <= full_speed <= MAX_COUNTS:
        allowed = f"int32 allows 1 to {MAX_COUNTS}"
        place.wrong(drive.counts_per_m_s, f"makes max_speed {full_speed:g} counts; {allowed}")
