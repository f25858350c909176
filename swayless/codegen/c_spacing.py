"""What taps at multiples of a spacing need in the C block: table, sums and rings. Not for: their law."""

from __future__ import annotations

from swayless.codegen.c_types import CConstant, CField, CTable, CTypes, c_table
from swayless.codegen.law_text import spacing_law
from swayless.controller.measured import ROPE
from swayless.controller.original_filter import MOST_RUNS
from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import spacing_of

STARTS_A_LINE = 4
"""Positions in one line of source: they have all the digits of their type."""


def spacing_look_ups(settings: ShaperSettings) -> int:
    """Bound the looks into the table of the spacing in a tick: each halves what is left of it.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    return (len(spacing_of(settings).ticks) - 1).bit_length()


def spacing_constants(settings: ShaperSettings) -> list[CConstant]:
    """List the scalar constants.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its taps follow a spacing.
    """
    spacing = spacing_of(settings)
    constants = [
        CConstant("uint32_t", "PIECES", f"{len(spacing.ticks)}u", "pieces of the table of the spacing"),
        CConstant("uint32_t", "MOST_SPACING", f"{spacing.most}u", "ticks: widest spacing"),
    ]
    if spacing_law(settings) == "original":
        doc = "by then the ring has forgotten the first runs"
        constants.append(CConstant("uint32_t", "MOST_RUNS", f"{MOST_RUNS}u", doc))
    return constants


def spacing_tables(settings: ShaperSettings, types: CTypes) -> list[CTable]:
    """List the table of the spacing.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its taps follow a spacing.
    types : CTypes
        Its types.
    """
    spacing, measured = spacing_of(settings), ROPE if settings.rope is None else settings.rope.measured
    unit = measured.value_unit(is_integer=types.number.is_integer)
    starts = [types.literal(start) for start in spacing.starts]
    lines = [starts[i : i + STARTS_A_LINE] for i in range(0, len(starts), STARTS_A_LINE)]
    return [
        c_table(types.real, "PIECE_START", lines, f"{unit} of {measured.title}: where each piece begins"),
        c_table("uint16_t", "PIECE_TICKS", [[f"{n}u" for n in spacing.ticks]], "spacing of each piece"),
    ]


def spacing_members(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List the sums and the spacings.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its taps follow a spacing.
    types : CTypes
        Its types.
    """
    zero, widest = types.literal(0), f"{spacing_of(settings).most}u"
    members = [CField(types.sum, "lap_sum", "sum of the commands of the lap before", "", zero)]
    if types.number.is_integer:
        members.append(
            CField(types.sum, "carry", "what rounding owes the next reference, over 2^30", "", zero)
        )
    members += [
        CField("uint32_t", "spacing", "ticks between taps", "", widest),
        CField("uint32_t", "start_spacing", "the same when the last rest ended", "", widest),
    ]
    if spacing_law(settings) == "original":
        members += [
            CField("uint32_t", "spacing_before", "spacing of the tick before", "", widest),
            CField("uint32_t", "cell", "cell that is released in this tick", "", "0u"),
            CField("uint32_t", "age", "ticks since the last rest, up to the longest delay", "", "0u"),
            CField("uint32_t", "run", "number of this run", "", "0u"),
        ]
    return members


def spacing_ring(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List the rings, and the delays of the taps where each has its own.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its taps follow a spacing.
    types : CTypes
        Its types.
    """
    cells, macro = settings.longest_delay_ticks + 1, types.name.upper()
    ring, taps = f"[{macro}_SHAPER_RING]", f"[{macro}_SHAPER_TAPS]"
    sums = CField(types.sum, "sums", "sum of the commands of this lap", ring, elements=cells)
    if spacing_law(settings) == "original":
        return [
            sums,
            CField(types.sum, "cells", "what is released in each tick to come", ring, elements=cells),
            CField("uint32_t", "runs", "run that has written to each cell", ring, elements=cells),
        ]
    most = max(len(table.lags) for table in settings.row_tables)
    return [
        sums,
        CField(types.real, "ring", "last ramped commands", ring, elements=cells),
        CField("uint16_t", "spacings", "spacing of their ticks", ring, elements=cells),
        CField("uint32_t", "delays", "ticks that each tap lags", taps, elements=most),
    ]


def spacing_flags(settings: ShaperSettings) -> list[tuple[str, str]]:
    """List the flags: names and comments.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its taps follow a spacing.
    """
    flags = [
        ("running", "commands within reach of the taps may differ"),
        ("lapped", "the ring is full of commands since the last rest"),
    ]
    if spacing_law(settings) == "original":
        flags.append(("disturbed", "a new spacing shakes a steady command"))
    return flags
