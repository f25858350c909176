"""`swayless design FAMILY`: one shaper for one mode."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.design_options import (
    COMMANDS,
    AccelerationOption,
    ContactorOption,
    CountsOption,
    NameOption,
    OutputOption,
    SpeedOption,
    TickOption,
    ToleranceOption,
    TypeOption,
)
from swayless.cli.options import JsonOption, Number

if TYPE_CHECKING:
    from swayless.cli.option_table import OptionTable, Texts

FAMILY = "FAMILY"
"""Name of the command in the list of the group; what stands in its place is the family."""

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
OrderOption = Annotated[str | None, typer.Option(metavar="N", help="For zvm: how many derivatives vanish.")]
DelayOption = Annotated[str | None, typer.Option(metavar="S", help="For oatf: spacing of the impulses.")]


def design_family(
    family: FamilyArgument,
    frequency: FrequencyOption = None,
    period: PeriodOption = None,
    rope_length: RopeOption = None,
    damping: DampingOption = "0",
    tolerance: ToleranceOption = "5 %",
    order: OrderOption = None,
    delay: DelayOption = None,
    tick: TickOption = None,
    contactor: ContactorOption = False,
    max_speed: SpeedOption = "1 m/s",
    acceleration: AccelerationOption = None,
    number: TypeOption = Number.double,
    counts_per_m_s: CountsOption = None,
    name: NameOption = None,
    output: OutputOption = None,
    json: JsonOption = False,
) -> None:
    """Design a shaper of a family, for one mode.

    Give the mode by exactly one of --frequency, --period and --rope-length. Values are numbers in SI, or
    numbers with a unit. With --tick the design holds taps, and `generate` and `verify` can use it.

    Examples
    --------
    swayless design ei --rope-length "24 ft" --tick "10 ms" -o ei.json
    swayless design zvd --frequency 4.5 --damping 0.02
    swayless design um-zv --period 5.4 --tolerance "5 %" --json
    """
    from swayless.cli.design_request import CodeRequest, deliver, requested
    from swayless.cli.option_table import option_table, the_one_given

    problems: list[str] = []
    row: dict[str, Texts | None] = {"family": family, "damping_ratio": damping, "tolerance": tolerance}
    row |= {"order": order, "delay": delay}
    mode = {"--frequency": frequency, "--period": period, "--rope-length": rope_length}
    given = the_one_given(mode, problems)
    where: dict[str, Texts | None] = {"frequency": "1.0"}  # so that the rest is checked
    if given is not None:
        where = {given.strip("-").replace("-", "_"): mode[given]}
    prefix = name or family.replace("-", "_")
    code = CodeRequest(tick, contactor, max_speed, acceleration, counts_per_m_s, number.value, prefix)
    made = requested(_row_options(option_table(row | where, problems)), code)
    deliver(made, output, json=json)


def _row_options(table: OptionTable) -> OptionTable:
    """Options as a row of a machine file has them: a name, and a frequency in the place of a period.

    What is wrong is reported, and replaced so that the other options are checked too.
    """
    from swayless.design import FAMILIES

    raw = dict(table.raw)
    if raw["family"] not in FAMILIES:
        table.place("family").wrong(raw["family"], _unknown(str(raw["family"])))
        raw = {key: raw[key] for key in raw.keys() - {"order", "delay"}} | {"family": "zv"}
    if raw.pop("period", None) is not None:
        raw["frequency"] = _frequency_of_period(table)
    return replace(table, raw=raw | {"name": raw["family"]})


def _unknown(family: str) -> str:
    from swayless.design import FAMILIES
    from swayless.machine.problems import nearest

    if family in COMMANDS:
        return f"is a command of its own, and stands first: swayless design {family} ..."
    return f"unknown family; {nearest(family, [*FAMILIES, *COMMANDS])}"


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
