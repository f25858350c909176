"""`swayless design bank`: rows that cover the whole range of a machine, each as wide as any can be.

Not for: code or figures; `swayless.cli.build` makes those from the same file.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.design_options import AmplitudesOption, ImpulsesOption, OutputOption
from swayless.cli.options import AxisOption, JsonOption, MachineArgument

if TYPE_CHECKING:
    from swayless.machine import Machine

_OPTION = re.compile(r"^.*?: bank option (\w+)")
"""How a problem of `load_machine` names an option."""

BankToleranceOption = Annotated[
    str | None,
    typer.Option(metavar="V", help="Residual vibration allowed: as few rows as it allows. Or --rows."),
]
RowsOption = Annotated[
    str | None, typer.Option(metavar="N", help="So many rows, at the smallest tolerance equal for all.")
]
DurationOption = Annotated[str | None, typer.Option(metavar="S", help="Duration of every row.")]
LongestOption = Annotated[
    str | None, typer.Option(metavar="S", help="Duration of every row but the last, which may be shorter.")
]
HysteresisOption = Annotated[
    str | None, typer.Option(metavar="M", help="Neighbours overlap at least so far, in m of rope or in Hz.")
]
LabelStepOption = Annotated[
    str | None, typer.Option(metavar="M", help="Switching lengths are whole multiples of it, such as 1ft.")
]


def bank(
    machine: MachineArgument,
    tolerance: BankToleranceOption = None,
    rows: RowsOption = None,
    duration: DurationOption = None,
    longest_duration: LongestOption = None,
    amplitudes: AmplitudesOption = None,
    impulses: ImpulsesOption = None,
    hysteresis: HysteresisOption = None,
    label_step: LabelStepOption = None,
    axis: AxisOption = None,
    output: OutputOption = None,
    json: JsonOption = False,
) -> None:
    """Design the rows that cover the range of a machine.

    Each row starts where the one before ends and holds as much as any shaper of its duration can: the fewest
    rows for a tolerance, or the smallest equal tolerance for a number of rows. Options stand in for the keys
    of [bank]; [[row]] sections are left aside. Prints the label of every knob position, and where to switch.

    Examples
    --------
    swayless design bank crane.toml
    swayless design bank crane.toml --tolerance "5 %" --duration 3.0
    swayless design bank crane.toml --rows 3 --duration 3.0 -o bank.json
    """
    from swayless.cli.bank_summary import print_bank
    from swayless.cli.console import progress
    from swayless.machine import save_text, write_text_atomically
    from swayless.machine.designing import design_machine

    given = {
        "tolerance": tolerance,
        "rows": rows,
        "duration": duration,
        "longest_duration": longest_duration,
        "amplitudes": amplitudes and amplitudes.value,
        "impulses": impulses,
        "hysteresis": hysteresis,
        "label_step": label_step,
    }
    described = _machine(machine, {key: value for key, value in given.items() if value is not None}, axis)
    with progress() as show:
        made = design_machine(described, on_row=lambda name: show(f"designing {name}"))
    text = save_text(made)
    if output is not None:
        write_text_atomically(output, text)
    if json:
        typer.echo(text, nl=False)
        return
    assert made.bank is not None  # noqa: S101 - the machine was loaded with a bank
    print_bank(made, made.bank)
    if output is not None:
        typer.echo(f"{output}: written")


def _machine(path: Path, options: dict[str, str], axis: str | None) -> Machine:
    """Load a machine with a bank: its own, or that of the options in the place of its rows."""
    from swayless.cli.option_table import refuse
    from swayless.errors import FileError
    from swayless.machine import load_machine

    if not options:
        described = load_machine(path, axis=axis)
        if described.bank is None:
            hint = "say which bank to design, for instance --tolerance '5 %' --duration 3.0"
            refuse([f"{path}: has rows of its own and no [bank]; {hint}"])
        return described
    try:
        return load_machine(path, options, axis=axis)
    except FileError as error:
        raise FileError([_OPTION.sub(_as_option, problem) for problem in error.problems]) from error


def _as_option(found: re.Match[str]) -> str:
    return f"--{found[1].replace('_', '-')}"
