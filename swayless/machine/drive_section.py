"""How the machine is driven: speeds and ramps of the plant section, and the ``[drive]`` section.

Not for: the number type in which the controller computes (`swayless.machine.controller_section`).
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.machine.checks import flag, label, number, quantity
from swayless.machine.plant_section import PlantKind
from swayless.machine.problems import Table, shown
from swayless.machine.speed_loop import read_speed_loop
from swayless.plant import ServoDrive

MAX_SPEED = quantity("speed", 1e-6, 1e4)
SPEED_OR_ZERO = quantity("speed", 0.0, 1e4)
ACCELERATION = quantity("acceleration", 1e-6, 1e4)
COUNTS = number(1e-3, 1e12)
SI_UNITS = "m/s"
_RAMPS = ("acceleration", "deceleration", "quick_stop")


@dataclass(frozen=True)
class DriveSection:
    """What the command is in, and the limits that are put on it before it is shaped.

    Parameters
    ----------
    units : str
        What the command is in, such as ``"m/s"`` or ``"counts"``.
    counts_per_m_s : float or None
        How many of these units are 1 m/s; None if the command is in m/s.
    max_speed_m_s : float
        Largest command, > 0.
    acceleration_m_s2, deceleration_m_s2, quick_stop_m_s2 : float or None
        Ramps of the command, > 0; None where it is not ramped.
    minimum_speed_m_s : float
        Commands below it count as 0.
    inching_speed_m_s : float
        Up to this speed a command from rest may stay unshaped.
    command_resolution_m_s : float
        Smallest change of the command that is taken for one.
    contactor : bool
        Whether the drive knows only 0 and full speed.
    speed_loop : ServoDrive or None
        What holds the trolley against the pull of the load, if the file gives it; otherwise it is ideal.
    """

    units: str
    counts_per_m_s: float | None
    max_speed_m_s: float
    acceleration_m_s2: float | None
    deceleration_m_s2: float | None
    quick_stop_m_s2: float | None
    minimum_speed_m_s: float
    inching_speed_m_s: float
    command_resolution_m_s: float
    contactor: bool = False
    speed_loop: ServoDrive | None = None


def read_drive(kind: PlantKind, plant: Table, drive: Table) -> DriveSection | None:
    """Read the speeds and ramps of both sections; None where a needed value is missing or wrong."""
    max_speed_m_s = plant.need("max_speed", MAX_SPEED)
    contactor = drive.take("contactor", flag, False) or False
    acceleration, deceleration, quick_stop = (_ramp(key, kind, plant, drive) for key in _RAMPS)
    units, counts_per_m_s = _read_units(drive)
    minimum = _speed_below("minimum_speed", drive, max_speed_m_s)
    inching = _speed_below("inching_speed", drive, max_speed_m_s)
    resolution = _speed_below("command_resolution", drive, max_speed_m_s)
    speed_loop = read_speed_loop(drive)
    if contactor:
        _refuse_speeds_between(plant, drive)
    if max_speed_m_s is None:
        return None
    return DriveSection(
        units=units,
        counts_per_m_s=counts_per_m_s,
        max_speed_m_s=max_speed_m_s,
        acceleration_m_s2=acceleration,
        deceleration_m_s2=acceleration if deceleration is None else deceleration,
        quick_stop_m_s2=acceleration if quick_stop is None else quick_stop,
        minimum_speed_m_s=minimum,
        inching_speed_m_s=inching,
        command_resolution_m_s=resolution,
        contactor=contactor,
        speed_loop=speed_loop,
    )


def _ramp(key: str, kind: PlantKind, plant: Table, drive: Table) -> float | None:
    in_plant, in_drive = plant.take(key, ACCELERATION, None), drive.take(key, ACCELERATION, None)
    if key in plant.raw and key in drive.raw:
        drive.place(key).wrong(
            drive.raw[key], f"stands in [{kind}] too, as {shown(plant.raw[key])}: keep one"
        )
    return in_plant if in_drive is None else in_drive


def _refuse_speeds_between(plant: Table, drive: Table) -> None:
    """Report what would give a contactor drive speeds between 0 and the full one."""
    for table in (plant, drive):
        for key in (*_RAMPS, "inching_speed"):
            if key in table.raw:
                table.place(key).wrong(
                    table.raw[key], "a contactor drive gives 0 or full speed: leave it out"
                )


def _read_units(drive: Table) -> tuple[str, float | None]:
    counts_per_m_s = drive.take("counts_per_m_s", COUNTS, None)
    counted = "counts_per_m_s" in drive.raw
    units = drive.take("units", label, "counts" if counted else SI_UNITS)
    if units is None:
        return SI_UNITS, counts_per_m_s
    if units != SI_UNITS and not counted:
        drive.place("counts_per_m_s").problem(f'missing: how many "{units}" are 1 m/s?')
    if units == SI_UNITS and counts_per_m_s not in {None, 1.0}:
        drive.place("counts_per_m_s").wrong(counts_per_m_s, f'must be 1 when units = "{SI_UNITS}"')
    return units, counts_per_m_s


def _speed_below(key: str, drive: Table, max_speed_m_s: float | None) -> float:
    speed_m_s = drive.take(key, SPEED_OR_ZERO, 0.0) or 0.0
    if max_speed_m_s is not None and speed_m_s >= max_speed_m_s:
        drive.place(key).wrong(drive.raw[key], f"must be below max_speed, {max_speed_m_s:g} m/s")
    return speed_m_s
