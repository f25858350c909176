"""What a design file holds, and the rules that it keeps: the schema ``swayless.design/1`` as dataclasses.

Every class is one object of the JSON document, and every field one key; ``docs/design-file.md`` explains
them.

Not for: making a design; see `swayless.design` and `swayless.controller`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, TypeAlias

from swayless.controller.number import NUMBER_TYPES
from swayless.machine.bank_record import MAX_SHAPERS, BankRecord
from swayless.machine.controller_section import LAWS
from swayless.machine.design_members import (
    AMPLITUDES,
    BAND,
    DAMPING,
    DAMPING_RANGE,
    DELAYS,
    FINITE,
    FLAG,
    FURTHER_BANDS,
    IMPULSES,
    LABEL,
    MULTIPLES,
    NAME,
    NOT_NEGATIVE,
    ORDER,
    PER_RAD,
    POSITIVE,
    QUANTA,
    RANGE,
    TAP_AMPLITUDES,
    TEXT,
    TIMES,
    TOLERANCE,
    word,
)
from swayless.machine.following_row import SPACED_LAWS
from swayless.machine.law_record import law_disagreements
from swayless.machine.operator_record import DiagnosticsRecord, OperatorRecord
from swayless.machine.record import Record, one, one_of, optional, several, where_needed
from swayless.machine.robust_row import AMPLITUDE_RULES
from swayless.machine.spacing_record import PositionRecord, SpacingRecord
from swayless.machine.stored_numbers import nearest_12

SCHEMA = "swayless.design/1"
PLANT_KINDS = ("crane", "double_pendulum", "arm", "mode")

CLOSE = 1e-9
"""Relative difference that 12 digits may leave between a number and the numbers that it follows from."""

WORST_SLACK = 1e-6
"""By how much of the tolerance a worst residual may stand above it: rounding of a solver's last step."""

Pair: TypeAlias = tuple[float, float]
Floats: TypeAlias = tuple[float, ...]


@dataclass(frozen=True)
class DoublePendulumRecord(Record):
    """Sling and masses of a double pendulum, and the range of its upper mode."""

    sling_length_m: Annotated[float, POSITIVE]
    hook_mass_kg: Annotated[float, POSITIVE]
    load_mass_kg: Annotated[float, POSITIVE]
    upper_frequency_hz: Annotated[Pair, RANGE]


@dataclass(frozen=True)
class PlantRecord(Record):
    """What the design is for: a crane, a crane with hook and sling, an arm, or one mode without a machine."""

    kind: Annotated[str, word("kind", PLANT_KINDS)]
    rope_length_m: Annotated[Pair | None, optional(RANGE)]
    frequency_hz: Annotated[Pair, RANGE]
    damping_ratio: Annotated[float, DAMPING]
    double_pendulum: Annotated[DoublePendulumRecord | None, optional(one(DoublePendulumRecord))]
    hoist_speed_m_s: Annotated[float | None, optional(POSITIVE)]
    position: Annotated[PositionRecord | None, where_needed(one(PositionRecord))] = None

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require sling and masses exactly for a double pendulum, and positions of an arm only."""
        if self.position is not None:
            if self.kind != "arm":
                yield "position", f'is not null, and kind = "{self.kind}"'
            whole_hz = (min(self.position.frequency_hz), max(self.position.frequency_hz))
            if self.frequency_hz != whole_hz:
                yield "frequency_hz", f"is not the range of position.frequency_hz, {list(whole_hz)}"
        if (self.kind == "double_pendulum") != (self.double_pendulum is not None):
            found = "null" if self.double_pendulum is None else "not null"
            yield "double_pendulum", f'is {found}, and kind = "{self.kind}"'


@dataclass(frozen=True)
class SpeedLoopRecord(Record):
    """Trolley, load, and the speed loop between them; the fields are those of `ServoDrive`."""

    trolley_mass_kg: Annotated[float, POSITIVE]
    load_mass_kg: Annotated[float, POSITIVE]
    gain_n_s_m: Annotated[float, POSITIVE]
    integral_time_s: Annotated[float | None, optional(POSITIVE)]


@dataclass(frozen=True)
class DriveRecord(Record):
    """What the command is in, and its limits; the fields are those of `DriveSection`."""

    units: Annotated[str, LABEL]
    counts_per_m_s: Annotated[float | None, optional(POSITIVE)]
    max_speed_m_s: Annotated[float, POSITIVE]
    acceleration_m_s2: Annotated[float | None, optional(POSITIVE)]
    deceleration_m_s2: Annotated[float | None, optional(POSITIVE)]
    quick_stop_m_s2: Annotated[float | None, optional(POSITIVE)]
    minimum_speed_m_s: Annotated[float, NOT_NEGATIVE]
    inching_speed_m_s: Annotated[float, NOT_NEGATIVE]
    command_resolution_m_s: Annotated[float, NOT_NEGATIVE]
    contactor: Annotated[bool, FLAG]
    speed_loop: Annotated[SpeedLoopRecord | None, where_needed(one(SpeedLoopRecord))] = None

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require the small speeds to be below the full speed, and no ramp for a contactor drive."""
        for key in ("acceleration_m_s2", "deceleration_m_s2", "quick_stop_m_s2"):
            if self.contactor and getattr(self, key) is not None:
                yield key, "must be null: a contactor drive gives 0 or full speed"
        for key in ("minimum_speed_m_s", "inching_speed_m_s", "command_resolution_m_s"):
            if getattr(self, key) >= self.max_speed_m_s:
                yield key, f"must be below max_speed_m_s, {self.max_speed_m_s!r}"


