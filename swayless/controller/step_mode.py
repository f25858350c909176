"""Step Mode: fixed ways at the press of a button (Kriikku et al. 1997, section V).

Presses add up in one signed sum of commands still to come, from which every command is taken: what was
pressed is what is travelled. Rows that take new commands at rest only make one planned move after another,
and presses on the way wait for the next. Not for: the shaper, nor when a press may start a move.
"""

from __future__ import annotations

from swayless.controller.ends import Switches
from swayless.controller.pins import ShaperInput
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

_STEPPING, _REFUSED = int(Status.STEPPING), int(Status.STEP_REFUSED)
_SIZE_INVALID = int(Status.STEP_SIZE_INVALID)


class StepButtons:
    """The two buttons: a press counts once, and only after the button was seen released."""

    def __init__(self) -> None:
        self._is_armed_forward = self._is_armed_reverse = False

    def read(self, inputs: ShaperInput) -> tuple[bool, bool]:
        """Whether each of the two, forward and reverse, is pressed in this tick."""
        forward = inputs.step_forward and self._is_armed_forward
        reverse = inputs.step_reverse and self._is_armed_reverse
        self._is_armed_forward, self._is_armed_reverse = not inputs.step_forward, not inputs.step_reverse
        return forward, reverse


class StepMode:
    """The steps that were pressed and are not yet travelled.

    Parameters
    ----------
    settings : ShaperSettings
        With Step Mode.
    """

    def __init__(self, settings: ShaperSettings) -> None:
        steps = settings.operator.steps
        assert steps is not None  # noqa: S101 - only a block with Step Mode asks
        self._sizes, self._capacity = steps.sizes, steps.capacity
        self._zero = settings.number.scalar(0)
        self._buttons = StepButtons()
        self._refusal = 0
        self.left = self.queued = self._zero
        self.is_running = False

    @property
    def status(self) -> int:
        """Bits of the steps; a refused press shows until the button is released."""
        return self._refusal | (_STEPPING if self.is_running else 0)

    def read(self, inputs: ShaperInput, switches: Switches | None, *, starts: bool) -> None:
        """Take the buttons of a tick.

        Parameters
        ----------
        inputs : ShaperInput
            Inputs of the tick.
        switches : Switches or None
            Nothing steps towards a made stop switch.
        starts : bool
            A press may begin a move: nothing else moves, is pending, or is commanded.
        """
        forward, reverse = self._buttons.read(inputs)
        if forward or reverse:
            self._refusal = _REFUSED
            if starts and forward != reverse:
                self._refusal = self._press(inputs.step_size, switches, forward=forward)
        elif not (inputs.step_forward or inputs.step_reverse):
            self._refusal = 0

    def take_over(self) -> None:
        """Add the presses that wait to what is left."""
        self.left, self.queued = self.left + self.queued, self._zero

    def finish(self) -> None:
        """End, at rest, where nothing is left."""
        self.is_running = bool(self.left != 0 or self.queued != 0)

    def cancel(self) -> None:
        """Forget what has not been travelled."""
        self.left = self.queued = self._zero
        self.is_running = False

    def _press(self, size: int, switches: Switches | None, *, forward: bool) -> int:
        """Count one press; returns why not."""
        if not 1 <= size <= len(self._sizes):
            return _SIZE_INVALID
        way = self._sizes[size - 1] if forward else self._zero - self._sizes[size - 1]
        is_shut = switches is not None and switches.shut(way)
        if is_shut or abs((self.left + self.queued) + way) > self._capacity:
            return _REFUSED
        self.queued = self.queued + way
        self.is_running = True
        return 0
