"""What a motion profile is put through: whole moves, stops at every phase, and what nobody should do.

Inputs are made while the reference runs: the next start is where the plant rests. Not for: judging.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from swayless.codegen.profile_model import ProfileCode
from swayless.codegen.profile_pins import INPUTS, OUTPUTS
from swayless.controller.profile import MotionProfile, ProfileInput, ProfileOutput, ProfileStatus
from swayless.controller.profile.settings import LARGEST_POSITION
from swayless.verify.records import record_of

SCALES = (1.0, -1.0, 0.37, -0.61, 1e-3)
"""Travels of whole moves, of the design's."""

PHASES = 64
"""Ticks of a move at which it is aborted: all of a short one."""

MOST_TICKS = 40_000
"""Of one stimulus: of a move of thousands of ticks not every scale is played, nor each phase aborted."""

LONGEST_SOAK = 100_000
"""Nothing of a move outlives the next one: more of them show no more."""

MOST_HALVINGS = 54
"""A double has 53 bits: one more finds the last digit of any limit."""

NEAR_LIMITS = (0.05, 0.95)
"""Of the width of the limits: where travels begin that one of the limits stops."""

EPISODES = 60
"""Moves of the stimulus in which everything is toggled."""


class ProfileStimulus(NamedTuple):
    """Inputs of a profile, tick by tick, and what its reference makes of them."""

    name: str
    inputs: NDArray[np.void]
    expected: NDArray[np.void]


class Operator:
    """Runs the reference of a block, and keeps what it was given and what it gave.

    Parameters
    ----------
    code : ProfileCode
        The block, and the move of its design.
    seed : int
        Of what is random.
    """

    def __init__(self, code: ProfileCode, seed: int) -> None:
        self.code, self.settings = code, code.settings
        self.random = np.random.default_rng(seed)
        self.scalar = self.settings.number.scalar
        self.home = self.scalar(code.origin.example[0])
        self.travel = code.origin.example[1] - code.origin.example[0]
        self.ticks, self.stop_ticks = self.settings.pieces.ticks, self.settings.rest_ticks
        self._block = MotionProfile(self.settings)
        self._given: list[tuple[Any, ...]] = []
        self._found: list[tuple[Any, ...]] = []
        self.last = self.tick(start=self.home)

    @property
    def played(self) -> int:
        """Ticks so far."""
        return len(self._given)

    def tick(
        self, *, execute: bool = False, abort: bool = False, start: Any = None, target: Any = None
    ) -> ProfileOutput:
        """Run one tick; a start that is not given is where the plant rests."""
        start = self.last.position if start is None else self.scalar(start)
        target = start if target is None else self.scalar(target)
        out = self._block.step(ProfileInput(execute, abort, start, target))
        self._given.append((execute, abort, start, target))
        self._found.append((out.reference, out.position, out.busy, out.done, out.aborted, out.status))
        self.last = out
        return out

    def move(self, target: Any, *, press: int, abort_at: int = -1, abort_ticks: int = 1) -> None:
        """Run a move from where the plant rests to its end, or until a stop has ended, and two ticks more."""
        start, longest = self.last.position, self.ticks + self.stop_ticks + 2
        for tick in range(longest):
            abort = abort_at <= tick < abort_at + abort_ticks
            out = self.tick(execute=tick < press, abort=abort, start=start, target=target)
            if not (out.busy or tick < press):
                break
        for _ in range(2):
            self.tick()

    def stimulus(self, name: str) -> ProfileStimulus:
        """Give everything so far as arrays."""
        number = self.settings.number
        inputs = np.array(self._given, dtype=record_of(INPUTS, number))
        return ProfileStimulus(name, inputs, np.array(self._found, dtype=record_of(OUTPUTS, number)))


def profile_stimuli(code: ProfileCode, soak_ticks: int) -> Iterator[ProfileStimulus]:
    """Make every stimulus.

    Parameters
    ----------
    code : ProfileCode
        The block, and the move of its design.
    soak_ticks : int
        Length of the long random run, up to `LONGEST_SOAK`; 0 leaves it out.
    """
    yield whole_moves(Operator(code, 1))
    yield aborts(Operator(code, 2))
    yield toggled(Operator(code, 3))
    yield odd_values(Operator(code, 4))
    yield limits(Operator(code, 5))
    if soak_ticks:
        yield soak(Operator(code, 6), min(soak_ticks, LONGEST_SOAK))


def whole_moves(operator: Operator) -> ProfileStimulus:
    """Move there and back, by all scales and either way, with execute held, or for one tick only."""
    for scale in SCALES:
        if operator.played > MOST_TICKS:
            break
        for press in (1, operator.ticks + 3):
            operator.move(operator.last.position + operator.scalar(scale * operator.travel), press=press)
            operator.move(operator.home, press=press)
    return operator.stimulus("whole moves")


