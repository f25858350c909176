"""The design of a machine if its drive did not feel the load: for comparison.

Not for: designs that run; see `swayless.machine.designing`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from swayless.design.robust import Amplitudes
from swayless.machine.design_document import DesignFile, PlantRecord, ShaperRecord
from swayless.machine.designing import design_row
from swayless.machine.plant_section import rope_bands
from swayless.machine.robust_row import ROBUST_FAMILIES, RobustRow
from swayless.machine.row_section import Row, RowSection
from swayless.machine.stored_numbers import outward_12
from swayless.plant import Band, pendulum_mode


def pendulum_design(design: DesignFile) -> DesignFile:
    """Design every row of a driven crane again, for the same ropes as pendulums.

    Parameters
    ----------
    design : DesignFile
        Of a machine with a speed loop.

    Returns
    -------
    DesignFile
        What chooses a row, and on which rope, stays.

    Raises
    ------
    DesignError
        If a row cannot be designed for the pendulum.
    """
    shapers = []
    for shaper in design.shapers:
        row = _row(shaper, design.plant)
        made = design_row(row, tick_s=design.tick_s, contactor=design.drive.contactor)
        taps, old = made.taps, shaper.taps
        if taps is not None and old is not None:
            ropes_m = old.guarantee.rope_length_m
            taps = replace(taps, guarantee=replace(taps.guarantee, rope_length_m=ropes_m))
        shapers.append(replace(made, taps=taps))
    return replace(design, shapers=tuple(shapers), drive=replace(design.drive, speed_loop=None))


def _row(shaper: ShaperRecord, plant: PlantRecord) -> Row:
    """Ask for a row again, for a pendulum with the rope's own damping."""
    own, tolerance, rope_m = plant.damping_ratio, shaper.guarantee.tolerance, shaper.mode.rope_length_m
    if shaper.family not in ROBUST_FAMILIES and rope_m is not None:
        mode = pendulum_mode(rope_m, own)
        return RowSection(shaper.name, shaper.family, mode, rope_m, tolerance, shaper.order, shaper.delay_s)
    is_si = shaper.family == "si"
    ropes_m = shaper.guarantee.rope_length_m
    band = rope_bands(ropes_m, None)[0]
    return RobustRow(
        name=shaper.name,
        family=shaper.family,
        bands=(Band(*outward_12((band.low_hz, band.high_hz if is_si else band.low_hz))),),
        rope_range_m=ropes_m,
        damping_ratios=(own, own),
        tolerance=tolerance,
        amplitudes=cast("Amplitudes", shaper.amplitude_rule),
        impulses=shaper.impulses,
        duration_s=None if is_si else shaper.duration_s,
    )
