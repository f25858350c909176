"""The members that the records of a design file are made of: each a check with a way to store.

Not for: rules between members; the records keep those.
"""

from __future__ import annotations

from collections.abc import Iterable

from swayless.controller.spacing import MOST_SPACING_TICKS
from swayless.design.families.closed_form import LARGEST_ORDER
from swayless.machine.checks import choice, flag, integer, label, machine_name
from swayless.machine.problems import RefusedError, plain
from swayless.machine.record import Member, several
from swayless.machine.stored_numbers import (
    around_zero,
    counting,
    inward_12,
    real,
    rising,
    rising_from_zero,
    rising_pair,
    ruled,
    sums_to_one,
    sums_to_one_exactly,
)

MAX_IMPULSES = 4096
MAX_BANDS = 8
MAX_PLACES = 1 << 16
MAX_TEXT_LENGTH = 255


def word(what: str, known: Iterable[str]) -> Member:
    """Member that is one of the known words."""
    return Member(choice(what, known))


@plain
def _text(value: object) -> str:
    if not isinstance(value, str) or not value.isprintable() or not 1 <= len(value) <= MAX_TEXT_LENGTH:
        raise RefusedError(f"must be a printable text of 1 to {MAX_TEXT_LENGTH} characters")
    return value


NAME = Member(machine_name)
LABEL = Member(label)
TEXT = Member(_text)
ORDER = Member(integer(0, LARGEST_ORDER))
IMPULSES = Member(integer(1, MAX_IMPULSES))
FLAG = Member(flag)

FINITE = real("finite", lambda _: True)
AMPLITUDE = real("at least -1000 and at most 1000", lambda value: abs(value) <= 1000.0)
POSITIVE = real("finite and > 0", lambda value: value > 0.0)
NOT_NEGATIVE = real("finite and at least 0", lambda value: value >= 0.0)
DAMPING = real("at least 0 and below 1", lambda value: 0.0 <= value < 1.0)
TOLERANCE = real("above 0 and below 1", lambda value: 0.0 < value < 1.0)

RANGE = ruled(several(POSITIVE, at_least=2, at_most=2), rising_pair)
BAND = Member(RANGE.check, inward_12)
FURTHER_BANDS = several(BAND, at_least=0, at_most=MAX_BANDS)
DAMPING_RANGE = ruled(several(DAMPING, at_least=2, at_most=2), rising_pair)
STEPS = several(POSITIVE, at_least=3, at_most=3)
CONTACTOR_SPEEDS = ruled(several(POSITIVE, at_least=1, at_most=2), rising)
OFFSETS = ruled(several(FINITE, at_least=2, at_most=2), around_zero)
TIMES = ruled(several(FINITE, at_least=1, at_most=MAX_IMPULSES), rising_from_zero)
AMPLITUDES = ruled(several(AMPLITUDE, at_least=1, at_most=MAX_IMPULSES), sums_to_one)
DELAYS = ruled(several(Member(integer(0, 2**31 - 1)), at_least=1, at_most=MAX_IMPULSES), rising_from_zero)
PER_RAD = Member(integer(1, 2**53))
PLACES = ruled(several(FINITE, at_least=1, at_most=MAX_PLACES), rising)
FREQUENCIES = several(POSITIVE, at_least=1, at_most=MAX_PLACES)
SPACINGS = several(Member(integer(1, MOST_SPACING_TICKS)), at_least=1, at_most=MAX_PLACES)
MULTIPLES = ruled(several(Member(integer(0, MAX_IMPULSES)), at_least=2, at_most=MAX_IMPULSES), counting)
QUANTA = several(Member(integer(1, 2**22)), at_least=2, at_most=4097)
TAP_AMPLITUDES = ruled(
    several(Member(AMPLITUDE.check), at_least=1, at_most=MAX_IMPULSES), sums_to_one_exactly
)
