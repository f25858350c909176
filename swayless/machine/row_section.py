"""What one knob position does: a ``[[row]]`` of a machine file.

Not for: designing the row; a tick or a damping that a family does not allow is found there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from swayless.design import DEFAULT_TOLERANCE, FAMILIES
from swayless.design.families.closed_form import LARGEST_ORDER
from swayless.machine.checks import choice, integer, label, quantity
from swayless.machine.plant_section import DAMPING, FREQUENCY, LENGTH, DoublePendulum, PlantKind
from swayless.machine.problems import Check, T, Table
from swayless.machine.robust_row import ROBUST_FAMILIES, RobustRow, read_robust
from swayless.plant import Mode, pendulum_mode

TOLERANCE = quantity("ratio", 1e-6, 1.0, below_high=True)
ORDER = integer(0, LARGEST_ORDER)
DELAY = quantity("time", 1e-6, 1e4)

WHOLE_FAMILIES = tuple(name for name in FAMILIES if name.startswith("um-"))
"""Named families whose amplitudes are +1 and -1: all that a contactor drive can follow."""

_ORDERED, _DELAYED = (
    tuple(name for name, family in FAMILIES.items() if parameter in family.parameters)
    for parameter in ("order", "delay_s")
)
_TAKERS: Mapping[str, tuple[str, ...]] = {
    "order": _ORDERED,
    "delay": _DELAYED,
    "bands": ("si",),
    "duration": ("fd",),
    "amplitudes": ROBUST_FAMILIES,
    "impulses": ROBUST_FAMILIES,
}


@dataclass(frozen=True)
class RowSection:
    """One knob position of a named family: the shaper wanted, and the mode that it is made for.

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

    @property
    def frequency_range_hz(self) -> tuple[float, float]:
        """Frequency of the mode, as both ends of a range."""
        return self.mode.frequency_hz, self.mode.frequency_hz

    @property
    def rope_range_m(self) -> tuple[float, float] | None:
        """Rope of the mode, as both ends of a range."""
        return None if self.rope_length_m is None else (self.rope_length_m, self.rope_length_m)

    @property
    def damping_ratios(self) -> tuple[float, float]:
        """Damping ratio of the mode, as both ends of a range."""
        return self.mode.damping_ratio, self.mode.damping_ratio


Row: TypeAlias = RowSection | RobustRow
"""What one knob position asks for, whatever its family."""


def read_row(
    kind: PlantKind,
    table: Table,
    *,
    damping_ratio: float,
    double_pendulum: DoublePendulum | None = None,
    contactor: bool = False,
) -> Row | None:
    """Read one row of any family.

    Parameters
    ----------
    kind : {"crane", "arm"}
        Which keys say where the row is to work.
    table : Table
        The row, or options with the same keys.
    damping_ratio : float
        The plant's, for a row that gives none.
    double_pendulum : DoublePendulum or None
        Sling and masses of the plant; robust rows then hold both modes, and others are refused.
    contactor : bool
        Whether the drive knows only 0 and full speed.

    Returns
    -------
    RowSection, RobustRow or None
        None where a value is missing or wrong.
    """
    name = table.need("name", label)
    family = table.need("family", choice("family", (*FAMILIES, *ROBUST_FAMILIES)))
    _refuse_keys_of_others(family, table)
    if family in ROBUST_FAMILIES:
        return read_robust(
            kind,
            table,
            name,
            family,
            damping_ratio=damping_ratio,
            double_pendulum=double_pendulum,
            contactor=contactor,
        )
    if family is not None:
        _check_plant(family, table, double_pendulum, contactor=contactor)
    return _read_named(kind, table, name, family, damping_ratio)


def _refuse_keys_of_others(family: str | None, table: Table) -> None:
    """Report keys that only other families take; where the family is unknown nothing is known of its keys."""
    for key, takers in _TAKERS.items():
        if key in table.raw and family not in takers:
            table.asked.append(key)
            if family is not None:
                only = f"only {', '.join(takers)} {'does' if len(takers) == 1 else 'do'}"
                table.place(key).wrong(table.raw[key], f'family "{family}" takes none; {only}')


def _check_plant(
    family: str, table: Table, double_pendulum: DoublePendulum | None, *, contactor: bool
) -> None:
    """Report a named family that the machine cannot use."""
    if double_pendulum is not None:
        reason = "would shape the lower mode of the double pendulum only; si holds both"
        table.place("family").wrong(family, reason)
    if contactor and family not in WHOLE_FAMILIES:
        allowed = ", ".join((*WHOLE_FAMILIES, *ROBUST_FAMILIES))
        table.place("family").wrong(family, f"a contactor drive gives 0 or full speed: allowed are {allowed}")


def _read_named(
    kind: PlantKind, table: Table, name: str | None, family: str | None, damping_ratio: float
) -> RowSection | None:
    mode, rope_length_m = _read_mode(kind, table, damping_ratio)
    tolerance = table.take("tolerance", TOLERANCE, DEFAULT_TOLERANCE)
    order = _read_parameter("order", ORDER, family, table)
    delay_s = _read_parameter("delay", DELAY, family, table)
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


def _read_parameter(key: str, check: Check[T], family: str | None, table: Table) -> T | None:
    """Read a key that only some families take, and that those need."""
    takes = family is None or family in _TAKERS[key]
    if takes and family is not None and key not in table.raw:
        table.place(key).problem(f'missing: family "{family}" needs it')
    return table.take(key, check, None) if takes else None
