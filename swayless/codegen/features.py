"""Which parts of the law a design uses, so that templates print no more than those. Not for: numbers."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.codegen.law_text import spacing_law
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacingLaw


@dataclass(frozen=True)
class Features:
    """Parts of the law in use.

    Parameters
    ----------
    has_minimum, has_resolution, has_inching : bool
        Whether the limit of that name is not 0.
    has_waiting_rows : bool
        Whether a row has negative amplitudes.
    has_rope : bool
        Whether the rope, or the position of an arm, is measured.
    has_phase_clock : bool
        Whether delays are phases of the pendulum.
    has_rope_rows : bool
        Whether the rope chooses among several rows.
    spacing_law : "original", "modified" or None
        What happens when the spacing of the taps changes; None where they follow none.
    has_steps, has_stop_switches, has_slow_switches, has_way, has_contactor, has_feedback : bool
        What an operator, the ends of the travel and the drive do (`operator_settings`).
    has_speed_limit, has_rope_offset, starts_from_zero : bool
        What is set on site, and how the block starts.
    has_sway, has_rope_bounds, has_tracking, has_facts : bool
        What the block says of itself (`diagnostics`).
    """

    has_minimum: bool
    has_resolution: bool
    has_inching: bool
    has_waiting_rows: bool
    has_rope: bool
    has_phase_clock: bool
    has_rope_rows: bool
    spacing_law: SpacingLaw | None
    has_steps: bool
    has_stop_switches: bool
    has_slow_switches: bool
    has_way: bool
    has_contactor: bool
    has_feedback: bool
    has_speed_limit: bool
    has_rope_offset: bool
    starts_from_zero: bool
    has_sway: bool
    has_rope_bounds: bool
    has_tracking: bool
    has_facts: bool

    @property
    def has_switches(self) -> bool:
        """Whether there are stop or slow-down switches."""
        return self.has_stop_switches or self.has_slow_switches

    @property
    def is_tuned(self) -> bool:
        """Whether there is something to set on site."""
        return self.has_speed_limit or self.has_rope_offset

    @property
    def has_lock(self) -> bool:
        """Whether a command may be locked wherever it points."""
        return self.has_steps or self.starts_from_zero

    @property
    def has_approach(self) -> bool:
        """Whether commands keep within ways."""
        return self.has_steps or self.has_way

    @property
    def has_plan(self) -> bool:
        """Whether moves of rows that wait are planned to keep within ways."""
        return self.has_approach and self.has_waiting_rows

    @property
    def has_sway_rope(self) -> bool:
        """Whether the predicted sway follows a measured rope."""
        return self.has_sway and self.has_rope

    @property
    def can_idle(self) -> bool:
        """Whether a tick with the same inputs as the last may have nothing to do, at rest."""
        return not (self.has_approach or self.has_sway or self.has_tracking)

    @property
    def has_spacing(self) -> bool:
        """Whether delays are multiples of a spacing that is looked up each tick."""
        return self.spacing_law is not None

    @property
    def has_turn(self) -> bool:
        """Whether what is measured moves the taps."""
        return self.has_phase_clock or self.has_spacing

    @property
    def checked_doc(self) -> str:
        """What the check of the command does besides clamping."""
        parts = [", above the minimum"] if self.has_minimum else []
        parts += [", and new"] if self.has_resolution else []
        return "".join(parts)

    @property
    def accept_doc(self) -> str:
        """When a command becomes the target of the ramp."""
        if self.has_waiting_rows:
            return ": at once or, where amplitudes are negative, when settled only"
        return ""


def features_of(settings: ShaperSettings) -> Features:
    """Find the parts of the law that a design uses.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    limits, operator, diagnostics = settings.limits, settings.operator, settings.diagnostics
    return Features(
        has_minimum=limits.minimum_command > 0,
        has_resolution=limits.command_resolution > 0,
        has_inching=limits.inching_command > 0,
        has_waiting_rows=any(table.waits for table in settings.row_tables),
        has_rope=settings.rope is not None,
        has_phase_clock=settings.clock is not None,
        has_rope_rows=settings.bank.by_rope is not None and len(settings.bank.rows) > 1,
        spacing_law=spacing_law(settings),
        has_steps=operator.steps is not None,
        has_stop_switches=operator.has_stop_switches,
        has_slow_switches=operator.slow_command is not None,
        has_way=operator.way is not None,
        has_contactor=bool(operator.contactor_commands),
        has_feedback=operator.has_drive_feedback,
        has_speed_limit=operator.has_speed_limit,
        has_rope_offset=operator.rope_offset is not None,
        starts_from_zero=operator.starts_from_zero,
        has_sway=diagnostics.sway is not None,
        has_rope_bounds=diagnostics.rope_bounds is not None,
        has_tracking=diagnostics.tracking is not None,
        has_facts=diagnostics.facts is not None,
    )
