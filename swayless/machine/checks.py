"""The checks that machine and design files share: quantities in a range, integers, choices, labels.

Each function is a check, or makes one. Not for: how one value relates to another.
"""

from __future__ import annotations

from collections.abc import Iterable

from swayless.machine.names import name_problem
from swayless.machine.problems import Check, Place, RefusedError, T, nearest, plain
from swayless.machine.quantity import UNITS, Dimension, parse_quantity

MAX_LABEL_LENGTH = 24
_ENDS_A_COMMENT = ("(*", "*)", "/*", "*/", "??", "]]>", *"{}$\"'\\<>&")


def quantity(dimension: Dimension, low: float, high: float, *, below_high: bool = False) -> Check[float]:
    """Check for a quantity from `low` to `high` in SI, or below `high` when `below_high` is set."""
    unit = "" if dimension == "ratio" else next(iter(UNITS[dimension]))
    upper = f"below {high:g}" if below_high else f"at most {high:g}"
    allowed = f"must be at least {low:g} and {upper} {unit}".rstrip()

    @plain
    def check(value: object) -> float:
        number = parse_quantity(value, dimension)
        if low > 0.0 and number <= 0.0:
            raise RefusedError("must be > 0")
        if number < low or number > high or (below_high and number == high):
            raise RefusedError(allowed)
        return number

    return check


def number(low: float, high: float) -> Check[float]:
    """Check for a plain number from `low` to `high`, ends included."""

    @plain
    def check(value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            raise RefusedError(f"must be a number from {low:g} to {high:g}")
        return float(value)

    return check


def one_or_two(single: Check[float]) -> Check[tuple[float, float]]:
    """Check for one value, or an array of one or two in any order: the ends of a range, rising."""

    def check(value: object, place: Place) -> tuple[float, float] | None:
        if not isinstance(value, list):
            number = single(value, place)
            return None if number is None else (number, number)
        if len(value) not in {1, 2}:
            place.wrong(value, "must be one value or an array of two")
            return None
        numbers = [single(item, place.item(index)) for index, item in enumerate(value)]
        good = [number for number in numbers if number is not None]
        return (min(good), max(good)) if len(good) == len(numbers) else None

    return check


def two(single: Check[float]) -> Check[tuple[float, float]]:
    """Check for an array of two different values in any order: the ends of a range, rising."""
    ends = one_or_two(single)

    def check(value: object, place: Place) -> tuple[float, float] | None:
        if not isinstance(value, list) or len(value) != 2:
            place.wrong(value, "must be an array of two values, the ends of a range")
            return None
        pair = ends(value, place)
        if pair is not None and pair[0] == pair[1]:
            place.wrong(value, "must be two different values, the ends of a range")
            return None
        return pair

    return check


def some(single: Check[T], *, at_least: int = 1, at_most: int) -> Check[tuple[T, ...]]:
    """Check for an array of `at_least` to `at_most` items."""

    def check(value: object, place: Place) -> tuple[T, ...] | None:
        if not isinstance(value, list) or not at_least <= len(value) <= at_most:
            size = f"{at_least}" if at_least == at_most else f"{at_least} to {at_most}"
            place.wrong(value, f"must be an array of {size}")
            return None
        items = [single(item, place.item(index)) for index, item in enumerate(value)]
        good = tuple(item for item in items if item is not None)
        return good if len(good) == len(items) else None

    return check


@plain
def flag(value: object) -> bool:
    """Check for true or false."""
    if not isinstance(value, bool):
        raise RefusedError("must be true or false")
    return value


def integer(low: int, high: int) -> Check[int]:
    """Check for an integer from `low` to `high`."""

    @plain
    def check(value: object) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise RefusedError(f"must be an integer from {low} to {high}")
        return value

    return check


def choice(what: str, known: Iterable[str]) -> Check[str]:
    """Check for one of the known words; `what` they are stands in the message."""
    words = tuple(known)

    @plain
    def check(value: object) -> str:
        if not isinstance(value, str):
            raise RefusedError(f"must be a text; known: {', '.join(words)}")
        if value not in words:
            raise RefusedError(f"unknown {what}; {nearest(value, words)}")
        return value

    return check


@plain
def label(value: object) -> str:
    """Check for a short text that can stand in a comment of every language that is generated."""
    if not isinstance(value, str):
        raise RefusedError("must be a text")
    if not 1 <= len(value) <= MAX_LABEL_LENGTH:
        raise RefusedError(f"must have 1 to {MAX_LABEL_LENGTH} characters, has {len(value)}")
    if not (value.isascii() and value.isprintable()) or value != value.strip():
        raise RefusedError("must be printable ASCII without blanks at its ends")
    found = [text for text in _ENDS_A_COMMENT if text in value]
    if found:
        raise RefusedError(f"must not contain {' '.join(found)} (it stands in generated comments)")
    return value


@plain
def machine_name(value: object) -> str:
    """Check for a name that can prefix every generated symbol."""
    if not isinstance(value, str):
        raise RefusedError("must be a text")
    reason = name_problem(value)
    if reason is not None:
        raise RefusedError(reason)
    return value
