"""What `swayless profile simulate` prints and writes: words, JSON, and a table of ticks. Not for: playing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from swayless.cli.console import counted, per_cent, print_line, print_table
from swayless.cli.profile_figures import move_title
from swayless.cli.profile_loop import Move, Run


def loop_document(move: Move, runs: Sequence[Run]) -> dict[str, Any]:
    """Give command, trajectory and every run, for machines."""
    command = move.command
    return {
        "name": move.name,
        "tick_s": command.tick_s,
        "ticks": command.values.size,
        "initial_value": command.initial_value,
        "command": command.values.tolist(),
        "final_value": command.final_value,
        "reference": move.reference.tolist(),
        "start": move.start,
        "target": move.target,
        "limit": list(move.limits),
        "later_s": move.later_ticks * command.tick_s,
        "runs": [_run_document(run) for run in runs],
    }


def _run_document(run: Run) -> dict[str, Any]:
    return {
        "frequency_ratio": run.frequency_ratio,
        "proportional": run.feedback.proportional,
        "derivative_s": run.feedback.derivative_s,
        "farthest_on_the_way": run.farthest,
        "left": run.left,
        "left_later": run.left_later,
        "lowest_input": float(run.input.min()),
        "highest_input": float(run.input.max()),
        "limit_share_ratio": run.share,
        "output": run.output.tolist(),
        "input": run.input.tolist(),
    }


def loop_table(move: Move, runs: Sequence[Run]) -> str:
    """Give feedforward, reference, and input and output of every run: CSV, one line a tick."""
    command, reference = move.command, move.reference
    count = runs[0].output.size
    columns = [
        _held(command.values, command.final_value, count),
        _held(reference, reference[-1], count),
        *(values for run in runs for values in (run.input, run.output)),
    ]
    names = [f"{what}_{_column(run)}" for run in runs for what in ("input", "output")]
    lines = [
        f"{tick},{tick * command.tick_s:.12g},{','.join(map(repr, row))}\n"
        for tick, row in enumerate(np.column_stack(columns).tolist())
    ]
    return ",".join(["tick", "time_s", "command", "reference", *names]) + "\n" + "".join(lines)


def _held(values: np.ndarray[Any, Any], last: float, count: int) -> np.ndarray[Any, Any]:
    return np.append(values, np.full(count - values.size, last))


def _column(run: Run) -> str:
    """Name a run in the head of a table, such as ``0.9_feedback``."""
    return f"{run.frequency_ratio:g}_{'feedback' if run.with_feedback else 'feedforward'}"


def print_runs(move: Move, runs: Sequence[Run]) -> None:
    """Print what came of a move, for a person."""
    heads = ("frequencies", "moved by", "on the way", "left", "later", "input", "of the limits")
    print_table(title(move), heads, [_row(run) for run in runs])
    later_s = move.later_ticks * move.command.tick_s
    print_line(
        "on the way: farthest from the trajectory until the command ends; left: farthest from the target at"
        f" any tick after it; later: the same from {later_s:.4g} s after its end on"
    )
    passing = [run for run in runs if run.share > 1.0 + 1e-9]
    if passing:
        most = max(passing, key=lambda run: run.share)
        print_line(
            f"note: the feedback asks for more than the limits of {move.limits[0]:g} to {move.limits[1]:g} in"
            f" {counted(len(passing), 'run')}, {most.label} for {per_cent(most.share, 4)}; the plant was"
            " simulated without them: a lower limit for the command leaves the feedback its share"
        )


def title(move: Move) -> str:
    """Name a move."""
    return move_title(move.name, move.start, move.target, move.command)


def _row(run: Run) -> tuple[str, ...]:
    return (
        run.label,
        "feedback too" if run.with_feedback else "command alone",
        *(f"{value:.3g}" if value > 1e-8 else "0" for value in (run.farthest, run.left, run.left_later)),
        f"{run.input.min():.4g} to {run.input.max():.4g}",
        per_cent(run.share, 4),
    )
