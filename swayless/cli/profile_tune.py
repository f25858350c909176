"""`swayless profile tune`: the parameters of a drive corrected by a measured move, and the next command."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from swayless.cli.options import JsonOption

if TYPE_CHECKING:
    from collections.abc import Sequence

    from swayless.design.inversion import Doubt, MeasuredMove, Step
    from swayless.machine.inversion_file import InversionRequest
    from swayless.plant.elastic_drive import ElasticDrive


class StepName(StrEnum):
    """Steps from one estimate to the next."""

    scaled = "scaled"
    paper = "paper"


RecordsArgument = Annotated[
    list[Path],
    typer.Argument(
        metavar="RECORD.csv...",
        help="Measured moves under the command of the file: time_s, position, and command if recorded.",
        show_default=False,
    ),
]
MachineOption = Annotated[
    Path,
    typer.Option("--machine", metavar="FILE.toml", help="Whose command was played.", show_default=False),
]
StepOption = Annotated[
    StepName,
    typer.Option("--step", help="scaled: Gauss-Newton, searched on the record; paper: down the gradient."),
]
ColumnOption = Annotated[
    str | None,
    typer.Option("--column", metavar="NAME", help="Head of the load positions, where it is not 'position'."),
]
OutputOption = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE.toml",
        help="Write the file with the next parameters here, instead of over --machine.",
    ),
]
CommandOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--command",
        metavar="FILE",
        help="Write the next command (.csv), or draw it (.svg, .png, .pdf); may be given several times.",
    ),
]

UNSEEN = "load_mass shows only in damping / load_mass and stiffness / load_mass: judge by these two"


def tune(
    records: RecordsArgument,
    machine: MachineOption,
    step: StepOption = StepName.scaled,
    column: ColumnOption = None,
    output: OutputOption = None,
    command: CommandOption = None,
    json: JsonOption = False,
) -> None:
    """Correct a drive by what its load did under the command of its file, and give the next command.

    One experiment at a time: play the command, record the load, tune, play the next one. Several records are
    repetitions of one command. The parameters of motor, load and transmission are written into the file,
    whose comments stay.

    Examples
    --------
    swayless profile tune measured.csv --machine servo.toml --command next.csv
    swayless profile tune measured.csv --machine servo.toml --step paper -o next.toml
    """
    from swayless.cli.console import print_json
    from swayless.cli.profile_figures import check_apart, check_places, write_by_suffix
    from swayless.cli.profile_inversion_output import draw, trajectory_text
    from swayless.machine.inversion_file import load_inversion
    from swayless.machine.inversion_record import read_move
    from swayless.machine.inversion_text import rounded, text_with_drive, with_drive
    from swayless.machine.writing import write_text_atomically

    commands, target = command or [], output or machine
    check_places(commands)
    check_apart([target, *commands], records)
    check_apart(commands, [machine])
    request = load_inversion(machine)
    drive = _drive(request)
    moves = [read_move(path, request, column=column) for path in records]
    doubt, taken = _checked(records, request, moves), _step(step, request, moves)
    next_drive = rounded(taken.drive)
    following = with_drive(request, next_drive)
    text = text_with_drive(machine, next_drive)
    facts = _facts(step, request, moves, taken)
    table = trajectory_text(following)
    write_text_atomically(target, text)
    write_by_suffix(commands, lambda: table, lambda: draw(following))
    if json:
        doubted = None if doubt is None else {doubt.what: doubt.size}
        print_json({**_document(facts, drive, following), "doubt": doubted})
        return
    _print_tuned(facts, drive, next_drive, doubt)
    for path in (target, *commands):
        typer.echo(f"{path}: written")


def _drive(request: InversionRequest) -> ElasticDrive:
    """Give the drive of a file; a transfer function has no parameters to correct."""
    from swayless.errors import FileError

    if request.drive is None:
        raise FileError([f"{request.file}: [drive]: missing: a [plant] has no parameters to correct"])
    return request.drive


def _checked(
    records: Sequence[Path], request: InversionRequest, moves: Sequence[MeasuredMove]
) -> Doubt | None:
    """Refuse records that no drive explains, and say what is doubtful in others."""
    from swayless.design.inversion import check_explained
    from swayless.errors import DesignError

    try:
        return check_explained(_drive(request), request.motion, moves)
    except DesignError as error:
        raise DesignError(f"{', '.join(map(str, records))}: {error}") from error


def _step(step: StepName, request: InversionRequest, moves: Sequence[MeasuredMove]) -> Step:
    """Take the step that was asked for."""
    from swayless.cli.console import progress
    from swayless.design.inversion import paper_step, scaled_step
    from swayless.errors import DesignError

    with progress() as show:
        show("explaining the moves")
        try:
            return {StepName.scaled: scaled_step, StepName.paper: paper_step}[step](
                _drive(request), request.motion, moves
            )
        except DesignError as error:
            raise DesignError(f"{request.file}: [drive] {error}") from error


def _facts(
    step: StepName, request: InversionRequest, moves: Sequence[MeasuredMove], taken: Step
) -> dict[str, Any]:
    """Say what was measured, and what is expected."""
    import numpy as np

    from swayless.design.inversion import cost

    return {
        "name": request.name,
        "step": str(step),
        "records": len(moves),
        "largest_error": max(float(np.abs(move.error(request.motion)).max()) for move in moves),
        "cost": cost(request.motion, moves),
        "expected_cost": taken.expected_cost,
    }


def _ratios(drive: ElasticDrive) -> dict[str, float]:
    """Give what a motion shows of the transmission."""
    return {
        "damping / load_mass": drive.damping / drive.load_mass,
        "stiffness / load_mass": drive.stiffness / drive.load_mass,
    }


def _values(drive: ElasticDrive) -> dict[str, float]:
    """Give the parameters by name."""
    from swayless.plant.elastic_drive import TUNED

    return dict(zip(TUNED, drive.tuned.tolist(), strict=True))


def _document(facts: dict[str, Any], before: ElasticDrive, following: InversionRequest) -> dict[str, Any]:
    """Give what was found, and the next command, for machines."""
    from swayless.cli.profile_inversion_output import document

    after = _drive(following)
    return {
        **facts,
        "before": {**_values(before), **_ratios(before)},
        "after": {**_values(after), **_ratios(after)},
        "not_identifiable": UNSEEN,
        **document(following),
    }


def _print_tuned(
    facts: dict[str, Any], before: ElasticDrive, after: ElasticDrive, doubt: Doubt | None
) -> None:
    """Print what was measured, and what was corrected."""
    from swayless.cli.console import counted, print_line, print_table

    measured = [
        ("load off its motion by", f"{facts['largest_error']:.4g} at most"),
        ("cost", f"{facts['cost']:.4g}"),
        ("cost left unexplained", f"{facts['expected_cost']:.4g}"),
    ]
    print_table(f"{facts['name']}: {counted(facts['records'], 'record')}", ("", "value"), measured)
    old, new = ({**_values(drive), **_ratios(drive)} for drive in (before, after))
    rows = [(name, f"{old[name]:.4g}", f"{new[name]:.4g}") for name in old]
    print_table(f"{facts['step']} step", ("parameter", "before", "after"), rows)
    print_line(f"note: {UNSEEN}")
    if doubt is not None:
        print_line(
            f"note: {doubt} in the record would explain most of what stays unexplained: if it is in the"
            " sensor, correct the record, as parameters are bent by it"
        )
    elif facts["step"] == StepName.scaled and facts["expected_cost"] > 0.9 * facts["cost"]:
        print_line(
            "note: no parameters explain the rest: noise, or what the model does not know; tuning is done"
        )
