"""A ``[[row]]`` of a robust family: the band it must hold, or the duration in which to hold what can be held.

Not for: named families (`swayless.machine.row_section`), nor for designing the row.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

from swayless.design import DEFAULT_TOLERANCE
from swayless.design.robust import Amplitudes
from swayless.design.robust.demand import LARGEST_DAMPING_RATIO, TOLERANCES
from swayless.machine.checks import choice, integer, one_or_two, quantity, some, two
from swayless.machine.plant_section import FREQUENCY, LENGTH, DoublePendulum, PlantKind, rope_bands
from swayless.machine.problems import Check, Place, Table
from swayless.machine.stored_numbers import outward_12
from swayless.plant import Band

ROBUST_FAMILIES = ("si", "fd")
"""Specified insensitivity: the shortest shaper for a band. Fixed duration: the widest band for a duration."""

AMPLITUDE_RULES: tuple[str, ...] = get_args(Amplitudes)
MAX_BANDS = 4
ROBUST_TOLERANCE = quantity("ratio", *TOLERANCES)
ROBUST_DAMPING = quantity("ratio", 0.0, LARGEST_DAMPING_RATIO)
DURATION = quantity("time", 1e-6, 1e4)
_MAX_IMPULSES = 99


@dataclass(frozen=True)
class RobustRow:
    """One knob position that holds a range of frequencies.

    Parameters
    ----------
    name : str
        What people call it; printable ASCII.
    family : {"si", "fd"}
        Shortest shaper for the bands, or widest band for the duration.
    bands : tuple of Band
        What to hold, ends rounded outward to 12 digits. For "fd" the one frequency to start from.
    rope_range_m : tuple of two floats or None
        Shortest and longest rope, if the file gives ropes. For "fd" twice the longest.
    damping_ratios : tuple of two floats
        Lowest and highest to hold.
    tolerance : float
        Residual vibration allowed, as a ratio.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule.
    impulses : int or None
        For "unity-magnitude": how many. None: as many as it takes.
    duration_s : float or None
        For "fd".
    """

    name: str
    family: str
    bands: tuple[Band, ...]
    rope_range_m: tuple[float, float] | None
    damping_ratios: tuple[float, float]
    tolerance: float
    amplitudes: Amplitudes
    impulses: int | None
    duration_s: float | None

    @property
    def frequency_range_hz(self) -> tuple[float, float]:
        """Lowest and highest frequency of the lowest band."""
        return self.bands[0].low_hz, self.bands[0].high_hz


@dataclass(frozen=True)
class SignRule:
    """Which amplitudes a shaper may have.

    Parameters
    ----------
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule.
    impulses : int or None
        For "unity-magnitude": how many.
    """

    amplitudes: Amplitudes
    impulses: int | None


def read_sign_rule(table: Table, *, contactor: bool) -> SignRule | None:
    """Read ``amplitudes`` and ``impulses``; a contactor drive allows unity-magnitude and nothing else."""
    default = "unity-magnitude" if contactor else "positive"
    amplitudes = table.take("amplitudes", choice("sign rule", AMPLITUDE_RULES), default)
    impulses = table.take("impulses", _odd, None)
    if contactor and amplitudes not in {None, "unity-magnitude"}:
        reason = 'a contactor drive gives 0 or full speed: must be "unity-magnitude"'
        table.place("amplitudes").wrong(amplitudes, reason)
    if "impulses" in table.raw and amplitudes not in {None, "unity-magnitude"}:
        table.place("impulses").wrong(table.raw["impulses"], 'only with amplitudes = "unity-magnitude"')
    for rule in get_args(Amplitudes):
        if rule == amplitudes:
            return SignRule(rule, impulses)
    return None


def read_robust(
    kind: PlantKind,
    table: Table,
    name: str | None,
    family: str,
    *,
    damping_ratio: float,
    double_pendulum: DoublePendulum | None,
    contactor: bool,
) -> RobustRow | None:
    """Read what follows name and family; None where a value is missing or wrong."""
    is_si = family == "si"
    bands, rope_range_m = _read_bands(kind, table, double_pendulum, as_band=is_si)
    if double_pendulum is not None and not is_si:
        table.place("family").wrong(family, f"{_TWO_MODES}; only si does")
    damping_ratios = table.take(
        "damping_ratio",
        one_or_two(ROBUST_DAMPING) if is_si else _twice(ROBUST_DAMPING),
        (damping_ratio, damping_ratio),
    )
    tolerance = table.take("tolerance", ROBUST_TOLERANCE, DEFAULT_TOLERANCE)
    rule = read_sign_rule(table, contactor=contactor)
    duration_s = None if is_si else table.need("duration", DURATION)
    if name is None or bands is None or damping_ratios is None or tolerance is None or rule is None:
        return None
    if duration_s is None and not is_si:
        return None
    return RobustRow(
        name=name,
        family=family,
        bands=bands,
        rope_range_m=rope_range_m,
        damping_ratios=damping_ratios,
        tolerance=tolerance,
        amplitudes=rule.amplitudes,
        impulses=rule.impulses,
        duration_s=duration_s,
    )


_TWO_MODES = "does not hold both modes of a double pendulum"


def _read_bands(
    kind: PlantKind, table: Table, double_pendulum: DoublePendulum | None, *, as_band: bool
) -> tuple[tuple[Band, ...] | None, tuple[float, float] | None]:
    """Read what to hold, and the ropes that have it; as a band, or as the one place to start from."""
    ends = two if as_band else _twice
    keys = [key for key in ("rope_length", "frequency", "bands") if _takes(key, kind, as_band=as_band)]
    if len(keys) > 1:
        table.need_one_of(*keys)
    elif keys[0] not in table.raw:
        table.place(keys[0]).problem("missing")
    if double_pendulum is not None:
        for key in ("frequency", "bands"):
            if key in table.raw:
                reason = "a double pendulum has two frequencies for each rope: give rope_length"
                table.place(key).wrong(table.raw[key], reason)
    ropes_m = table.take("rope_length", ends(LENGTH), None) if "rope_length" in keys else None
    single = table.take("frequency", ends(FREQUENCY), None)
    pairs = table.take("bands", some(two(FREQUENCY), at_most=MAX_BANDS), None) if as_band else None
    if ropes_m is not None:
        pairs = tuple((band.low_hz, band.high_hz) for band in rope_bands(ropes_m, double_pendulum))
    elif single is not None:
        pairs = (single,)
    return None if pairs is None else tuple(Band(*outward_12(pair)) for pair in pairs), ropes_m


def _takes(key: str, kind: PlantKind, *, as_band: bool) -> bool:
    return kind == "crane" if key == "rope_length" else key == "frequency" or as_band


def _twice(single: Check[float]) -> Check[tuple[float, float]]:
    """Check for one value, given as both ends of a range."""

    def check(value: object, place: Place) -> tuple[float, float] | None:
        number = single(value, place)
        return None if number is None else (number, number)

    return check


def _odd(value: object, place: Place) -> int | None:
    number = integer(3, _MAX_IMPULSES)(value, place)
    if number is not None and number % 2 == 0:
        place.wrong(value, "must be odd: +1, -1, ..., +1")
        return None
    return number
