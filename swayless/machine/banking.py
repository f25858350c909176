"""From a ``[bank]`` to its rows: where each one ends, where the knob is turned, and what the knob says there.

Not for: the rows themselves (`swayless.design.robust`), nor for reading the section (`bank_section`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TypeVar

from swayless.design.robust import cover, cover_with
from swayless.design.robust.bank import RowDesigner, TickRows
from swayless.design.robust.driven_rows import DrivenTickRows
from swayless.machine.bank_record import BankRecord
from swayless.machine.bank_section import BankSection, unit_size
from swayless.machine.plant_section import PlantSection
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_design import RowDesign, robust_design
from swayless.machine.stored_numbers import outward_12
from swayless.plant import Band, DrivenRopes, FreeRopes, Ropes

Made = TypeVar("Made")

_PENDULUMS = FreeRopes()
_LABEL_DECIMALS = 2
_OVERLAP_DECIMALS = 9  # of m or Hz: what the last digits of an edge leave is no overlap


@dataclass(frozen=True)
class BankDesign:
    """A designed bank.

    Parameters
    ----------
    rows : tuple of RobustRow
        Rows as if the file had written them down, by falling rope length.
    designs : tuple of RowDesign
        Their designs.
    record : BankRecord
        How they share the range.
    """

    rows: tuple[RobustRow, ...]
    designs: tuple[RowDesign, ...]
    record: BankRecord


def design_bank(
    bank: BankSection,
    plant: PlantSection,
    *,
    tick_s: float,
    contactor: bool,
    ropes: DrivenRopes | None = None,
    on_row: Callable[[str], None] = lambda _: None,
) -> BankDesign:
    """Work out the rows of a bank.

    Parameters
    ----------
    bank : BankSection
        What the rows have in common.
    plant : PlantSection
        Its range is what they share.
    tick_s : float
        Length of a tick.
    contactor : bool
        Whether the drive knows only 0 and full speed.
    ropes : DrivenRopes or None
        Ropes below a driven trolley: each row is then designed for the damping in its middle.
    on_row : callable
        Called with words for what is designed next.

    Raises
    ------
    DesignError
        If the range cannot be covered as asked.
    """
    known: Ropes = FreeRopes(plant.damping_ratio) if ropes is None else ropes
    switching = Switching(plant.rope_length_m is not None, bank.hysteresis, bank.label_step_m, known)
    ticked = _tick_rows(bank, plant, ropes, tick_s)
    if bank.rule.amplitudes == "unity-magnitude" and not contactor:
        between = ticked.ideal
        designs = [robust_design(made, tick_s) for made in _covered(bank, plant, between, switching, on_row)]
    else:
        designs = [robust_design(made, tick_s) for made in _covered(bank, plant, ticked, switching, on_row)]
    switches = [switching.place(design.promise.band.high_hz) for design in designs[:-1]]
    names = _names(bank, plant, switches)
    ropes_m = _ropes_m(plant, switching, switches)
    rows = tuple(map(partial(_row, bank), names, designs, ropes_m))
    return BankDesign(rows, tuple(designs), _record(bank, switching, switches, names, designs))


def _tick_rows(bank: BankSection, plant: PlantSection, ropes: DrivenRopes | None, tick_s: float) -> TickRows:
    rule, damping_ratio = bank.rule, plant.damping_ratio
    if ropes is None:
        return TickRows(tick_s, rule.amplitudes, rule.impulses, damping_ratio)
    return DrivenTickRows(tick_s, rule.amplitudes, rule.impulses, damping_ratio, ropes=ropes)


@dataclass(frozen=True)
class Switching:
    """Where one row hands over to the next.

    Neighbours overlap by the hysteresis at least, and the knob is turned in the middle of that. With a step
    the place is the next whole multiple beyond, held by both.

    Parameters
    ----------
    on_rope : bool
        Whether places are lengths of rope in m; otherwise they are frequencies in Hz.
    hysteresis : float
        Least overlap, in m or Hz.
    step_m : float or None
        Places are whole multiples of it.
    ropes : Ropes
        Which rope has which frequency.

    Examples
    --------
    >>> switching = Switching(on_rope=True, hysteresis=0.0, step_m=0.3048)
    >>> round(switching.place(0.181835) / 0.3048, 9)  # a row that ends at 24.65 ft
    25.0
    """

    on_rope: bool
    hysteresis: float
    step_m: float | None
    ropes: Ropes = _PENDULUMS

    def place(self, end_hz: float) -> float:
        """Where the knob is turned, of where a row ends: m of rope, or Hz; rounded towards the next row."""
        if not self.on_rope:
            return outward_12((end_hz - 0.5 * self.hysteresis, end_hz))[0]
        shortest_m = self.ropes.rope_length_m(end_hz) + 0.5 * self.hysteresis
        if self.step_m is None:
            return outward_12((shortest_m, shortest_m))[1]
        return math.ceil(shortest_m / self.step_m) * self.step_m

    def next_start_hz(self, end_hz: float) -> float:
        """Where the next row starts, of where a row ends; a number of 12 digits, so that no gap is stored."""
        start = self.start(self.place(end_hz))
        start_hz = self.ropes.mode(start).frequency_hz if self.on_rope else start
        return outward_12((min(start_hz, end_hz), end_hz))[0]

    def start(self, place: float) -> float:
        """Where the next row starts, of where the knob is turned: m of rope, or Hz."""
        return place + (0.5 if self.on_rope else -0.5) * self.hysteresis

    def frequency_hz(self, place: float) -> float:
        """Frequency of a place."""
        return self.ropes.mode(place).frequency_hz if self.on_rope else place

    def overlap(self, lower: Band, upper: Band) -> float:
        """By how much two neighbours overlap, in m or Hz."""
        if not self.on_rope:
            shared = lower.high_hz - upper.low_hz
        else:
            shared = self.ropes.rope_length_m(upper.low_hz) - self.ropes.rope_length_m(lower.high_hz)
        return max(round(shared, _OVERLAP_DECIMALS), 0.0)


def _covered(
    bank: BankSection,
    plant: PlantSection,
    rows: RowDesigner[Made],
    switching: Switching,
    on_row: Callable[[str], None],
) -> tuple[Made, ...]:
    """Cover the plant's range by the fewest rows, or by a number of them."""
    low_hz, high_hz = outward_12(plant.frequency_hz)
    on_row("the bank")

    def tell(number: int) -> None:
        on_row(f"the bank, {number} done")

    if bank.rows is None or bank.duration_s is None:
        return cover(
            low_hz,
            high_hz,
            rows,
            tolerance=bank.tolerance or 0.0,
            duration_s=bank.duration_s,
            longest_duration_s=bank.longest_duration_s,
            next_start_hz=switching.next_start_hz,
            on_row=tell,
        )
    return cover_with(
        bank.rows,
        low_hz,
        high_hz,
        rows,
        duration_s=bank.duration_s,
        next_start_hz=switching.next_start_hz,
        on_row=tell,
    )


