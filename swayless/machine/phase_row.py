"""Rows under ``law = "phase"``: their taps at phases of the pendulum.

Not for: what a file says of them (`following_row`), nor for the clock and what runs (`swayless.controller`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from swayless.controller.number import number_type
from swayless.controller.phase_clock import PhaseClock, phase_clock
from swayless.controller.phase_taps import PhaseTaps, phase_taps, worst_still_residual
from swayless.controller.rope import RopeSettings, rope_settings
from swayless.design import GridShaper, Guarantee, Shaper
from swayless.design import guarantee_of as guarantee_of_impulses
from swayless.design.grid_shaper import decimal_amplitudes
from swayless.machine.following_row import design_within
from swayless.machine.plant_section import PlantSection
from swayless.machine.row_section import RowSection
from swayless.plant import Band


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


def design_phase_row(row: RowSection, plant: PlantSection, *, tick_s: float, number: str) -> PhaseDesign:
    """Design a row for every rope of the range.

    A tap that falls between two ticks is split.

    Raises
    ------
    DesignError
        If the family does not exist for the tolerance, or the tick is too coarse for the shortest rope.
    """

    def taps_of(shaper: Shaper) -> tuple[PhaseTaps, float]:
        taps = _taps(shaper, row, plant, tick_s=tick_s, number=number)
        return taps, worst_still_residual(taps)

    shaper, taps, worst = design_within(row, taps_of, tick_s=tick_s)
    held = guarantee_of_impulses(shaper, row.mode, tolerance=row.tolerance)
    promise = replace(taps.guarantee, worst_residual_ratio=worst)
    return PhaseDesign(replace(shaper, guarantee=held), replace(taps, guarantee=promise))


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
