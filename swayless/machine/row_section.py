"""What one knob position does: a ``[[row]]`` of a machine file.

Not for: designing the row; a tick or a damping that a family does not allow is found there.
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.design import DEFAULT_TOLERANCE, FAMILIES
from swayless.design.families.closed_form import LARGEST_ORDER
from swayless.machine.checks import choice, integer, label, quantity
from swayless.machine.plant_section import DAMPING, FREQUENCY, LENGTH, PlantKind
from swayless.machine.problems import Check, T, Table
from swayless.plant import Mode, pendulum_mode

TOLERANCE = quantity("ratio", 1e-6, 1.0, below_high=True)
ORDER = integer(0, LARGEST_ORDER)
DELAY = quantity("time", 1e-6, 1e4)


@dataclass(frozen=True)
class RowSection:
    """One knob position: the shaper wanted, and the mode that it is made for.

    Parameters
    ----------
    name : str
        What people call it; printable ASCII.
    family : str
        A name in `swayless.design.FAMILIES`.
    mode : Mode
        The mode to design for.
    rope_length_m : float or None
        The rope of that mode, if the file gives one.
    tolerance : float
        Residual vibration, as a ratio, at which the band is reported and, for some families, designed.
    order : int or None
        For families that have an order.
    delay_s : float or None
        For families whose delay is chosen.
    """

    name: str
    family: str
    mode: Mode
    rope_length_m: float | None
    tolerance: float
    order: int | None
    delay_s: float | None


def read_row(kind: PlantKind, table: Table, *, damping_ratio: float) -> RowSection | None:
    """Read one row; `damping_ratio` is the plant's. None where a value is missing or wrong."""
    name = table.need("name", label)
    family = table.need("family", choice("family", FAMILIES))
    mode, rope_length_m = _read_mode(kind, table, damping_ratio)
    tolerance = table.take("tolerance", TOLERANCE, DEFAULT_TOLERANCE)
    order = _read_parameter("order", "order", ORDER, family, table)
    delay_s = _read_parameter("delay", "delay_s", DELAY, family, table)
    if name is None or family is None or mode is None or tolerance is None:
        return None
    return RowSection(name, family, mode, rope_length_m, tolerance, order, delay_s)


def _read_mode(kind: PlantKind, table: Table, default: float) -> tuple[Mode | None, float | None]:
    rope_length_m = None
    if kind == "crane":
        table.need_one_of("rope_length", "frequency")
        rope_length_m = table.take("rope_length", LENGTH, None)
        frequency_hz = table.take("frequency", FREQUENCY, None)
    else:
        frequency_hz = table.need("frequency", FREQUENCY)
    damping_ratio = table.take("damping_ratio", DAMPING, default)
    if damping_ratio is None:
        return None, None
    if rope_length_m is not None:
        return pendulum_mode(rope_length_m, damping_ratio), rope_length_m
    return None if frequency_hz is None else Mode(frequency_hz, damping_ratio), None


def _read_parameter(key: str, parameter: str, check: Check[T], family: str | None, table: Table) -> T | None:
    """Read a key that only some families take, and that those need."""
    value = table.take(key, check, None)
    if family is None:
        return value
    takes = parameter in FAMILIES[family].parameters
    if takes and key not in table.raw:
        table.place(key).problem(f'missing: family "{family}" needs it')
    if not takes and key in table.raw:
        takers = [name for name, known in FAMILIES.items() if parameter in known.parameters]
        table.place(key).wrong(table.raw[key], f'family "{family}" takes none; only {", ".join(takers)} does')
    return value