def _ropes_m(
    plant: PlantSection, switching: Switching, switches: Sequence[float]
) -> list[tuple[float, float] | None]:
    """Give shortest and longest rope of each row, as far as the bank sets them."""
    if plant.rope_length_m is None:
        return [None] * (len(switches) + 1)
    shortest_m, longest_m = plant.rope_length_m
    starts_m = [longest_m, *map(switching.start, switches)]
    return list(zip([*switches, shortest_m], starts_m, strict=True))


def _row(
    bank: BankSection, name: str, design: RowDesign, rope_range_m: tuple[float, float] | None
) -> RobustRow:
    promise = design.promise
    return RobustRow(
        name=name,
        family=design.shaper.family,
        bands=promise.bands,
        rope_range_m=rope_range_m,
        damping_ratios=promise.damping_ratios,
        tolerance=promise.tolerance,
        amplitudes=bank.rule.amplitudes,
        impulses=bank.rule.impulses,
        duration_s=bank.duration_s,
    )


def _names(bank: BankSection, plant: PlantSection, switches: Sequence[float]) -> list[str]:
    """Name the rows by their ends, in the unit of the file: as few decimals as tell all ends apart."""
    ends = plant.frequency_hz if plant.rope_length_m is None else plant.rope_length_m[::-1]
    size = unit_size(bank)
    values = [value / size for value in (ends[0], *switches, ends[1])]
    decimals = _LABEL_DECIMALS
    while len({_decimal(value, decimals) for value in values}) < len(values):
        decimals += 1
    texts = [_decimal(value, decimals) for value in values]
    return [f"{start}-{end} {bank.unit}" for start, end in pairwise(texts)]


def _decimal(value: float, decimals: int) -> str:
    return f"{value:.{decimals}f}".rstrip("0").rstrip(".")


def _record(
    bank: BankSection,
    switching: Switching,
    switches: Sequence[float],
    names: Sequence[str],
    designs: Sequence[RowDesign],
) -> BankRecord:
    bands = [design.promise.band for design in designs]
    overlaps = tuple(switching.overlap(lower, upper) for lower, upper in pairwise(bands))
    on_rope = switching.on_rope
    return BankRecord(
        selection=bank.selection,
        tolerance=bank.tolerance or max(design.promise.tolerance for design in designs),
        hysteresis_m=bank.hysteresis if on_rope else None,
        hysteresis_hz=None if on_rope else bank.hysteresis,
        switching_frequency_hz=tuple(switching.frequency_hz(place) for place in switches),
        switching_rope_length_m=tuple(switches) if on_rope else None,
        overlap_m=overlaps if on_rope else None,
        overlap_hz=None if on_rope else overlaps,
        labels=tuple(f"{position}: {name}" for position, name in enumerate(names, start=1)),
    )
