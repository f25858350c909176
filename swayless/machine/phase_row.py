"""Rows under ``law = "phase"``: what a file says of them, and their taps at phases of the pendulum.

Not for: the clock and what runs (`swayless.controller`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from swayless.controller.number import number_type
from swayless.controller.phase_clock import PhaseClock, phase_clock
from swayless.controller.phase_taps import PhaseTaps, phase_taps, worst_still_residual
from swayless.controller.rope import RopeSettings, rope_settings
from swayless.design import DEFAULT_TOLERANCE, FAMILIES, GridShaper, Guarantee, Shaper, design_shaper
from swayless.design import guarantee_of as guarantee_of_impulses
from swayless.design.grid_shaper import decimal_amplitudes
from swayless.errors import ControllerError, DesignError
from swayless.machine.checks import choice, integer, label, quantity
from swayless.machine.plant_section import PlantSection
from swayless.machine.problems import Table
from swayless.machine.row_section import ORDER, TOLERANCE, RowSection
from swayless.plant import Band, pendulum_mode

PHASE_FAMILIES = tuple(
    name for name, family in FAMILIES.items() if not family.negative and "delay_s" not in family.parameters
)
"""Families that the phase clock runs: with positive amplitudes, in times that scale with the period."""

_MARGIN = 1.5  # times what taps leave too much is taken from the tolerance that the family is designed for
_ROUNDS = 4
_PLACES = ("rope_length", "frequency", "bands")
_WHY_NOT = "the phase clock follows the rope; leave it out"


@dataclass(frozen=True, eq=False)
class PhaseDesign:
    """A row for every rope of the range.

    Parameters
    ----------
    shaper : Shaper
        As it is on the longest rope.
    taps : PhaseTaps
        The same at phases, and what they hold on any rope.
    """

    shaper: Shaper
    taps: PhaseTaps


def check_phase_plant(plant: PlantSection, table: Table, *, contactor: bool) -> None:
    """Report a plant whose rope the phase clock cannot follow."""
    if plant.kind != "crane" or plant.rope_length_m is None or plant.double_pendulum is not None:
        table.place("rope_length").problem(
            'law = "phase" follows a measured rope: it needs a [crane] with its shortest and longest rope, '
            "without a sling"
        )
    elif plant.rope_length_m[0] == plant.rope_length_m[1]:
        table.place("rope_length").problem(
            'law = "phase" needs two lengths, the shortest and the longest rope; for one, law = "fixed" does'
        )
    if plant.hoist_speed_m_s is None and "hoist_speed" not in table.raw:
        table.place("hoist_speed").problem('missing: law = "phase" needs the fastest that the hoist moves')
    if contactor:
        table.report.problems.append(f'{table.report.file}: [drive] contactor: cannot follow law = "phase"')


def read_phase_row(table: Table, plant: PlantSection | None) -> RowSection | None:
    """Read a row that follows the rope; None where a value is missing or wrong."""
    name = table.need("name", label)
    family = table.need("family", choice('family for law = "phase"', PHASE_FAMILIES))
    for key in _PLACES:
        if key in table.raw:
            table.asked.append(key)
            table.place(key).wrong(table.raw[key], _WHY_NOT)
    ratio = table.take("damping_ratio", quantity("ratio", 0.0, 1.0, below_high=True), None)
    tolerance = table.take("tolerance", TOLERANCE, DEFAULT_TOLERANCE)
    order = None
    if family is not None and "order" in FAMILIES[family].parameters:
        order = table.need("order", ORDER)
    elif "order" in table.raw:
        table.take("order", integer(0, 0), None)
    if name is None or family is None or tolerance is None or plant is None or plant.rope_length_m is None:
        return None
    longest_m = plant.rope_length_m[1]
    mode = pendulum_mode(longest_m, plant.damping_ratio if ratio is None else ratio)
    return RowSection(name, family, mode, longest_m, tolerance, order, None)


def design_phase_row(row: RowSection, plant: PlantSection, *, tick_s: float, number: str) -> PhaseDesign:
    """Design a row for every rope of the range.

    A tap that falls between two ticks is split, which leaves a little more than the impulses do: where that
    is more than the tolerance, the family is designed for as much less.

    Raises
    ------
    DesignError
        If the family does not exist for the tolerance, or the tick is too coarse for the shortest rope.
    """
    aim = row.tolerance
    for _ in range(_ROUNDS):
        shaper = design_shaper(row.family, row.mode, tolerance=aim, order=row.order)
        try:
            taps = _taps(shaper, row, plant, tick_s=tick_s, number=number)
        except ControllerError as error:
            raise DesignError(f"{error}") from error
        worst = worst_still_residual(taps)
        if worst <= row.tolerance:
            held = guarantee_of_impulses(shaper, row.mode, tolerance=row.tolerance)
            promise = replace(taps.guarantee, worst_residual_ratio=worst)
            return PhaseDesign(replace(shaper, guarantee=held), replace(taps, guarantee=promise))
        aim -= _MARGIN * (worst - row.tolerance)
        if aim <= 0.0:
            break
    raise DesignError(
        f"on ticks of {tick_s:g} s the taps leave {100 * worst:.4g} % on a still rope, more than "
        f"{100 * row.tolerance:g} %; a finer tick does"
    )


def clock_of(
    rope_length_m: tuple[float, float],
    hoist_speed_m_s: float,
    *,
    tick_s: float,
    number: str,
    most_phase_rad: float,
) -> tuple[RopeSettings, PhaseClock]:
    """Make the rope and the clock of a crane in a number type."""
    kind = number_type(number)
    rope = rope_settings(rope_length_m, hoist_speed_m_s, tick_s=tick_s, number=kind)
    return rope, phase_clock(rope, tick_s=tick_s, most_phase_rad=most_phase_rad, number=kind)


def taps_on_a_still_rope(
    phases_rad: tuple[float, ...], amplitudes: tuple[float, ...], guarantee: Guarantee, tick_s: float
) -> GridShaper:
    """Give the ticks on which taps at phases release while the rope of the guarantee's mode is still."""
    delays = np.array(phases_rad) / (2.0 * math.pi * guarantee.mode.frequency_hz * tick_s)
    whole = np.floor(delays)
    share = delays - whole
    ticks = np.concatenate([whole, whole + 1.0]).astype(np.int64)
    split = np.concatenate([np.array(amplitudes) * (1.0 - share), np.array(amplitudes) * share])
    summed = decimal_amplitudes(np.bincount(ticks, split).astype(np.float64))
    used = np.flatnonzero(summed > 0.0)
    return GridShaper(used, summed[used], tick_s, guarantee)


def _taps(shaper: Shaper, row: RowSection, plant: PlantSection, *, tick_s: float, number: str) -> PhaseTaps:
    """Bring impulses to phases; what they hold is still to be found."""
    assert plant.rope_length_m is not None  # noqa: S101 - checked when the file was read
    assert plant.hoist_speed_m_s is not None  # noqa: S101 - as above
    phases_rad = shaper.times_s * (2.0 * math.pi * row.mode.frequency_hz)
    _, clock = clock_of(
        plant.rope_length_m,
        plant.hoist_speed_m_s,
        tick_s=tick_s,
        number=number,
        most_phase_rad=float(phases_rad[-1]),
    )
    promise = Guarantee(1.0, row.mode, Band(*plant.frequency_hz), 1.0)
    return replace(
        phase_taps(phases_rad, shaper.amplitudes, tick_s=tick_s, guarantee=promise, clock=clock),
        guarantee=replace(promise, tolerance=row.tolerance, worst_residual_ratio=row.tolerance),
    )
