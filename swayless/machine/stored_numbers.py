"""How numbers stand in a design file: 12 significant digits, bands rounded inward, tick amplitudes exactly.

Twelve digits are far finer than any guarantee, and coarse enough that two builds of a mathematical library
store the same text.

Not for: number literals of generated code.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Context

from swayless.machine.problems import Check, Place, RefusedError, plain
from swayless.machine.record import Member

DIGITS = 12
LATTICE = 10**DIGITS
"""Amplitudes on the tick grid are whole multiples of 1 / LATTICE: their decimal sum can be exactly 1."""

SUM_TOLERANCE = 1e-9
"""How far rounded amplitudes of continuous time may sum from 1."""

_DOWN, _NEAREST, _UP = (
    Context(DIGITS, rounding) for rounding in (ROUND_FLOOR, ROUND_HALF_EVEN, ROUND_CEILING)
)


def _round(value: float, context: Context) -> float:
    # From the shortest text of the double, so that a number already stored is left alone in every direction.
    return float(context.create_decimal(repr(float(value)))) + 0.0  # + 0.0 turns -0.0 into 0.0


def nearest_12(value: float) -> float:
    """Round to 12 significant digits.

    Examples
    --------
    >>> nearest_12(0.1 + 0.2), nearest_12(2.0 / 3.0)
    (0.3, 0.666666666667)
    """
    return _round(value, _NEAREST)


def inward_12(band: tuple[float, float]) -> list[float]:
    """Round the ends of a band to 12 significant digits, so that the stored band lies within the proven one.

    Examples
    --------
    >>> inward_12((1.0 / 3.0, 2.0 / 3.0))
    [0.333333333334, 0.666666666666]
    """
    return [_round(band[0], _UP), _round(band[1], _DOWN)]


def outward_12(band: tuple[float, float]) -> tuple[float, float]:
    """Round the ends of a band to 12 significant digits, so that it still holds all that it held.

    A band so rounded is stored as it is, so what was asked for lies within what is stored.

    Examples
    --------
    >>> outward_12((1.0 / 3.0, 2.0 / 3.0))
    (0.333333333333, 0.666666666667)
    """
    return _round(band[0], _DOWN), _round(band[1], _UP)


def real(allowed: str, holds: Callable[[float], bool]) -> Member:
    """Member that is a finite number for which `holds` is true; `allowed` says so in words."""

    @plain
    def check(value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise RefusedError("must be a number")
        if not (abs(value) <= sys.float_info.max and holds(value)):
            raise RefusedError(f"must be {allowed}")
        return float(value)

    return Member(check, nearest_12)


def ruled(member: Member, rule: Callable[..., str | None]) -> Member:
    """Member whose value also keeps a rule: a function that gives what is wrong with the value, or None."""

    def check(value: object, place: Place) -> object:
        found_before = len(place.report.problems)
        good = member.check(value, place)
        reason = rule(good) if len(place.report.problems) == found_before else None
        if reason is not None:
            place.problem(reason)
        return good

    checked: Check[object] = check
    return Member(checked, member.stored)


def rising_from_zero(values: tuple[float, ...]) -> str | None:
    """Rule: the first value is 0, and each is above the one before."""
    if values[0] != 0:
        return f"must start at 0, starts at {values[0]!r}"
    return rising(values)


def rising(values: tuple[float, ...]) -> str | None:
    """Rule: each value is above the one before."""
    falls = [index for index in range(1, len(values)) if values[index] <= values[index - 1]]
    return f"must rise, does not at item {falls[0]} ({values[falls[0]]!r})" if falls else None


def counting(values: tuple[int, ...]) -> str | None:
    """Rule: the values are 0, 1, 2 and so on."""
    return None if values == tuple(range(len(values))) else "must be 0, 1, 2 and so on"


def around_zero(ends: tuple[float, float]) -> str | None:
    """Rule: a range with 0 in it."""
    return (
        None if ends[0] <= 0.0 <= ends[1] else "must be the low end, at most 0, then the high end, at least 0"
    )


def sums_to_one(amplitudes: tuple[float, ...]) -> str | None:
    """Rule: the sum is 1, but for rounding."""
    total = sum(amplitudes)
    return None if abs(total - 1.0) <= SUM_TOLERANCE else f"must sum to 1, sum to {nearest_12(total)!r}"


def sums_to_one_exactly(amplitudes: tuple[float, ...]) -> str | None:
    """Rule: each amplitude is a multiple of 1e-12, and their decimal sum is exactly 1.

    Examples
    --------
    >>> sums_to_one_exactly((0.25, 0.5, 0.25))
    >>> sums_to_one_exactly((0.25, 0.5, 0.250000000001))
    'must sum to exactly 1, sum to 1.000000000001'
    """
    multiples = [round(amplitude * LATTICE) for amplitude in amplitudes]
    for amplitude, multiple in zip(amplitudes, multiples, strict=True):
        if multiple / LATTICE != amplitude:
            return f"must be whole multiples of 1e-12, {amplitude!r} is not"
    return (
        None if sum(multiples) == LATTICE else f"must sum to exactly 1, sum to {sum(multiples) / LATTICE!r}"
    )


def rising_pair(ends: tuple[float, float]) -> str | None:
    """Rule: low end, then high end; both may be the same."""
    return None if ends[0] <= ends[1] else "must be the low end, then the high end"
