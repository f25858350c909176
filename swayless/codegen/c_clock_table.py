"""The table of a phase clock in the C block: quanta of phase in a tick over the rope. Not for: taps."""

from __future__ import annotations

from swayless.codegen.c_types import CConstant, CTable, CTypes, c_table
from swayless.controller.phase_clock import FRACTION_BITS, PhaseClock
from swayless.controller.settings import ShaperSettings


def clock_constants(clock: PhaseClock, types: CTypes) -> list[CConstant]:
    """List the scalar constants of the look-up.

    Parameters
    ----------
    clock : PhaseClock
        The table.
    types : CTypes
        Types of the block.
    """
    spans, last = clock.cells_per_unit, len(clock.nodes) - 2
    constants = [CConstant("uint32_t", "LAST_SPAN", f"{last}u", "last span of the table of quanta")]
    if not types.number.is_integer:
        doc = "spans of the table per m of rope"
        return [*constants, CConstant(types.real, "SPANS_PER_METRE", types.literal(spans), doc)]
    doc = "spans of the table per mm, over 2^32"
    counters = (
        ("SPAN_SHIFT", 32 - FRACTION_BITS, "from there to places in the table"),
        ("SHARE_BITS", FRACTION_BITS, "bits of a place within a span"),
        ("SHARE_HALF", 1 << (FRACTION_BITS - 1), "rounds to the nearest quantum"),
    )
    return [
        *constants,
        CConstant("uint64_t", "SPANS_PER_MM", f"UINT64_C({spans})", doc),
        *(CConstant("uint32_t", name, f"{value}u", why) for name, value, why in counters),
    ]


def clock_table(clock: PhaseClock, settings: ShaperSettings, types: CTypes) -> CTable:
    """Lay the table out.

    Parameters
    ----------
    clock : PhaseClock
        The table.
    settings : ShaperSettings
        The block; it has a measured rope.
    types : CTypes
        Its types.
    """
    assert settings.rope is not None  # noqa: S101 - a clock is of a rope
    rope, unit = settings.rope, "mm" if types.number.is_integer else "m"
    doc = f"quanta of phase in a tick, at equal steps from {rope.shortest:.6g} to {rope.longest:.6g} {unit}"
    return c_table("uint32_t", "TICK_QUANTA", [[f"{node}u" for node in clock.nodes]], doc)
