"""What the block says of itself: keys of ``[controller]`` and ``[drive]``.

Not for: how it finds that out (`swayless.controller`).
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.machine.checks import flag, quantity
from swayless.machine.drive_section import MAX_SPEED, DriveSection
from swayless.machine.operator_section import MEASURED_ROPE, FunctionTables
from swayless.machine.plant_section import PlantSection
from swayless.machine.problems import Table

TRACKING_TIME = quantity("time", 0.0, 60.0)

DEFAULT_TRACKING_TIME_S = 0.5
"""Long enough for the noise of a speed signal, short enough to see before the load swings back."""

DEFAULT_TRACKING_DELAY_S = 0.2
"""Velocity loops of crane drives lag by about 0.1 s; twice that still tells a drive that does not follow."""


@dataclass(frozen=True)
class TrackingSection:
    """When the drive counts as not following the reference.

    Parameters
    ----------
    tolerance_m_s : float
        How far its speed may be from every reference of late, above 0.
    time_s : float
        For how long, at least 0.
    delay_s : float
        Which references are of late: its lag, at least 0.
    """

    tolerance_m_s: float
    time_s: float
    delay_s: float


@dataclass(frozen=True)
class DiagnosticsSection:
    """What a block says of itself besides its status; nothing unless asked for.

    Parameters
    ----------
    predicted_sway : bool
        Output of where the load hangs, by the linear model.
    residual_bound_at_rope : bool
        The residual bound is that of the measured rope, in the place of the row's tolerance.
    tracking : TrackingSection or None
        Whether the drive follows.
    design_check : bool
        Output of the design's identifier, and a block that refuses tables that are not its own.
    """

    predicted_sway: bool = False
    residual_bound_at_rope: bool = False
    tracking: TrackingSection | None = None
    design_check: bool = False


NO_DIAGNOSTICS = DiagnosticsSection()
"""A block that says of itself what every block does."""


def read_diagnostics(
    tables: FunctionTables,
    plant: PlantSection | None,
    drive: DriveSection | None,
    *,
    law: str | None,
    measures_rope: bool,
) -> DiagnosticsSection:
    """Read what the block is to say of itself, and refuse what it cannot know.

    Parameters
    ----------
    tables : FunctionTables
        The sections.
    plant, drive : PlantSection, DriveSection or None
        What swings, and how it is driven; None where that is wrong.
    law : str or None
        Of the controller.
    measures_rope : bool
        Whether the block reads the length of a rope.
    """
    controller = tables.controller
    sway, at_rope, check = (
        bool(controller.take(key, flag, False))
        for key in ("predicted_sway", "residual_bound_at_rope", "design_check")
    )
    tracking = _tracking(tables.drive, drive)
    if sway:
        _refuse_model("predicted_sway", controller, plant, drive)
    if at_rope and not measures_rope:
        controller.place("residual_bound_at_rope").problem(MEASURED_ROPE)
    elif at_rope and law == "phase":
        controller.place("residual_bound_at_rope").problem(
            'under law = "phase" a row guarantees the same on every rope: leave it out'
        )
    elif at_rope:
        _refuse_model("residual_bound_at_rope", controller, plant, drive)
    return DiagnosticsSection(sway, at_rope, tracking, check)


def _tracking(table: Table, drive: DriveSection | None) -> TrackingSection | None:
    """Read when the drive counts as not following."""
    tolerance_m_s = table.take("tracking_tolerance", MAX_SPEED, None)
    time_s = table.take("tracking_time", TRACKING_TIME, DEFAULT_TRACKING_TIME_S)
    delay_s = table.take("tracking_delay", TRACKING_TIME, DEFAULT_TRACKING_DELAY_S)
    for key in ("tracking_time", "tracking_delay"):
        if key in table.raw and "tracking_tolerance" not in table.raw:
            table.place(key).wrong(table.raw[key], "needs tracking_tolerance beside it")
    if tolerance_m_s is None or time_s is None or delay_s is None:
        return None
    if drive is not None and tolerance_m_s > drive.max_speed_m_s:
        table.place("tracking_tolerance").wrong(
            table.raw["tracking_tolerance"], f"must be at most max_speed, {drive.max_speed_m_s:g} m/s"
        )
    return TrackingSection(tolerance_m_s, time_s, delay_s)


def _refuse_model(key: str, table: Table, plant: PlantSection | None, drive: DriveSection | None) -> None:
    """Report machines of which the model, one pendulum below an ideal trolley, is not true."""
    place = table.place(key)
    if plant is not None and plant.kind == "arm":
        place.problem("is of a load on a rope, and this is an [arm]: leave it out")
    if plant is not None and plant.double_pendulum is not None:
        place.problem("is of a load that swings in one mode, and sling_length makes two: leave it out")
    if drive is not None and drive.speed_loop is not None:
        place.problem("is of an ideal trolley, and trolley_mass makes a driven one: leave it out")
