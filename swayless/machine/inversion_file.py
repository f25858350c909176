"""The file of a move by inversion: a drive or a plant, and the polynomial motion of its load, in TOML.

Not for: finding the command (`swayless.design.inversion`), or moves within limits (`profile_file`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from swayless.design.inversion import DEFAULT_TRUNCATION, InvertedCommand, PolynomialMotion, invert
from swayless.design.inversion.motion import LARGEST_ORDER
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError, FileError, PlantError
from swayless.machine.checks import choice, integer, machine_name, number, quantity
from swayless.machine.controller_section import TICK
from swayless.machine.plant_section import MASS
from swayless.machine.problems import Place, Report, Table, shown
from swayless.machine.profile_plant import COEFFICIENT, coefficients
from swayless.machine.toml_source import read_toml
from swayless.plant.elastic_drive import ElasticDrive

DURATION = quantity("time", 1e-5, 1e4)
_SIZE = number(1e-12, 1e12)
_DRIVE = {
    "motor_inertia": _SIZE,
    "motor_friction": _SIZE,
    "gain": _SIZE,
    "integral_time": quantity("time", 1e-6, 1e6),
    "load_mass": MASS,
    "damping": number(0.0, 1e12),
    "stiffness": _SIZE,
}
"""Keys of ``[drive]``, in the order of `ElasticDrive`."""

_MARGIN = 0.1  # of the command's range, on either side, where the file gives no limit


@dataclass(frozen=True, eq=False)
class InversionRequest:
    """What a file asks for.

    Parameters
    ----------
    file : str
        What the user called it.
    name : str
        Of the command.
    drive : ElasticDrive or None
        None where the file has a ``[plant]``.
    numerator, denominator : ndarray
        Transfer function from command to load, falling powers of s.
    motion : PolynomialMotion
    tick_s : float
    truncation_ratio : float
    limits : tuple of two floats or None
        Lowest and highest command.
    number : {"double", "float"}
        Number type of the block that plays it.
    """

    file: str
    name: str
    drive: ElasticDrive | None
    numerator: FloatArray
    denominator: FloatArray
    motion: PolynomialMotion
    tick_s: float
    truncation_ratio: float
    limits: tuple[float, float] | None
    number: str

    @cached_property
    def found(self) -> InvertedCommand:
        """The command.

        Raises
        ------
        DesignError
            If there is none, or it exceeds the limits.
        """
        try:
            found = invert(
                self.numerator,
                self.denominator,
                self.motion,
                self.tick_s,
                truncation_ratio=self.truncation_ratio,
            )
        except DesignError as error:
            raise DesignError(f"{self.file}: {error}") from error
        values = np.append(found.command.values, found.command.final_value)
        low, high = float(values.min()), float(values.max())
        if self.limits is not None and not (self.limits[0] <= low and high <= self.limits[1]):
            raise DesignError(
                f"{self.file}: [move] limit = {self.limits[0]:g} to {self.limits[1]:g}: the command goes from"
                f" {low:.6g} to {high:.6g}; take a longer duration, or another limit"
            )
        return found

    @property
    def played_limits(self) -> tuple[float, float]:
        """Limits of the file, or else the command's range and a tenth of it on either side."""
        command = self.found.command
        values = [*command.values.tolist(), command.initial_value, command.final_value]
        margin = _MARGIN * (max(values) - min(values))
        return self.limits or (min(values) - margin, max(values) + margin)


def load_inversion(path: Path) -> InversionRequest:
    """Load the file of a move by inversion.

    Parameters
    ----------
    path : Path
        A TOML file; ``docs/profile-invert.md`` says what stands in it.

    Raises
    ------
    FileError
        With every problem found: file, key, value and what is allowed.
    """
    document = read_toml(path)
    report = Report(str(path))
    root = Table(document, report, "")
    name = root.take("name", machine_name, "move")
    root.need_one_of("drive", "plant")
    drive = root.take("drive", _drive, None)
    plant = root.take("plant", _plant, None)
    move = root.need("move", section)
    root.close()
    request = None
    if move is not None:
        request = _read_move(name or "move", drive, plant, Table(move, report, "[move] "))
    if request is None or report.problems:
        raise FileError(report.problems)
    return request


def section(value: object, place: Place) -> Mapping[str, object] | None:
    """Check for a section."""
    if not isinstance(value, dict):
        place.problem(f"{shown(value)} must be a section of its own, with its name in brackets")
        return None
    return value


def _drive(value: object, place: Place) -> ElasticDrive | None:
    """Check for a section with all keys of a drive."""
    raw = section(value, place)
    if raw is None:
        return None
    table = Table(raw, place.report, f"[{place.path}] ")
    values = [table.need(key, check) for key, check in _DRIVE.items()]
    table.close()
    good = [each for each in values if each is not None]
    if len(good) < len(values):
        return None
    try:
        return ElasticDrive(*good)
    except PlantError as error:
        place.report.problems.append(f"{place.report.file}: [{place.path}] {error}")
        return None


def _plant(value: object, place: Place) -> tuple[FloatArray, FloatArray] | None:
    """Check for a section with a transfer function."""
    raw = section(value, place)
    if raw is None:
        return None
    table = Table(raw, place.report, f"[{place.path}] ")
    top, bottom = (table.need(key, coefficients) for key in ("numerator", "denominator"))
    table.close()
    return None if top is None or bottom is None else (np.array(top), np.array(bottom))


def _read_move(
    name: str,
    drive: ElasticDrive | None,
    plant: tuple[FloatArray, FloatArray] | None,
    table: Table,
) -> InversionRequest | None:
    """Read the section ``[move]``; None where a value is missing or wrong."""
    tick_s = table.need("tick", TICK)
    start = table.take("start", COEFFICIENT, 0.0)
    target = table.need("target", COEFFICIENT)
    duration_s = table.need("duration", DURATION)
    order = table.take("order", integer(3, LARGEST_ORDER), 7)
    truncation = table.take("truncation", quantity("ratio", 1e-12, 0.1), DEFAULT_TRUNCATION)
    limits = table.take("limit", _limits, None)
    kind = table.take("number", choice("number type", ("double", "float")), "double")
    table.close()
    function = plant if drive is None else drive.transfer_function
    if table.report.problems or function is None or tick_s is None or target is None or duration_s is None:
        return None
    try:
        motion = PolynomialMotion(duration_s, target, start or 0.0, order or 7)
    except DesignError as error:
        raise FileError([f"{table.report.file}: [move] {error}"]) from error
    return InversionRequest(
        table.report.file,
        name,
        drive,
        *function,
        motion,
        tick_s,
        truncation or DEFAULT_TRUNCATION,
        limits,
        kind or "double",
    )


def _limits(value: object, place: Place) -> tuple[float, float] | None:
    """Check for the lowest and the highest command."""
    given = coefficients(value, place)
    if given is None:
        return None
    if len(given) != 2 or not given[0] < given[1]:
        place.wrong(value, "must be the lowest and the highest command")
        return None
    return given[0], given[1]