@dataclass(frozen=True)
class ModeRecord(Record):
    """The mode that a shaper is made for, and the rope that has it, if one was given."""

    frequency_hz: Annotated[float, POSITIVE]
    damping_ratio: Annotated[float, DAMPING]
    rope_length_m: Annotated[float | None, optional(POSITIVE)]


@dataclass(frozen=True)
class GuaranteeRecord(Record):
    """What impulses hold: at most `tolerance` in the bands at every damping ratio, and so on the ropes."""

    tolerance: Annotated[float, TOLERANCE]
    frequency_hz: Annotated[Pair, BAND]
    further_frequency_hz: Annotated[tuple[Pair, ...], FURTHER_BANDS]
    damping_ratio: Annotated[Pair, DAMPING_RANGE]
    rope_length_m: Annotated[Pair, BAND]
    worst_residual_ratio: Annotated[float, NOT_NEGATIVE]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require bands that rise and are apart, and the worst residual to be within the tolerance."""
        for lower, upper in pairwise((self.frequency_hz, *self.further_frequency_hz)):
            if not lower[1] < upper[0]:
                yield (
                    "further_frequency_hz",
                    f"must rise and be apart: {upper[0]!r} is not above {lower[1]!r}",
                )
        if self.worst_residual_ratio > self.tolerance * (1.0 + WORST_SLACK):
            yield (
                "worst_residual_ratio",
                f"{self.worst_residual_ratio!r} is above the tolerance {self.tolerance!r}",
            )


@dataclass(frozen=True)
class TapsRecord(Record):
    """The impulses on the tick grid, which is what runs, and what they hold."""

    delays_ticks: Annotated[tuple[int, ...], DELAYS]
    amplitudes: Annotated[Floats, TAP_AMPLITUDES]
    duration_s: Annotated[float, NOT_NEGATIVE]
    overtravel_s: Annotated[float, FINITE]
    guarantee: Annotated[GuaranteeRecord, one(GuaranteeRecord)]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one amplitude for each delay."""
        yield from _lengths("delays_ticks", self.delays_ticks, self.amplitudes)


@dataclass(frozen=True)
class PhaseTapsRecord(Record):
    """The impulses at phases of the pendulum, which is what runs; times are those on the longest rope."""

    phases_rad: Annotated[Floats, TIMES]
    amplitudes: Annotated[Floats, TAP_AMPLITUDES]
    duration_s: Annotated[float, NOT_NEGATIVE]
    overtravel_s: Annotated[float, FINITE]
    guarantee: Annotated[GuaranteeRecord, one(GuaranteeRecord)]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one amplitude for each phase."""
        yield from _lengths("phases_rad", self.phases_rad, self.amplitudes)


@dataclass(frozen=True)
class SpacedTapsRecord(Record):
    """The impulses at multiples of the spacing, which is what runs; times are those at the widest spacing."""

    delays_spacings: Annotated[tuple[int, ...], MULTIPLES]
    amplitudes: Annotated[Floats, TAP_AMPLITUDES]
    duration_s: Annotated[float, NOT_NEGATIVE]
    overtravel_s: Annotated[float, FINITE]
    guarantee: Annotated[GuaranteeRecord, one(GuaranteeRecord)]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one amplitude for each multiple."""
        yield from _lengths("delays_spacings", self.delays_spacings, self.amplitudes)


