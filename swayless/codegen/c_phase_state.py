"""What the phase clock keeps in the state of the C block. Not for: their constants."""

from __future__ import annotations

from swayless.codegen.c_types import CField, CTypes
from swayless.controller.hoist_int32 import inverse_shift
from swayless.controller.phase_clock import PhaseClock
from swayless.controller.phase_filter import last_cell
from swayless.controller.settings import ShaperSettings

_FORESEEN = "1 / quanta of the tick that is to release each part"


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
    members.append(_inverse(settings.clock, types))
    members.append(CField(types.real, "answered", "hoist speed answered last", "", zero))
    return [
        *members,
        CField("uint32_t", "quanta", "quanta of phase in this tick", "", quanta),
        *_weights(settings, types),
        CField("uint32_t", "elapsed_quanta", "quanta of the tick before", "", quanta),
    ]


def _weights(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List what shares a change out, and what is foreseen of its parts, found once for a rate."""
    later, size = _later_taps(settings), f"[{types.name.upper()}_SHAPER_LATER_TAPS]"
    return [
        CField(types.sum, "weight", "weight of each later tap for a change now", size, elements=later),
        CField(_inverse_type(types), "foreseen", "the same of a change now", size, elements=later),
        CField("bool", "weighed", "both are for the rate and row of this tick", "", "false"),
    ]


def _inverse_type(types: CTypes) -> str:
    return "uint32_t" if types.number.is_integer else types.real


def _inverse(clock: PhaseClock, types: CTypes) -> CField:
    """List the reciprocal of the quanta of a tick: after power-on of the longest rope."""
    if not types.number.is_integer:
        inverse = types.literal(types.number.scalar(1) / types.number.scalar(clock.fewest_quanta))
        return CField(types.sum, "inverse", "1 / quanta of this tick", "", inverse)
    shift = inverse_shift(clock)
    whole = (1 << shift) // clock.fewest_quanta
    return CField("uint32_t", "inverse", "INVERSE_SCALE / quanta of this tick", "", f"{whole}u")


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
    parts = "part of each later tap" + (", scaled" if types.number.is_integer else "")
    return [
        CField(types.sum, "part", parts, size, elements=later),
        CField(_inverse_type(types), "foreseen", _FORESEEN, size, elements=later),
        CField("uint32_t", "gap", "quanta until the next cell"),
    ]


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
