"""What diagnostics need in the C block: constants, tables and state. Not for: the sums of all tables."""

from __future__ import annotations

from itertools import accumulate, chain

from swayless.codegen.c_clock_table import clock_constants, clock_table
from swayless.codegen.c_types import CConstant, CField, CTable, CTypes, c_table
from swayless.controller.rope_bound import RopeBounds
from swayless.controller.settings import ShaperSettings
from swayless.controller.sway import RopeTurn, SwaySettings
from swayless.controller.sway_model import RATIO_BITS, IntegerSway
from swayless.controller.tracking import TrackingSettings

BOUNDS_A_LINE = 4
"""Rope lengths in one line of source: they have all the digits of their type."""


def diagnostic_constants(settings: ShaperSettings, types: CTypes) -> list[CConstant]:
    """List the scalar constants.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    """
    sway, tracking = settings.diagnostics.sway, settings.diagnostics.tracking
    constants = [] if tracking is None else _tracking_constants(tracking, settings, types)
    if sway is None:
        return constants
    constants += _integer_sway(sway) if types.number.is_integer else _float_sway(sway, types)
    if sway.rope is None:
        return constants
    constants += [] if settings.clock is not None else clock_constants(sway.rope.clock, types)
    return constants + _rope_turn(sway.rope, sway, types)


def _tracking_constants(
    tracking: TrackingSettings, settings: ShaperSettings, types: CTypes
) -> list[CConstant]:
    tolerance = types.literal(tracking.tolerance)
    return [
        CConstant(
            types.real, "TRACKING_TOLERANCE", tolerance, f"{settings.limits.units}: tracking_tolerance"
        ),
        CConstant(
            "uint32_t", "TRACKING_TICKS", f"{tracking.time_ticks}u", "how long the drive may be outside"
        ),
        CConstant(
            "uint32_t", "WINDOW_TICKS", f"{tracking.window_ticks}u", "references that count as followed"
        ),
    ]


def _float_sway(sway: SwaySettings, types: CTypes) -> list[CConstant]:
    return [
        CConstant(types.real, "LARGEST_SWAY", types.literal(sway.largest), "where the linear model ends"),
        CConstant(
            types.real, "FORGOTTEN_SWAY", types.literal(sway.forgotten), "a smaller swing counts as none"
        ),
    ]


def _integer_sway(sway: SwaySettings) -> list[CConstant]:
    scale = 1 << sway.metres_shift
    numbers = [
        ("LARGEST_SWAY", sway.largest, "where the linear model ends"),
        ("SWAY_SCALE", 1 << sway.command_shift, "commands are scaled by it"),
        ("METRES_ONE", scale, "mm are scaled by it"),
        ("METRES_HALF", scale >> 1, "rounds to the nearest mm"),
    ]
    return [CConstant("int64_t", name, f"INT64_C({value})", doc) for name, value, doc in numbers]


def _rope_turn(rope: RopeTurn, sway: SwaySettings, types: CTypes) -> list[CConstant]:
    """List what makes the turn of a tick on a measured rope."""
    whole = types.number.is_integer
    scalar = types.number.scalar
    sixth, twelfth = (IntegerSway.SIXTH, IntegerSway.TWELFTH) if whole else (scalar(1 / 6), scalar(1 / 12))
    scaled = ", over 2^30" if whole else ""
    numbers = [
        ("SWAY_QUANTUM", rope.quantum, f"rad: turn of a quantum{', scaled' if whole else ''}"),
        ("SWAY_LOSS", rope.loss, f"shrinking per rad of the turn{scaled}"),
        ("SWAY_HELD", sway.held, f"kept of a turn without damping{scaled}"),
        ("SWAY_METRES", rope.metres, "m per unit of place, times quanta" if not whole else "mm, scaled"),
        ("SIXTH", sixth, f"1 / 6, of the series of the sine{scaled}"),
        ("TWELFTH", twelfth, f"1 / 12, of the series of the cosine{scaled}"),
    ]
    if whole:
        numbers += [
            ("SWAY_QUANTUM_SCALE", 1 << (rope.quantum_shift - 30), "SWAY_QUANTUM is so much too large"),
            ("RATIO_ONE", 1 << RATIO_BITS, "ratios of quanta are over it"),
        ]
    return [CConstant(types.sum, name, types.wide(value), doc) for name, value, doc in numbers]


