"""From a design file to what runs: taps and limits in a number type. Not for: text or figures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import cast, get_args

import numpy as np

from swayless.controller import (
    Bank,
    NumberType,
    Row,
    ShaperSettings,
    SpeedLimits,
    command_limits,
    number_type,
    quantised_taps,
)
from swayless.controller.phase_taps import phase_taps
from swayless.controller.rope import MM_PER_M, RopeSettings, rope_settings
from swayless.controller.spaced_taps import SpacedTaps, SpacingLaw, spaced_taps
from swayless.controller.spacing import Spacing
from swayless.controller.taps import RopeRows
from swayless.design import GridShaper, Guarantee, Shaper
from swayless.errors import ControllerError
from swayless.machine.design_document import (
    CLOSE,
    AnyTapsRecord,
    DesignFile,
    DriveRecord,
    GuaranteeRecord,
    PhaseTapsRecord,
    PlantRecord,
    ShaperRecord,
    SpacedTapsRecord,
    TapsRecord,
)
from swayless.machine.functions import with_functions
from swayless.machine.phase_row import clock_of, taps_on_a_still_rope
from swayless.machine.spaced_row import Followed, taps_at_the_slowest, typed_spacing
from swayless.plant import Band, Mode

_SAME_LENGTH = 1e-9
"""Relative difference of rope lengths that rounding to 12 digits of frequencies explains."""


def shaper_settings(design: DesignFile, *, number: str | None = None) -> ShaperSettings:
    """Make the constants of the command shaper that a design file describes.

    Parameters
    ----------
    design : DesignFile
        A design with taps.
    number : str or None
        Number type; None takes the design's own.

    Raises
    ------
    ControllerError
        If the design has no tick, or it cannot run in the number type with every guarantee kept.
    """
    if design.tick_s is None:
        raise ControllerError("the design has no tick: design it with --tick, for instance --tick '10 ms'")
    kind = number_type(number or design.number)
    if design.law == "phase":
        return with_functions(_phase_settings(design, kind), design)
    if design.law in get_args(SpacingLaw):
        return with_functions(_spaced_settings(design, kind), design)
    return with_functions(_fixed_settings(design, kind, design.tick_s), design)


def _fixed_settings(design: DesignFile, kind: NumberType, tick_s: float) -> ShaperSettings:
    """Make the constants of a block whose taps keep their delays in ticks."""
    rows = []
    for shaper in design.shapers:
        assert isinstance(shaper.taps, TapsRecord)  # noqa: S101 - the file has taps where it has a tick
        guarantee = _guarantee(shaper, shaper.taps.guarantee)
        delays, amplitudes = np.array(shaper.taps.delays_ticks), np.array(shaper.taps.amplitudes)
        try:
            taps = quantised_taps(delays, amplitudes, tick_s, guarantee, kind)
        except ControllerError as error:
            raise ControllerError(f'row "{shaper.name}": {error}') from error
        rows.append(Row(shaper.name, shaper.family, taps))
    limits = command_limits(_speed_limits(design.drive, kind.is_integer), tick_s=tick_s, number=kind)
    if design.bank is None or design.bank.selection == "knob":
        return ShaperSettings(Bank(tuple(rows)), limits)
    return ShaperSettings(Bank(tuple(rows), _rope_rows(design, kind)), limits, _rope(design, kind))


def _rope(design: DesignFile, kind: NumberType) -> RopeSettings:
    """Make the constants of a measured rope."""
    plant = design.plant
    if plant.rope_length_m is None or plant.hoist_speed_m_s is None or design.tick_s is None:
        raise ControllerError("a measured rope needs plant.rope_length_m, plant.hoist_speed_m_s and tick_s")
    return rope_settings(plant.rope_length_m, plant.hoist_speed_m_s, tick_s=design.tick_s, number=kind)


def _rope_rows(design: DesignFile, kind: NumberType) -> RopeRows:
    """Give each row the ropes between its switching lengths, and half the hysteresis beyond.

    Raises
    ------
    ControllerError
        If a row does not hold all of them.
    """
    bank, ropes_m = design.bank, design.plant.rope_length_m
    if bank is None or bank.hysteresis_m is None or bank.switching_rope_length_m is None or ropes_m is None:
        raise ControllerError("rows chosen by the rope need switching lengths and a hysteresis in m")
    half_m = 0.5 * bank.hysteresis_m
    lower_m = [*(place - half_m for place in bank.switching_rope_length_m), ropes_m[0]]
    upper_m = [ropes_m[1], *(place + half_m for place in bank.switching_rope_length_m)]
    for shaper, low_m, high_m in zip(design.shapers, lower_m, upper_m, strict=True):
        assert shaper.taps is not None  # noqa: S101 - the file has taps exactly where it has a tick
        held_m = shaper.taps.guarantee.rope_length_m
        if low_m < held_m[0] * (1.0 - _SAME_LENGTH) or high_m > held_m[1] * (1.0 + _SAME_LENGTH):
            raise ControllerError(
                f'row "{shaper.name}" holds {held_m[0]:.6g} to {held_m[1]:.6g} m and would be chosen from '
                f"{low_m:.6g} to {high_m:.6g} m"
            )
    if kind.is_integer:
        return RopeRows(
            tuple(math.ceil(value * MM_PER_M) for value in lower_m),
            tuple(math.floor(value * MM_PER_M) for value in upper_m),
        )
    return RopeRows(tuple(map(kind.scalar, lower_m)), tuple(map(kind.scalar, upper_m)))


def most_phase_rad(shapers: Sequence[ShaperRecord]) -> float:
    """Largest phase of any tap of rows that follow the rope."""
    return max(shaper.taps.phases_rad[-1] for shaper in shapers if isinstance(shaper.taps, PhaseTapsRecord))


def _phase_settings(design: DesignFile, kind: NumberType) -> ShaperSettings:
    """Make the constants of a block that follows the rope; the table as stored, where its type is stored."""
    plant = design.plant
    assert plant.rope_length_m is not None  # noqa: S101 - a design file with this law has it
    assert plant.hoist_speed_m_s is not None  # noqa: S101 - as above
    assert design.tick_s is not None  # noqa: S101 - as above
    assert design.clock is not None  # noqa: S101 - as above
    rope, clock = clock_of(
        plant.rope_length_m,
        plant.hoist_speed_m_s,
        tick_s=design.tick_s,
        number=kind.name,
        most_phase_rad=most_phase_rad(design.shapers),
    )
    if kind.name == design.number:
        stored = (1.0 / design.clock.quanta_per_rad, design.clock.tick_quanta)
        if stored != (clock.quantum_rad, clock.nodes):
            raise ControllerError("the table of the phase clock is not that of the stored ropes and tick")
    rows = []
    for shaper in design.shapers:
        assert isinstance(shaper.taps, PhaseTapsRecord)  # noqa: S101 - a design file with this law has them
        phases_rad, amplitudes = np.array(shaper.taps.phases_rad), np.array(shaper.taps.amplitudes)
        guarantee = _guarantee(shaper, shaper.taps.guarantee)
        try:
            taps = phase_taps(phases_rad, amplitudes, tick_s=design.tick_s, guarantee=guarantee, clock=clock)
        except ControllerError as error:
            raise ControllerError(f'row "{shaper.name}": {error}') from error
        rows.append(Row(shaper.name, shaper.family, taps))
    limits = command_limits(
        _speed_limits(design.drive, kind.is_integer), tick_s=design.tick_s, number=kind, on_grid=True
    )
    return ShaperSettings(Bank(tuple(rows)), limits, rope)


def _spaced_settings(design: DesignFile, kind: NumberType) -> ShaperSettings:
    """Make the constants of a block whose taps follow a spacing; the spacing as stored."""
    assert design.tick_s is not None  # noqa: S101 - a design file with this law has it
    assert design.spacing is not None  # noqa: S101 - as above
    followed = _followed(design.plant)
    stored, fresh = Spacing(design.spacing.starts, design.spacing.ticks), followed.spacing(design.tick_s)
    if stored.ticks != fresh.ticks or not np.allclose(stored.starts, fresh.starts, rtol=CLOSE, atol=CLOSE):
        raise ControllerError("spacing: is not that of the stored ropes or positions, damping and tick")
    spacing = typed_spacing(stored, kind)
    rows = []
    for shaper in design.shapers:
        try:
            taps = _spaced_taps(shaper, spacing, cast("SpacingLaw", design.law), design.tick_s, kind)
        except ControllerError as error:
            raise ControllerError(f'row "{shaper.name}": {error}') from error
        rows.append(Row(shaper.name, shaper.family, taps))
    limits = command_limits(_speed_limits(design.drive, kind.is_integer), tick_s=design.tick_s, number=kind)
    rope = followed.settings(tick_s=design.tick_s, number=kind)
    return ShaperSettings(Bank(tuple(rows)), limits, rope)


def _spaced_taps(
    shaper: ShaperRecord, spacing: Spacing, law: SpacingLaw, tick_s: float, kind: NumberType
) -> SpacedTaps:
    assert isinstance(shaper.taps, SpacedTapsRecord)  # noqa: S101 - a design file with these laws has them
    guarantee = _guarantee(shaper, shaper.taps.guarantee)
    impulses = Shaper(
        np.array(shaper.times_s), np.array(shaper.taps.amplitudes), shaper.family, guarantee, shaper.name
    )
    return spaced_taps(impulses, spacing, law, tick_s=tick_s, guarantee=guarantee, number=kind)


def _followed(plant: PlantRecord) -> Followed:
    """Give what a spaced law follows."""
    positions = None if plant.position is None else plant.position.positions
    return Followed(plant.rope_length_m, plant.hoist_speed_m_s, positions, plant.damping_ratio)


def stored_shapers(design: DesignFile) -> tuple[Shaper, ...]:
    """Give the shapers of a design file in continuous time, as stored.

    Parameters
    ----------
    design : DesignFile
        Any design.
    """
    return tuple(
        Shaper(
            np.array(shaper.times_s),
            np.array(shaper.amplitudes) / np.sum(shaper.amplitudes),
            shaper.family,
            _guarantee(shaper, shaper.guarantee),
            design.source or design.generator,
        )
        for shaper in design.shapers
    )


def stored_taps(design: DesignFile) -> tuple[GridShaper, ...]:
    """Give the taps of a design file, as stored.

    Parameters
    ----------
    design : DesignFile
        A design with a tick.
    """
    return tuple(
        _grid_shaper(shaper, shaper.taps, design)
        for shaper in design.shapers
        if shaper.taps is not None and design.tick_s is not None
    )


def _grid_shaper(shaper: ShaperRecord, taps: AnyTapsRecord, design: DesignFile) -> GridShaper:
    """Give taps on ticks; those that follow the machine as they release at the row's own mode."""
    assert design.tick_s is not None  # noqa: S101 - the file has taps exactly where it has a tick
    if isinstance(taps, PhaseTapsRecord):
        still = _guarantee(shaper, shaper.guarantee)
        return taps_on_a_still_rope(taps.phases_rad, taps.amplitudes, still, design.tick_s)
    if isinstance(taps, SpacedTapsRecord):
        assert design.spacing is not None  # noqa: S101 - a design file with such taps has it
        promise = _guarantee(shaper, taps.guarantee)
        return taps_at_the_slowest(taps.amplitudes, max(design.spacing.ticks), promise, design.tick_s)
    return GridShaper(
        np.array(taps.delays_ticks),
        np.array(taps.amplitudes),
        design.tick_s,
        _guarantee(shaper, taps.guarantee),
    )


