"""What the C block knows of a measured rope or position, and what it remembers. Not for: the phase clock."""

from __future__ import annotations

from dataclasses import replace

from swayless.codegen.c_types import CConstant, CField, CTable, CTypes, c_table
from swayless.controller.measured import Measured
from swayless.controller.rope import MOST_HELD_TICKS, RopeSettings
from swayless.controller.taps import RopeRows

FROZEN_SCALE = 1_000_000
"""In int32 the way of a frozen rope is in mm and microseconds."""


def c_said(measured: Measured, text: str) -> str:
    """Say of a measured quantity what a name without its prefix, or a comment, says of a rope.

    Parameters
    ----------
    measured : Measured
        What is measured.
    text : str
        A name in C, or words.

    Examples
    --------
    >>> from swayless.controller.measured import ARM_ANGLE, ROPE
    >>> [c_said(ARM_ANGLE, name) for name in ("rope_length", "HOIST_SPEED", "LONGEST_ROPE", "rope_still")]
    ['position', 'POSITION_SPEED', 'HIGHEST_POSITION', 'position_still']
    >>> c_said(ROPE, "LONGEST_ROPE")
    'LONGEST_ROPE'
    """
    if measured.is_length:
        return text
    value, speed = measured.c_name, measured.c_speed_name
    names = (
        ("SHORTEST_ROPE", f"LOWEST_{value.upper()}"),
        ("LONGEST_ROPE", f"HIGHEST_{value.upper()}"),
        ("HOIST_SPEED", speed.upper()),
        ("hoist_speed", speed),
        ("rope_length", value),
        ("rope length", measured.title),
        ("ROPE", value.upper()),
        ("rope", value),
    )
    for old, new in names:
        text = text.replace(old, new)
    return measured.said(text)


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
    reals = [
        ("SHORTEST_ROPE", rope.shortest, f"{length}: rope_length"),
        ("LONGEST_ROPE", rope.longest, f"{length}: rope_length"),
        ("HOIST_SPEED", rope.hoist_speed, f"{length}/s: hoist_speed"),
        ("ROPE_JUMP", rope.jump, f"{length}: difference of two readings that is always taken"),
        ("ROPE_WAY_PER_TICK", rope.way_per_tick, f"{length}: hoist_speed times tick"),
        ("ROPE_TICK", rope.tick_s, f"{tick}: tick"),
        ("FROZEN_WAY", frozen, f"{way}: a length that stays so long is frozen"),
    ]
    constants = [CConstant(types.real, name, types.literal(value), doc) for name, value, doc in reals]
    held = "by then the hoist may be anywhere"
    constants.append(CConstant("uint32_t", "MOST_HELD_TICKS", f"{MOST_HELD_TICKS}u", held))
    return [replace(c, name=c_said(measured, c.name), doc=c_said(measured, c.doc)) for c in constants]


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
    measured = rope.measured
    return [replace(m, c_name=c_said(measured, m.c_name), c_doc=c_said(measured, m.c_doc)) for m in members]
