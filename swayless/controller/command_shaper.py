"""The command shaper: the Python reference of the generated block.

Per tick: read the inputs, see to the stops, choose the row, ramp, shape, foretell the stop. The order of
operations is the law: the generated C and Structured Text follow it to the last bit. Not for: text.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.command_reader import CommandReader
from swayless.controller.diagnosis import Diagnosis
from swayless.controller.ends import Switches
from swayless.controller.foretelling import Foretelling
from swayless.controller.motion import Motion, filter_of
from swayless.controller.output_units import OutputUnits
from swayless.controller.pins import ShaperInput, ShaperOutput
from swayless.controller.rope import Rope
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import ERROR_BITS, Status
from swayless.controller.step_mode import StepMode
from swayless.controller.step_motion import StepMotion
from swayless.controller.stops import Stops
from swayless.controller.travel import Travel
from swayless.controller.tuning import Tuning

__all__ = ["CommandShaper", "ShaperInput", "ShaperOutput"]

# Plain integers: the flag type is an order of magnitude slower, and this runs millions of times.
_DISABLED, _UNSHAPED, _ROW_WAITS = int(Status.DISABLED), int(Status.UNSHAPED), int(Status.ROW_WAITS)
_COMMAND_WAITS, _SELECTOR_INVALID = int(Status.COMMAND_WAITS), int(Status.SELECTOR_INVALID)
_INCHING = int(Status.INCHING)
_ERRORS = int(ERROR_BITS)


class CommandShaper:
    """A command shaper with its state, at rest at 0.

    Parameters
    ----------
    settings : ShaperSettings
        Rows, limits and number type.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        self._settings, self._by_rope = settings, settings.bank.by_rope
        self._zero = settings.number.scalar(0)
        self._units = OutputUnits(settings)
        self._foretelling = Foretelling(settings)
        self.init()

    def init(self) -> None:
        """Return to the state after power-on: at rest at 0, row 0, nothing latched."""
        settings, operator = self._settings, self._settings.operator
        self._filter = filter_of(settings)
        self._rope = Rope(settings.rope, settings.number) if settings.rope else None
        self._diagnosis = Diagnosis(settings)
        self._motion, self._stops = Motion(settings, self._filter), Stops(settings)
        self._reader = CommandReader(settings)
        self._tuning = Tuning(settings) if operator.is_tuned else None
        self._switches = Switches(settings) if operator.has_switches else None
        self._travel = Travel(settings) if operator.way else None
        self._steps = StepMode(settings) if operator.steps else None
        self._step_motion = StepMotion(settings, self._travel) if operator.steps else None
        found = (self._tuning, self._switches, self._travel, self._steps)
        self._functions = tuple(part for part in found if part is not None)
        self._selected_row = self._wanted_row = 0
        self._rope_row = 1
        self._row_is_locked = False
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
        if not self._diagnosis.tables_match:
            return self._diagnosis.refusal
        motion, stops = self._motion, self._stops
        if self._tuning is not None:
            inputs = self._tuning.read(inputs)
        self._status = self._read_rope(inputs)
        motion.reference = stops.watch_drive(inputs, motion.reference)
        command = self._read_command(inputs)
        self._want_row(inputs)
        hits = self._switches is not None and self._switches.hit(motion)
        stops.latch(inputs, hits=hits, is_zero=self._reader.is_zero, reference=motion.reference)
        if self._travel is not None:
            self._travel.read(inputs, motion)
        if self._steps is not None:
            self._read_steps(inputs, self._steps)
        if stops.is_latched:
            self._stop(at_once=stops.is_halted)
        else:
            self._move(command)
        self._diagnosis.watch(motion.reference, inputs.actual_speed, expected=not stops.is_halted)
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

    def _read_command(self, inputs: ShaperInput) -> Any:
        """Read the command as far as locks, limits and switches let it count."""
        locks = self._steps is not None and self._steps.is_running
        command = self._reader.read(inputs.command, locks=locks)
        if self._tuning is not None:
            command = self._tuning.limited(command)
        if self._switches is not None:
            command = self._switches.limited(command, inputs)
        return command

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

    def _read_steps(self, inputs: ShaperInput, steps: StepMode) -> None:
        """Take the step buttons; a press counts while steps run, or at rest while no speed is commanded."""
        motion = self._motion
        free = motion.is_settled and motion.command == 0 and self._reader.is_zero
        starts = (steps.is_running or free) and not self._stops.is_latched
        self._row_is_locked = steps.is_running
        steps.read(inputs, self._switches, starts=starts and self._speed_limit > 0)

    @property
    def _speed_limit(self) -> Any:
        return self._settings.limits.max_command if self._tuning is None else self._tuning.speed_limit

    def _stop(self, *, at_once: bool) -> None:
        self._motion.stop(at_once=at_once)
        if self._steps is not None:
            self._steps.cancel()

    def _move(self, command: Any) -> None:
        """Choose the row when settled; ramp, or step; then shape, but never towards a made stop switch."""
        motion, steps = self._motion, self._steps
        if not self._row_is_locked:
            next_row = None if self._travel is None else self._travel.next_row
            motion.choose_row(self._wanted_row, command, next_row)
        if steps is not None and steps.is_running:
            self._make_steps(steps)
        else:
            self._ramp(command)
        if self._switches is not None and self._switches.shut(motion.reference):
            self._stops.is_quick = True
            self._stop(at_once=True)

    def _ramp(self, command: Any) -> None:
        motion, travel = self._motion, self._travel
        if not motion.accept(command if travel is None else travel.wanted(motion, command)):
            self._status |= _COMMAND_WAITS
        motion.follow(motion.ramp() if travel is None else travel.next(motion))

    def _make_steps(self, steps: StepMode) -> None:
        motion, step_motion = self._motion, self._step_motion
        assert step_motion is not None  # noqa: S101 - steps come with their motion
        motion.target = step_motion.command(motion, steps, self._switches, self._speed_limit)
        motion.follow(motion.target)
        if motion.is_settled and motion.command == 0:
            steps.finish()

    def _outputs(self) -> ShaperOutput:
        motion, wanted_row = self._motion, self._wanted_row
        if self._travel is not None:
            self._travel.look_ahead(motion, wanted_row)
        to_come = self._foretelling.foretell(motion, self._stops, self._steps, wanted_row, self._travel)
        row = 0 if self._stops.is_latched else motion.row
        status, diagnosis = self._full_status(), self._diagnosis
        length = self._zero if self._rope is None else self._rope.length
        return ShaperOutput(
            reference=motion.reference,
            stop_distance=self._units.distance(to_come.total),
            stop_time_s=self._units.time_s(to_come.ticks),
            stop_time_ticks=to_come.ticks,
            residual_bound=diagnosis.residual_bound(row, length, status),
            row=motion.row,
            settled=motion.is_settled,
            active=row > 0,
            error=(status & _ERRORS) != 0,
            status=status,
            predicted_sway=diagnosis.predicted_sway(motion.reference, motion.row, length),
            design_id=diagnosis.design_id,
        )

    def _full_status(self) -> int:
        motion = self._motion
        status = self._status | self._reader.status | self._stops.status | self._diagnosis.status
        for part in self._functions:
            status |= part.status
        if motion.row == 0:
            status |= _UNSHAPED
        if not motion.is_inching and motion.row != self._wanted_row:
            status |= _ROW_WAITS
        if motion.is_inching:
            status |= _INCHING
        return status
