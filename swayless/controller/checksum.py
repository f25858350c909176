"""A checksum over tables by arithmetic: the same in C, Structured Text and Python, in every number type.

Structured Text cannot see the bits of a real, so numbers are taken apart by exact operations: a real is
brought below 1 by a power of two, and each product with 2**16 gives a whole digit and an exact rest. The last
rest must be 0, and no number but 0 may be smaller than a last digit. Digits go into two sums modulo the prime
65537, the second one of all the first, as Fletcher did; no step leaves 31 bits. A changed bit of a whole
number or of a real's significand changes the first sum by a power of two, which the prime does not divide;
where a negative whole number borrows, by 65535 more or less, which makes no multiple of it either. Signs and
exponents change several digits, and so both sums. Not for: security, nor for which tables a block has
(`tables`).

References
----------
J. G. Fletcher, An arithmetic checksum for serial transmissions, IEEE Trans. Communications 30 (1982).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from swayless.controller.number import NumberType
from swayless.errors import ControllerError

BASE = 1 << 16
"""Digits are to this base, towards 0: with the sign of their number."""

MODULUS = BASE + 1
"""A prime. A sum below it and a digit need one correction."""

FEWEST_DIGITS = 2
"""Digits of a whole number of 32 bits, and of a real at least: loops of one trip are not portable."""

MOST_DIGITS = {"double": 12, "float": 7}
"""Digits of a real, at most, by type: numbers of one table far apart in size, and nothing leaves the type."""


class Checksum(NamedTuple):
    """The two sums, each at least 0 and below `MODULUS`."""

    first: int
    second: int


@dataclass(frozen=True)
class Table:
    """Numbers of a table, in order, and how each is taken apart.

    Parameters
    ----------
    name : str
        For messages.
    numbers : tuple of float or int
        Reals of the number type, or whole numbers of 32 bits.
    limit : float or None
        Power of two, in the number type, above every real; None for whole numbers.
    digits : int
        Digits of each number.
    """

    name: str
    numbers: tuple[Any, ...]
    limit: Any
    digits: int

    @property
    def least(self) -> Any:
        """Size of the last digit of a real: smaller ones but 0 are none of the table."""
        return self.limit / type(self.limit)(BASE) ** self.digits


def whole_table(name: str, numbers: Iterable[Any]) -> Table:
    """Make a table of whole numbers.

    Parameters
    ----------
    name : str
        For messages.
    numbers : iterable of int
        -2**31 to 2**31 - 1.

    Raises
    ------
    ControllerError
        If a number has more than 32 bits.
    """
    kept = tuple(int(number) for number in numbers)
    for number in kept:
        if not -(1 << 31) <= number < 1 << 31:
            raise ControllerError(f"table {name}: {number} has more than 32 bits")
    return Table(name, kept, None, FEWEST_DIGITS)


def real_table(name: str, numbers: Sequence[Any], number: NumberType) -> Table:
    """Make a table of reals, with the limit and the digits that hold every bit of them.

    Parameters
    ----------
    name : str
        For messages.
    numbers : sequence of float
        Finite, in the number type.
    number : NumberType
        ``"double"`` or ``"float"``.

    Raises
    ------
    ControllerError
        If a number is not finite, or the table holds numbers too far apart in size.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> real_table("ropes", [3.0, 6.5], number_type("double"))
    Table(name='ropes', numbers=(3.0, 6.5), limit=8.0, digits=2)
    """
    sizes = [abs(float(each)) for each in numbers]
    if not all(math.isfinite(size) for size in sizes):
        raise ControllerError(f"table {name}: every number must be finite")
    bits = math.frexp(max(sizes, default=0.0))[1]
    lowest = max((_lowest_bit(size) for size in sizes if size > 0.0), default=0)
    digits = max(-(-(bits + lowest) // 16), FEWEST_DIGITS)
    if digits > MOST_DIGITS[number.name]:
        raise ControllerError(f"table {name}: {min(sizes):g} and {max(sizes):g} are too far apart in size")
    return Table(name, tuple(numbers), number.scalar(2.0**bits), digits)


def _lowest_bit(size: float) -> int:
    """Binary places behind the point of a number, up to its lowest bit; negative for multiples of 2."""
    value = Fraction(size)
    twos = (value.numerator & -value.numerator).bit_length() - 1
    return value.denominator.bit_length() - 1 - twos


def checksum(tables: Iterable[Table]) -> Checksum | None:
    """Sum tables up.

    Parameters
    ----------
    tables : iterable of Table
        In order.

    Returns
    -------
    Checksum or None
        None if a real is not finite, not below the limit, or has a rest: not a number of this table.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> reals = real_table("amplitudes", [0.25, 0.75], number_type("double"))
    >>> checksum([whole_table("lags", [0, 70_000]), reals])
    Checksum(first=4465, second=55100)
    """
    first, second = 1, 0
    for table in tables:
        for number in table.numbers:
            digits = _whole_digits(number) if table.limit is None else _real_digits(number, table)
            if digits is None:
                return None
            for digit in digits:
                first = _within(first + digit)
                second = _within(second + first)
    return Checksum(first, second)


def _within(total: int) -> int:
    """Bring a sum back to 0 up to the modulus."""
    if total < 0:
        return total + MODULUS
    return total - MODULUS if total >= MODULUS else total


def _whole_digits(number: int) -> Iterator[int]:
    """Take a whole number apart, its higher digit first; division cuts towards 0, as in C."""
    higher = abs(number) // BASE
    yield higher if number >= 0 else -higher
    yield number - (higher if number >= 0 else -higher) * BASE


def _real_digits(number: Any, table: Table) -> list[int] | None:
    """Take a real apart; None if it is none of the table's kind."""
    if not -table.limit < number < table.limit or (number != 0 and abs(number) < table.least):
        return None
    rest, digits = number * (1 / table.limit), []
    for _ in range(table.digits):
        rest = rest * type(number)(BASE)
        digit = int(rest)
        digits.append(digit)
        rest = rest - type(number)(digit)
    return digits if rest == 0 else None
