"""What a design file holds of the functions that a block has only where they are asked for.

Not for: what the functions do (`swayless.controller`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Annotated, TypeAlias

from swayless.controller.operator_options import OperatorOptions
from swayless.machine.design_members import CONTACTOR_SPEEDS, FLAG, NOT_NEGATIVE, OFFSETS, POSITIVE, STEPS
from swayless.machine.diagnostics_section import NO_DIAGNOSTICS, DiagnosticsSection
from swayless.machine.operator_section import NO_FUNCTIONS
from swayless.machine.record import Record, one, optional

Floats: TypeAlias = tuple[float, ...]
Pair: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class OperatorRecord(Record):
    """What an operator touches besides command and knob; the fields are those of `OperatorOptions`."""

    step_sizes_m: Annotated[Floats | None, optional(STEPS)] = None
    step_speed_m_s: Annotated[float | None, optional(POSITIVE)] = None
    stop_switches: Annotated[bool, FLAG] = False
    slow_speed_m_s: Annotated[float | None, optional(POSITIVE)] = None
    limit_margin_m: Annotated[float | None, optional(NOT_NEGATIVE)] = None
    contactor_speeds_m_s: Annotated[Floats | None, optional(CONTACTOR_SPEEDS)] = None
    drive_feedback: Annotated[bool, FLAG] = False
    speed_limit: Annotated[bool, FLAG] = False
    rope_offset_m: Annotated[Pair | None, optional(OFFSETS)] = None
    start_from_zero: Annotated[bool, FLAG] = False

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require sizes for a speed of steps, and nothing that a contactor drive cannot do."""
        if self.step_speed_m_s is not None and self.step_sizes_m is None:
            yield "step_speed_m_s", "is not null, and step_sizes_m is"
        between = {"step_sizes_m": self.step_sizes_m is not None, "drive_feedback": self.drive_feedback}
        for key, asked in (between | {"speed_limit": self.speed_limit}).items():
            if asked and self.contactor_speeds_m_s is not None:
                yield key, "needs speeds between those of contactor_speeds_m_s"


@dataclass(frozen=True)
class TrackingRecord(Record):
    """When the drive counts as not following the reference."""

    tolerance_m_s: Annotated[float, POSITIVE]
    time_s: Annotated[float, NOT_NEGATIVE]
    delay_s: Annotated[float, NOT_NEGATIVE]


@dataclass(frozen=True)
class DiagnosticsRecord(Record):
    """What a block says of itself; the fields are those of `DiagnosticsSection`."""

    predicted_sway: Annotated[bool, FLAG] = False
    residual_bound_at_rope: Annotated[bool, FLAG] = False
    tracking: Annotated[TrackingRecord | None, optional(one(TrackingRecord))] = None
    design_check: Annotated[bool, FLAG] = False


def operator_record(options: OperatorOptions) -> OperatorRecord | None:
    """Give what the operator touches as it stands in the design file; None where nothing is asked for.

    Examples
    --------
    >>> operator_record(OperatorOptions()), operator_record(OperatorOptions(speed_limit=True)).speed_limit
    (None, True)
    """
    if options == NO_FUNCTIONS:
        return None
    return OperatorRecord(**{field.name: getattr(options, field.name) for field in fields(OperatorRecord)})


def operator_options(record: OperatorRecord) -> OperatorOptions:
    """Give what a design file asks for.

    Examples
    --------
    >>> operator_options(OperatorRecord(stop_switches=True)).stop_switches
    True
    """
    return OperatorOptions(**{field.name: getattr(record, field.name) for field in fields(OperatorOptions)})


def diagnostics_record(asked: DiagnosticsSection) -> DiagnosticsRecord | None:
    """Give what the block says of itself as it stands in the design file; None where nothing is asked for.

    Examples
    --------
    >>> diagnostics_record(DiagnosticsSection()), diagnostics_record(DiagnosticsSection(True)).predicted_sway
    (None, True)
    """
    if asked == NO_DIAGNOSTICS:
        return None
    tracking = None if asked.tracking is None else TrackingRecord(**vars(asked.tracking))
    return DiagnosticsRecord(**{**vars(asked), "tracking": tracking})