def diagnostic_tables(settings: ShaperSettings, types: CTypes) -> list[CTable]:
    """List turns and bounds.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    """
    bounds, sway = settings.diagnostics.rope_bounds, settings.diagnostics.sway
    tables = [] if bounds is None else _bound_tables(bounds, types)
    if sway is None:
        return tables
    if sway.rope is not None:
        return tables + (
            [] if settings.clock is not None else [clock_table(sway.rope.clock, settings, types)]
        )
    docs = {
        "cosine": "of the turn of a tick of the load, made smaller by damping, by row from 1 on",
        "sine": "of the same turn",
        "metres": "deflection of the load per unit of place, by row from 1 on",
    }
    for name, doc in docs.items():
        values = [types.literal(getattr(turn, name)) for turn in sway.turns]
        tables.append(c_table(types.real, f"TURN_{name.upper()}", [values], doc))
    return tables


def _bound_tables(bounds: RopeBounds, types: CTypes) -> list[CTable]:
    """List the bounds over the rope, row by row."""
    whole = types.number.is_integer
    firsts = [0, *accumulate(len(row) for row in bounds.starts)]
    starts, values = (
        [literals[i : i + BOUNDS_A_LINE] for i in range(0, len(literals), BOUNDS_A_LINE)]
        for literals in (
            [types.literal(each) for each in chain.from_iterable(rows)]
            for rows in (bounds.starts, bounds.bounds)
        )
    )
    doc = "residual vibration that the row leaves at most on each" + (", in millionths" if whole else "")
    return [
        c_table(
            "uint32_t", "FIRST_BOUND", [[f"{n}u" for n in firsts]], "first piece of each row, and the end"
        ),
        c_table(types.real, "BOUND_START", starts, f"{'mm' if whole else 'm'} of rope: where pieces begin"),
        c_table(types.real, "ROPE_BOUND", values, doc),
    ]


def diagnostic_members(settings: ShaperSettings, types: CTypes) -> list[CField]:
    """List what diagnostics remember.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    """
    sway, zero = settings.diagnostics.sway, types.literal(0)
    found: list[tuple[str, str, str, str]] = []
    if sway is not None:
        found += [
            (types.sum, "sway_pace", "speed of the load against the trolley, as a command", zero),
            (types.sum, "sway_place", "its deflection, as a command", zero),
            (types.real, "sway_reference", "reference of the tick before", zero),
        ]
    if sway is not None and sway.rope is None:
        found.append(("uint8_t", "sway_row", "place of its mode in the tables", "0u"))
    if sway is not None and sway.rope is not None:
        found += [
            (types.sum, name, doc, "")
            for name, doc in (
                ("turn_cosine", "turn of a tick on the rope of now"),
                ("turn_sine", "the same"),
                ("turn_metres", "deflection per unit of place on the rope of now"),
            )
        ]
        if not types.number.is_integer:
            found.append((types.real, "sway_inverse", "1 / quanta of a tick on the rope of now", ""))
        found.append(("uint32_t", "sway_quanta", "quanta of a tick on the rope of now", ""))
    if settings.diagnostics.tracking is not None:
        found += [
            (types.real, "low", "least reference of this window", zero),
            (types.real, "high", "largest reference of this window", zero),
            (types.real, "last_low", "the same of the window before", zero),
            (types.real, "last_high", "the same of the window before", zero),
            ("uint32_t", "filled_ticks", "ticks of this window", "0u"),
            ("uint32_t", "outside_ticks", "ticks for which the drive has not followed", "0u"),
        ]
    if settings.diagnostics.facts is not None:
        found.append(("bool", "tables_match", "the tables are those of the design", ""))
    return [CField(kind, name, doc, "", initial) for kind, name, doc, initial in found]
