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
    """

    has_minimum: bool
    has_resolution: bool
    has_inching: bool
    has_waiting_rows: bool
    has_rope: bool
    has_phase_clock: bool
    has_rope_rows: bool
    spacing_law: SpacingLaw | None

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
    limits = settings.limits
    return Features(
        has_minimum=limits.minimum_command > 0,
        has_resolution=limits.command_resolution > 0,
        has_inching=limits.inching_command > 0,
        has_waiting_rows=any(table.waits for table in settings.row_tables),
        has_rope=settings.rope is not None,
        has_phase_clock=settings.clock is not None,
        has_rope_rows=settings.bank.by_rope is not None and len(settings.bank.rows) > 1,
        spacing_law=spacing_law(settings),
    )
