"""What stands in the stored file of a motion profile, schema ``swayless.profile/1``, and its checks.

Numbers that run, and the plant, are stored with all their digits: what is proved is what runs. The command
is stored to 12 digits, which is what it was made from. Not for: reading or writing files.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from swayless.controller.profile.pieces import LARGEST_DEGREE, LARGEST_LENGTH
from swayless.controller.profile.settings import LARGEST_INPUT
from swayless.design.optimal.linear_plant import LARGEST_ORDER
from swayless.design.optimal.robustification import LARGEST_ROBUST_ORDER
from swayless.design.optimal.task import LARGEST_TICKS
from swayless.machine.checks import choice, integer
from swayless.machine.design_members import FINITE, NAME, NOT_NEGATIVE, POSITIVE, TEXT
from swayless.machine.record import Member, Record, one, optional, several, where_needed
from swayless.machine.stored_numbers import real

SCHEMA = "swayless.profile/1"

MOST_STATES = 64

_EXACT = Member(FINITE.check)
_TICK = real("from 1e-06 to 1", lambda value: 1e-6 <= value <= 1.0)
_INPUT = Member(real(f"at most {LARGEST_INPUT:g} in size", lambda value: abs(value) <= LARGEST_INPUT).check)
_PLANT_ROW = several(_EXACT, at_least=1, at_most=LARGEST_ORDER)
_STATES = several(_EXACT, at_least=1, at_most=MOST_STATES)
_GAINS = several(_EXACT, at_least=2, at_most=MOST_STATES + 1)
_LENGTHS = several(Member(integer(1, LARGEST_LENGTH)), at_least=1, at_most=LARGEST_TICKS)
_POLYNOMIAL = several(_EXACT, at_least=1, at_most=LARGEST_DEGREE + 1)
_RANGE = several(Member(integer(1, LARGEST_TICKS)), at_least=2, at_most=2)
_PAIR = several(_EXACT, at_least=2, at_most=2)

Rows = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class PlantRecord(Record):
    """A state space."""

    a: Annotated[Rows, several(_PLANT_ROW, at_least=1, at_most=LARGEST_ORDER)]
    b: Annotated[tuple[float, ...], _PLANT_ROW]
    c: Annotated[tuple[float, ...], _PLANT_ROW]
    d: Annotated[float, _EXACT]


@dataclass(frozen=True)
class CommandRecord(Record):
    """What was computed: one value a tick."""

    hold: Annotated[str, Member(choice("hold", ("zero-order", "first-order")))]
    initial_value: Annotated[float, FINITE]
    final_value: Annotated[float, FINITE]
    values: Annotated[tuple[float, ...], several(FINITE, at_least=1, at_most=LARGEST_TICKS)]


@dataclass(frozen=True)
class TableRecord(Record):
    """Pieces of the shape."""

    lengths: Annotated[tuple[int, ...], _LENGTHS]
    coefficients: Annotated[Rows, several(_POLYNOMIAL, at_least=1, at_most=LARGEST_TICKS)]


@dataclass(frozen=True)
class ModelRecord(Record):
    """The plant from tick to tick, in the number type."""

    change: Annotated[Rows, several(_STATES, at_least=1, at_most=MOST_STATES)]
    input: Annotated[tuple[float, ...], _STATES]
    output: Annotated[tuple[float, ...], _STATES]
    feedthrough: Annotated[float, _EXACT]


@dataclass(frozen=True)
class StopRecord(Record):
    """Pieces of the gains after an abort, and ticks in which they begin; null where no stop is of use."""

    lengths: Annotated[tuple[int, ...], _LENGTHS]
    coefficients: Annotated[
        tuple[Rows, ...],
        several(several(_GAINS, at_least=1, at_most=LARGEST_DEGREE + 1), at_least=1, at_most=LARGEST_TICKS),
    ]
    rest: Annotated[tuple[float, ...], _GAINS]
    ranges: Annotated[tuple[tuple[int, ...], ...], several(_RANGE, at_least=1, at_most=LARGEST_TICKS)]


@dataclass(frozen=True)
class ExtremesRecord(Record):
    """Least and largest of all that can be played."""

    shape: Annotated[tuple[float, ...], _PAIR]
    rest: Annotated[tuple[float, ...], _PAIR]


@dataclass(frozen=True)
class GuaranteeRecord(Record):
    """What is promised, and proved again whenever the file is loaded."""

    final_error_ratio: Annotated[float, NOT_NEGATIVE]
    stop_error_ratio: Annotated[float, NOT_NEGATIVE]
    rounding_gain: Annotated[float, NOT_NEGATIVE]
    rate_excess_ratio: Annotated[float | None, where_needed(NOT_NEGATIVE)]
    final_swing_ratio: Annotated[float | None, where_needed(NOT_NEGATIVE)]
    stop_swing_ratio: Annotated[float | None, where_needed(NOT_NEGATIVE)]


@dataclass(frozen=True)
class ProfileRecord(Record):
    """The document."""

    schema: Annotated[str, Member(choice("schema", (SCHEMA,)))]
    name: Annotated[str, NAME]
    source: Annotated[str, TEXT]
    generator: Annotated[str, TEXT]
    number: Annotated[str, Member(choice("number type", ("double", "float")))]
    tick_s: Annotated[float, _TICK]
    start: Annotated[float, FINITE]
    target: Annotated[float, FINITE]
    limit: Annotated[tuple[float, ...], several(_INPUT, at_least=2, at_most=2)]
    rate_limit_per_s: Annotated[float | None, optional(Member(POSITIVE.check))]
    robust_order: Annotated[int, Member(integer(0, LARGEST_ROBUST_ORDER))]
    split_ratio: Annotated[float | None, optional(POSITIVE)]
    plant: Annotated[PlantRecord, one(PlantRecord)]
    command: Annotated[CommandRecord, one(CommandRecord)]
    guarantee: Annotated[GuaranteeRecord, one(GuaranteeRecord)]
    hold_ratio: Annotated[float, _EXACT]
    max_travel: Annotated[float, _EXACT]
    extremes: Annotated[ExtremesRecord, one(ExtremesRecord)]
    table: Annotated[TableRecord, one(TableRecord)]
    model: Annotated[ModelRecord, one(ModelRecord)]
    stop: Annotated[StopRecord | None, optional(one(StopRecord))]
