"""Constants and tables of the phase clock in Structured Text. Not for: their law."""

from __future__ import annotations

from swayless.codegen import phase_work
from swayless.codegen.st_diagnostics import table_constants
from swayless.codegen.st_types import Constant, RealConstant, StTypes, Table, st_table
from swayless.controller import hoist
from swayless.controller.hoist_answers import answers, leaning_from
from swayless.controller.phase_clock import PhaseClock
from swayless.controller.phase_filter import last_cell
from swayless.controller.settings import ShaperSettings


def phase_constants(settings: ShaperSettings, types: StTypes) -> list[Constant]:
    """List the constants of the phase clock; nothing without one.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    clock = settings.clock
    if clock is None:
        return []
    last = last_cell(settings)
    whole = (
        ("LastCell", last, "last cell of the ring"),
        ("CellCount", last + 1, "cells of the ring"),
    )
    return [
        *(Constant(name, "DINT", str(value), doc) for name, value, doc in whole),
        *table_constants(clock.nodes, clock.cells_per_unit, types),
        *types.constants(_clock_constants(clock)),
        *types.constants(_hoist_constants(settings)),
    ]


def phase_tables(settings: ShaperSettings, types: StTypes) -> list[Table]:
    """List the tables of the phase clock; nothing without one.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    clock = settings.clock
    if clock is None:
        return []
    by_row = [[types.literal(s) for s in row] for row in hoist.stretches(settings)]
    steps = [[types.literal(s) for s in each.even] for each in answers(settings)]
    leans = [[types.literal(s) for s in each.lean] for each in answers(settings)]
    nodes = [[types.literal(node) for node in clock.nodes]]
    lengths = f"{float(clock.shortest):.6g} m on, {1.0 / float(clock.cells_per_unit):.6g} m apart"
    return [
        st_table(
            "Stretches",
            types.real,
            by_row,
            "[s per m and quantum] Change of sqrt(L) until each tap, relative, per hoist speed; by row.",
        ),
        st_table("Answers", types.real, steps, "Steps of the taps that answer a wanted step of 1; by row."),
        st_table("Leans", types.real, leans, "Steps that let an answer go only up or only down; by row."),
        st_table("PhaseTable", types.real, nodes, f"[quanta] Phase of a tick on ropes from {lengths}."),
    ]


def most_cells_a_tick(clock: PhaseClock) -> int:
    """Bound the cells that a tap passes in a tick; at least 2, as loops of one trip are not portable.

    Parameters
    ----------
    clock : PhaseClock
        The clock.
    """
    return max(2, phase_work.most_cells_a_tick(clock))


def _clock_constants(clock: PhaseClock) -> list[RealConstant]:
    return [
        ("Quantum", clock.quantum_rad, "[rad] phase of a quantum"),
        ("PerMostQuanta", 1.0 / clock.most_quanta, "1 / quanta of a tick on the shortest rope"),
        ("PerFewestQuanta", 1.0 / clock.fewest_quanta, "1 / quanta of a tick on the longest rope"),
    ]


def _hoist_constants(settings: ShaperSettings) -> list[RealConstant]:
    units, scalar = settings.limits.units, settings.number.scalar
    full, kick = settings.limits.max_command, hoist.kick_per_quantum(settings)
    first, second, third, fourth = hoist.SERIES
    return [
        ("KickPerQuantum", kick, "[s/m] kick of a change of hoist speed, 1 / (w L)"),
        ("Loss", 2.0 * hoist.loss_ratio(settings), "twice the damping ratio of that swing"),
        ("LongestStretch", hoist.LONGEST_STRETCH, "relative change of sqrt(L) that is weighted for at most"),
        ("FirstOrder", first, "of z in (1 + z)^(-1/2)"),
        ("SecondOrder", second, "of its square"),
        ("ThirdOrder", third, "of its cube"),
        ("FourthOrder", fourth, "of its fourth power"),
        ("LeastMismatch", hoist.LEAST_MISMATCH, "relative error of a weight from which on it is corrected"),
        ("LeastAnswer", full * scalar(hoist.LEAST_ANSWER), f"[{units}] smaller kicks are collected"),
        ("LeastLack", full * scalar(hoist.LEAST_LACK), f"[{units}] smaller corrections are left"),
        ("LeaningFrom", leaning_from(settings), f"[{units}] from here on answers lean away from the maximum"),
    ]
