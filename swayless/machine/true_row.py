"""What a row asks for below a driven trolley: the true modes of its ropes in the place of a pendulum's.

Not for: designing the row (`swayless.machine.driven_row`).
"""

from __future__ import annotations

from dataclasses import replace

from swayless.design.robust.demand import LARGEST_DAMPING_RATIO
from swayless.errors import PlantError
from swayless.machine.problems import Table
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_section import Row, RowSection
from swayless.machine.stored_numbers import outward_12
from swayless.plant import Band, DrivenRopes

_ROPE_ONLY = "the speed loop moves frequency and damping of every rope: give rope_length"


def check_driven_row(table: Table, row: Row, ropes: DrivenRopes) -> None:
    """Report a row that cannot be designed for a driven trolley.

    Parameters
    ----------
    table : Table
        The row, for the places of problems.
    row : RowSection or RobustRow
        As the file describes it, for a pendulum.
    ropes : DrivenRopes
        Of the machine.
    """
    if row.rope_range_m is None:
        for key in ("frequency", "bands"):
            if key in table.raw:
                table.place(key).wrong(table.raw[key], _ROPE_ONLY)
        return
    if row.damping_ratios[0] != row.damping_ratios[1]:
        table.place("damping_ratio").wrong(
            table.raw["damping_ratio"],
            "below a speed loop the range of damping follows from the ropes: give one",
        )
        return
    try:
        true = true_row(row, ropes)
    except PlantError as error:
        table.place("rope_length").wrong(table.raw["rope_length"], f"{error}")
        return
    highest = true.damping_ratios[1]
    if isinstance(true, RobustRow) and highest > LARGEST_DAMPING_RATIO:
        reason = f"below the speed loop damping ratios reach {highest:.3g}: {row.family} holds up to"
        table.place("rope_length").wrong(table.raw["rope_length"], f"{reason} {LARGEST_DAMPING_RATIO:g}")


def true_row(row: Row, ropes: DrivenRopes) -> Row:
    """Give a row at the true modes of its ropes, in the place of those of a pendulum.

    Parameters
    ----------
    row : RowSection or RobustRow
        With ropes; its damping ratio is the rope's own.
    ropes : DrivenRopes
        Of the machine.

    Raises
    ------
    PlantError
        If the load does not swing as one clear vibration on these ropes.
    """
    own = replace(ropes, damping_ratio=row.damping_ratios[0])
    range_m = row.rope_range_m
    assert range_m is not None  # noqa: S101 - checked when the file was read
    if isinstance(row, RowSection):
        return replace(row, mode=own.mode(range_m[0]))
    band = Band(*outward_12(own.frequency_range_hz(range_m)))
    return replace(row, bands=(band,), damping_ratios=outward_12(own.damping_range(range_m)))
