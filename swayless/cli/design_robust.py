"""`swayless design si` and `swayless design fd`: the best shaper for a range, with the proof that it is.

Not for: several rows that share a range (`swayless.cli.design_bank`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.design_options import (
    AccelerationOption,
    AmplitudesOption,
    ContactorOption,
    CountsOption,
    ImpulsesOption,
    NameOption,
    OutputOption,
    SpeedOption,
    TickOption,
    ToleranceOption,
    TypeOption,
)
from swayless.cli.options import JsonOption, Number

if TYPE_CHECKING:
    from swayless.cli.option_table import Texts


BandOption = Annotated[
    list[str],
    typer.Option(
        metavar="LOW HIGH",
        help="Frequencies to hold, in Hz or with units; once for each mode.",
        show_default=False,
    ),
]
RopesOption = Annotated[
    str | None,
    typer.Option(metavar="SHORT LONG", help="Rope lengths to hold, such as 9ft 29ft; instead of --band."),
]
FromOption = Annotated[
    str,
    typer.Option(
        "--from",
        metavar="ROPE|HZ",
        help="Where the range begins: the longest rope or the lowest frequency, with its unit.",
        show_default=False,
    ),
]
DurationOption = Annotated[
    str, typer.Option(metavar="S", help="Duration of the shaper, in s.", show_default=False)
]
DampingOption = Annotated[
    str, typer.Option(metavar="Z", help="Damping ratio of every mode, 0 to 0.2, such as 0.02 or '2 %'.")
]
DampingRangeOption = Annotated[
    str,
    typer.Option(metavar="Z [HIGH]", help="Damping ratio, 0 to 0.2, or the lowest and the highest: 0 0.05."),
]


def si(
    band: BandOption = [],  # noqa: B006 - typer copies it
    rope_length: RopesOption = None,
    damping: DampingRangeOption = "0",
    tolerance: ToleranceOption = "5 %",
    amplitudes: AmplitudesOption = None,
    impulses: ImpulsesOption = None,
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
    """Design the shortest shaper that holds a range, proved.

    Specified insensitivity: at most the tolerance is left anywhere in the range. A lower bound comes with it,
    below which no shaper with such amplitudes holds the range. The amplitudes that are not positive are
    faster, and let a new command wait until the last one has come to rest. A range reads LOW HIGH, LOW:HIGH
    or "LOW to HIGH".

    Examples
    --------
    swayless design si --band 0.17 0.30 --tolerance "5 %"
    swayless design si --rope-length 9ft 29ft --amplitudes bounded
    swayless design si --band 0.2 0.25 --band 0.8 1 --damping 0 0.02
    swayless design si --rope-length 9ft 29ft --tick "10 ms" -o si.json
    """
    from swayless.cli.design_request import CodeRequest, deliver, requested
    from swayless.cli.option_table import option_table
    from swayless.cli.ranges import ends
    from swayless.cli.several_modes import savings

    problems: list[str] = []
    row: dict[str, Texts | None] = {
        "name": "si",
        "family": "si",
        "damping_ratio": ends(damping),
        "tolerance": tolerance,
        "amplitudes": amplitudes and amplitudes.value,
        "impulses": impulses,
    }
    where = _where_to_hold(band, rope_length, problems)
    code = CodeRequest(tick, contactor, max_speed, acceleration, counts_per_m_s, number.value, name or "si")
    made = requested(
        option_table(row | where, problems, called={"frequency": "--band", "bands": "--band"}), code
    )
    deliver(made, output, json=json, remarks=[] if json else savings(made))


def fd(
    duration: DurationOption,
    start: FromOption,
    damping: DampingOption = "0",
    tolerance: ToleranceOption = "5 %",
    amplitudes: AmplitudesOption = None,
    impulses: ImpulsesOption = None,
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
    """Design the shaper of a given duration that reaches farthest.

    Fixed duration: at most the tolerance is left from the longest rope, or the lowest frequency, up as far as
    any shaper of the duration and such amplitudes can hold it. Several of them, each one from where the last
    one ends, are a bank: `swayless design bank` makes it.

    Examples
    --------
    swayless design fd --duration 3.0 --from 29ft --tolerance "5 %"
    swayless design fd --duration 2.5 --from "0.2 Hz" --amplitudes bounded
    """
    from swayless.cli.design_request import CodeRequest, deliver, requested
    from swayless.cli.option_table import option_table

    problems: list[str] = []
    row: dict[str, Texts | None] = {
        "name": "fd",
        "family": "fd",
        "duration": duration,
        "damping_ratio": damping,
        "tolerance": tolerance,
        "amplitudes": amplitudes and amplitudes.value,
        "impulses": impulses,
    }
    where = _where_to_start(start, problems)
    code = CodeRequest(tick, contactor, max_speed, acceleration, counts_per_m_s, number.value, name or "fd")
    made = requested(option_table(row | where, problems, called=dict.fromkeys(where, "--from")), code)
    deliver(made, output, json=json)


def _where_to_hold(band: list[str], rope_length: str | None, problems: list[str]) -> dict[str, Texts]:
    """Keys of a row that say where it is to hold; where options do not, any, so that the rest is checked."""
    from swayless.cli.option_table import the_one_given
    from swayless.cli.ranges import ends

    given = the_one_given({"--band": band, "--rope-length": rope_length}, problems)
    if given is None:
        return {"frequency": ["1", "2"]}
    if rope_length is not None:
        return {"rope_length": ends(rope_length)}
    bands = [ends(text) for text in band]
    return {"frequency": bands[0]} if len(bands) == 1 else {"bands": bands}


def _where_to_start(start: str, problems: list[str]) -> dict[str, Texts]:
    """Keys of a row that say where it is to start: a rope or a frequency, told apart by the unit."""
    from swayless.machine.problems import shown
    from swayless.machine.quantity import UNITS

    lengths, frequencies = UNITS["length"], UNITS["frequency"]
    unit = start.strip().lstrip("+-.0123456789 ")
    if unit in lengths:
        return {"rope_length": start}
    if unit in frequencies:
        return {"frequency": start}
    allowed = f"{', '.join(lengths)} for the longest rope, {', '.join(frequencies)} for the lowest frequency"
    problems.append(f"--from = {shown(start)}: needs a unit: {allowed}")
    return {"frequency": "1"}
