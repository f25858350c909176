"""The machine file: one TOML file that describes a crane or an arm, its drive, its controller and its knob.

Every problem of a file is reported at once. Not for: designing what the file asks for.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from swayless.controller.operator_options import OperatorOptions
from swayless.errors import FileError
from swayless.machine.axes import axis_documents, chosen_axis, merged_problems
from swayless.machine.bank_section import MAX_ROWS, BankSection, read_bank, with_options
from swayless.machine.checks import machine_name
from swayless.machine.controller_section import ControllerSection, check_counts, law_of, read_controller
from swayless.machine.diagnostics_section import NO_DIAGNOSTICS, DiagnosticsSection, read_diagnostics
from swayless.machine.drive_section import DriveSection, read_drive
from swayless.machine.following_row import (
    FAMILIES_OF_LAW,
    check_followed,
    check_plant_kind,
    following_law,
    read_following_row,
)
from swayless.machine.move_section import MoveSection, read_moves
from swayless.machine.operator_section import NO_FUNCTIONS, FunctionTables, read_operator
from swayless.machine.plant_section import PlantKind, PlantSection, read_plant
from swayless.machine.problems import RefusedError, Report, Table, plain, shown
from swayless.machine.row_section import Row, read_row
from swayless.machine.speed_loop import driven_ropes, plant_below
from swayless.machine.toml_source import read_toml
from swayless.machine.true_row import check_driven_row
from swayless.plant import DrivenRopes

_PLANT_KINDS: tuple[PlantKind, ...] = ("crane", "arm")
_ONE_OF = {"[crane] or [arm]": _PLANT_KINDS, "[[row]] or [bank]": ("row", "bank")}
_FUNCTIONS = ("steps", "limits", "tuning")


@dataclass(frozen=True)
class Machine:
    """A machine as its file describes it, in SI.

    Parameters
    ----------
    name : str
        Prefix of every generated symbol.
    source : str
        Base name of the file, for the provenance of what is generated.
    plant : PlantSection
        What swings.
    drive : DriveSection
        What the command is in, and its limits.
    controller : ControllerSection
        Tick, number type and law.
    rows : tuple of RowSection or RobustRow
        The knob's positions from 1 on; position 0 is unshaped. Empty if there is a bank.
    bank : BankSection or None
        What to work the rows out from, if they are not written down.
    moves : tuple of MoveSection
        What to simulate; often none.
    axis : str
        Which axis of the file this is; empty for a file without axes.
    operator : OperatorOptions
        What the operator touches besides command and knob; nothing unless asked for.
    diagnostics : DiagnosticsSection
        What the block says of itself besides its status.
    """

    name: str
    source: str
    plant: PlantSection
    drive: DriveSection
    controller: ControllerSection
    rows: tuple[Row, ...]
    bank: BankSection | None = None
    moves: tuple[MoveSection, ...] = ()
    axis: str = ""
    operator: OperatorOptions = NO_FUNCTIONS
    diagnostics: DiagnosticsSection = NO_DIAGNOSTICS

    @property
    def driven_ropes(self) -> DrivenRopes | None:
        """Ropes below the trolley of a speed loop; None where the trolley follows its reference exactly."""
        plant, speed_loop = self.plant, self.drive.speed_loop
        if speed_loop is None or plant.rope_length_m is None:
            return None
        return DrivenRopes(speed_loop, plant.rope_length_m, plant.damping_ratio)


@dataclass(frozen=True)
class Axes:
    """The machines of one file: one for each axis, or the one machine of a file without axes.

    Parameters
    ----------
    name : str
        Name in the file: the machine's, or what the names of all axes begin with.
    machines : tuple of Machine
        In the order of the file.
    """

    name: str
    machines: tuple[Machine, ...]


def load_machine(
    path: Path | str, bank_options: Mapping[str, object] | None = None, *, axis: str | None = None
) -> Machine:
    """Load a machine file.

    Parameters
    ----------
    path : Path or str
        A TOML file; ``docs/machine-file.md`` says what stands in it.
    bank_options : mapping or None
        Values by the keys of ``[bank]``, numbers or texts as on a command line, which replace those of the
        file, and those that they exclude: ``rows`` replaces ``tolerance``, ``duration`` replaces
        ``longest_duration``. Rows that the file writes down are then left aside: the machine has a bank. An
        empty mapping takes ``[bank]`` as it is, and reports a file without one. None takes the file as it is.
    axis : str or None
        Which axis, for a file that has axes.

    Raises
    ------
    FileError
        With every problem found: file, key, value and what is allowed.

    Examples
    --------
    >>> import tempfile
    >>> from swayless.machine import example_text
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "crane.toml")
    ...     _ = path.write_text(example_text("srtc-gantry"))
    ...     machine = load_machine(path)
    >>> machine.name, machine.controller.tick_s, [row.name for row in machine.rows]
    ('srtc_gantry', 0.01, ['long', 'middle', 'short'])

    The same crane with a bank in the place of its rows:

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "crane.toml")
    ...     _ = path.write_text(example_text("srtc-gantry"))
    ...     machine = load_machine(path, {"rows": "3", "duration": "3 s", "amplitudes": "bounded"})
    >>> machine.rows, machine.bank.rows, machine.bank.duration_s, machine.bank.unit
    ((), 3, 3.0, 'ft')
    """
    path = Path(path)
    document = _document(path)
    report = Report(str(path))
    axes = axis_documents(document, report)
    chosen_axis(tuple(axes), axis, report)
    if report.problems:
        raise FileError(report.problems)
    chosen = document if axis is None else axes[axis]
    machine = _read_machine(Table(_with_bank(chosen, bank_options), report, ""), path.name, bank_options)
    if machine is None or report.problems:
        found = (
            report.problems
            if axis is None
            else merged_problems({axis: report.problems}, document, report.file)
        )
        raise FileError(found)
    return replace(machine, axis=axis or "")


def load_axes(path: Path | str) -> Axes:
    """Load a machine file with all its axes.

    Parameters
    ----------
    path : Path or str
        A TOML file, with sections ``[axis.NAME]`` or without.

    Raises
    ------
    FileError
        With every problem found in any axis.

    Examples
    --------
    >>> import tempfile
    >>> from swayless.machine import example_text
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "crane.toml")
    ...     _ = path.write_text(example_text("two-axis-crane"))
    ...     axes = load_axes(path)
    >>> axes.name, [machine.name for machine in axes.machines]
    ('two_axis_crane', ['two_axis_crane_bridge', 'two_axis_crane_trolley'])
    """
    path = Path(path)
    document = _document(path)
    report = Report(str(path))
    documents = axis_documents(document, report)
    if report.problems:
        raise FileError(report.problems)
    if not documents:
        machine = load_machine(path)
        return Axes(machine.name, (machine,))
    found = {axis: Report(str(path)) for axis in documents}
    read = [_read_machine(Table(own, found[axis], ""), path.name, None) for axis, own in documents.items()]
    machines = tuple(
        replace(machine, axis=axis)
        for axis, machine in zip(documents, read, strict=True)
        if machine is not None
    )
    problems = merged_problems({axis: own.problems for axis, own in found.items()}, document, str(path))
    if problems or len(machines) < len(read):
        raise FileError(problems)
    return Axes(str(document["name"]), machines)


_OTHER_BLOCKS = {
    "adaptive": "an adaptive shaper, which `swayless build` makes",
    "plant": "a move computed ahead, which `swayless profile` and `swayless build` take",
    "move": "a move computed ahead, which `swayless profile` and `swayless build` take",
}
"""What a file without a machine describes, by a section of it."""


def _document(path: Path) -> dict[str, object]:
    document = read_toml(path)
    if not document:
        needs = "name, [crane] or [arm], [controller] and at least one [[row]] or a [bank]"
        hint = "'swayless init' writes a commented file to start from"
        raise FileError([f"{path}: is empty: a machine file needs {needs}; {hint}"])
    if {"crane", "arm", "axis"}.isdisjoint(document):
        for section, what in _OTHER_BLOCKS.items():
            if section in document:
                needed = "here a machine with [crane] or [arm] is needed"
                raise FileError([f"{path}: [{section}]: {what}; {needed}"])
    return document


def _with_bank(document: dict[str, object], bank_options: Mapping[str, object] | None) -> dict[str, object]:
    """Leave aside the rows of a document that is to have a bank, and open the section for options."""
    if bank_options is None:
        return document
    kept = {key: value for key, value in document.items() if key != "row"}
    return {"bank": {}, **kept} if bank_options else kept


def _read_machine(root: Table, source: str, bank_options: Mapping[str, object] | None) -> Machine | None:
    name = root.need("name", machine_name)
    kind = _plant_kind(root)
    _check_sections(root)
    plant_table, controller_table = _section(root, kind, None), _section(root, "controller", None)
    drive_table, law = _section(root, "drive", {}), law_of(controller_table)
    kind = check_plant_kind(law, kind, plant_table)
    plant = read_plant(kind, plant_table)
    drive = read_drive(kind, plant_table, drive_table)
    controller = read_controller(controller_table)
    if drive is not None and controller_table.raw.get("number") == "int32":
        check_counts(drive_table, drive)
    contactor = drive is not None and drive.contactor
    ropes = None
    if plant is not None and drive is not None:
        ropes = driven_ropes(drive.speed_loop, plant, drive_table, law=law)
        plant = plant if ropes is None else plant_below(plant, ropes)
    if law is not None and law in FAMILIES_OF_LAW and plant is not None:
        check_followed(law, plant, plant_table, contactor=contactor)
    rows = _read_rows(kind, root, plant, law, ropes, contactor=contactor)
    bank_table = with_options(_section(root, "bank", {}), bank_options or {})
    bank = None
    if plant is not None and "bank" in root.raw:
        if law in FAMILIES_OF_LAW:
            root.place("[bank]").problem(f'law = "{law}" needs one row for all of the range: give a [[row]]')
        bank = read_bank(bank_table, plant=plant, plant_table=plant_table, contactor=contactor)
        bank_table.close()
    speed_m_s = None if drive is None else drive.max_speed_m_s
    most_rows = MAX_ROWS if "bank" in root.raw else max(1, len(rows))
    unit = plant.positions.unit if plant is not None and plant.positions is not None else None
    moves = read_moves(kind, root, max_speed_m_s=speed_m_s, rows=most_rows, position_unit=unit)
    tables = FunctionTables(drive_table, controller_table, *(_section(root, key, {}) for key in _FUNCTIONS))
    by_rope = plant is None or law is None or _measures_rope(law, plant, root)
    operator = read_operator(tables, drive, measures_rope=by_rope)
    diagnostics = read_diagnostics(tables, plant, drive, law=law, measures_rope=by_rope)
    for table in (root, plant_table, *tables):
        table.close()
    if name is None or plant is None or drive is None or controller is None:
        return None
    return Machine(
        name, source, plant, drive, controller, rows, bank, moves, operator=operator, diagnostics=diagnostics
    )


def _measures_rope(law: str, plant: PlantSection, root: Table) -> bool:
    """Whether the block reads the length of a rope: for its taps, or to choose the row."""
    bank = root.raw.get("bank")
    chooses = isinstance(bank, dict) and bank.get("selection") == "rope_length"
    return plant.kind == "crane" and (law in FAMILIES_OF_LAW or chooses)


def _plant_kind(root: Table) -> PlantKind:
    """Find which plant section stands; without one, go on as for a crane to find what else is wrong."""
    return "arm" if "arm" in root.raw and "crane" not in root.raw else "crane"


def _check_sections(root: Table) -> None:
    """Report sections that are missing, or that exclude each other."""
    for heading, keys in _ONE_OF.items():
        root.asked.extend(keys)
        present = sum(key in root.raw for key in keys)
        if present != 1:
            found = "both are there" if present else "none is there"
            root.place(heading).problem(f"exactly one of these sections is needed, {found}")
    if "controller" not in root.raw:
        root.place("[controller]").problem("this section is missing")


def _section(root: Table, key: str, default: dict[str, object] | None) -> Table:
    """Table of a section; an absent or broken one is reported once, and its keys to nobody."""
    raw = root.take(key, _as_section, default)
    return Table({}, Report("nobody"), "") if raw is None else Table(raw, root.report, f"[{key}] ")


@plain
def _as_section(value: object) -> dict[str, object]:
    if not isinstance(value, dict):
        raise RefusedError("must be a section of its own, with its name in brackets")
    return value


@plain
def _as_rows(value: object) -> list[dict[str, object]]:
    rows = value if isinstance(value, list) else []
    if not rows or not all(isinstance(row, dict) for row in rows):
        raise RefusedError("must be sections [[row]], in two brackets, one for each knob position")
    return rows


def _read_rows(
    kind: PlantKind,
    root: Table,
    plant: PlantSection | None,
    law: str | None,
    ropes: DrivenRopes | None,
    *,
    contactor: bool,
) -> tuple[Row, ...]:
    seen: dict[str, int] = {}
    rows = []
    tables = root.take("row", _as_rows, None) or []
    if len(tables) > MAX_ROWS:
        root.place("[[row]]").problem(f"stands {len(tables)} times; at most {MAX_ROWS} are allowed")
    for position, raw in enumerate(tables[:MAX_ROWS], start=1):
        name = raw.get("name")
        known_as = f" ({shown(name)})" if isinstance(name, str) else ""
        table = Table(raw, root.report, f"[[row]] {position}{known_as} ")
        following = following_law(law, table)
        rows.append(
            read_following_row(following, table, plant)
            if following is not None
            else read_row(
                kind,
                table,
                damping_ratio=plant.damping_ratio if plant else 0.0,
                double_pendulum=plant.double_pendulum if plant else None,
                contactor=contactor,
            )
        )
        if ropes is not None and rows[-1] is not None:
            check_driven_row(table, rows[-1], ropes)
        table.close()
        first = seen.setdefault(str(name).lower(), position)
        if first != position and isinstance(name, str):
            table.place("name").problem(f"is also the name of [[row]] {first}")
    return tuple(row for row in rows if row is not None)
