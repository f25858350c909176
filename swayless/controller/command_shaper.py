"""The command shaper: the Python reference of the generated block (`law = "fixed"`).

Per tick: check the command, see to the stops, choose the row, ramp, shape, foretell the stop. The order of
operations is the law: the generated C and Structured Text follow it to the last bit. Not for: text.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.output_units import OutputUnits, residual_bounds
from swayless.controller.phase_filter import FloatPhaseFilter, PhaseFilter
from swayless.controller.phase_filter_int32 import IntegerPhaseFilter
from swayless.controller.pins import ShaperInput, ShaperOutput
from swayless.controller.ramp import Glider, on_grid, ramped
from swayless.controller.rope import Rope
from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import SpacedFilter
from swayless.controller.spacing_laws import spaced_filter
from swayless.controller.status import ERROR_BITS, Status
from swayless.controller.tap_filter import TapFilter, tap_filter

__all__ = ["CommandShaper", "ShaperInput", "ShaperOutput", "filter_of"]

# Plain integers: the flag type is an order of magnitude slower, and this runs millions of times.
_DISABLED, _UNSHAPED, _ROW_WAITS = int(Status.DISABLED), int(Status.UNSHAPED), int(Status.ROW_WAITS)
_COMMAND_WAITS, _COMMAND_CLAMPED = int(Status.COMMAND_WAITS), int(Status.COMMAND_CLAMPED)
_COMMAND_INVALID, _SELECTOR_INVALID = int(Status.COMMAND_INVALID), int(Status.SELECTOR_INVALID)
_QUICK_STOP, _EMERGENCY_STOP = int(Status.QUICK_STOP), int(Status.EMERGENCY_STOP)
_BELOW_MINIMUM, _INCHING = int(Status.BELOW_MINIMUM), int(Status.INCHING)
_ERRORS = int(ERROR_BITS)


class CommandShaper:
    """A command shaper with its state, at rest at 0.

    Parameters
    ----------
    settings : ShaperSettings
        Rows, limits and number type.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        limits, number = settings.limits, settings.number
        self._settings, self._limits, self._number = settings, limits, number
        self._tables = settings.row_tables
        self._zero = number.scalar(0)
        self._on_grid = settings.clock is not None
        self._by_rope = settings.bank.by_rope
        self._last = settings.longest_lag
        self._bounds = residual_bounds(settings)
        self._units = OutputUnits(settings)
        self._speed_up = Glider(limits.acceleration_step, limits, number)
        self._slow_down = Glider(limits.deceleration_step, limits, number)
        self._quick_down = Glider(limits.quick_stop_step, limits, number)
        self.init()

    def init(self) -> None:
        """Return to the state after power-on: at rest at 0, row 0, nothing latched."""
        self._filter = filter_of(self._settings)
        self._rope = Rope(self._settings.rope, self._number) if self._settings.rope else None
        self._held = self._target = self._command = self._reference = self._zero
        self._still = self._last
        self._row = self._selected_row = self._wanted_row = 0
        self._rope_row = 1
        self._invalid = self._quick = self._emergency = self._inching = False
        self._status = 0

    def step(self, inputs: ShaperInput) -> ShaperOutput:
        """Run one tick.

        Parameters
        ----------
        inputs : ShaperInput
            Inputs of the tick; the command in the number type.

        Returns
        -------
        ShaperOutput
            Outputs of the tick.
        """
        self._status = self._read_rope(inputs)
        command = self._checked(inputs.command)
        self._want_row(inputs)
        self._latch_stops(inputs)
        if self._emergency or self._quick:
            self._stop()
        else:
            self._move(command)
        return self._outputs()

    def _read_rope(self, inputs: ShaperInput) -> int:
        if self._rope is None:
            return 0
        status = self._rope.read(
            inputs.rope_length,
            inputs.hoist_speed,
            valid=inputs.rope_length_valid,
            at_rest=not self._filter.is_running,
        )
        self._filter.turn(self._rope.length, self._rope.speed)
        return status

    def _checked(self, command: Any) -> Any:
        """Return the command as far as it is finite, within the maximum, above the minimum and new."""
        command, valid = self._finite(command)
        magnitude = abs(command)
        if magnitude < self._limits.minimum_command:
            if magnitude > 0:
                self._status |= _BELOW_MINIMUM
            command = self._zero
        command = self._resolved(command)
        self._zero_commanded = valid and command == 0
        if not valid:
            self._invalid = True
        elif self._zero_commanded:
            self._invalid = False
        if self._invalid:
            self._status |= _COMMAND_INVALID
        if self._invalid or self._zero_commanded:
            return self._zero
        return on_grid(command, self._limits) if self._on_grid else command

    def _finite(self, command: Any) -> tuple[Any, bool]:
        """Clamp the command to the maximum; a command that is not finite becomes 0 and is not valid."""
        limit = self._limits.max_command
        if -limit <= command <= limit:
            return command, True
        if self._number.is_integer or abs(command) * self._number.scalar(0.5) < abs(command):
            self._status |= _COMMAND_CLAMPED
            return (limit if command > 0 else -limit), True
        return self._zero, False

    def _resolved(self, command: Any) -> Any:
        """Hold the last command until it changes by the resolution; the maximum and 0 always arrive."""
        resolution, magnitude = self._limits.command_resolution, abs(command)
        if magnitude + magnitude < resolution:
            self._held = self._zero
        elif magnitude >= self._limits.max_command or abs(command - self._held) >= resolution:
            self._held = command
        return self._held

    def _want_row(self, inputs: ShaperInput) -> None:
        if inputs.selector <= self._settings.last_selector:
            self._selected_row = inputs.selector
        else:
            self._status |= _SELECTOR_INVALID
        self._wanted_row = self._selected_row
        if self._by_rope is not None and self._rope is not None:
            self._rope_row = self._by_rope.followed(self._rope_row, self._rope.length)
            if self._selected_row > 0:
                self._wanted_row = self._rope_row
        if not inputs.enable:
            self._status |= _DISABLED
            self._wanted_row = 0

    def _latch_stops(self, inputs: ShaperInput) -> None:
        if inputs.emergency_stop:
            self._emergency = True
        elif self._zero_commanded:
            self._emergency = False
        if inputs.quick_stop:
            self._quick = True
        elif self._zero_commanded and self._reference == 0:
            self._quick = False

    def _stop(self) -> None:
        """Take the reference to 0 and what is pending with it: the shaper rests at the reference."""
        reach = abs(self._reference) - self._limits.quick_stop_step
        if self._emergency or reach <= 0:
            self._reference = self._zero
        else:
            self._reference = reach if self._reference > 0 else -reach
        self._command = self._target = self._reference
        self._still = self._last if self._reference == 0 else 0
        self._inching = False
        self._filter.rest(self._reference)

    def _move(self, command: Any) -> None:
        if self._is_settled:
            self._inching = self._wanted_row > 0 and self._inches(self._command, command)
            self._row = 0 if self._inching else self._wanted_row
        self._accept(command)
        before, self._command = self._command, ramped(self._command, self._target, self._limits)
        still = max(min(self._still + self._filter.elapsed, self._last), 0)
        self._still = still if self._command == before else 0
        if self._still >= self._tables[self._row].tail:
            self._filter.rest(self._command)
            self._reference = self._command
        else:
            self._reference = self._filter.run(self._command, self._row)
            if self._filter.has_pushed:
                self._still = 0

    def _accept(self, command: Any) -> None:
        """Make the command the ramp's target, at once or, where amplitudes are negative, at rest only."""
        wanted = command
        if self._inching:
            limit = self._limits.inching_command
            wanted = min(max(command, -limit), limit)
        if not self._tables[self._row].waits:
            self._target = wanted
        elif self._is_settled:
            reverses = (self._command > 0 and wanted < 0) or (self._command < 0 and wanted > 0)
            self._target = self._zero if reverses else wanted
        if self._target != command:
            self._status |= _COMMAND_WAITS

    @property
    def _is_settled(self) -> bool:
        return self._still >= self._last

    def _inches(self, command: Any, wanted: Any) -> bool:
        limit = self._limits.inching_command
        return bool(abs(command) <= limit and abs(wanted) <= limit and not command == wanted == 0)

    def _row_at_rest(self, command: Any) -> int:
        """Row that takes over if the command becomes 0 when settled at `command`."""
        return 0 if self._inches(command, self._zero) else self._wanted_row

    def _foretell(self) -> tuple[Any, int]:
        """Sum of the references to come, and ticks until 0, if the command is 0 from the next tick on."""
        if self._emergency:
            return self._zero, 0
        if self._quick:
            glide = self._quick_down(self._reference, self._zero)
            return glide.total, glide.ticks
        if self._tables[self._row].waits and not self._is_settled and self._target != 0:
            return self._foretell_waiting()
        row = self._row_at_rest(self._command) if self._is_settled else self._row
        tail = self._tables[row].tail
        down = self._slow_down(self._command, self._zero)
        still = 0 if down.ticks > 0 else min(self._still, tail)
        ticks = down.ticks + self._filter.ticks_of(tail - still)
        return self._filter.pending(row) + down.total, ticks

    def _foretell_waiting(self) -> tuple[Any, int]:
        """Foretell a stop that waits: the ramp completes, the shaper settles, only then the 0 is accepted."""
        target = self._target
        glider = self._speed_up if abs(target) > abs(self._command) else self._slow_down
        rise = glider(self._command, target)
        hold = self._last if rise.ticks > 0 else self._last - self._still
        down = self._slow_down(target, self._zero)
        row = self._row_at_rest(target)
        change = self._filter.rest_sum(target, row) - self._filter.rest_sum(target, self._row)
        total = self._filter.pending(self._row) + rise.total
        total = total + (self._number.scalar(hold) * target)
        total = (total + change) + down.total
        return total, rise.ticks + hold + down.ticks + self._tables[row].tail

    def _outputs(self) -> ShaperOutput:
        total, ticks = self._foretell()
        stopped = self._emergency or self._quick
        row = 0 if stopped else self._row
        return ShaperOutput(
            reference=self._reference,
            stop_distance=self._units.distance(total),
            stop_time_s=self._units.time_s(ticks),
            stop_time_ticks=ticks,
            residual_bound=self._bounds[row],
            row=self._row,
            settled=self._is_settled,
            active=row > 0,
            error=(self._status & _ERRORS) != 0,
            status=self._full_status(),
        )

    def _full_status(self) -> int:
        status = self._status
        if self._row == 0:
            status |= _UNSHAPED
        if not self._inching and self._row != self._wanted_row:
            status |= _ROW_WAITS
        if self._quick:
            status |= _QUICK_STOP
        if self._emergency:
            status |= _EMERGENCY_STOP
        if self._inching:
            status |= _INCHING
        return status


def filter_of(settings: ShaperSettings) -> TapFilter | PhaseFilter | SpacedFilter:
    """Make the filter of a block: of its clock, in its number type, at rest at 0."""
    if settings.is_spaced:
        return spaced_filter(settings)
    if settings.clock is None:
        return tap_filter(settings)
    return IntegerPhaseFilter(settings) if settings.number.is_integer else FloatPhaseFilter(settings)
