"""The motion profile, tick by tick. Not for: what it plays; that is made ahead, in `design.playing`."""

from __future__ import annotations

from typing import Any

from swayless.controller.profile.moving_model import MovingModel
from swayless.controller.profile.pins import ProfileInput, ProfileOutput
from swayless.controller.profile.settings import LARGEST_POSITION, ProfileSettings
from swayless.controller.profile.status import ProfileStatus
from swayless.controller.profile.table import TablePlayer

# Plain integers: the flag type is an order of magnitude slower, and this runs millions of times.
_IGNORED, _ABORT_HELD = int(ProfileStatus.EXECUTE_IGNORED), int(ProfileStatus.ABORT_HELD)
_NOT_FINITE, _LIMIT = int(ProfileStatus.INPUT_NOT_FINITE), int(ProfileStatus.LIMIT_EXCEEDED)
_TOO_LONG, _ELSEWHERE = int(ProfileStatus.TRAVEL_TOO_LONG), int(ProfileStatus.START_ELSEWHERE)
_START_INVALID, _STOPPING = int(ProfileStatus.START_INVALID), int(ProfileStatus.STOPPING)

_RESTING, _MOVING, _IN_STOP = range(3)


class MotionProfile:
    """Plays a command computed ahead between any two positions, and brings the plant to rest when asked.

    Parameters
    ----------
    settings : ProfileSettings
        Table, model, stop, limits and number type.

    References
    ----------
    Xu and Meckl (2005), fig 12: the position is what a feedback follows beside this feedforward.

    Examples
    --------
    A mass of 1 kg moves by 1 m in two ticks of 1 s:

    >>> from swayless.controller.profile import Extremes, Pieces, ProfileModel
    >>> mass = ProfileModel([[0.0, 1.0], [0.0, 0.0]], [0.5, 1.0], [1.0, 0.0], 0.0)
    >>> table, extremes = Pieces([1, 1], [[1.0], [-1.0]]), Extremes((-1.0, 1.0), (0.0, 0.0))
    >>> profile = MotionProfile(ProfileSettings(1.0, table, mass, None, extremes, (-4.0, 4.0)))
    >>> for tick in range(3):
    ...     output = profile.step(ProfileInput(True, False, start=2.0, target=5.0))
    ...     print(output.reference, output.position, output.busy, output.done)
    3.0 2.0 True False
    -3.0 3.5 True False
    0.0 5.0 False True
    """

    def __init__(self, settings: ProfileSettings) -> None:
        scalar = settings.number.scalar
        self._table = TablePlayer(settings.pieces, settings.number)
        self._model = MovingModel(settings.model, settings.stop, settings.number)
        self._hold, self._max_travel = scalar(settings.hold_ratio), scalar(settings.max_travel)
        self._low, self._high = (scalar(limit) for limit in settings.limits)
        self._shapes = [scalar(shape) for shape in settings.extremes.shape]
        self._rests = [scalar(rest) for rest in settings.extremes.rest]
        self._largest = scalar(LARGEST_POSITION)
        self._position = scalar(settings.first_position)
        self._start = self._target = self._travel = scalar(0)
        self._phase = _RESTING
        self._executed = self._has_moved = self._is_aborting = self._done = self._aborted = False
        self._refused = 0

    def step(self, pins: ProfileInput) -> ProfileOutput:
        """Run one tick."""
        rises = pins.execute and not self._executed
        was_busy = self._phase != _RESTING
        self._executed = pins.execute
        if not pins.execute:
            self._refused = 0
            self._done = self._aborted = False
        self._go_on(pins.abort)
        status = 0 if self._has_moved else self._follow(pins.start)
        if rises:
            self._refused = _IGNORED if was_busy else self._reasons(pins)
            if not self._refused:
                self._begin(pins)
        reference, position = self._play()
        status |= self._refused | (_STOPPING if self._is_aborting else 0)
        busy = self._phase != _RESTING
        return ProfileOutput(reference, position, busy, self._done, self._aborted, status)

    def _go_on(self, abort: bool) -> None:
        """End what is over; after an abort begin a stop in the first tick in which one may begin."""
        if self._phase == _IN_STOP and self._model.has_stopped:
            self._come_to_rest(self._start + (self._travel * self._model.rest))
        elif self._phase == _MOVING and self._table.is_over:
            self._come_to_rest(self._target)
        elif self._phase == _MOVING:
            self._is_aborting = self._is_aborting or abort
            if self._model.stops(self._is_aborting):
                self._phase = _IN_STOP

    def _come_to_rest(self, position: Any) -> None:
        self._phase, self._position = _RESTING, position
        self._done, self._aborted = not self._is_aborting, self._is_aborting
        self._is_aborting = False

    def _follow(self, start: Any) -> int:
        """Hold where `start` says, if it can; before the first move nobody else knows where the plant is."""
        if self._is_position(start) and self._is_allowed(self._hold * start):
            self._position = start
            return 0
        return _START_INVALID

    def _reasons(self, pins: ProfileInput) -> int:
        """Give every reason why a move cannot start."""
        held = _ABORT_HELD if pins.abort else 0
        start, target = pins.start, pins.target
        if not (self._is_position(start) and self._is_position(target)):
            return held | _NOT_FINITE
        travel = target - start
        too_long = 0 if abs(travel) <= self._max_travel else _TOO_LONG
        jumps = self._hold != 0.0 and (start < self._position or start > self._position)
        exceeds = not self._keeps_limits(start, target, travel)
        return held | too_long | (_ELSEWHERE if jumps else 0) | (_LIMIT if exceeds else 0)

    def _is_position(self, value: Any) -> bool:
        return bool(abs(value) <= self._largest)

    def _is_allowed(self, reference: Any) -> bool:
        return bool(self._low <= reference <= self._high)

    def _keeps_limits(self, start: Any, target: Any, travel: Any) -> bool:
        """Whether all that can be played stays within the limits: rounding is monotone, the extremes tell."""
        held = self._hold * start
        references = [
            *(held + (travel * shape) for shape in self._shapes),
            self._hold * target,
            *(self._hold * (start + (travel * rest)) for rest in self._rests),
        ]
        return all(self._is_allowed(reference) for reference in references)

    def _begin(self, pins: ProfileInput) -> None:
        """Start a move at rest."""
        self._start, self._target = pins.start, pins.target
        self._travel = pins.target - pins.start
        self._phase, self._has_moved = _MOVING, True
        self._done = self._aborted = False
        self._table.rewind()
        self._model.start()

    def _play(self) -> tuple[Any, Any]:
        """Give reference and position of this tick."""
        if self._phase == _RESTING:
            return self._hold * self._position, self._position
        shape = self._table.next() if self._phase == _MOVING else self._model.next_of_stop()
        position = self._model.advance(shape)
        reference = (self._hold * self._start) + (self._travel * shape)
        return reference, self._start + (self._travel * position)