def aborts(operator: Operator) -> ProfileStimulus:
    """Abort at the first and the last ticks and many between, and go home from where the plant rests."""
    for place, phase in enumerate(_phases(operator)):
        target = operator.home + operator.scalar(SCALES[place % 3] * operator.travel)
        operator.move(target, press=1, abort_at=phase, abort_ticks=1 + 3 * (place % 2))
        operator.move(operator.home, press=1)
    return operator.stimulus("aborts")


def _phases(operator: Operator) -> list[int]:
    """Give ticks of aborts: all over the move; at the ends of ranges of stops, in and between them."""
    most = max(4, min(PHASES, MOST_TICKS // operator.ticks))
    stop = operator.settings.stop
    ends = np.zeros(0, dtype=np.int64) if stop is None else stop.ranges.ravel()
    middles = (ends[1:] + ends[:-1]) // 2
    evenly = np.linspace(0, operator.ticks, most).astype(np.int64)
    phases = np.unique(np.concatenate([evenly, ends - 1, ends, ends + 1, middles]))
    return [int(phase) for phase in phases if 0 <= phase <= operator.ticks]


def toggled(operator: Operator) -> ProfileStimulus:
    """Toggle execute and abort while starts and targets wander."""
    for _ in range(EPISODES):
        if operator.played <= MOST_TICKS:
            _episode(operator)
    return operator.stimulus("execute and abort toggled")


def odd_values(operator: Operator) -> ProfileStimulus:
    """Give values that are not finite, huge, tiny or negative zero; before the first move, and after."""
    info = np.finfo(np.float64 if operator.settings.number.name == "double" else np.float32)
    odd = [np.nan, np.inf, -np.inf, info.max, -info.max, info.tiny, -0.0, 1e15, -1.1e15]
    for moved in (False, True):
        for value in odd:
            operator.tick(start=value, target=operator.home)
            operator.tick(execute=True, start=value, target=operator.home)
            operator.tick(start=operator.last.position, target=value)
            operator.tick(execute=True, target=value)
            operator.tick(execute=True, abort=True, start=value, target=value)
            operator.move(operator.last.position, press=0)
        if not moved:
            operator.move(operator.home + operator.scalar(operator.travel), press=1)
    return operator.stimulus("odd values")


def limits(operator: Operator) -> ProfileStimulus:
    """Ask for travels that are just allowed and just too long, and for starts elsewhere, either way."""
    # Before the first move any start is good: from near either limit each of them is what stops a travel.
    for start in _starts_near_limits(operator):
        for sign in (1.0, -1.0):
            _longest(operator, sign, start)
    for sign in (1.0, -1.0):
        longest = _longest(operator, sign, operator.home)
        for travel in (longest, longest * (1.0 + 1e-6), 2.0 * longest):
            at = operator.last.position
            operator.move(at + operator.scalar(sign * travel), press=1)
            operator.tick(execute=True, start=at + operator.scalar(1e-3 * operator.travel), target=at)
            operator.move(operator.home, press=1)
    return operator.stimulus("limits")


def _starts_near_limits(operator: Operator) -> list[Any]:
    """Give starts held by references near the lowest and the highest; none where all take the same."""
    (low, high), hold = operator.settings.limits, operator.settings.hold_ratio
    references = (low + share * (high - low) for share in NEAR_LIMITS) if hold else ()
    return [operator.scalar(reference / hold) for reference in references]


def _longest(operator: Operator, sign: float, start: Any) -> float:
    """Find the longest travel that is allowed, to the last digit; abort is held, so that nothing moves."""

    def allowed(travel: float) -> bool:
        operator.tick(start=start)
        target = start + operator.scalar(sign * travel)
        out = operator.tick(execute=True, abort=True, start=start, target=target)
        return out.status == ProfileStatus.ABORT_HELD

    low, high = 0.0, abs(operator.travel)
    while allowed(high) and high < LARGEST_POSITION:
        low, high = high, 2.0 * high
    for _ in range(MOST_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if allowed(middle) else (low, middle)
    return low


def soak(operator: Operator, ticks: int) -> ProfileStimulus:
    """Do anything for a long time."""
    while operator.played < ticks:
        _episode(operator)
    return operator.stimulus("soak")


def _episode(operator: Operator) -> None:
    """Move somewhere, or try to, with execute and abort pressed at random."""
    random = operator.random
    travel = operator.scalar(random.choice(SCALES) * random.random() * operator.travel)
    target = operator.home if random.random() < 0.3 else operator.last.position + travel
    start = operator.last.position
    length = int(random.integers(2, operator.ticks + operator.stop_ticks + 8))
    execute = random.random(length) < random.choice([0.1, 0.5, 0.95])
    abort = random.random(length) < random.choice([0.0, 0.0, 0.02, 0.3])
    for pressed, stopped in zip(execute.tolist(), abort.tolist(), strict=True):
        resting = not operator.last.busy
        start = operator.last.position if resting and random.random() < 0.9 else start
        operator.tick(execute=pressed, abort=stopped, start=start, target=target)
