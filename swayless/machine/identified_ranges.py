"""What the ranges of a machine file become when a swing was identified: kept, corrected or exchanged.

A single rope or frequency is exchanged for what was identified. A range is where the machine works: it is
kept, corrected by what its ropes were off, or widened to hold what was identified.

Not for: the text around them (`identified_text`).
"""

from __future__ import annotations

from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import NamedTuple

from swayless.errors import FileError
from swayless.machine.quantity import UNITS, Dimension, QuantityError, parse_quantity, unit_of
from swayless.plant import Band, pendulum_rope_length_m

_DIGITS = 6
LAST_DIGIT = 10.0 ** (1 - _DIGITS)
"""The largest that a last digit of a range can be, relative to the number."""

_ONE = 0.1
"""A range of ropes or frequencies that is narrower, relatively, is a single one and its uncertainty."""

_CORRECTED = "pendulum lengths by swayless identify"
_WITHIN = "two standard deviations to either side"


class Exchange(NamedTuple):
    """New ends of a range, or None to keep it; why, and a comment to leave beside it."""

    ends: tuple[str, ...] | None
    why: str
    note: str | None = None


def exchanged_ropes(
    place: str, old: object, band: Band, rope_offset_m: tuple[float, float] | None, comment: str
) -> Exchange:
    """Correct the ropes of a file by their offset, once; exchange a single one, measured without its length.

    Parameters
    ----------
    place : str
        File, key and value, for messages.
    old : object
        What stands in the file.
    band : Band
        What was identified.
    rope_offset_m : tuple of two floats or None
        By how much the pendulum is longer than what is shown, from and to.
    comment : str
        Beside the old value.

    Raises
    ------
    FileError
        If they are no lengths, a range of which one was measured, corrected already, or too short.
    """
    low_m, high_m = _parsed(place, old, "length")
    if rope_offset_m is None:
        if high_m - low_m > _ONE * high_m:
            raise FileError(
                [
                    f"{place}: is a range of ropes, and the swing tells of one: give --rope-length, what the"
                    " crane showed, and the range is kept and corrected by the difference"
                ]
            )
        ends_m = pendulum_rope_length_m(band.high_hz), pendulum_rope_length_m(band.low_hz)
        return Exchange(range_ends("length", old, *ends_m), _WITHIN)
    if _CORRECTED in comment:
        raise FileError(
            [
                f"{place}: are pendulum lengths already, says their comment: write what the crane shows, and"
                " delete the comment, to correct it anew"
            ]
        )
    least_m, most_m = rope_offset_m
    if low_m + least_m <= 0.0:
        raise FileError([f"{place}: corrected, its shortest would be {low_m + least_m:.4g} m: must be > 0"])
    return Exchange(
        range_ends("length", old, low_m + least_m, high_m + most_m),
        f"the pendulum is {least_m:+.4g} to {most_m:+.4g} m longer than shown",
        f"{_CORRECTED}; shown: {shown_value(old)}",
    )


def exchanged_frequencies(place: str, old: object, band: Band) -> Exchange:
    """Exchange a single frequency; let a range hold what was identified.

    Parameters
    ----------
    place, old, band
        As for `exchanged_ropes`.

    Raises
    ------
    FileError
        If they are no frequencies, or what was identified lies outside of their range.

    Examples
    --------
    >>> exchanged_frequencies("crane.toml", [0.17, 0.30], Band(0.165, 0.175)).ends
    ('0.165', '0.3')
    """
    low_hz, high_hz = _parsed(place, old, "frequency")
    if high_hz - low_hz <= _ONE * high_hz:
        return Exchange(range_ends("frequency", old, band.low_hz, band.high_hz), _WITHIN)
    held = f"{band.low_hz:.5g} to {band.high_hz:.5g} Hz"
    if low_hz <= band.low_hz and band.high_hz <= high_hz:
        return Exchange(None, f"a range, and it holds {held}")
    if band.high_hz < low_hz or high_hz < band.low_hz:
        raise FileError(
            [
                f"{place}: is a range, and what was identified, {held}, lies outside of it: write the range"
                " by hand, or a single frequency to be exchanged"
            ]
        )
    low, high = range_ends("frequency", old, band.low_hz, band.high_hz)
    assert isinstance(old, list)  # noqa: S101 - one value alone is no range
    first, last = (shown_value(end) for end in sorted(old, key=lambda end: parse_quantity(end, "frequency")))
    ends = low if band.low_hz < low_hz else first, high if band.high_hz > high_hz else last
    return Exchange(ends, f"a range, widened to hold {held}")


def _parsed(place: str, old: object, dimension: Dimension) -> tuple[float, float]:
    """Give the ends of a range in SI, or twice a single value."""
    try:
        values = [parse_quantity(end, dimension) for end in (old if isinstance(old, list) else [old])]
    except QuantityError as error:
        raise FileError([f"{place}: {error}"]) from error
    if not values:
        raise FileError([f"{place}: must be one value or two"])
    return min(values), max(values)


def toml_value(value: str | tuple[str, ...]) -> str:
    """Write a value, or the items of an array, as TOML."""
    return value if isinstance(value, str) else f"[{', '.join(value)}]"


def shown_value(value: object) -> str:
    """Write a value as its file does, or that it was not there."""
    if value is None:
        return "not given"
    if isinstance(value, list):
        return f"[{', '.join(shown_value(item) for item in value)}]"
    return f'"{value}"' if isinstance(value, str) else f"{value}"


def range_ends(dimension: Dimension, old: object, low: float, high: float) -> tuple[str, str]:
    """Write the ends of a range in the unit of the file, rounded outward."""
    unit = unit_of(old, dimension)
    first = old[0] if isinstance(old, list) else old
    low_text = _rounded(low, dimension, unit, ROUND_FLOOR)
    high_text = _rounded(high, dimension, unit, ROUND_CEILING)
    return (
        (f'"{low_text} {unit}"', f'"{high_text} {unit}"') if isinstance(first, str) else (low_text, high_text)
    )


def _rounded(value: float, dimension: Dimension, unit: str, rounding: str) -> str:
    size = UNITS[dimension][unit]
    exact = Fraction(value) / size
    context = Context(prec=_DIGITS, rounding=rounding)
    return f"{context.divide(Decimal(exact.numerator), Decimal(exact.denominator)).normalize():f}"
