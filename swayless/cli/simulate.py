"""`swayless simulate`: moves with the controller's own reference, on a simulated crane."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from swayless.cli.options import AxisOption, JsonOption, OptionError

if TYPE_CHECKING:
    from collections.abc import Callable

    from swayless.cli.simulated_case import Simulation
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile
    from swayless.machine.move_section import MoveSection

FileArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE", help="A machine file (.toml) or a design file (.json).", show_default=False
    ),
]
MoveOption = Annotated[
    str | None,
    typer.Option(
        metavar="MOVE",
        help="'12 m at 0.6 m/s from 2 s' or '8 s'; at full speed, long enough to settle, unless given.",
    ),
]
HoistOption = Annotated[
    str | None,
    typer.Option(
        metavar="HOIST", help="'8.84 m to 3.74 m at 0.3 m/s from 1 s'; the rope stands unless given."
    ),
]
WindOption = Annotated[
    str | None,
    typer.Option(metavar="WIND", help="Force per load mass: '0.05 m/s2 from 3 s', and 'for 4 s' for a gust."),
]
RopeOption = Annotated[
    list[str] | None,
    typer.Option("--rope-length", metavar="L", help="A rope that stands; may be given several times."),
]
FrequencyOption = Annotated[
    list[str] | None,
    typer.Option("--frequency", metavar="F", help="Of an arm; may be given several times."),
]
PositionOption = Annotated[
    list[str] | None,
    typer.Option("--position", metavar="P", help="Of an arm with positions; may be given several times."),
]
SweepOption = Annotated[
    str | None,
    typer.Option(metavar="SWEEP", help="'3.1 m to 3.9 m at 0.3 m/s from 1 s': the position of an arm."),
]
RowOption = Annotated[
    list[str] | None,
    typer.Option("--row", metavar="N", help="Row to run, all unless given; may be given several times."),
]
WithinOption = Annotated[
    str | None,
    typer.Option(
        metavar="LENGTH",
        help="The load rests within this of its end; 50 mm, or 2 % of an arm's unshaped step, unless given.",
    ),
]
DirectoryOption = Annotated[
    Path | None,
    typer.Option("-o", "--output", metavar="DIR", help="Folder for a figure and a record of every rope."),
]


def simulate(
    file: FileArgument,
    move: MoveOption = None,
    hoist: HoistOption = None,
    wind: WindOption = None,
    rope_length: RopeOption = None,
    frequency: FrequencyOption = None,
    position: PositionOption = None,
    sweep: SweepOption = None,
    row: RowOption = None,
    within: WithinOption = None,
    axis: AxisOption = None,
    output: DirectoryOption = None,
    json: JsonOption = False,
) -> None:
    """Run moves on a simulated crane, shaped and unshaped.

    With every row, unshaped, and with plain ramps that take as long. The references are those of the
    generated block, tick by tick. Without options the moves of the machine file
    are run, or, if it has none, one at full speed on the shortest, the middle and the longest rope.

    Examples
    --------
    swayless simulate crane.toml
    swayless simulate crane.toml --move "12 m at 0.6 m/s" --rope-length "6 m" --row 1 -o moves
    swayless simulate crane.json --move "12 m" --hoist "8.84 m to 3.74 m at 0.3 m/s from 1 s"
    """
    from swayless.cli.console import print_json, progress
    from swayless.cli.simulation import simulate_move
    from swayless.cli.simulation_summary import print_note, print_simulation, simulation_document
    from swayless.machine.running import shaper_settings

    spoken: dict[str, Any] = {"move": move, "hoist": hoist, "sweep": sweep, "wind": wind}
    spoken |= {"rope_length": rope_length, "frequency": frequency, "position": position}
    with progress() as show:
        design, of_file = _design(file, axis, show)
        settings = shaper_settings(design)
        pendulum = _pendulum_settings(design)
        moves, within_m = _moves(design, settings.last_selector, of_file, spoken, row, within)
        simulations = []
        for number, asked in enumerate(moves, start=1):
            show(f"simulating move {number}")
            simulations.append(simulate_move(design, settings, asked, pendulum))
        written = [] if output is None else _write(output, design, simulations, show)
    if json:
        documents = [simulation_document(design, simulation, within_m) for simulation in simulations]
        print_json({"name": design.name, "within_m": within_m, "moves": documents, "files": written})
        return
    for simulation in simulations:
        print_simulation(design, simulation, within_m)
    print_note(design, within_m)
    for path in written:
        typer.echo(f"{path}: written")


def _design(
    file: Path, axis: str | None, show: Callable[[str], None]
) -> tuple[DesignFile, tuple[MoveSection, ...]]:
    """Load a design, or make that of a machine; give the moves that its file describes."""
    from swayless.machine import load_design, load_machine
    from swayless.machine.designing import design_machine

    if file.suffix == ".json":
        if axis is not None:
            raise OptionError(["--axis: a design file is of one axis; give it for a machine file"])
        return load_design(file), ()
    machine = load_machine(file, axis=axis)
    return design_machine(machine, on_row=lambda name: show(f"designing {name}")), machine.moves


def _pendulum_settings(design: DesignFile) -> ShaperSettings | None:
    """Give the block that a driven crane would have if its drive did not feel the load; None for others."""
    if design.drive.speed_loop is None:
        return None
    from swayless.machine.as_pendulum import pendulum_design
    from swayless.machine.running import shaper_settings

    return shaper_settings(pendulum_design(design))


def _moves(
    design: DesignFile,
    positions: int,
    of_file: tuple[MoveSection, ...],
    spoken: dict[str, Any],
    row: list[str] | None,
    within: str | None,
) -> tuple[list[MoveSection], float]:
    """Give the moves to run: the one on the command line, or those of the file, or the usual one."""
    from swayless.cli.option_table import option_table, refuse
    from swayless.cli.simulated_place import usual_within_m
    from swayless.machine.move_section import MoveSection
    from swayless.machine.plant_section import LENGTH

    problems: list[str] = []
    within_m = option_table({"within": within}, problems).take("within", LENGTH, None)
    given = any(value not in (None, []) for value in spoken.values())
    asked = _asked(design, positions, spoken, row, problems)
    moves = [asked] if given else [replace(move, rows=asked.rows or move.rows) for move in of_file]
    for number, knob in ((number, max(move.rows or (0,))) for number, move in enumerate(moves, start=1)):
        if knob > positions:
            problems.append(f"[[move]] {number} row = {knob}: the knob has positions 0 to {positions}")
    refuse(problems)
    return moves or [MoveSection(rows=asked.rows)], within_m or usual_within_m(design)


def _asked(
    design: DesignFile, positions: int, spoken: dict[str, Any], row: list[str] | None, problems: list[str]
) -> MoveSection:
    """Read the move that the options describe, with the checks of the machine file."""
    from swayless.cli.option_table import option_table
    from swayless.cli.phrases import HOIST, WIND, move_phrase, phrase
    from swayless.machine.move_section import PLACE_KEYS, WAY_KEYS, MoveSection, read_move
    from swayless.machine.plant_section import PlantKind

    kind: PlantKind = "crane" if design.plant.kind in {"crane", "double_pendulum"} else "arm"
    many = {key: _one_or_all(spoken[key]) for key in PLACE_KEYS}
    raw: dict[str, Any] = {} if spoken["move"] is None else dict(move_phrase(spoken["move"], problems))
    called = dict.fromkeys(raw, "--move")
    table = option_table({**raw, **many, "row": _one_or_all(row)}, problems, called=called)
    inner = {
        key: phrase(spoken[key], words, problems, f"--{key}")
        for key, words in (*((way, HOIST) for way in WAY_KEYS), ("wind", WIND))
        if spoken[key] is not None
    }
    table = replace(table, raw={**table.raw, **inner})
    unit = None if design.plant.position is None else design.plant.position.unit
    speed_m_s = design.drive.max_speed_m_s
    asked = read_move(kind, table, max_speed_m_s=speed_m_s, rows=positions, position_unit=unit)
    return asked or MoveSection()


def _one_or_all(values: list[str] | None) -> str | list[str] | None:
    return values[0] if values and len(values) == 1 else values or None


def _write(
    directory: Path, design: DesignFile, simulations: list[Simulation], show: Callable[[str], None]
) -> list[str]:
    """Write a figure and a record of every rope of every move."""
    from swayless.cli.simulation_summary import figures, record_text
    from swayless.errors import FileError
    from swayless.machine import write_text_atomically
    from swayless.report import save_figure

    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError([f"{directory}: cannot be made: {error.strerror or error}"]) from error
    written = []
    for number, simulation in enumerate(simulations, start=1):
        drawn = zip(simulation.sites(), figures(design, simulation), strict=True)
        for place, ((_, cases), figure) in enumerate(drawn, start=1):
            show(f"drawing move {number}")
            path = directory / f"{design.name}-move-{number}-rope-{place}"
            save_figure(figure, path.with_name(f"{path.name}.svg"))
            write_text_atomically(path.with_name(f"{path.name}.csv"), record_text(design, cases))
            written += [f"{path}.svg", f"{path}.csv"]
    return written
