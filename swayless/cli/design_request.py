"""From options to a design of one row: every option checked with the checks of the machine file.

Not for: which options a command has, or printing what was designed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from swayless.cli.option_table import OptionTable
    from swayless.machine import DesignFile


@dataclass(frozen=True)
class CodeRequest:
    """What generated code is made for, as options say it; None where one is not given.

    Parameters
    ----------
    tick, max_speed, acceleration, counts_per_m_s : str or None
        Quantities, unchecked.
    contactor : bool
        Whether the drive knows only 0 and full speed.
    number : str
        Number type.
    name : str
        Prefix of generated symbols, unchecked.
    """

    tick: str | None
    contactor: bool
    max_speed: str
    acceleration: str | None
    counts_per_m_s: str | None
    number: str
    name: str


def requested(row_options: OptionTable, code: CodeRequest) -> DesignFile:
    """Check every option, then design.

    Parameters
    ----------
    row_options : OptionTable
        Options as a row of a machine file has them; may have found problems already.
    code : CodeRequest
        The other options.

    Raises
    ------
    OptionError
        With every problem of every option.
    DesignError
        If the row cannot be designed as asked.
    """
    from swayless.cli.option_table import option_table, refuse
    from swayless.machine.checks import machine_name
    from swayless.machine.controller_section import TICK, check_counts
    from swayless.machine.designing import design_mode
    from swayless.machine.drive_section import read_drive
    from swayless.machine.row_section import read_row

    problems = row_options.report.problems
    row = read_row("crane", row_options, damping_ratio=0.0, contactor=code.contactor)
    given = {"tick": code.tick, "max_speed": code.max_speed, "acceleration": code.acceleration}
    table = option_table(given, problems)
    counts = option_table({"counts_per_m_s": code.counts_per_m_s}, problems)
    drive_table = replace(counts, raw={**counts.raw, "contactor": code.contactor})
    tick_s = table.take("tick", TICK, None)
    drive = read_drive("crane", table, drive_table)
    if drive is not None and code.number == "int32":
        check_counts(drive_table, drive)
    machine_name(code.name, table.place("name"))
    refuse(problems)
    assert row is not None  # noqa: S101 - where something is missing there is a problem
    assert drive is not None  # noqa: S101 - as above
    return design_mode(row, drive=drive, name=code.name, tick_s=tick_s, number=code.number)


def deliver(design: DesignFile, output: Path | None, *, json: bool, remarks: Sequence[str] = ()) -> None:
    """Write the design file where one is asked for, and print it or what it says.

    Parameters
    ----------
    design : DesignFile
        A design of one row.
    output : Path or None
        File to write.
    json : bool
        Whether to print the design file itself.
    remarks : sequence of str
        What else there is to say to a person.
    """
    from swayless.cli.design_summary import print_design
    from swayless.machine import save_text, write_text_atomically

    text = save_text(design)
    if output is not None:
        write_text_atomically(output, text)
    if json:
        typer.echo(text, nl=False)
        return
    print_design(design, remarks)
    if output is not None:
        typer.echo(f"{output}: written")
