"""What `swayless profile invert` and `tune` print and write of a command: words, JSON, and a table of ticks.

Not for: finding the command.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swayless.cli.console import counted, print_line, print_table
from swayless.design.inversion import closed_form
from swayless.design.optimal import output_at_ticks

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.machine.inversion_file import InversionRequest

_AGREES = 1e-9  # of the command's largest change: the least digits for which a formula is worth writing out


def document(request: InversionRequest) -> dict[str, Any]:
    """Give everything that is known of a command, for machines."""
    found, motion = request.found, request.motion
    command = found.command
    output = output_at_ticks(found.plant, command, start=motion.start)
    return {
        "name": request.name,
        "tick_s": command.tick_s,
        "ticks": command.values.size,
        "duration_s": command.duration_s,
        "motion_s": motion.duration_s,
        "post_action_s": found.post_action_s,
        "hold": command.hold,
        "initial_value": command.initial_value,
        "command": command.values.tolist(),
        "final_value": command.final_value,
        "start": motion.start,
        "target": motion.target,
        "order": motion.order,
        "limit": list(request.played_limits),
        "truncation_ratio": request.truncation_ratio,
        "truncation_bound": found.truncation_bound,
        "correction": found.correction,
        "deviation": found.deviation,
        "final_error_ratio": found.final_error_ratio,
        "reference": output.tolist(),
        "polynomial": motion.at(command.tick_s * np.arange(output.size)).tolist(),
        "exact_command": found.exact.tolist(),
        "closed_form": _closed_form(request),
    }


def _closed_form(request: InversionRequest) -> dict[str, Any] | None:
    """Write the formula of the command out; none where zeros so alike or so far apart take its digits."""
    motion, found = request.motion, request.found
    changes = found.exact - found.command.initial_value
    with np.errstate(all="ignore"):
        form = closed_form(request.numerator, request.denominator, motion)
        off = np.abs(
            form.at(request.tick_s * np.arange(changes.size, dtype=np.float64), motion) - changes
        ).max()
    if not off <= _AGREES * float(np.abs(changes).max()):
        return None
    return {
        "initial_value": found.command.initial_value,
        "polynomial": form.polynomial.tolist(),
        "exponentials": [
            {
                "rate_rad_s": [zero.real, zero.imag],
                "amplitude": [during.real, during.imag],
                "amplitude_after": [after.real, after.imag],
            }
            for zero, during, after in zip(
                form.rates.tolist(), form.during.tolist(), form.after.tolist(), strict=True
            )
        ],
        "final_change": form.final,
    }


def trajectory_text(request: InversionRequest) -> str:
    """Give the command, as feedforward, and the load's motion, as the reference of a feedback: CSV.

    The last line is of the end of the command; both stay there.
    """
    found = request.found
    command = found.command
    output = output_at_ticks(found.plant, command, start=request.motion.start)
    inputs = [*command.values.tolist(), command.final_value]
    lines = [
        f"{tick},{tick * command.tick_s:.12g},{value!r},{reference!r}\n"
        for tick, (value, reference) in enumerate(zip(inputs, output.tolist(), strict=True))
    ]
    return "tick,time_s,command,reference\n" + "".join(lines)


def draw(request: InversionRequest) -> Figure:
    """Draw the command and the load."""
    from swayless.cli.profile_figures import move_title
    from swayless.report.profile import PlottedMove, move_figure

    command, motion = request.found.command, request.motion
    title = move_title(request.name, motion.start, motion.target, command)
    return move_figure(
        PlottedMove(title, request.found.plant, command, motion.start, motion.target, request.limits)
    )


def print_found(request: InversionRequest) -> None:
    """Print a command for a person: how long, and how far from the polynomial it leaves the load."""
    found, motion = request.found, request.motion
    command = found.command
    rows = [
        ("move", f"{motion.start:g} to {motion.target:g} in {motion.duration_s:g} s, order {motion.order}"),
        ("command", f"{command.values.min():.6g} to {command.values.max():.6g}"),
        (
            "lasts",
            f"{counted(command.values.size, 'tick')} of {command.tick_s:g} s, {command.duration_s:.6g} s",
        ),
        ("goes on with the load there", f"{found.post_action_s:.6g} s"),
        ("held at the end by", f"{command.final_value:.6g}"),
        ("load off the polynomial by", f"{found.deviation:.2g} at most, at the ticks"),
        ("misses rest by", f"{found.final_error_ratio:.1g} of the largest state"),
    ]
    if request.drive is not None:
        mode = request.drive.mode
        swing = f"{mode.frequency_hz:.6g} Hz, damping ratio {mode.damping_ratio:.4g}"
        rows.insert(1, ("the load swings at", swing))
    print_table(request.name, ("", "value"), rows)
    if found.truncation_bound:
        print_line(f"proved: what is cut off the command never exceeds {found.truncation_bound:.2g}")
