"""What the operator touches besides command and knob: ``[steps]``, ``[limits]``, ``[tuning]``, and more.

Not for: what the functions do (`swayless.controller`).
"""

from __future__ import annotations

from typing import NamedTuple

from swayless.controller.operator_options import OperatorOptions
from swayless.machine.checks import flag, quantity, some, two
from swayless.machine.drive_section import MAX_SPEED, DriveSection
from swayless.machine.problems import Place, Table

STEP_SIZES = some(quantity("length", 1e-4, 1e3), at_least=3, at_most=3)
MARGIN = quantity("length", 0.0, 1e3)
OFFSET = two(quantity("length", -1e2, 1e2))
CONTACTOR_SPEEDS = some(MAX_SPEED, at_most=2)

NO_FUNCTIONS = OperatorOptions()
"""A machine that asks for none."""

MEASURED_ROPE = 'needs a measured rope: law = "phase", or a [bank] with selection = "rope_length"'


class FunctionTables(NamedTuple):
    """The sections in which functions are asked for; those that the file has not are empty."""

    drive: Table
    controller: Table
    steps: Table
    limits: Table
    tuning: Table


def read_operator(
    tables: FunctionTables, drive: DriveSection | None, *, measures_rope: bool
) -> OperatorOptions:
    """Read what the operator touches, and refuse what does not go together.

    Parameters
    ----------
    tables : FunctionTables
        The sections.
    drive : DriveSection or None
        Speeds of the drive; None where they are wrong.
    measures_rope : bool
        Whether the block reads the length of a rope.

    Returns
    -------
    OperatorOptions
        Nothing asked for, where a problem was found.
    """
    report = tables.drive.report
    found_before = len(report.problems)
    contactor_speeds = _contactor_speeds(tables.drive, drive)
    steps, limits, tuning = tables.steps, tables.limits, tables.tuning
    sizes_m, step_speed_m_s = steps.take("sizes", STEP_SIZES, None), _speed("speed", steps, drive)
    if steps.raw and "sizes" not in steps.raw:
        steps.place("sizes").problem("missing: the three ways that a step may have")
    slow_speed_m_s = _speed("slow_speed", limits, drive)
    stop_switches, margin_m = limits.take("stop_switches", flag, False), limits.take("margin", MARGIN, None)
    speed_limit, offset_m = tuning.take("speed_limit", flag, False), tuning.take("rope_offset", OFFSET, None)
    feedback = tables.drive.take("feedback", flag, False)
    start_from_zero = tables.controller.take("start_from_zero", flag, False)
    if drive is not None and drive.contactor:
        _refuse_on_contactors(tables, contactor_speeds, slow_speed_m_s)
    if offset_m is not None:
        _check_offset(tuning.place("rope_offset"), offset_m, measures_rope=measures_rope)
    if len(report.problems) > found_before:
        return NO_FUNCTIONS
    return OperatorOptions(
        step_sizes_m=sizes_m,
        step_speed_m_s=step_speed_m_s,
        stop_switches=bool(stop_switches),
        slow_speed_m_s=slow_speed_m_s,
        limit_margin_m=margin_m,
        contactor_speeds_m_s=contactor_speeds,
        drive_feedback=bool(feedback),
        speed_limit=bool(speed_limit),
        rope_offset_m=offset_m,
        start_from_zero=bool(start_from_zero),
    )


def _speed(key: str, table: Table, drive: DriveSection | None) -> float | None:
    """Read a speed up to the maximum."""
    speed_m_s = table.take(key, MAX_SPEED, None)
    if speed_m_s is not None and drive is not None and speed_m_s > drive.max_speed_m_s:
        table.place(key).wrong(table.raw[key], f"must be at most max_speed, {drive.max_speed_m_s:g} m/s")
    return speed_m_s


def _contactor_speeds(table: Table, drive: DriveSection | None) -> tuple[float, ...] | None:
    """Read the speeds that contactors switch."""
    speeds_m_s = table.take("contactor_speeds", CONTACTOR_SPEEDS, None)
    if speeds_m_s is None or drive is None:
        return speeds_m_s
    if not drive.contactor:
        reason = "are those of a contactor drive: add contactor = true"
    elif speeds_m_s[-1] != drive.max_speed_m_s:
        reason = f"must end with max_speed, {drive.max_speed_m_s:g} m/s"
    elif list(speeds_m_s) != sorted(set(speeds_m_s)):
        reason = "must rise: the slow speed, then the full one"
    else:
        return speeds_m_s
    table.place("contactor_speeds").wrong(table.raw["contactor_speeds"], reason)
    return None


def _refuse_on_contactors(
    tables: FunctionTables, speeds_m_s: tuple[float, ...] | None, slow_speed_m_s: float | None
) -> None:
    """Report what a drive that only switches cannot do."""
    drive, steps, limits, tuning = tables.drive, tables.steps, tables.limits, tables.tuning
    between = "needs speeds between those of a contactor drive: leave it out"
    for table, key in ((steps, "sizes"), (drive, "feedback"), (tuning, "speed_limit")):
        if table.raw.get(key, False) is not False:
            table.place(key).wrong(table.raw[key], between)
    if "contactor_speeds" not in drive.raw:
        for key in ("slow_speed", "margin"):
            if key in limits.raw:
                limits.place(key).wrong(
                    limits.raw[key], "on a contactor drive needs contactor_speeds in [drive]"
                )
    elif speeds_m_s is not None and slow_speed_m_s is not None and slow_speed_m_s < speeds_m_s[0]:
        limits.place("slow_speed").wrong(
            limits.raw["slow_speed"],
            f"below the slowest of contactor_speeds, {speeds_m_s[0]:g} m/s, nothing moves",
        )


def _check_offset(place: Place, offset_m: tuple[float, float], *, measures_rope: bool) -> None:
    """Report an offset that has no rope, or not 0 in its range."""
    if not measures_rope:
        place.problem(MEASURED_ROPE)
    if not offset_m[0] <= 0.0 <= offset_m[1]:
        place.problem(f"must be a range around 0, is {offset_m[0]:g} to {offset_m[1]:g} m")
