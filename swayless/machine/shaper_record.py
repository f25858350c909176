"""From a designed row to its record in the design file. Not for: designing, or the layout of the file."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from swayless.design import (
    GridShaper,
    Guarantee,
    overtravel_s,
    peak_factor,
    rope_length_interval_m,
)
from swayless.design.grid_shaper import decimal_amplitudes
from swayless.machine.design_document import (
    GuaranteeRecord,
    ModeRecord,
    PhaseTapsRecord,
    ShaperRecord,
    SpacedTapsRecord,
    TapsRecord,
)
from swayless.machine.phase_row import PhaseDesign
from swayless.machine.plant_section import PlantSection
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_design import RowDesign
from swayless.machine.row_section import Row, RowSection
from swayless.machine.spaced_row import SpacedDesign
from swayless.plant import Band

_SAME_LENGTH = 1e-11  # relative: more than bands of 12 digits move a rope, less than anybody means


def shaper_record(row: Row, design: RowDesign) -> ShaperRecord:
    """Make the record of a designed row.

    Parameters
    ----------
    row : RowSection or RobustRow
        What was asked for.
    design : RowDesign
        What was found.
    """
    shaper, taps, mode = design.shaper, design.taps, design.promise.mode
    return ShaperRecord(
        name=row.name,
        family=row.family,
        **_parameters(row),
        mode=ModeRecord(mode.frequency_hz, mode.damping_ratio, _rope_m(row)),
        times_s=tuple(shaper.times_s.tolist()),
        amplitudes=tuple(shaper.amplitudes.tolist()),
        duration_s=shaper.duration_s,
        lower_bound_s=design.lower_bound_s,
        overtravel_s=overtravel_s(shaper),
        peak_factor=peak_factor(shaper),
        guarantee=_guarantee_record(row, shaper.guarantee),
        taps=None if taps is None else _taps_record(row, taps),
    )


def phase_record(row: RowSection, design: PhaseDesign, plant: PlantSection) -> ShaperRecord:
    """Make the record of a row that follows the rope; its times are those on the longest.

    Parameters
    ----------
    row : RowSection
        What was asked for.
    design : PhaseDesign
        What was found.
    plant : PlantSection
        For the range of ropes.
    """
    record = shaper_record(row, RowDesign(design.shaper, None, None))
    assert plant.rope_length_m is not None  # noqa: S101 - checked when the file was read
    shaper, promise = design.shaper, _guarantee_record(row, design.taps.guarantee)
    amplitudes = decimal_amplitudes(shaper.amplitudes)
    taps = PhaseTapsRecord(
        phases_rad=tuple((shaper.times_s * (2.0 * math.pi * row.mode.frequency_hz)).tolist()),
        amplitudes=tuple(amplitudes.tolist()),
        duration_s=shaper.duration_s,
        overtravel_s=float(amplitudes @ shaper.times_s),
        guarantee=replace(promise, rope_length_m=plant.rope_length_m),
    )
    return replace(record, taps=taps)


def spaced_record(row: RowSection, design: SpacedDesign, plant: PlantSection) -> ShaperRecord:
    """Make the record of a row under a spaced law; its times are those where the machine vibrates slowest.

    Parameters
    ----------
    row : RowSection
        What was asked for.
    design : SpacedDesign
        What was found.
    plant : PlantSection
        For the range of ropes.
    """
    record = shaper_record(row, RowDesign(design.shaper, None, None))
    promise = _guarantee_record(row, design.taps.guarantee)
    amplitudes, times_s = decimal_amplitudes(design.shaper.amplitudes), design.taps.times_s
    taps = SpacedTapsRecord(
        delays_spacings=tuple(range(amplitudes.size)),
        amplitudes=tuple(amplitudes.tolist()),
        duration_s=design.taps.duration_s,
        overtravel_s=float(amplitudes @ times_s),
        guarantee=replace(promise, rope_length_m=plant.rope_length_m or promise.rope_length_m),
    )
    return replace(record, taps=taps)


def _parameters(row: Row) -> dict[str, Any]:
    """Give what only some rows say; null for the others."""
    if isinstance(row, RowSection):
        return {"order": row.order, "delay_s": row.delay_s, "amplitude_rule": None, "impulses": None}
    return {"order": None, "delay_s": None, "amplitude_rule": row.amplitudes, "impulses": row.impulses}


def _rope_m(row: Row) -> float | None:
    return row.rope_length_m if isinstance(row, RowSection) else None


def _taps_record(row: Row, taps: GridShaper) -> TapsRecord:
    return TapsRecord(
        delays_ticks=tuple(taps.delays_ticks.tolist()),
        amplitudes=tuple(taps.amplitudes.tolist()),
        duration_s=taps.duration_s,
        overtravel_s=overtravel_s(taps),
        guarantee=_guarantee_record(row, taps.guarantee),
    )


def _guarantee_record(row: Row, guarantee: Guarantee) -> GuaranteeRecord:
    return GuaranteeRecord(
        tolerance=guarantee.tolerance,
        frequency_hz=(guarantee.band.low_hz, guarantee.band.high_hz),
        further_frequency_hz=tuple((band.low_hz, band.high_hz) for band in guarantee.further_bands),
        damping_ratio=guarantee.damping_ratios,
        rope_length_m=_ropes_m(row, guarantee.band),
        worst_residual_ratio=guarantee.worst_residual_ratio,
    )


def _ropes_m(row: Row, band: Band) -> tuple[float, float]:
    """Ropes that have the frequencies of a band; those that the row was asked for by as they were given.

    A robust row holds a little more than was asked, to the 12th digit. Of a double pendulum, whose ropes have
    two bands each, the ropes that were asked for.
    """
    asked_m = row.rope_range_m if isinstance(row, RobustRow) else None
    if isinstance(row, RobustRow) and len(row.bands) > 1 and asked_m is not None:
        return asked_m
    shortest_m, longest_m = rope_length_interval_m(band)
    for end_m in asked_m or ():
        shortest_m = end_m if math.isclose(shortest_m, end_m, rel_tol=_SAME_LENGTH) else shortest_m
        longest_m = end_m if math.isclose(longest_m, end_m, rel_tol=_SAME_LENGTH) else longest_m
    return shortest_m, longest_m
