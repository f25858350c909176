"""`swayless profile optimal`: the fastest or the smoothest move of a linear plant within its limits."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from swayless.cli.options import AxisOption, JsonOption

FileArgument = Annotated[
    Path | None,
    typer.Argument(
        metavar="FILE.toml", help="A profile file, or a machine file with a crane.", show_default=False
    ),
]
NumeratorOption = Annotated[
    str | None,
    typer.Option("--numerator", metavar="'B ... B'", help="Of the plant, falling powers of s: '1'."),
]
DenominatorOption = Annotated[
    str | None,
    typer.Option("--denominator", metavar="'A ... A'", help="Of the plant: '0.01 0 1'."),
]
LimitOption = Annotated[
    str | None,
    typer.Option("--limit", metavar="U", help="Of the input: '5' either way, or '-1 3'."),
]
RateOption = Annotated[
    str | None, typer.Option("--rate-limit", metavar="R", help="Largest change of the input per second.")
]
TickOption = Annotated[
    str | None, typer.Option("--tick", metavar="S", help="Tick of the controller, such as '5 ms'.")
]
StartOption = Annotated[
    str | None, typer.Option("--start", metavar="Y", help="Output before the move; 0 unless given.")
]
TargetOption = Annotated[
    str | None, typer.Option("--target", metavar="Y", help="Output after the move; of a crane in m.")
]
RobustOption = Annotated[
    str | None,
    typer.Option("--robust", metavar="M", help="Derivatives of the vibration that vanish too, 0 to 6."),
]
EiOption = Annotated[
    str | None,
    typer.Option("--ei", metavar="G", help="Instead: nothing is left so far off on either side: '10 %'."),
]
RelaxOption = Annotated[
    str | None,
    typer.Option("--relax", metavar="K", help="The least energy in K times the fewest ticks, K >= 1."),
]
TrackOption = Annotated[
    str | None,
    typer.Option("--track", metavar="FILE.csv", help="Follow these outputs, one a tick from tick 1 on."),
]
ToleranceOption = Annotated[
    str | None, typer.Option("--tolerance", metavar="E", help="How near to --track the output stays.")
]
RopeOption = Annotated[
    str | None, typer.Option("--rope-length", metavar="M", help="Rope of the crane during the move.")
]
FrequencyOption = Annotated[
    str | None, typer.Option("--frequency", metavar="HZ", help="Of the load, in the place of a rope length.")
]
OutputOption = Annotated[
    list[Path] | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        help="Write command and trajectory, one line a tick (.csv), draw them (.svg, .png, .pdf), or both"
        " with what is proved (.html); may be given several times.",
    ),
]


def optimal(
    file: FileArgument = None,
    numerator: NumeratorOption = None,
    denominator: DenominatorOption = None,
    limit: LimitOption = None,
    rate_limit: RateOption = None,
    tick: TickOption = None,
    start: StartOption = None,
    target: TargetOption = None,
    robust: RobustOption = None,
    ei: EiOption = None,
    relax: RelaxOption = None,
    track: TrackOption = None,
    tolerance: ToleranceOption = None,
    rope_length: RopeOption = None,
    frequency: FrequencyOption = None,
    axis: AxisOption = None,
    output: OutputOption = None,
    json: JsonOption = False,
) -> None:
    """Find the command that moves a plant from rest to rest in the fewest ticks.

    The plant is a transfer function or a state space, in a profile file, or the load of a crane, from its
    machine file. Options replace what the file says. What is found is proved: it rests at the end, and one
    tick less cannot keep the limits.

    Examples
    --------
    swayless profile optimal move.toml --relax 1.5 -o move.csv -o move.svg
    swayless profile optimal crane.toml --rope-length "6 m" --target 12 --robust 1
    swayless profile optimal --numerator 1 --denominator "1 0" --limit 2 --tick 0.1 --target 3
    """
    from swayless.cli.console import print_json
    from swayless.cli.option_table import option_table
    from swayless.cli.profile_figures import check_apart, check_places, draw_move, write_by_suffix, write_page
    from swayless.cli.profile_output import document, print_found, trajectory_text
    from swayless.cli.profile_work import found_for
    from swayless.machine.profile_file import load_profile

    given = {
        "numerator": numerator,
        "denominator": denominator,
        "limit": limit,
        "rate_limit": rate_limit,
        "tick": tick,
        "start": start,
        "target": target,
        "robust": robust,
        "ei": ei,
        "relax": relax,
        "track": track,
        "tolerance": tolerance,
        "rope_length": rope_length,
        "frequency": frequency,
    }
    outputs = output or []
    check_places(outputs, page=True)
    request = load_profile(file, option_table(given, []).raw, axis=axis)
    check_apart(outputs, request.files)
    found = found_for(request)
    write_by_suffix(
        outputs,
        lambda: trajectory_text(request, found),
        lambda: draw_move(request, found),
        lambda: write_page(request, found),
    )
    if json:
        print_json(document(request, found))
        return
    print_found(request, found)
    note = "note: give -o to write the command and the output that it should make, one line a tick"
    for line in [f"{path}: written" for path in outputs] or [note]:
        typer.echo(line)