AnyTapsRecord: TypeAlias = TapsRecord | PhaseTapsRecord | SpacedTapsRecord
"""Taps of any law."""

_TAPS: dict[str, type[Record]] = {
    "delays_ticks": TapsRecord,
    "phases_rad": PhaseTapsRecord,
    "delays_spacings": SpacedTapsRecord,
}
_DELAYS_OF_LAW: Mapping[str, str] = {"fixed": "delays_ticks", "phase": "phases_rad"} | dict.fromkeys(
    SPACED_LAWS, "delays_spacings"
)


@dataclass(frozen=True)
class ClockRecord(Record):
    """The table of the phase clock in the design's number type: quanta of a tick over the rope length."""

    quanta_per_rad: Annotated[int, PER_RAD]
    tick_quanta: Annotated[tuple[int, ...], QUANTA]


@dataclass(frozen=True)
class ShaperRecord(Record):
    """One row of the bank: the shaper in continuous time, and its taps where there is a tick."""

    name: Annotated[str, LABEL]
    family: Annotated[str, LABEL]
    order: Annotated[int | None, optional(ORDER)]
    delay_s: Annotated[float | None, optional(POSITIVE)]
    amplitude_rule: Annotated[str | None, optional(word("sign rule", AMPLITUDE_RULES))]
    impulses: Annotated[int | None, optional(IMPULSES)]
    mode: Annotated[ModeRecord, one(ModeRecord)]
    times_s: Annotated[Floats, TIMES]
    amplitudes: Annotated[Floats, AMPLITUDES]
    duration_s: Annotated[float, NOT_NEGATIVE]
    lower_bound_s: Annotated[float | None, optional(NOT_NEGATIVE)]
    overtravel_s: Annotated[float, FINITE]
    peak_factor: Annotated[float, POSITIVE]
    guarantee: Annotated[GuaranteeRecord, one(GuaranteeRecord)]
    taps: Annotated[AnyTapsRecord | None, optional(one_of(_TAPS))]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one amplitude for each time, what follows from them, and the damping of the mode."""
        for key, guarantee in self.guarantees.items():
            if guarantee.damping_ratio[0] != self.mode.damping_ratio:
                lowest, own = guarantee.damping_ratio[0], self.mode.damping_ratio
                yield f"{key}.damping_ratio", f"starts at {lowest!r}, mode.damping_ratio is {own!r}"
        yield from _lengths("times_s", self.times_s, self.amplitudes)
        if len(self.times_s) == len(self.amplitudes):
            yield from _moments(self, self.times_s)
            if not math.isclose(self.peak_factor, sum(map(abs, self.amplitudes)), rel_tol=CLOSE):
                yield "peak_factor", f"{self.peak_factor!r} is not the sum of the amplitudes' sizes"

    @property
    def guarantees(self) -> dict[str, GuaranteeRecord]:
        """Guarantees of the impulses and of the taps, by their keys."""
        of_taps = {} if self.taps is None else {"taps.guarantee": self.taps.guarantee}
        return {"guarantee": self.guarantee} | of_taps


@dataclass(frozen=True, kw_only=True)
class DesignFile(Record):
    """A whole design file.

    Examples
    --------
    >>> from dataclasses import fields
    >>> [field.name for field in fields(DesignFile)][:4]
    ['schema', 'name', 'generator', 'source']
    """

    schema: Annotated[str, word("schema", (SCHEMA,))] = SCHEMA
    name: Annotated[str, NAME]
    generator: Annotated[str, TEXT]
    source: Annotated[str | None, optional(TEXT)]
    law: Annotated[str, word("law", LAWS)]
    tick_s: Annotated[float | None, optional(POSITIVE)]
    number: Annotated[str, word("number type", NUMBER_TYPES)]
    plant: Annotated[PlantRecord, one(PlantRecord)]
    drive: Annotated[DriveRecord, one(DriveRecord)]
    shapers: Annotated[tuple[ShaperRecord, ...], several(one(ShaperRecord), at_least=1, at_most=MAX_SHAPERS)]
    bank: Annotated[BankRecord | None, optional(one(BankRecord))]
    clock: Annotated[ClockRecord | None, optional(one(ClockRecord))] = None
    spacing: Annotated[SpacingRecord | None, where_needed(one(SpacingRecord))] = None
    operator: Annotated[OperatorRecord | None, where_needed(one(OperatorRecord))] = None
    diagnostics: Annotated[DiagnosticsRecord | None, where_needed(one(DiagnosticsRecord))] = None

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require what no record sees by itself: between shapers, tick, drive and bank."""
        if self.bank is not None and len(self.bank.labels) != len(self.shapers):
            yield "bank.labels", f"has {len(self.bank.labels)} values, there are {len(self.shapers)} shapers"
        yield from law_disagreements(self)
        yield from self._speed_loop()
        if self.number == "int32" and self.drive.counts_per_m_s is None:
            yield "drive.counts_per_m_s", 'is null, and number = "int32" computes in counts'
        names = [shaper.name.lower() for shaper in self.shapers]
        for index, shaper in enumerate(self.shapers):
            if names[index] in names[:index]:
                yield f"shapers[{index}].name", f"is also the name of shapers[{names.index(names[index])}]"
            yield from _taps(f"shapers[{index}].taps", shaper.taps, self._unit_s(shaper.taps))
            yield from _law(f"shapers[{index}].taps", shaper.taps, self.law)
            yield from _whole(f"shapers[{index}].taps", shaper.taps, contactor=self.drive.contactor)

    def _speed_loop(self) -> Iterator[tuple[str, str]]:
        """Require a crane with ropes, and the law that holds their modes, where the load is felt."""
        if self.drive.speed_loop is None:
            return
        if self.plant.kind != "crane" or self.plant.rope_length_m is None or self.law != "fixed":
            yield "drive.speed_loop", 'needs plant.kind = "crane", plant.rope_length_m and law = "fixed"'

    def _unit_s(self, taps: AnyTapsRecord | None) -> float | None:
        """Time that delays of taps are counted in: a tick, or the widest spacing."""
        if isinstance(taps, SpacedTapsRecord) and self.spacing is not None and self.tick_s is not None:
            return max(self.spacing.ticks) * self.tick_s
        return self.tick_s


