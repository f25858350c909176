"""From a machine, or one row, to its design file: what each row is, and what it guarantees on the tick grid.

Not for: the mathematics (`swayless.design`) or the layout of the file (`swayless.machine.design_document`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import cast

import swayless
from swayless.controller.spaced_taps import SpacingLaw
from swayless.errors import DesignError
from swayless.machine.bank_record import BankRecord
from swayless.machine.bank_section import BankSection
from swayless.machine.banking import design_bank
from swayless.machine.design_document import (
    ClockRecord,
    DesignFile,
    DoublePendulumRecord,
    DriveRecord,
    PlantRecord,
    ShaperRecord,
    SpeedLoopRecord,
)
from swayless.machine.design_file import as_stored
from swayless.machine.drive_section import DriveSection
from swayless.machine.driven_bank import design_driven_bank
from swayless.machine.driven_row import design_driven_row, driven_record
from swayless.machine.following_row import SPACED_LAWS
from swayless.machine.machine_file import Machine
from swayless.machine.operator_record import diagnostics_record, operator_record
from swayless.machine.phase_row import clock_of, design_phase_row
from swayless.machine.plant_section import PlantSection, rope_bands
from swayless.machine.row_design import design_of
from swayless.machine.row_section import Row, RowSection
from swayless.machine.running import most_phase_rad
from swayless.machine.shaper_record import phase_record, shaper_record, spaced_record
from swayless.machine.spaced_row import Followed, design_spaced_row
from swayless.machine.spacing_record import PositionRecord, SpacingRecord
from swayless.plant import Band, ServoDrive

GENERATOR = f"swayless {swayless.__version__}"
"""What a design file says of who made it."""


def design_machine(machine: Machine, *, on_row: Callable[[str], None] = lambda _: None) -> DesignFile:
    """Design every row of a machine, or its bank.

    Parameters
    ----------
    machine : Machine
        As its file describes it.
    on_row : callable
        Called with the name of each row before it is designed.

    Raises
    ------
    DesignError
        If a row or the bank cannot be designed as asked; the message names it.
    """
    records, bank = [], None
    for position, row in enumerate(machine.rows, start=1):
        on_row(row.name)
        try:
            records.append(_ROW_OF_LAW[machine.controller.law](row, machine))
        except DesignError as error:
            raise DesignError(f'{machine.source}: [[row]] {position} ("{row.name}"): {error}') from error
    if machine.bank is not None:
        try:
            records, bank = _bank(machine.bank, machine, on_row)
        except DesignError as error:
            raise DesignError(f"{machine.source}: [bank]: {error}") from error
    design = DesignFile(
        name=machine.name,
        generator=GENERATOR,
        source=machine.source,
        law=machine.controller.law,
        tick_s=machine.controller.tick_s,
        number=machine.controller.number,
        plant=plant_record(machine.plant),
        drive=drive_record(machine.drive),
        shapers=tuple(records),
        bank=bank,
        clock=_clock_record(machine, records) if machine.controller.law == "phase" else None,
        spacing=_spacing_record(machine) if machine.controller.law in SPACED_LAWS else None,
        operator=operator_record(machine.operator),
        diagnostics=diagnostics_record(machine.diagnostics),
    )
    return as_stored(design)


def design_mode(row: Row, *, drive: DriveSection, name: str, tick_s: float | None, number: str) -> DesignFile:
    """Design one row without a machine file.

    Parameters
    ----------
    row : RowSection or RobustRow
        Family, mode or bands, tolerance and parameters.
    drive : DriveSection
        Limits of the command, for generated code.
    name : str
        Prefix of generated symbols.
    tick_s : float or None
        Length of a tick; None leaves the design in continuous time.
    number : str
        Number type of generated code.

    Raises
    ------
    DesignError
        If there is no such shaper, or the tick is too coarse.
    """
    kind = "mode" if row.rope_range_m is None else "crane"
    design = DesignFile(
        name=name,
        generator=GENERATOR,
        source=None,
        law="fixed",
        tick_s=tick_s,
        number=number,
        plant=PlantRecord(kind, row.rope_range_m, row.frequency_range_hz, row.damping_ratios[0], None, None),
        drive=drive_record(drive),
        shapers=(design_row(row, tick_s=tick_s, contactor=drive.contactor),),
        bank=None,
    )
    return as_stored(design)


def design_row(row: Row, *, tick_s: float | None, contactor: bool = False) -> ShaperRecord:
    """Design one row, and solve it on the tick grid where there is one.

    Parameters
    ----------
    row : RowSection or RobustRow
        Family, mode or bands, tolerance and parameters.
    tick_s : float or None
        Length of a tick; None leaves the design in continuous time.
    contactor : bool
        Whether the drive knows only 0 and full speed.

    Raises
    ------
    DesignError
        If there is no such shaper, or the tick is too coarse.
    """
    return shaper_record(row, design_of(row, tick_s=tick_s, contactor=contactor))


def _bank(
    bank: BankSection, machine: Machine, on_row: Callable[[str], None]
) -> tuple[list[ShaperRecord], BankRecord]:
    """Design the rows of a bank, below a driven trolley or not."""
    tick_s, contactor, ropes = machine.controller.tick_s, machine.drive.contactor, machine.driven_ropes
    if ropes is not None:
        driven = design_driven_bank(
            bank, machine.plant, ropes, tick_s=tick_s, contactor=contactor, on_row=on_row
        )
        return list(driven.shapers), driven.record
    made = design_bank(bank, machine.plant, tick_s=tick_s, contactor=contactor, on_row=on_row)
    records = [shaper_record(row, design) for row, design in zip(made.rows, made.designs, strict=True)]
    return records, made.record


def _fixed_row(row: Row, machine: Machine) -> ShaperRecord:
    """Design one row by itself, below a driven trolley or not."""
    tick_s, contactor, ropes = machine.controller.tick_s, machine.drive.contactor, machine.driven_ropes
    if ropes is None:
        return design_row(row, tick_s=tick_s, contactor=contactor)
    return driven_record(row, design_driven_row(row, ropes, tick_s=tick_s, contactor=contactor))


def _phase_row(row: Row, machine: Machine) -> ShaperRecord:
    """Design one row for every rope of a machine."""
    assert isinstance(row, RowSection)  # noqa: S101 - the phase clock's rows are of named families
    controller = machine.controller
    made = design_phase_row(row, machine.plant, tick_s=controller.tick_s, number=controller.number)
    return phase_record(row, made, machine.plant)


def _spaced_row(row: Row, machine: Machine) -> ShaperRecord:
    """Design one row for every position of a machine."""
    assert isinstance(row, RowSection)  # noqa: S101 - rows of these laws are of named families
    controller, band = machine.controller, Band(*machine.plant.frequency_hz)
    law, tick_s, number = cast("SpacingLaw", controller.law), controller.tick_s, controller.number
    made = design_spaced_row(row, _followed(machine.plant), band, law, tick_s=tick_s, number=number)
    return spaced_record(row, made, machine.plant)


_ROW_OF_LAW: Mapping[str, Callable[[Row, Machine], ShaperRecord]] = {
    "fixed": _fixed_row,
    "phase": _phase_row,
} | dict.fromkeys(SPACED_LAWS, _spaced_row)


def _followed(plant: PlantSection) -> Followed:
    return Followed(plant.rope_length_m, plant.hoist_speed_m_s, plant.positions, plant.damping_ratio)


def _spacing_record(machine: Machine) -> SpacingRecord:
    """Give the spacing that all rows share."""
    spacing = _followed(machine.plant).spacing(machine.controller.tick_s)
    return SpacingRecord(spacing.starts, spacing.ticks)


def _clock_record(machine: Machine, records: Sequence[ShaperRecord]) -> ClockRecord:
    """Give the table of the clock that all rows share."""
    plant, controller = machine.plant, machine.controller
    assert plant.rope_length_m is not None  # noqa: S101 - checked when the file was read
    assert plant.hoist_speed_m_s is not None  # noqa: S101 - as above
    _, clock = clock_of(
        plant.rope_length_m,
        plant.hoist_speed_m_s,
        tick_s=controller.tick_s,
        number=controller.number,
        most_phase_rad=most_phase_rad(records),
    )
    return ClockRecord(round(1.0 / clock.quantum_rad), clock.nodes)


def plant_record(plant: PlantSection) -> PlantRecord:
    """Give the plant as it stands in the design file."""
    pendulum, positions = plant.double_pendulum, plant.positions
    if pendulum is None or plant.rope_length_m is None:
        return PlantRecord(
            plant.kind,
            plant.rope_length_m,
            plant.frequency_hz,
            plant.damping_ratio,
            None,
            plant.hoist_speed_m_s,
            None if positions is None else PositionRecord(**vars(positions)),
        )
    upper = rope_bands(plant.rope_length_m, pendulum)[1]
    record = DoublePendulumRecord(
        sling_length_m=pendulum.sling_length_m,
        hook_mass_kg=pendulum.hook_mass_kg,
        load_mass_kg=pendulum.load_mass_kg,
        upper_frequency_hz=(upper.low_hz, upper.high_hz),
    )
    return PlantRecord(
        "double_pendulum",
        plant.rope_length_m,
        plant.frequency_hz,
        plant.damping_ratio,
        record,
        plant.hoist_speed_m_s,
    )


def drive_record(drive: DriveSection) -> DriveRecord:
    """Give the drive as it stands in the design file."""
    values = {name: getattr(drive, name) for name in DriveRecord.__dataclass_fields__}
    return DriveRecord(**{**values, "speed_loop": speed_loop_record(drive.speed_loop)})


def speed_loop_record(loop: ServoDrive | None) -> SpeedLoopRecord | None:
    """Give a speed loop as it stands in the design file."""
    if loop is None:
        return None
    integral_time_s = loop.integral_time_s if math.isfinite(loop.integral_time_s) else None
    return SpeedLoopRecord(loop.trolley_mass_kg, loop.load_mass_kg, loop.gain_n_s_m, integral_time_s)
