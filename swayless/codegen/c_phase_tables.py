"""Constants and tables of the phase clock in C. Not for: taps, ramps and limits, nor the rope's readings."""

from __future__ import annotations

from swayless.codegen.c_phase_float import float_constants, float_tables
from swayless.codegen.c_phase_int32 import integer_constants, integer_tables
from swayless.codegen.c_types import CConstant, CTable, CTypes, c_table
from swayless.controller.phase_filter import last_cell
from swayless.controller.settings import ShaperSettings


def phase_constants(settings: ShaperSettings, types: CTypes) -> list[CConstant]:
    """List the scalar constants, each with its origin.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    assert settings.clock is not None  # noqa: S101 - only a phase clock has these constants
    last_span = len(settings.clock.nodes) - 2
    return [
        CConstant("uint32_t", "LAST_CELL", f"{last_cell(settings)}u", "last cell of the ring"),
        CConstant("uint32_t", "LAST_SPAN", f"{last_span}u", "last span of the table of quanta"),
        *(integer_constants if types.number.is_integer else float_constants)(settings, types),
    ]


def phase_tables(settings: ShaperSettings, types: CTypes) -> list[CTable]:
    """List the tables: quanta over the rope length, and what hoisting does to each tap.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    assert settings.clock is not None  # noqa: S101 - only a phase clock has these tables
    assert settings.rope is not None  # noqa: S101 - which has a rope
    rope, unit = settings.rope, "mm" if types.number.is_integer else "m"
    doc = f"quanta of phase in a tick, at equal steps from {rope.shortest:.6g} to {rope.longest:.6g} {unit}"
    nodes = [f"{node}u" for node in settings.clock.nodes]
    return [
        c_table("uint32_t", "TICK_QUANTA", [nodes], doc),
        *(integer_tables if types.number.is_integer else float_tables)(settings, types),
    ]
