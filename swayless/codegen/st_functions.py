"""What the head of a Structured Text block says of its optional functions. Not for: those of every block."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from itertools import chain

from swayless.controller.output_units import OutputUnits
from swayless.controller.settings import ShaperSettings
from swayless.controller.tables import tables_of

WIDTH = 108
"""Longest line of the head."""


def function_lines(settings: ShaperSettings) -> list[str]:
    """Explain the optional functions of a block, and end by an empty line; nothing where it has none.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    subjects = (_steps, _ends, _drive, _tuning, _diagnostics)
    said = chain.from_iterable(said_of(settings) for said_of in subjects)
    lines = [line for each in said for line in textwrap.wrap(each, WIDTH, subsequent_indent="  ")]
    return [*lines, ""] if lines else []


def _steps(settings: ShaperSettings) -> Iterator[str]:
    steps, units = settings.operator.steps, settings.limits.units
    if steps is None:
        return
    per_sum = OutputUnits(settings).metres_per_unit_tick
    first, second, third = (f"{float(size * per_sum):.6g}" for size in steps.sizes)
    yield (
        f"StepForward, StepReverse: a press is a way of {first}, {second} or {third} m by StepSize 1 to 3, "
        f"at most {float(steps.command):.6g} {units}. It begins at rest, without a command, and adds to "
        "steps that run. A command of a speed counts again after it has been 0."
    )


def _ends(settings: ShaperSettings) -> Iterator[str]:
    operator, units = settings.operator, settings.limits.units
    if operator.has_stop_switches:
        yield (
            "StopForward, StopReverse: motion towards a made switch ends by a quick stop, and a command "
            "towards it counts after it has been 0 or pointed away. The way back is open."
        )
    if operator.slow_command is not None:
        slow = f"{float(operator.slow_command):.6g} {units}"
        yield f"SlowForward, SlowReverse: at most {slow} towards a made switch."
    if operator.way is not None:
        yield (
            f"DistanceForward, DistanceReverse: the shaped stop ends {float(operator.way.margin):.6g} m "
            "before each end. While they are not valid, what is travelled is taken from the last ones."
        )


def _drive(settings: ShaperSettings) -> Iterator[str]:
    operator, tracking, units = settings.operator, settings.diagnostics.tracking, settings.limits.units
    if operator.contactor_commands:
        speeds = " and ".join(f"{float(each):.6g}" for each in operator.contactor_commands)
        yield f"The drive knows 0 and {speeds} {units}: a command counts as the largest that is not above it."
    if operator.has_drive_feedback:
        yield (
            "DriveReady: while it is FALSE the reference is 0. When it is TRUE again the reference goes on "
            "from ActualSpeed by a quick stop: give the speed that the drive has at that call."
        )
    if tracking is not None:
        yield (
            f"ActualSpeed: it follows within {float(tracking.tolerance):.6g} {units} of the references of "
            f"the last {tracking.window_ticks} ticks or more; a status bit says where it has not for more "
            f"than {tracking.time_ticks} ticks."
        )


def _tuning(settings: ShaperSettings) -> Iterator[str]:
    operator, limits = settings.operator, settings.limits
    if operator.has_speed_limit:
        yield f"SpeedLimit: commands and steps keep within it, 0 to {limits.max_command:.6g} {limits.units}."
    if operator.rope_offset is not None:
        low, high = (f"{float(end):.6g}" for end in operator.rope_offset)
        yield f"RopeOffset: {low} to {high}, added to what is measured."
    if operator.starts_from_zero:
        yield "After power-on a command counts only after it has been 0."


def _diagnostics(settings: ShaperSettings) -> Iterator[str]:
    asked = settings.diagnostics
    if asked.sway is not None:
        yield "PredictedSway: of a linear model that the reference drives. It knows no wind, push or slip."
    if asked.rope_bounds is not None:
        yield "ResidualBound: proven for the rope of now; all of it while the length is not known."
    if asked.facts is not None:
        count = sum(len(table.numbers) for table in tables_of(settings))
        yield (
            f"DesignId: the design. The first call sums up the {count} numbers of all tables and takes so "
            "much longer; where they are not those of the design, the reference stays 0."
        )
