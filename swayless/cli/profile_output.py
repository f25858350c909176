"""What `swayless profile` prints and writes of a command: words, JSON, and a table of ticks.

Not for: finding the command.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from swayless.cli.console import counted, per_cent, print_line, print_table, rounded_down
from swayless.design.optimal import Command, LinearPlant, OptimalCommand, output_at_ticks
from swayless.design.optimal.linear_plant import shown
from swayless.design.optimal.sensitivity import mode_of, swing_left
from swayless.machine.profile_file import ProfileRequest

OFF = (0.9, 1.0, 1.1)
"""Actual frequencies, of the nominal ones, at which what is left is said."""

CURVE = tuple(percent / 100.0 for percent in range(70, 131))
"""The same in JSON: a sensitivity curve."""


def document(request: ProfileRequest, found: OptimalCommand) -> dict[str, Any]:
    """Give everything that is known of a command, for machines."""
    task, command = request.task, found.command
    output = output_at_ticks(task.plant, command, start=task.start)
    return {
        "name": request.name,
        "tick_s": command.tick_s,
        "ticks": found.ticks,
        "duration_s": command.duration_s,
        "hold": command.hold,
        "initial_value": command.initial_value,
        "command": command.values.tolist(),
        "final_value": command.final_value,
        "start": task.start,
        "target": task.target,
        "limit": list(task.limits),
        "rate_limit_per_s": task.rate_limit_per_s,
        "robust_order": task.robustness.order,
        "split_ratio": task.robustness.split_ratio,
        "tracking_tolerance": request.tolerance,
        "utilisation_ratio": found.utilisation_ratio,
        "proved_utilisation_ratio": found.proved_utilisation_ratio,
        "fewer_utilisation_ratio": _finite(found.fewer_utilisation_ratio),
        "final_error_ratio": found.final_error_ratio,
        "reference": output.tolist(),
        "left": _left_document(task.plant, command),
    }


def _left_document(plant: LinearPlant, command: Command) -> list[dict[str, Any]]:
    """Give a sensitivity curve of each mode; none where modes cannot be told apart."""
    if not plant.can_be_off:
        return []
    modes = [mode_of(complex(pole)) for pole in plant.ringing_poles_rad_s]
    return [
        {
            "frequency_hz": mode.frequency_hz,
            "damping_ratio": mode.damping_ratio,
            "at_ratio": list(CURVE),
            "amplitude": left.tolist(),
        }
        for mode, left in zip(modes, swing_left(plant, command, CURVE), strict=True)
    ]


def _finite(ratio: float | None) -> float | None:
    """Give a ratio that JSON can hold: none for infinity, where no input at all would do."""
    return ratio if ratio is not None and ratio < float("inf") else None


def trajectory_text(request: ProfileRequest, found: OptimalCommand) -> str:
    """Give the command, as feedforward, and the output it should make, as the reference of a feedback: CSV.

    The last line is of the end of the command; both stay there.
    """
    task, command = request.task, found.command
    output = output_at_ticks(task.plant, command, start=task.start)
    inputs = [*command.values.tolist(), command.final_value]
    lines = [
        f"{tick},{tick * command.tick_s:.12g},{value!r},{reference!r}\n"
        for tick, (value, reference) in enumerate(zip(inputs, output.tolist(), strict=True))
    ]
    return "tick,time_s,command,reference\n" + "".join(lines)


def print_found(request: ProfileRequest, found: OptimalCommand) -> None:
    """Print a command for a person: how long, what is proved, and what is left where the plant differs."""
    for title, heads, rows in found_tables(request, found):
        print_table(title, heads, rows)
    for line in found_remarks(request, found):
        print_line(line)


def found_tables(
    request: ProfileRequest, found: OptimalCommand
) -> list[tuple[str, Sequence[str], Sequence[Sequence[str]]]]:
    """Give title, heads and rows of the tables on a command: its facts, and what its modes leave, if any."""
    task, command = request.task, found.command
    how = "fastest" if found.fewer_utilisation_ratio is not None else "least energy"
    lasts = f"{counted(found.ticks, 'tick')} of {command.tick_s:g} s, {command.duration_s:.6g} s"
    rows = [
        ("move", f"{task.start:g} to {task.target:g}"),
        (how, lasts),
        ("command", f"{command.values.min():.6g} to {command.values.max():.6g}"),
        ("held at the end by", f"{command.final_value:.6g}"),
        ("takes of the limits", per_cent(found.utilisation_ratio)),
        ("misses rest by", f"{found.final_error_ratio:.1g} of the largest state"),
    ]
    facts = (request.name, ("", "value"), rows)
    modes = _left_rows(request, found)
    heads = ("mode [Hz]", *(f"at {100 * ratio:g} %" for ratio in OFF))
    left = ("left swinging at the end, where the frequency is off", heads, modes)
    return [facts, left] if modes else [facts]


def found_remarks(request: ProfileRequest, found: OptimalCommand) -> list[str]:
    """Give what is proved of a command, in sentences."""
    merged = request.task.plant.merged_pole_rad_s
    notes = (
        []
        if merged is None
        else [f"note: two modes at {shown(merged)} rad/s are one: none can be off on its own"]
    )
    if found.fewer_utilisation_ratio is not None:
        return [*notes, _proof(found.ticks - 1, found.fewer_utilisation_ratio)]
    least = rounded_down(100.0 * found.proved_utilisation_ratio)
    return [*notes, f"proved: no command of this length takes less than {least} % of the limits"]


def _left_rows(request: ProfileRequest, found: OptimalCommand) -> list[tuple[str, ...]]:
    """Say what each mode leaves at each frequency, in units of the output."""
    plant = request.task.plant
    if not plant.can_be_off:
        return []
    lefts = swing_left(plant, found.command, OFF)
    frequencies = [mode_of(complex(pole)).frequency_hz for pole in plant.ringing_poles_rad_s]
    return [
        (f"{frequency_hz:.6g}", *(f"{left:.3g}" if left > 1e-8 else "0" for left in row))
        for frequency_hz, row in zip(frequencies, lefts, strict=True)
    ]


def _proof(ticks: int, share: float) -> str:
    """Say why one tick less is too few."""
    if share == float("inf"):
        return f"proved: {counted(ticks, 'tick')} cannot bring the plant to rest, whatever the limits"
    least = rounded_down(100.0 * share)
    return (
        f"proved: {counted(ticks, 'tick')} would take at least {least} % of the limits; no command is shorter"
    )
