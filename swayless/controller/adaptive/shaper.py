"""The adaptive command shaper, tick by tick. Not for: how coefficients are found; that is the learner."""

from __future__ import annotations

from typing import Any

from swayless.controller.adaptive.information import Coefficients
from swayless.controller.adaptive.learner import Learner
from swayless.controller.adaptive.pins import AdaptiveInput, AdaptiveOutput
from swayless.controller.adaptive.settings import AdaptiveSettings
from swayless.controller.adaptive.status import AdaptiveStatus
from swayless.controller.finite import is_finite

LARGEST_VIBRATION = 100.0
"""In units of `vibration_scale`: larger readings count as invalid, so that no sum can overflow."""

# Plain integers: the flag type is an order of magnitude slower, and this runs millions of times.
_DISABLED, _UNSHAPED = int(AdaptiveStatus.DISABLED), int(AdaptiveStatus.UNSHAPED)
_ADAPTING, _CONVERGED = int(AdaptiveStatus.ADAPTING), int(AdaptiveStatus.CONVERGED)
_CLAMPED, _INVALID = int(AdaptiveStatus.COMMAND_CLAMPED), int(AdaptiveStatus.COMMAND_INVALID)
_FROZEN, _AGAIN = int(AdaptiveStatus.FROZEN), int(AdaptiveStatus.LEARNING_AGAIN)
_REFUSED, _VIBRATION = int(AdaptiveStatus.SET_REFUSED), int(AdaptiveStatus.VIBRATION_INVALID)


class AdaptiveShaper:
    """Shapes a command by three impulses whose amplitudes it learns from the measured vibration.

    After a change of the command has passed, whatever still vibrates tells which amplitudes would have left
    nothing, whatever the delay between them. They are used from the end of the first cycle on, and change
    only while the command rests: the reference then is the command, bit for bit, whatever they are.

    Parameters
    ----------
    settings : AdaptiveSettings
        Delay, limits, scale and number type.

    References
    ----------
    S. Rhim, W. J. Book, Adaptive command shaping using adaptive filter approach in time domain, eqs 7-16.

    Examples
    --------
    >>> settings = AdaptiveSettings(25, 0.001, max_command=1.0, vibration_scale=1.0, cycle_ticks=4000)
    >>> shaper = AdaptiveShaper(settings)
    >>> output = shaper.step(AdaptiveInput(command=0.5, vibration=0.0))
    >>> output.reference, AdaptiveStatus(output.status)
    (0.5, <AdaptiveStatus.UNSHAPED: 2>)
    """

    def __init__(self, settings: AdaptiveSettings) -> None:
        scalar = settings.number.scalar
        self._settings, self._number = settings, settings.number
        self._max_command = scalar(settings.max_command)
        self._max_vibration = scalar(LARGEST_VIBRATION * settings.vibration_scale)
        self._per_scale = scalar(1.0 / settings.vibration_scale)
        self._learner = Learner(settings)
        self._is_shaping = False
        self._used: Coefficients = self._learner.coefficients
        self._commands = [scalar(0)] * settings.ring_length
        self._vibrations = [scalar(0)] * settings.ring_length
        self._command = self._vibration = scalar(0)
        self._head = self._rest_ticks = self._quiet_ticks = self._moved_ticks = 0
        self._status = 0

    def step(self, pins: AdaptiveInput) -> AdaptiveOutput:
        """Run one tick."""
        self._status = 0 if pins.enable else _DISABLED
        self._read_command(pins.command)
        self._read_vibration(pins.vibration)
        first, second = self._advance()
        adapting = self._learn(pins.enable, first, second)
        reference = self._shape(pins.enable, first, second)
        learner = self._learner
        self._status |= (
            (_ADAPTING if adapting else 0)
            | (_CONVERGED if learner.is_converged else 0)
            | (_FROZEN if learner.is_frozen else 0)
            | (_AGAIN if learner.learns_again else 0)
            | (_REFUSED if learner.was_refused else 0)
        )
        return AdaptiveOutput(
            reference, learner.coefficients, adapting, learner.is_converged, learner.is_frozen, self._status
        )

    def _read_command(self, command: Any) -> None:
        """Take a finite command within the maximum, and count how long it has rested."""
        if not abs(command) <= self._max_command:
            if is_finite(command, self._number):
                command = self._max_command if command > 0.0 else -self._max_command
                self._status |= _CLAMPED
            else:
                command = self._command
                self._status |= _INVALID
        settings = self._settings
        if command == self._command:
            self._rest_ticks = min(self._rest_ticks + 1, settings.settled_ticks)
            self._quiet_ticks = min(self._quiet_ticks + 1, settings.quiet_ticks)
            self._moved_ticks = min(self._moved_ticks + (self._moved_ticks > 0), settings.cycle_ticks)
        else:
            self._rest_ticks = self._quiet_ticks = 0
            self._learner.begin_rest()
            self._moved_ticks = min(self._moved_ticks + 1, settings.cycle_ticks)
        self._command = command

    def _read_vibration(self, vibration: Any) -> None:
        """Take a reading in range, scaled to order 1; another holds the last and disturbs two delays."""
        if abs(vibration) <= self._max_vibration:
            self._vibration = vibration * self._per_scale
        else:
            self._quiet_ticks = 0
            self._learner.interrupt()
            self._status |= _VIBRATION

    def _advance(self) -> tuple[int, int]:
        """Store both samples; give the cells of one and two delays ago."""
        length, delay = self._settings.ring_length, self._settings.delay_ticks
        head = 0 if self._head >= length - 1 else self._head + 1
        self._commands[head], self._vibrations[head] = self._command, self._vibration
        self._head = head
        first = head - delay if head >= delay else head + (length - delay)
        return first, 0 if head >= length - 1 else head + 1

    def _learn(self, enable: bool, first: int, second: int) -> bool:
        """Learn from this tick if all samples of two delays are free vibration."""
        if not enable:
            self._learner.interrupt()
        elif self._quiet_ticks >= self._settings.quiet_ticks:
            samples = self._vibrations
            self._learner.learn(self._vibration, samples[first], samples[second], in_use=self._is_shaping)
            return True
        return False

    def _shape(self, enable: bool, first: int, second: int) -> Any:
        """Give the reference; coefficients change where they do not matter."""
        is_settled = self._rest_ticks >= self._settings.settled_ticks
        if is_settled:
            is_past_cycle = self._moved_ticks >= self._settings.cycle_ticks
            is_shaping = enable and self._learner.has_learned and is_past_cycle
            if is_shaping != self._is_shaping:
                self._learner.interrupt()
            self._is_shaping, self._used = is_shaping, self._learner.coefficients
        if not self._is_shaping:
            self._status |= _UNSHAPED
        if is_settled or not self._is_shaping:
            return self._command
        c0, c1, c2 = self._used
        return ((c0 * self._command) + (c1 * self._commands[first])) + (c2 * self._commands[second])