def _law(key: str, taps: AnyTapsRecord | None, law: str) -> Iterator[tuple[str, str]]:
    wanted = _DELAYS_OF_LAW[law]
    if taps is not None and not isinstance(taps, _TAPS[wanted]):
        yield key, f'must have {wanted}: law = "{law}"'


def _taps(key: str, taps: AnyTapsRecord | None, unit_s: float | None) -> Iterator[tuple[str, str]]:
    if (taps is None) != (unit_s is None):
        there, null = ("tick_s", key) if taps is None else (key, "tick_s")
        yield key, f"{null} is null and {there} is not: both or neither"
    elif isinstance(taps, TapsRecord | SpacedTapsRecord) and unit_s is not None:
        delays = taps.delays_ticks if isinstance(taps, TapsRecord) else taps.delays_spacings
        for figure, reason in _moments(taps, [delay * unit_s for delay in delays]):
            yield f"{key}.{figure}", reason


def _whole(key: str, taps: AnyTapsRecord | None, *, contactor: bool) -> Iterator[tuple[str, str]]:
    """Require that a contactor drive is only ever asked for 0 or full speed."""
    if contactor and taps is not None and any(abs(amplitude) != 1.0 for amplitude in taps.amplitudes):
        yield f"{key}.amplitudes", "must be 1 and -1: a contactor drive gives 0 or full speed"


def _lengths(key: str, times: Sequence[float], amplitudes: Floats) -> Iterator[tuple[str, str]]:
    if len(times) != len(amplitudes):
        yield "amplitudes", f"has {len(amplitudes)} values, {key} has {len(times)}"


def _moments(
    impulses: ShaperRecord | TapsRecord | SpacedTapsRecord, times_s: Sequence[float]
) -> Iterator[tuple[str, str]]:
    """Require the duration and the overtravel that follow from the impulses."""
    moments = [amplitude * time_s for amplitude, time_s in zip(impulses.amplitudes, times_s, strict=True)]
    last, total = nearest_12(times_s[-1]), nearest_12(sum(moments))
    if not math.isclose(impulses.duration_s, last, rel_tol=CLOSE):
        yield "duration_s", f"{impulses.duration_s!r} is not the time of the last impulse, {last!r}"
    if abs(impulses.overtravel_s - total) > CLOSE * sum(map(abs, moments)):
        yield "overtravel_s", f"{impulses.overtravel_s!r} is not the sum of amplitude times time, {total!r}"
