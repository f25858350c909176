"""Laws that follow a measured rope or position: which plants they take, and what a file says of their rows.

Such a row works wherever the machine stands, so it gives no place of its own. Not for: designing rows
(`phase_row`, `spaced_row`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

from swayless.design import DEFAULT_TOLERANCE, FAMILIES, Shaper, design_shaper
from swayless.errors import ControllerError, DesignError
from swayless.machine.checks import choice, label
from swayless.machine.plant_section import DAMPING, PlantKind, PlantSection
from swayless.machine.problems import Table
from swayless.machine.row_section import ORDER, TOLERANCE, RowSection
from swayless.plant import Mode

SPACED_LAWS = ("original", "modified")
"""Magee and Book's two laws."""

_SCALING = tuple(
    name for name, family in FAMILIES.items() if not family.negative and "delay_s" not in family.parameters
)
_THIRDS = ("mzv",)  # impulses a third of a period apart
_SPACED = tuple(name for name in _SCALING if name not in _THIRDS)

FAMILIES_OF_LAW: Mapping[str, tuple[str, ...]] = {"phase": _SCALING} | dict.fromkeys(SPACED_LAWS, _SPACED)
"""Families of each law that follows: with positive amplitudes, in times that scale with the period; of the
spaced laws with impulses half a period apart."""

_MARGIN = 1.5  # times what taps leave too much is taken from the tolerance that the family is designed for
_ROUNDS = 4
_PLACES = ("rope_length", "frequency", "bands")

T = TypeVar("T")


def following_law(law: str | None, row: Table) -> str | None:
    """Give the law by which a row is to be read if it is one that follows.

    Where the law is not known, a row without a place of its own can only be meant for such a law: nobody is
    to be told that a place is missing.

    Examples
    --------
    >>> from swayless.machine.problems import Report
    >>> following_law(None, Table({"family": "zvd"}, Report("crane.toml"), "[[row]] 1 "))
    'phase'
    """
    if law is None and not any(key in row.raw for key in _PLACES):
        return "phase"
    return law if law in FAMILIES_OF_LAW else None


def check_plant_kind(law: str | None, kind: PlantKind, table: Table) -> PlantKind:
    """Report an arm under the phase clock; its keys are then read as those of the crane that it has to be."""
    if law != "phase" or kind != "arm":
        return kind
    table.report.problems.append(
        f'{table.report.file}: [arm]: law = "phase" follows the rope of a crane: give a [crane] with '
        'rope_length (shortest and longest) and hoist_speed; for an arm there is law = "modified"'
    )
    return "crane" if "rope_length" in table.raw else kind


def check_followed(law: str, plant: PlantSection, table: Table, *, contactor: bool) -> None:
    """Report a plant that a law which follows it cannot follow."""
    if plant.kind == "crane":
        _check_rope(law, plant, table)
    elif law in SPACED_LAWS and plant.positions is None:
        table.place("position").problem(
            f'missing: law = "{law}" follows a measured position: give position, frequency at each, and '
            "position_speed"
        )
    elif plant.positions is not None and "position_speed" not in table.raw:
        table.place("position_speed").problem(f'missing: law = "{law}" needs the fastest that it changes')
    if contactor:
        table.report.problems.append(f'{table.report.file}: [drive] contactor: cannot follow law = "{law}"')


def _check_rope(law: str, plant: PlantSection, table: Table) -> None:
    place = table.place("rope_length")
    if plant.rope_length_m is None or plant.double_pendulum is not None:
        place.problem(
            f'law = "{law}" follows a measured rope: it needs a [crane] with its shortest and longest rope, '
            "without a sling"
        )
    elif plant.rope_length_m[0] == plant.rope_length_m[1]:
        place.problem(
            f'law = "{law}" needs two lengths, the shortest and the longest rope; for one, law = "fixed" does'
        )
    if plant.hoist_speed_m_s is None and "hoist_speed" not in table.raw:
        table.place("hoist_speed").problem(f'missing: law = "{law}" needs the fastest that the hoist moves')


def read_following_row(law: str, table: Table, plant: PlantSection | None) -> RowSection | None:
    """Read a row that follows the machine; None where a value is missing or wrong.

    Parameters
    ----------
    law : str
        One of `FAMILIES_OF_LAW`.
    table : Table
        The row.
    plant : PlantSection or None
        For its slowest mode, for which times are given; None if it is missing or wrong.
    """
    name = table.need("name", label)
    family = table.need("family", choice(f'family for law = "{law}"', FAMILIES_OF_LAW[law]))
    who = "the phase clock follows the rope" if law == "phase" else f'law = "{law}" follows what is measured'
    for key in _PLACES:
        _refuse(table, key, f"{who}; leave it out")
    if law in SPACED_LAWS:
        _refuse(table, "damping_ratio", "rows share a spacing, and the damping of the machine; leave it out")
    ratio = table.take("damping_ratio", DAMPING, None)
    tolerance = table.take("tolerance", TOLERANCE, DEFAULT_TOLERANCE)
    order = _read_order(family, table)
    if name is None or family is None or tolerance is None or plant is None:
        return None
    mode = Mode(plant.frequency_hz[0], plant.damping_ratio if ratio is None else ratio)
    rope_length_m = None if plant.rope_length_m is None else plant.rope_length_m[1]
    return RowSection(name, family, mode, rope_length_m, tolerance, order, None)


def _read_order(family: str | None, table: Table) -> int | None:
    if family is None:
        table.asked.append("order")
        return None
    if "order" in FAMILIES[family].parameters:
        return table.need("order", ORDER)
    _refuse(table, "order", f'family "{family}" takes none')
    return None


def _refuse(table: Table, key: str, reason: str) -> None:
    if key in table.raw:
        table.asked.append(key)
        table.place(key).wrong(table.raw[key], reason)


def design_within(
    row: RowSection, taps_of: Callable[[Shaper], tuple[T, float]], *, tick_s: float
) -> tuple[Shaper, T, float]:
    """Design a family so that its taps, too, leave no more than the row's tolerance.

    Taps on ticks leave a little more than the impulses do: where that is more than the tolerance, the family
    is designed for as much less.

    Parameters
    ----------
    row : RowSection
        What is asked for.
    taps_of : callable
        From impulses to taps, and to what these leave at worst while the machine stands still.
    tick_s : float
        Length of a tick.

    Returns
    -------
    Shaper, taps and float
        Impulses, their taps, and the worst that these leave.

    Raises
    ------
    DesignError
        If the family does not exist for the tolerance, or the tick is too coarse.
    """
    aim = row.tolerance
    for _ in range(_ROUNDS):
        shaper = design_shaper(row.family, row.mode, tolerance=aim, order=row.order)
        try:
            taps, worst = taps_of(shaper)
        except ControllerError as error:
            raise DesignError(f"{error}") from error
        if worst <= row.tolerance:
            return shaper, taps, worst
        aim -= _MARGIN * (worst - row.tolerance)
        if aim <= 0.0:
            break
    raise DesignError(
        f"on ticks of {tick_s:g} s the taps leave {100 * worst:.4g} % while nothing but the command moves, "
        f"more than {100 * row.tolerance:g} %; a finer tick or a larger tolerance does"
    )
