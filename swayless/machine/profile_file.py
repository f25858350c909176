"""The profile file: a plant and a move of it, in TOML, with options of a command line over it.

A machine file may stand in its place: the plant is then the load below the trolley, the limits are the
machine's. Not for: finding the command (`swayless.design.optimal`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from swayless.design.optimal import LinearPlant, MoveTask, Robustness
from swayless.design.optimal.robustification import LARGEST_ROBUST_ORDER, LARGEST_SPLIT_RATIO
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError, FileError
from swayless.machine.checks import choice, integer, machine_name, number, quantity
from swayless.machine.controller_section import TICK
from swayless.machine.problems import Place, Report, Table, shown
from swayless.machine.profile_machine import LOAD_KEYS, read_machine
from swayless.machine.profile_plant import COEFFICIENT, coefficients, read_plant_model
from swayless.machine.profile_trajectory import read_trajectory
from swayless.machine.toml_source import read_toml

PLANT_KEYS = ("numerator", "denominator", "a", "b", "c", "d")


@dataclass(frozen=True, eq=False)
class ProfileRequest:
    """What a profile file asks for.

    Parameters
    ----------
    name : str
        Of the command.
    task : MoveTask
        Plant, limits and move.
    relax_ratio : float or None
        The command of least energy in so many times the fewest ticks; the one of the fewest unless given.
    wanted : ndarray or None
        Outputs to follow, at ticks 1, 2, ...
    tolerance : float or None
        How near.
    number : {"double", "float"}
        Number type of the block that plays it; int32 has no use for tables of fractions.
    files : tuple of Path
        What it was read from.
    """

    name: str
    task: MoveTask
    relax_ratio: float | None = None
    wanted: FloatArray | None = None
    tolerance: float | None = None
    number: str = "double"
    files: tuple[Path, ...] = ()


@dataclass(frozen=True)
class _Overlaid(Table):
    """A section with some keys replaced by options; problems say which of the two they are about."""

    options: frozenset[str] = frozenset()

    def place(self, key: str) -> Place:
        """Where the value of `key` stands: on the command line where the file has no such section."""
        option = f"--{key.replace('_', '-')}"
        return Place(self.report, option) if key in self.options or not self.prefix else super().place(key)


def is_profile(path: Path) -> bool:
    """Whether a TOML file has a section ``[plant]`` or ``[move]``; whatever else is wrong is for others."""
    try:
        document = read_toml(path)
    except FileError:
        return False
    return not _is_machine(document) and any(isinstance(document.get(key), dict) for key in ("plant", "move"))


def _is_machine(document: Mapping[str, object]) -> bool:
    return not {"crane", "arm", "axis"}.isdisjoint(document)


def load_profile(
    path: Path | None, options: Mapping[str, object], *, axis: str | None = None
) -> ProfileRequest:
    """Load a profile file, or a machine file, or take everything from options.

    Parameters
    ----------
    path : Path or None
        A TOML file; ``docs/profile.md`` says what stands in it.
    options : mapping
        Values by the keys of ``[plant]`` and ``[move]``, which replace those of the file; ``rope_length`` or
        ``frequency`` say which load of a machine with a range is meant.
    axis : str or None
        Which axis, for a machine file that has axes.

    Raises
    ------
    FileError
        With every problem found: file, key, value and what is allowed.
    DesignError
        If no command can do the move; the message names the cause.

    Examples
    --------
    >>> options = {"numerator": "1", "denominator": "0.01 0 1", "limit": "5", "tick": "5 ms", "target": 1}
    >>> load_profile(None, options).task.held_input
    1.0
    """
    report = Report("" if path is None else str(path))
    document = {} if path is None else read_toml(path)
    if path is not None and _is_machine(document):
        name, plant, move = _of_machine(path, options, report, axis)
    else:
        name, plant, move = _of_profile(document, options, report)
    request = _read_move(name, plant, move, path)
    if request is None or report.problems:
        raise FileError(report.problems)
    return request


def _of_profile(
    document: dict[str, object], options: Mapping[str, object], report: Report
) -> tuple[str, LinearPlant | None, Table]:
    """Take plant and move from a profile file and options."""
    root = Table(document, report, "")
    name = root.take("name", machine_name, "move") or "move"
    sections = {}
    for section in ("plant", "move"):
        raw = root.take(section, _section, {}) or {}
        given = {key: value for key, value in options.items() if (key in PLANT_KEYS) == (section == "plant")}
        kept = {} if section == "plant" and given else raw
        prefix = f"[{section}] " if document else ""
        sections[section] = _Overlaid({**kept, **given}, report, prefix, options=frozenset(given))
    root.close()
    plant = read_plant_model(sections["plant"])
    sections["plant"].close()
    return name, plant, sections["move"]


def _of_machine(
    path: Path, options: Mapping[str, object], report: Report, axis: str | None
) -> tuple[str, LinearPlant | None, Table]:
    """Take plant and limits from a machine file, and the move from options."""
    load = {key: value for key, value in options.items() if key in LOAD_KEYS}
    given = {key: value for key, value in options.items() if key not in LOAD_KEYS}
    name, plant, limits = read_machine(path, _Overlaid(load, report, ""), axis=axis)
    return name, plant, _Overlaid({**limits, **given}, report, "")


def _read_move(
    name: str, plant: LinearPlant | None, table: Table, path: Path | None
) -> ProfileRequest | None:
    """Read the section ``[move]``; None where a value is missing or wrong."""
    tick_s = table.need("tick", TICK)
    limits = table.need("limit", _limits)
    rate = table.take("rate_limit", _positive, None)
    start = table.take("start", COEFFICIENT, 0.0)
    target = table.need("target", COEFFICIENT)
    order = table.take("robust", integer(0, LARGEST_ROBUST_ORDER), 0)
    split = table.take("ei", quantity("ratio", 1e-6, LARGEST_SPLIT_RATIO, below_high=True), None)
    relax = table.take("relax", number(1.0, 100.0), None)
    tolerance = table.take("tolerance", _positive, None)
    track = table.take("track", _file, None)
    kind = table.take("number", choice("number type", ("double", "float")), "double")
    table.close()
    if "robust" in table.raw and "ei" in table.raw:
        table.place("ei").problem("poles are either repeated or split: leave robust or ei out")
    if ("track" in table.raw) != ("tolerance" in table.raw):
        table.place("track").problem("a trajectory and its tolerance belong together")
    if "track" in table.raw and "relax" in table.raw:
        table.place("relax").problem("a trajectory has its length: leave track or relax out")
    if target is not None and target == (start or 0.0):
        table.place("target").problem(f"{target:g}: must differ from the start")
    if table.report.problems or plant is None or tick_s is None or limits is None or target is None:
        return None
    # A file's names are beside it, an option's where the command is given.
    beside = path.parent if path is not None and not table.place("track").path.startswith("--") else Path()
    wanted = None if track is None else read_trajectory(beside / track)
    try:
        task = MoveTask(plant, tick_s, limits, target, start or 0.0, rate, Robustness(order or 0, split))
    except DesignError as error:
        raise DesignError(f"{path}: {error}" if path else str(error)) from error
    files = (*([] if path is None else [path]), *([] if track is None else [beside / track]))
    return ProfileRequest(name, task, relax, wanted, tolerance, kind or "double", files)


def _limits(value: object, place: Place) -> tuple[float, float] | None:
    """Check for the largest input either way, > 0, or the lowest and the highest."""
    given = coefficients(value, place)
    if given is None:
        return None
    low, high = (-given[0], given[0]) if len(given) == 1 else given[:2]
    if len(given) > 2 or not low < high:
        place.wrong(value, "must be one number > 0, either way, or the lowest and the highest input")
        return None
    return low, high


def _positive(value: object, place: Place) -> float | None:
    """Check for a number above 0."""
    found = COEFFICIENT(value, place)
    if found is not None and found <= 0.0:
        place.wrong(value, "must be > 0")
        return None
    return found


def _file(value: object, place: Place) -> Path | None:
    """Check for the name of a file."""
    if not isinstance(value, str) or not value:
        place.wrong(value, "must be the name of a CSV file")
        return None
    return Path(value)


def _section(value: object, place: Place) -> dict[str, object] | None:
    """Check for a section."""
    if not isinstance(value, dict):
        place.problem(f"{shown(value)} must be a section of its own, with its name in brackets")
        return None
    return value