def _guarantee(shaper: ShaperRecord, stored: GuaranteeRecord) -> Guarantee:
    lowest, highest = stored.damping_ratio
    return Guarantee(
        tolerance=stored.tolerance,
        mode=Mode(shaper.mode.frequency_hz, lowest),
        band=Band(*stored.frequency_hz),
        worst_residual_ratio=stored.worst_residual_ratio,
        further_bands=tuple(Band(*band) for band in stored.further_frequency_hz),
        highest_damping_ratio=None if highest == lowest else highest,
    )


def _speed_limits(drive: DriveRecord, is_integer: bool) -> SpeedLimits:
    if is_integer and drive.counts_per_m_s is None:
        raise ControllerError("number = 'int32' calculates in counts: give counts_per_m_s in [drive]")
    in_counts = is_integer or drive.units != "m/s"
    return SpeedLimits(
        max_speed_m_s=drive.max_speed_m_s,
        acceleration_m_s2=drive.acceleration_m_s2,
        deceleration_m_s2=drive.deceleration_m_s2,
        quick_stop_m_s2=drive.quick_stop_m_s2,
        minimum_speed_m_s=drive.minimum_speed_m_s,
        inching_speed_m_s=drive.inching_speed_m_s,
        command_resolution_m_s=drive.command_resolution_m_s,
        units=("counts" if drive.units == "m/s" else drive.units) if in_counts else "m/s",
        units_per_m_s=(drive.counts_per_m_s or 1.0) if in_counts else 1.0,
    )
