"""From a machine, or one mode, to its design file: what each row is, and what it guarantees on the tick grid.

Not for: the mathematics (`swayless.design`) or the layout of the file (`swayless.machine.design_document`).
"""

from __future__ import annotations

from collections.abc import Callable

import swayless
from swayless.design import (
    GridShaper,
    Guarantee,
    Shaper,
    design_shaper,
    overtravel_s,
    peak_factor,
    rope_length_interval_m,
    solve_on_grid,
)
from swayless.errors import DesignError
from swayless.machine.design_document import (
    DesignFile,
    DriveRecord,
    GuaranteeRecord,
    ModeRecord,
    PlantRecord,
    ShaperRecord,
    TapsRecord,
)
from swayless.machine.design_file import as_stored
from swayless.machine.drive_section import DriveSection
from swayless.machine.machine_file import Machine
from swayless.machine.row_section import RowSection

GENERATOR = f"swayless {swayless.__version__}"
"""What a design file says of who made it."""


def design_machine(machine: Machine, *, on_row: Callable[[str], None] = lambda _: None) -> DesignFile:
    """Design every row of a machine.

    Parameters
    ----------
    machine : Machine
        As its file describes it.
    on_row : callable
        Called with the name of each row before it is designed.

    Raises
    ------
    DesignError
        If a row cannot be designed as asked; the message names the row.
    """
    records = []
    for position, row in enumerate(machine.rows, start=1):
        on_row(row.name)
        try:
            records.append(design_row(row, tick_s=machine.controller.tick_s))
        except DesignError as error:
            raise DesignError(f'{machine.source}: [[row]] {position} ("{row.name}"): {error}') from error
    plant = machine.plant
    design = DesignFile(
        name=machine.name,
        generator=GENERATOR,
        source=machine.source,
        law=machine.controller.law,
        tick_s=machine.controller.tick_s,
        number=machine.controller.number,
        plant=PlantRecord(plant.kind, plant.rope_length_m, plant.frequency_hz, plant.damping_ratio),
        drive=drive_record(machine.drive),
        shapers=tuple(records),
    )
    return as_stored(design)


def design_mode(
    row: RowSection, *, drive: DriveSection, name: str, tick_s: float | None, number: str
) -> DesignFile:
    """Design one shaper for one mode, without a machine file.

    Parameters
    ----------
    row : RowSection
        Family, mode, tolerance and parameters.
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
        If the family does not exist for the mode or tolerance, or the tick is too coarse.
    """
    frequency_hz = row.mode.frequency_hz
    kind, rope_m = (
        ("mode", None) if row.rope_length_m is None else ("crane", (row.rope_length_m, row.rope_length_m))
    )
    design = DesignFile(
        name=name,
        generator=GENERATOR,
        source=None,
        law="fixed",
        tick_s=tick_s,
        number=number,
        plant=PlantRecord(kind, rope_m, (frequency_hz, frequency_hz), row.mode.damping_ratio),
        drive=drive_record(drive),
        shapers=(design_row(row, tick_s=tick_s),),
    )
    return as_stored(design)


def design_row(row: RowSection, *, tick_s: float | None) -> ShaperRecord:
    """Design one row, and solve it on the tick grid where there is one.

    Parameters
    ----------
    row : RowSection
        Family, mode, tolerance and parameters.
    tick_s : float or None
        Length of a tick; None leaves the design in continuous time.

    Raises
    ------
    DesignError
        If the family does not exist for the mode or tolerance, or the tick is too coarse.
    """
    shaper = design_shaper(
        row.family, row.mode, tolerance=row.tolerance, order=row.order, delay_s=row.delay_s
    )
    taps = None if tick_s is None else _taps_record(solve_on_grid(shaper, tick_s))
    return _shaper_record(row, shaper, taps)


def drive_record(drive: DriveSection) -> DriveRecord:
    """Give the drive as it stands in the design file."""
    return DriveRecord(**{name: getattr(drive, name) for name in DriveRecord.__dataclass_fields__})


def _shaper_record(row: RowSection, shaper: Shaper, taps: TapsRecord | None) -> ShaperRecord:
    return ShaperRecord(
        name=row.name,
        family=row.family,
        order=row.order,
        delay_s=row.delay_s,
        mode=ModeRecord(row.mode.frequency_hz, row.mode.damping_ratio, row.rope_length_m),
        times_s=tuple(shaper.times_s.tolist()),
        amplitudes=tuple(shaper.amplitudes.tolist()),
        duration_s=shaper.duration_s,
        lower_bound_s=None,
        overtravel_s=overtravel_s(shaper),
        peak_factor=peak_factor(shaper),
        guarantee=_guarantee_record(shaper.guarantee),
        taps=taps,
    )


def _taps_record(grid: GridShaper) -> TapsRecord:
    return TapsRecord(
        delays_ticks=tuple(grid.delays_ticks.tolist()),
        amplitudes=tuple(grid.amplitudes.tolist()),
        duration_s=grid.duration_s,
        overtravel_s=overtravel_s(grid),
        guarantee=_guarantee_record(grid.guarantee),
    )


def _guarantee_record(guarantee: Guarantee) -> GuaranteeRecord:
    band = guarantee.band
    return GuaranteeRecord(
        tolerance=guarantee.tolerance,
        frequency_hz=(band.low_hz, band.high_hz),
        rope_length_m=rope_length_interval_m(band),
        worst_residual_ratio=guarantee.worst_residual_ratio,
    )
