"""The ``[bank]`` section: rows that share the range of the machine, worked out instead of written down.

Not for: where one row ends and the next begins (`swayless.machine.banking`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from swayless.machine.bank_record import SELECTIONS
from swayless.machine.checks import choice, integer, quantity
from swayless.machine.plant_section import LENGTH, PlantSection
from swayless.machine.problems import Place, Table
from swayless.machine.quantity import UNITS, Dimension, unit_of
from swayless.machine.robust_row import DURATION, ROBUST_TOLERANCE, SignRule, read_sign_rule

MAX_ROWS = 8
ROWS = integer(1, MAX_ROWS)
_HYSTERESIS = {
    "length": quantity("length", 0.0, 1e4),
    "frequency": quantity("frequency", 0.0, 1e4),
}
_EXCLUSIVE = (("tolerance", "rows"), ("duration", "longest_duration"))


@dataclass(frozen=True)
class BankSection:
    """What the rows of a bank have in common.

    Parameters
    ----------
    tolerance : float or None
        Residual vibration allowed, for the fewest rows; None if their number is given.
    rows : int or None
        How many rows, for the smallest equal tolerance; None if the tolerance is given.
    duration_s : float or None
        Duration of every row; None if only the longest is given.
    longest_duration_s : float or None
        Longest duration: the last row may be shorter.
    rule : SignRule
        Which amplitudes the rows may have.
    hysteresis : float
        By how much neighbours overlap at least, in m of rope, or in Hz where the machine has no rope lengths.
    label_step_m : float or None
        Switching lengths are whole multiples of it.
    unit : str
        Unit of the range in the file, in which the knob is labelled.
    selection : {"knob", "rope_length"}
        What chooses the row: the operator, or the measured rope.
    """

    tolerance: float | None
    rows: int | None
    duration_s: float | None
    longest_duration_s: float | None
    rule: SignRule
    hysteresis: float
    label_step_m: float | None
    unit: str
    selection: str = "knob"


@dataclass(frozen=True)
class OptionedTable(Table):
    """A ``[bank]`` section with some keys replaced by options; problems say which of the two it is about."""

    options: frozenset[str] = frozenset()

    def place(self, key: str) -> Place:
        """Where the value of `key` stands: in the file, or among the options."""
        return Place(self.report, f"bank option {key}") if key in self.options else super().place(key)


def with_options(table: Table, options: Mapping[str, object]) -> OptionedTable:
    """Put options over the keys of a ``[bank]`` section.

    An option replaces its key, and a key that it excludes: ``rows`` takes the place of ``tolerance``.

    Parameters
    ----------
    table : Table
        The section; empty where the file has none.
    options : mapping
        Values by key. A text that is a whole number counts as one.

    Examples
    --------
    >>> from swayless.machine.problems import Report
    >>> section = Table({"tolerance": 0.05, "duration": 3.0}, Report("crane.toml"), "[bank] ")
    >>> with_options(section, {"rows": "3"}).raw
    {'duration': 3.0, 'rows': 3}
    """
    excluded = {key for group in _EXCLUSIVE for key in group if not options.keys().isdisjoint(group)}
    kept = {key: value for key, value in table.raw.items() if key not in excluded}
    given = {key: _whole(value) for key, value in options.items()}
    return OptionedTable(kept | given, table.report, table.prefix, options=frozenset(given))


def read_bank(
    table: Table, *, plant: PlantSection, plant_table: Table, contactor: bool
) -> BankSection | None:
    """Read the section.

    Parameters
    ----------
    table : Table
        The section, or options with the same keys.
    plant : PlantSection
        What swings; its range is what the rows share.
    plant_table : Table
        Its section, for the unit of its range.
    contactor : bool
        Whether the drive knows only 0 and full speed.

    Returns
    -------
    BankSection or None
        None where a value is missing or wrong.
    """
    found_before = len(table.report.problems)
    for group in _EXCLUSIVE:
        table.need_one_of(*group)
    tolerance = table.take("tolerance", ROBUST_TOLERANCE, None)
    rows = table.take("rows", ROWS, None)
    duration_s = table.take("duration", DURATION, None)
    longest_duration_s = table.take("longest_duration", DURATION, None)
    rule = read_sign_rule(table, contactor=contactor)
    dimension: Dimension = "frequency" if plant.rope_length_m is None else "length"
    hysteresis = table.take("hysteresis", _HYSTERESIS[dimension], 0.0)
    label_step_m = table.take("label_step", LENGTH, None)
    if "rows" in table.raw and "longest_duration" in table.raw:
        table.place("longest_duration").problem(
            "a number of rows needs one duration for all of them: duration"
        )
    if "label_step" in table.raw and plant.rope_length_m is None:
        table.place("label_step").problem(
            "the machine is given by frequencies, which are labelled as they are"
        )
    selection = table.take("selection", choice("selection", SELECTIONS), SELECTIONS[0])
    if selection == "rope_length":
        _check_measured(plant, table, hysteresis)
    _check_range(plant, plant_table)
    found = len(table.report.problems) > found_before
    if found or rule is None or hysteresis is None or selection is None:
        return None
    unit = unit_of(plant_table.raw["frequency" if plant.rope_length_m is None else "rope_length"], dimension)
    return BankSection(
        tolerance, rows, duration_s, longest_duration_s, rule, hysteresis, label_step_m, unit, selection
    )


def _check_measured(plant: PlantSection, table: Table, hysteresis: float | None) -> None:
    """Report what a bank lacks whose rows the measured rope chooses."""
    why = 'missing: selection = "rope_length" needs'
    if plant.rope_length_m is None:
        table.place("selection").problem('"rope_length" needs a [crane] with its shortest and longest rope')
    elif plant.hoist_speed_m_s is None:
        table.place("selection").problem(f"{why} hoist_speed in [crane]")
    if hysteresis == 0.0:
        table.place("hysteresis").problem(f"{why} it, so that rows do not change to and fro")


def unit_size(bank: BankSection) -> float:
    """Size of the unit of the labels in m or Hz."""
    return float(next(units[bank.unit] for units in UNITS.values() if bank.unit in units))


def _check_range(plant: PlantSection, plant_table: Table) -> None:
    """Report a plant whose range no bank can share."""
    key = "frequency" if plant.rope_length_m is None else "rope_length"
    if plant.frequency_hz[0] == plant.frequency_hz[1]:
        plant_table.place(key).wrong(plant_table.raw[key], "a bank needs a range to cover: give two values")
    if plant.double_pendulum is not None:
        plant_table.place("sling_length").problem(
            "a bank holds one mode, a double pendulum has two: give [[row]] sections of family si"
        )


def _whole(value: object) -> object:
    return int(value) if isinstance(value, str) and value.isascii() and value.isdecimal() else value
