"""What the phase clock keeps in the state of the C block. Not for: their constants."""

from __future__ import annotations

from swayless.codegen.c_types import CField, CTypes
from swayless.controller.phase_filter import last_cell
from swayless.controller.settings import ShaperSettings


def ring_length(settings: ShaperSettings) -> int:
    """Count the cells of the ring.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    return settings.longest_delay_ticks + 1 if settings.clock is None else last_cell(settings) + 1


def phase_members(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List sums and scalars of the phase clock.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    assert settings.clock is not None  # noqa: S101 - only a phase clock has these members
    wide, zero, quanta = types.sum, types.literal(0), f"{settings.clock.fewest_quanta}u"
    sums = [
        ("level", "sum of everything released"),
        ("late", "what this tick leaves to the next"),
        ("mass", "sum of the parts under way"),
        ("moment", "sum of part times quanta still to go"),
        ("place", "place of the swing, as a change of speed"),
        ("pace", "pace of the swing"),
        ("rate", "hoist speed times quanta of this tick"),
    ]
    if types.number.is_integer:
        sums.append(("carry", "what rounding owes the next reference"))
    else:
        sums += [
            ("fresh", "moment of the cells of this lap alone"),
            ("fresh_mass", "mass of the cells of this lap alone"),
        ]
    members = [CField(wide, name, doc, "", zero) for name, doc in sums]
    if not types.number.is_integer:
        inverse = types.literal(types.number.scalar(1) / types.number.scalar(settings.clock.fewest_quanta))
        members.append(CField(wide, "inverse", "1 / quanta of this tick", "", inverse))
    members.append(CField(types.real, "answered", "hoist speed answered last", "", zero))
    return [
        *members,
        CField("uint32_t", "quanta", "quanta of phase in this tick", "", quanta),
        CField("uint32_t", "elapsed_quanta", "quanta of the tick before", "", quanta),
    ]


def phase_cells(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List what a cell of the ring holds.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    later, size = _later_taps(settings), f"[{types.name.upper()}_SHAPER_LATER_TAPS]"
    over = " over 2^30" if types.number.is_integer else ""
    parts = "part of each later tap" + (", scaled" if types.number.is_integer else "")
    stretch = f"change of sqrt(rope length) it is made for{over}"
    fields = [
        CField(types.sum, "part", parts, size, elements=later),
        CField(types.real, "stretch", stretch, size, elements=later),
        CField("uint32_t", "gap", "quanta until the next cell"),
    ]
    if not types.number.is_integer:
        fields.insert(2, CField(types.real, "inverse", "1 / gap"))
    return fields


def phase_ring(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List the ring of the phase clock and the pointers into it.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    cells, later = ring_length(settings), _later_taps(settings)
    ring, taps = (f"[{types.name.upper()}_SHAPER_{size}]" for size in ("RING", "LATER_TAPS"))
    return [
        CField(types.cell, "ring", "changes of the command under way", ring, elements=cells),
        CField("uint32_t", "next", "cell that each later tap reaches next", taps, elements=later),
        CField("uint32_t", "ahead", "quanta until it does", taps, elements=later),
    ]


def _later_taps(settings: ShaperSettings) -> int:
    return max(len(table.lags) for table in settings.row_tables) - 1
