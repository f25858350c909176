"""`swayless design`: one shaper for one mode."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.options import JsonOption, Number

if TYPE_CHECKING:
    from swayless.cli.option_table import OptionTable
    from swayless.machine import DesignFile

_MODE_OPTIONS = ("frequency", "period", "rope_length")

FamilyArgument = Annotated[
    str,
    typer.Argument(
        metavar="FAMILY",
        help="zv zvd zvdd zvddd zvm ei ei2 ei3 mzv; with negative amplitudes um-zv um-zvd um-ei oatf.",
        show_default=False,
    ),
]
FrequencyOption = Annotated[
    str | None, typer.Option(metavar="HZ", help="Undamped natural frequency, such as 4.5 or '270 rpm'.")
]
PeriodOption = Annotated[
    str | None, typer.Option(metavar="S", help="Period as measured (damped), such as 5.4 or '220 ms'.")
]
RopeOption = Annotated[str | None, typer.Option(metavar="M", help="Rope length, such as 7.3 or '24 ft'.")]
DampingOption = Annotated[str, typer.Option(metavar="Z", help="Damping ratio, such as 0.02 or '2 %'.")]
ToleranceOption = Annotated[
    str, typer.Option(metavar="V", help="Residual vibration allowed, as a part of the unshaped one.")
]
OrderOption = Annotated[str | None, typer.Option(metavar="N", help="For zvm: how many derivatives vanish.")]
DelayOption = Annotated[str | None, typer.Option(metavar="S", help="For oatf: spacing of the impulses.")]
TickOption = Annotated[
    str | None,
    typer.Option(
        metavar="S", help="Tick of the controller, such as '10 ms': solve on its grid, for generated code."
    ),
]
SpeedOption = Annotated[
    str, typer.Option(metavar="V", help="Largest command of generated code, such as '40 m/min'.")
]
AccelerationOption = Annotated[
    str | None, typer.Option(metavar="A", help="Ramp before the shaper, in m/s2; no ramp unless given.")
]
TypeOption = Annotated[Number, typer.Option(help="Number type of generated code.")]
CountsOption = Annotated[
    str | None,
    typer.Option(
        "--counts-per-m-s",
        metavar="N",
        help="Commands are in counts, and N of them are 1 m/s; needed for int32.",
    ),
]
NameOption = Annotated[
    str | None, typer.Option(metavar="NAME", help="Prefix of generated symbols; the family unless given.")
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE.json", help="Design file to write.")
]


def design(
    family: FamilyArgument,
    frequency: FrequencyOption = None,
    period: PeriodOption = None,
    rope_length: RopeOption = None,
    damping: DampingOption = "0",
    tolerance: ToleranceOption = "5 %",
    order: OrderOption = None,
    delay: DelayOption = None,
    tick: TickOption = None,
    max_speed: SpeedOption = "1 m/s",
    acceleration: AccelerationOption = None,
    number: TypeOption = Number.double,
    counts_per_m_s: CountsOption = None,
    name: NameOption = None,
    output: OutputOption = None,
    json: JsonOption = False,
) -> None:
    """Design one shaper and say what it guarantees.

    Give the mode by exactly one of --frequency, --period and --rope-length. Values are numbers in SI, or
    numbers with a unit. With --tick the design holds taps, and `generate` and `verify` can use it.

    Examples
    --------
    swayless design ei --rope-length "24 ft" --tick "10 ms" -o ei.json
    swayless design zvd --frequency 4.5 --damping 0.02
    swayless design um-zv --period 5.4 --tolerance "5 %" --json
    """
    from swayless.cli.design_summary import print_design
    from swayless.machine import save_text, write_text_atomically

    row = {"family": family, "damping_ratio": damping, "tolerance": tolerance, "order": order, "delay": delay}
    mode = {"frequency": frequency, "period": period, "rope_length": rope_length}
    rest = {"tick": tick, "max_speed": max_speed, "acceleration": acceleration}
    made = _made(row | mode | rest, counts_per_m_s, name or family.replace("-", "_"), number.value)
    text = save_text(made)
    if output is not None:
        write_text_atomically(output, text)
    if json:
        typer.echo(text, nl=False)
        return
    print_design(made)
    if output is not None:
        typer.echo(f"{output}: written")


def _made(given: dict[str, str | None], counts_per_m_s: str | None, name: str, number: str) -> DesignFile:
    """Check every option with the checks of the machine file, then design."""
    from swayless.cli.option_table import option_table, refuse
    from swayless.machine.checks import machine_name
    from swayless.machine.controller_section import TICK, check_counts
    from swayless.machine.designing import design_mode
    from swayless.machine.drive_section import read_drive
    from swayless.machine.row_section import read_row

    problems: list[str] = []
    table = option_table(given, problems)
    counts = option_table({"counts_per_m_s": counts_per_m_s}, problems)
    row = read_row("crane", _row_options(table), damping_ratio=0.0)
    tick_s = table.take("tick", TICK, None)
    drive = read_drive("crane", table, counts)
    if drive is not None and number == "int32":
        check_counts(counts, drive)
    machine_name(name, table.place("name"))
    refuse(problems)
    assert row is not None  # noqa: S101 - where something is missing there is a problem
    assert drive is not None  # noqa: S101 - as above
    return design_mode(row, drive=drive, name=name, tick_s=tick_s, number=number)


def _row_options(table: OptionTable) -> OptionTable:
    """Options as a row of a machine file has them: a name, and a frequency in the place of a period."""
    from dataclasses import replace

    from swayless.design import FAMILIES

    family = table.raw["family"]
    raw = {key: value for key, value in table.raw.items() if key not in _MODE_OPTIONS}
    raw["name"] = family if family in FAMILIES else "unknown"
    given = [key for key in _MODE_OPTIONS if key in table.raw]
    if len(given) != 1:
        found = f"{' and '.join(table.place(key).path for key in given)} are" if given else "none is"
        options = ", ".join(table.place(key).path for key in _MODE_OPTIONS)
        table.report.problems.append(f"{options}: exactly one of them is needed, {found} given")
        raw["frequency"] = 1.0  # so that the other options are checked too
    elif given == ["period"]:
        raw["frequency"] = _frequency_of_period(table)
    else:
        raw[given[0]] = table.raw[given[0]]
    return replace(table, raw=raw)


def _frequency_of_period(table: OptionTable) -> float:
    """Undamped frequency, in Hz, of a damped period; 1 where an option is wrong, and so reported."""
    from swayless.cli.option_table import option_table
    from swayless.machine.checks import quantity
    from swayless.machine.plant_section import DAMPING
    from swayless.plant import Mode

    period_s = table.take("period", quantity("time", 1e-4, 1e3), None)
    damping_ratio = option_table({"damping_ratio": str(table.raw["damping_ratio"])}, []).take(
        "damping_ratio", DAMPING, None
    )
    if period_s is None or damping_ratio is None:
        return 1.0
    return Mode.from_damped_period(period_s, damping_ratio).frequency_hz
