"""Banks of a crane whose speed loop feels the load: every row proved on its own ropes, at their own damping.

Not for: single rows (`swayless.machine.driven_row`), nor for how a bank shares a range (`banking`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

from swayless.design.along_ropes import HeldRopes, held_ropes, worst_on_ropes
from swayless.errors import DesignError
from swayless.machine.bank_record import BankRecord
from swayless.machine.bank_section import BankSection
from swayless.machine.banking import BankDesign, design_bank
from swayless.machine.design_document import ShaperRecord
from swayless.machine.driven_row import MARGIN, OVER, ROUNDS, DrivenDesign, driven_record, impulses_of
from swayless.machine.plant_section import PlantSection
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_design import RowDesign
from swayless.plant import DrivenRopes

_LESS = 0.999  # of what the first row leaves: a row that leaves less has time to spare


@dataclass(frozen=True)
class DrivenBank:
    """A bank for a driven trolley, as a design file holds it.

    Parameters
    ----------
    shapers : tuple of ShaperRecord
        Rows by falling rope length, with the ropes on which each leaves no more than it promises.
    record : BankRecord
        How they share the range.
    """

    shapers: tuple[ShaperRecord, ...]
    record: BankRecord


def design_driven_bank(
    bank: BankSection,
    plant: PlantSection,
    ropes: DrivenRopes,
    *,
    tick_s: float,
    contactor: bool,
    on_row: Callable[[str], None] = lambda _: None,
) -> DrivenBank:
    """Work out the rows of a bank for the true modes of its ropes.

    A bank of a tolerance is designed for a smaller one until no row leaves more than was asked on any of its
    ropes; a bank of so many rows promises what they leave.

    Parameters
    ----------
    bank, plant, tick_s, contactor, on_row
        As for `design_bank`; the plant's frequencies are the true ones.
    ropes : DrivenRopes
        Of the machine.

    Raises
    ------
    DesignError
        If the range cannot be covered as asked.
    """
    aim = bank.tolerance
    for _ in range(ROUNDS):
        made = design_bank(
            replace(bank, tolerance=aim),
            plant,
            tick_s=tick_s,
            contactor=contactor,
            ropes=ropes,
            on_row=on_row,
        )
        worst = [_worst(row, design, ropes) for row, design in zip(made.rows, made.designs, strict=True)]
        needed = max(worst) / (1.0 - MARGIN)
        if bank.tolerance is None or aim is None:
            return _bank(made, worst, ropes, needed)
        if needed <= bank.tolerance:
            return _bank(made, worst, ropes, bank.tolerance)
        aim *= bank.tolerance / needed / (1.0 + OVER)
    raise DesignError(
        f"no tolerance to design for leaves {100 * needed:g} % or less on every rope: their damping differs"
        " too much; a longer duration does"
    )


def _worst(row: RobustRow, design: RowDesign, ropes: DrivenRopes) -> float:
    """Find the most that a row leaves on any of its ropes, or in the band that it was designed for."""
    range_m = row.rope_range_m
    assert range_m is not None  # noqa: S101 - a driven crane is given by ropes
    on_ropes = max(worst_on_ropes(made, ropes, range_m) for made in impulses_of(design))
    return max(on_ropes, design.promise.tolerance * (1.0 - MARGIN))


def _bank(made: BankDesign, worst: list[float], ropes: DrivenRopes, tolerance: float) -> DrivenBank:
    """Make the records of a bank; the last row of a fixed duration may leave less than the others."""
    shapers = []
    for row, design, left in zip(made.rows, made.designs, worst, strict=True):
        is_least = design.promise.tolerance < _LESS * made.designs[0].promise.tolerance
        promised = left / (1.0 - MARGIN) if is_least else tolerance
        shapers.append(_record(replace(row, tolerance=promised), design, ropes))
    held_m = [shaper.guarantees["taps.guarantee"].rope_length_m for shaper in shapers]
    overlap_m = tuple(max(0.0, upper[1] - lower[0]) for lower, upper in pairwise(held_m))
    return DrivenBank(tuple(shapers), replace(made.record, tolerance=tolerance, overlap_m=overlap_m))


def _record(row: RobustRow, design: RowDesign, ropes: DrivenRopes) -> ShaperRecord:
    """Make the record of a row with the ropes that it holds, around its shortest and longest."""
    assert row.rope_range_m is not None  # noqa: S101 - a driven crane is given by ropes
    middle_m, allowed = 0.5 * sum(row.rope_range_m), row.tolerance * (1.0 - MARGIN)
    held = tuple(
        _with(row.rope_range_m, held_ropes(made, ropes, middle_m, tolerance=allowed))
        for made in impulses_of(design)
    )
    return driven_record(row, DrivenDesign(row, design, held))


def _with(range_m: tuple[float, float], held: HeldRopes) -> HeldRopes:
    """Add the ends of a range that is held, which rounding may leave out."""
    ends_m = min(held.range_m[0], range_m[0]), max(held.range_m[1], range_m[1])
    return replace(held, range_m=ends_m)
