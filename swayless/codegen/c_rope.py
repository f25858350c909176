"""What the C block knows of a measured rope, and what it remembers. Not for: the phase clock.

The position of an arm is read in the same way: names of the code say rope for it too, its pins do not.
"""

from __future__ import annotations

from dataclasses import replace

from swayless.codegen.c_types import CConstant, CField, CTable, CTypes, c_table
from swayless.controller.rope import MOST_HELD_TICKS, RopeSettings
from swayless.controller.taps import RopeRows

FROZEN_SCALE = 1_000_000
"""In int32 the way of a frozen rope is in mm and microseconds."""


def rope_constants(rope: RopeSettings, types: CTypes) -> list[CConstant]:
    """List the constants of a measured rope.

    Parameters
    ----------
    rope : RopeSettings
        What the block knows of it.
    types : CTypes
        Types of the block.
    """
    whole = types.number.is_integer
    measured, length = rope.measured, rope.measured.value_unit(is_integer=whole)
    tick, way = ("us", f"{length} times 10^6") if whole else ("s", length)
    frozen = rope.jump * FROZEN_SCALE if whole else rope.jump
    constants = [
        ("SHORTEST_ROPE", rope.shortest, f"{length}: {measured.c_name}"),
        ("LONGEST_ROPE", rope.longest, f"{length}: {measured.c_name}"),
        ("HOIST_SPEED", rope.hoist_speed, f"{length}/s: {measured.c_speed_name}"),
        ("ROPE_JUMP", rope.jump, f"{length}: difference of two readings that is always taken"),
        ("ROPE_WAY_PER_TICK", rope.way_per_tick, f"{length}: {measured.c_speed_name} times tick"),
        ("ROPE_TICK", rope.tick_s, f"{tick}: tick"),
        ("FROZEN_WAY", frozen, measured.said(f"{way}: a length that stays so long is frozen")),
    ]
    anywhere = measured.said("by then the hoist may be anywhere")
    held = CConstant("uint32_t", "MOST_HELD_TICKS", f"{MOST_HELD_TICKS}u", anywhere)
    return [*(CConstant(types.real, name, types.literal(value), doc) for name, value, doc in constants), held]


def rope_row_tables(rows: RopeRows | None, types: CTypes) -> list[CTable]:
    """List the rope lengths of the rows, where the rope chooses the row; row 0 has none.

    Parameters
    ----------
    rows : RopeRows or None
        The rope lengths, if the rope chooses.
    types : CTypes
        Types of the block.
    """
    if rows is None:
        return []
    unit = "mm" if types.number.is_integer else "m"
    tables = (
        ("ROW_SHORTEST", rows.lower, "below it the next row is wanted"),
        ("ROW_LONGEST", rows.upper, "above it the row before is wanted"),
    )
    return [
        c_table(
            types.real, name, [[types.literal(value) for value in (0, *values)]], f"{unit} of rope: {doc}"
        )
        for name, values, doc in tables
    ]


def rope_members(rope: RopeSettings, types: CTypes) -> list[CField]:
    """List what is remembered of a measured rope.

    Parameters
    ----------
    rope : RopeSettings
        What the block knows of it.
    types : CTypes
        Types of the block.
    """
    zero = types.literal(0)
    members = [
        CField(types.sum, "unmoved", "way of the hoist while the length stayed", "", zero),
        CField(types.real, "rope_length", "length believed", "", types.literal(rope.longest)),
        CField(types.real, "hoist_speed", "hoist speed, clamped", "", zero),
        CField("uint32_t", "held_ticks", "ticks for which no length was taken", "", "0u"),
    ]
    return [replace(member, c_doc=rope.measured.said(member.c_doc)) for member in members]
