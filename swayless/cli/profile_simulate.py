"""`swayless profile simulate`: a move on plants that are off, with and without a feedback."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.options import AxisOption, JsonOption
from swayless.cli.profile_optimal import (
    EiOption,
    FrequencyOption,
    LimitOption,
    RelaxOption,
    RobustOption,
    RopeOption,
    TargetOption,
    TickOption,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from swayless.cli.profile_loop import Move
    from swayless.design.optimal import Feedback, LinearPlant

FileArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE.toml",
        help="A profile file, one of an inversion, or a machine file with a crane.",
        show_default=False,
    ),
]
OffOption = Annotated[
    list[str] | None,
    typer.Option(
        "--off",
        metavar="R",
        help="Actual frequencies, of the nominal ones: 0.9 or '90 %'; may be given several times; 0.9 and 1.1"
        " unless given.",
    ),
]
FeedbackOption = Annotated[
    str | None,
    typer.Option(
        "--feedback",
        metavar="'P D'",
        help="Add a feedback on the trajectory: P times the difference, D times its slope in seconds.",
    ),
]
OutputOption = Annotated[
    list[Path] | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        help="Write command, trajectory and every run (.csv), or draw them (.svg, .png, .pdf); may be given"
        " several times.",
    ),
]

USUAL_OFF = (0.9, 1.1)
MOST_OFF = 12
"""Plants of one simulation: what a table and a figure can show."""


def simulate(
    file: FileArgument,
    off: OffOption = None,
    feedback: FeedbackOption = None,
    limit: LimitOption = None,
    tick: TickOption = None,
    target: TargetOption = None,
    robust: RobustOption = None,
    ei: EiOption = None,
    relax: RelaxOption = None,
    rope_length: RopeOption = None,
    frequency: FrequencyOption = None,
    axis: AxisOption = None,
    output: OutputOption = None,
    json: JsonOption = False,
) -> None:
    """Play a move on its plant, and on plants whose frequencies are off.

    The command goes through the exact plant from tick to tick, alone, and with a feedback that holds the
    plant to the trajectory that the command should make. Options replace what the file says.

    Examples
    --------
    swayless profile simulate move.toml --feedback "2 0.15" -o loop.svg
    swayless profile simulate move.toml --off 0.8 --off 1.2 --limit 4
    """
    from swayless.cli.console import print_json
    from swayless.cli.profile_figures import check_places, write_by_suffix
    from swayless.cli.profile_loop import NONE, draw_runs, simulated
    from swayless.cli.profile_loop_output import loop_document, loop_table, print_runs, title

    outputs = output or []
    check_places(outputs)
    ratios, closed = _read(off, feedback)
    options = {"limit": limit, "tick": tick, "target": target, "robust": robust, "ei": ei, "relax": relax}
    given = {**options, "rope_length": rope_length, "frequency": frequency}
    move = _move(file, {key: value for key, value in given.items() if value is not None}, axis, outputs)
    runs = simulated(move, _actual(move.plant, ratios), [NONE] if closed is None else [NONE, closed])
    write_by_suffix(outputs, lambda: loop_table(move, runs), lambda: draw_runs(move, title(move), runs))
    if json:
        print_json(loop_document(move, runs))
        return
    print_runs(move, runs)
    for path in outputs:
        typer.echo(f"{path}: written")


def _read(off: list[str] | None, feedback: str | None) -> tuple[tuple[float, ...] | None, Feedback | None]:
    """Read which plants, and which feedback."""
    from swayless.cli.option_table import option_table, refuse
    from swayless.design.optimal import Feedback
    from swayless.machine.checks import quantity, some
    from swayless.machine.profile_plant import coefficients

    problems: list[str] = []
    table = option_table({"off": off or None}, problems)
    ratios = table.take("off", some(quantity("ratio", 0.1, 10.0), at_most=MOST_OFF), None)
    gains = None if feedback is None else coefficients(feedback, table.place("feedback"))
    if gains is not None and (len(gains) != 2 or gains == (0.0, 0.0)):
        table.place("feedback").wrong(feedback, "must be two numbers, P and D, not both 0")
    refuse(problems)
    return ratios, None if gains is None else Feedback(*gains)


def _actual(plant: LinearPlant, ratios: tuple[float, ...] | None) -> list[float]:
    """Give the frequencies to play at, the nominal ones among them."""
    from swayless.cli.options import OptionError

    if ratios is not None and plant.ringing_poles_rad_s.size == 0:
        raise OptionError(["--off: nothing rings in this plant: no frequency can be off; leave it out"])
    return sorted({1.0, *(ratios or (USUAL_OFF if plant.can_be_off else ()))})


def _move(file: Path, options: Mapping[str, str], axis: str | None, outputs: Sequence[Path]) -> Move:
    """Find the command of a file, unless an output is what it was read from."""
    from swayless.cli.option_table import option_table
    from swayless.cli.profile_figures import check_apart
    from swayless.cli.profile_loop import Move
    from swayless.cli.profile_work import found_for
    from swayless.machine.inversion import asks_for_inversion
    from swayless.machine.profile_file import load_profile
    from swayless.machine.toml_source import read_toml

    if asks_for_inversion(read_toml(file)):
        check_apart(outputs, [file])
        return _inverted(file, [*options, *([] if axis is None else ["axis"])])
    request = load_profile(file, option_table(options, []).raw, axis=axis)
    check_apart(outputs, request.files)
    task = request.task
    command = found_for(request).command
    return Move(request.name, task.plant, command, task.limits, task.start, task.target)


def _inverted(file: Path, given: Sequence[str]) -> Move:
    """Find the command of a file that asks for an inversion."""
    from swayless.cli.option_table import refuse
    from swayless.cli.profile_loop import Move
    from swayless.machine.inversion import inverted_move

    refuse(
        [
            f"--{key.replace('_', '-')}: belongs to the fastest move; {file} asks for one by inversion"
            for key in given
        ]
    )
    found = inverted_move(file)
    return Move(found.name, found.plant, found.command, found.limits, found.start, found.target)
