"""Constants and tables of the phase clock in C. Not for: taps, ramps and limits, nor the rope's readings."""

from __future__ import annotations

from swayless.codegen.c_clock_table import clock_constants, clock_table
from swayless.codegen.c_phase_float import float_constants, float_tables
from swayless.codegen.c_phase_int32 import integer_constants, integer_tables
from swayless.codegen.c_types import CConstant, CTable, CTypes
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
    return [
        CConstant("uint32_t", "LAST_CELL", f"{last_cell(settings)}u", "last cell of the ring"),
        *clock_constants(settings.clock, types),
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
    return [
        clock_table(settings.clock, settings, types),
        *(integer_tables if types.number.is_integer else float_tables)(settings, types),
    ]
