"""`swayless design`: one shaper for one mode."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.options import JsonOption, Number, quantity

if TYPE_CHECKING:
    from swayless.machine import DesignFile, ShaperRecord
    from swayless.plant import Mode


def design(
    family: Annotated[
        str,
        typer.Argument(
            metavar="FAMILY",
            help="zv zvd zvdd zvddd zvm ei ei2 ei3 mzv um-zv um-zvd um-ei oatf",
            show_default=False,
        ),
    ],
    frequency: Annotated[
        float | None,
        typer.Option(parser=quantity("frequency"), metavar="HZ", help="Undamped natural frequency.", show_default=False),
    ] = None,
    period: Annotated[
        float | None,
        typer.Option(parser=quantity("time"), metavar="S", help="Measured (damped) period.", show_default=False),
    ] = None,
    rope_length: Annotated[
        float | None,
        typer.Option(parser=quantity("length"), metavar="M", help="Rope length, such as 7.3 or '24 ft'.", show_default=False),
    ] = None,
    damping: Annotated[float, typer.Option(parser=quantity("ratio"), metavar="Z", help="Damping ratio.")] = "0",  # type: ignore[assignment]
    tolerance: Annotated[
        float,
        typer.Option(parser=quantity("ratio"), metavar="V", help="Residual vibration allowed, such as 0.05 or '5 %'."),
    ] = "5 %",  # type: ignore[assignment]
    order: Annotated[int | None, typer.Option(min=0, help="Order of zvm.", show_default=False)] = None,
    delay: Annotated[
        float | None,
        typer.Option(parser=quantity("time"), metavar="S", help="Delay of oatf.", show_default=False),
    ] = None,
    tick: Annotated[
        float | None,
        typer.Option(
            parser=quantity("time"),
            metavar="S",
            help="Tick of the controller: solve on its grid, so that code can be generated.",
            show_default=False,
        ),
    ] = None,
    max_speed: Annotated[
        float, typer.Option(parser=quantity("speed"), metavar="V", help="Largest command, for generated code.")
    ] = "1 m/s",  # type: ignore[assignment]
    acceleration: Annotated[
        float | None,
        typer.Option(
            parser=quantity("acceleration"), metavar="A", help="Ramp before the shaper; none unless given.", show_default=False
        ),
    ] = None,
    number: Annotated[Number, typer.Option("--number", help="Number type of generated code.")] = Number.double,
    counts_per_m_s: Annotated[
        float | None,
        typer.Option("--counts-per-m-s", metavar="N", help="Counts of 1 m/s, for int32.", show_default=False),
    ] = None,
    name: Annotated[
        str | None,
        typer.Option("--name", help="Prefix of generated symbols; the family unless given.", show_default=False),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.json", help="Design file to write.", show_default=False)
    ] = None,
    json: JsonOption = False,
) -> None:
    """Design one shaper and say what it guarantees.

    Give the mode by exactly one of --frequency, --period and --rope-length. Values are in SI, or carry a unit.

    Examples:

      swayless design ei --rope-length "24 ft" --tick "10 ms" -o ei.json

      swayless design zvd --frequency 4.5 --damping 0.02

      swayless design um-zv --period 5.4 --tolerance "5 %" --json
    """
    from swayless.cli.console import print_json
    from swayless.machine import save_text, write_text_atomically
    from swayless.machine.designing import design_mode
    from swayless.machine.drive_section import DriveSection
    from swayless.machine.row_section import RowSection

    mode = _mode(frequency, period, rope_length, damping)
    row = RowSection(family, family, mode, rope_length, tolerance, order, delay)
    drive = DriveSection(
        "m/s", counts_per_m_s, max_speed, acceleration, acceleration, acceleration, 0.0, 0.0, 0.0
    )
    made = design_mode(row, drive=drive, name=name or family.replace("-", "_"), tick_s=tick, number=number.value)
    text = save_text(made)
    if output is not None:
        write_text_atomically(output, text)
    if json:
        import json as json_module

        print_json(json_module.loads(text))
        return
    _print(made)
    if output is not None:
        typer.echo(f"{output}: written")


def _mode(
    frequency_hz: float | None, period_s: float | None, rope_length_m: float | None, damping_ratio: float
) -> Mode:
    from swayless.plant import Mode, pendulum_mode

    if sum(value is not None for value in (frequency_hz, period_s, rope_length_m)) != 1:
        raise typer.BadParameter("give the mode by exactly one of --frequency, --period and --rope-length")
    if frequency_hz is not None:
        return Mode(frequency_hz, damping_ratio)
    if period_s is not None:
        return Mode.from_damped_period(period_s, damping_ratio)
    assert rope_length_m is not None  # noqa: S101 - exactly one is given
    return pendulum_mode(rope_length_m, damping_ratio)


def _print(design: DesignFile) -> None:
    from swayless.cli.console import print_table

    shaper = design.shapers[0]
    mode = f"{shaper.mode.frequency_hz:.6g} Hz, damping ratio {shaper.mode.damping_ratio:g}"
    impulses = [
        (f"{time:.9g}", f"{amplitude:.9g}") for time, amplitude in zip(shaper.times_s, shaper.amplitudes, strict=True)
    ]
    print_table(f"{shaper.family} for {mode}", ("time [s]", "amplitude"), impulses, _summary(shaper))
    if shaper.taps is not None:
        taps = [
            (f"{delay}", f"{amplitude:.12g}")
            for delay, amplitude in zip(shaper.taps.delays_ticks, shaper.taps.amplitudes, strict=True)
        ]
        print_table(f"on ticks of {design.tick_s:g} s", ("delay [ticks]", "amplitude"), taps, _summary(shaper, on_grid=True))


def _summary(shaper: ShaperRecord, *, on_grid: bool = False) -> str:
    part = shaper.taps if on_grid and shaper.taps is not None else shaper
    held = part.guarantee
    (low_hz, high_hz), (low_m, high_m) = held.frequency_hz, held.rope_length_m
    return (
        f"holds {100 * held.tolerance:g} % from {low_hz:.6g} to {high_hz:.6g} Hz (rope {low_m:.4g} to {high_m:.4g} m)\n"
        f"duration {part.duration_s:.6g} s, overtravel {part.overtravel_s:.6g} m per m/s, "
        f"peak factor {sum(map(abs, part.amplitudes)):.6g}"
    )
