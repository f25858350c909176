"""Row, ramp and shaper: from the command that counts to the reference. Not for: what counts, or stops."""

from __future__ import annotations

from typing import Any

from swayless.controller.phase_filter import FloatPhaseFilter, PhaseFilter
from swayless.controller.phase_filter_int32 import IntegerPhaseFilter
from swayless.controller.ramp import ramped
from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import SpacedFilter
from swayless.controller.spacing_laws import spaced_filter
from swayless.controller.tap_filter import TapFilter, tap_filter

Filter = TapFilter | PhaseFilter | SpacedFilter


class Motion:
    """Where the block is: row, target of the ramp, ramped command and reference; after power-on at rest at 0.

    Parameters
    ----------
    settings : ShaperSettings
        Rows, limits and number type.
    shaper : TapFilter, PhaseFilter or SpacedFilter
        What shapes.
    """

    def __init__(self, settings: ShaperSettings, shaper: Filter) -> None:
        self._limits, self._tables = settings.limits, settings.row_tables
        self._last = settings.longest_lag
        self._zero = settings.number.scalar(0)
        self.filter = shaper
        self.target = self.command = self.reference = self._zero
        self.still = self._last
        self.row = 0
        self.is_inching = False

    @property
    def is_settled(self) -> bool:
        """Whether nothing is pending, so that a row may change."""
        return self.still >= self._last

    @property
    def waits(self) -> bool:
        """Whether the row in use takes a new command at rest only."""
        return self._tables[self.row].waits

    @property
    def pending(self) -> Any:
        """Sum of the references to come from what is under way."""
        return self.filter.pending(self.row)

    def inches(self, command: Any, wanted: Any) -> bool:
        """Whether a change between two commands passes unshaped, both being small."""
        limit = self._limits.inching_command
        return bool(abs(command) <= limit and abs(wanted) <= limit and not command == wanted == 0)

    def choose_row(self, wanted_row: int, command: Any, next_row: int | None = None) -> None:
        """Change to the wanted row, or to row 0 for a small command, where the block has settled.

        Parameters
        ----------
        wanted_row : int
            Row that is wanted.
        command : float or int
            Command of the tick.
        next_row : int or None
            The one row that may take over while the crane moves; None: every row.
        """
        if not self.is_settled:
            return
        if wanted_row > 0 and self.inches(self.command, command):
            self.is_inching, self.row = True, 0
        elif next_row is None or self.command == 0 or wanted_row == next_row:
            self.is_inching, self.row = False, wanted_row

    def accept(self, command: Any) -> bool:
        """Make a command the ramp's target, at once or, where amplitudes are negative, at rest only.

        Returns
        -------
        bool
            Whether it is the target now.
        """
        wanted = command
        if self.is_inching:
            limit = self._limits.inching_command
            wanted = min(max(command, -limit), limit)
        if not self.waits:
            self.target = wanted
        elif self.is_settled:
            reverses = (self.command > 0 and wanted < 0) or (self.command < 0 and wanted > 0)
            self.target = self._zero if reverses else wanted
        return bool(self.target == command)

    def ramp(self) -> Any:
        """Next command on the ramp to the target."""
        return ramped(self.command, self.target, self._limits)

    def follow(self, command: Any) -> None:
        """Shape the command of a tick."""
        before, self.command = self.command, command
        still = max(min(self.still + self.filter.elapsed, self._last), 0)
        self.still = still if command == before else 0
        if self.still >= self._tables[self.row].tail:
            self.filter.rest(command)
            self.reference = command
        else:
            self.reference = self.filter.run(command, self.row)
            if self.filter.has_pushed:
                self.still = 0

    def stop(self, *, at_once: bool) -> None:
        """Take the reference to 0 and what is pending with it: the shaper rests at the reference."""
        reach = abs(self.reference) - self._limits.quick_stop_step
        if at_once or reach <= 0:
            self.reference = self._zero
        else:
            self.reference = reach if self.reference > 0 else -reach
        self.command = self.target = self.reference
        self.still = self._last if self.reference == 0 else 0
        self.is_inching = False
        self.filter.rest(self.reference)


def filter_of(settings: ShaperSettings) -> Filter:
    """Make the filter of a block: of its clock, in its number type, at rest at 0."""
    if settings.is_spaced:
        return spaced_filter(settings)
    if settings.clock is None:
        return tap_filter(settings)
    return IntegerPhaseFilter(settings) if settings.number.is_integer else FloatPhaseFilter(settings)
