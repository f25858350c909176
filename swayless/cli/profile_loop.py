"""A move on plants that are off, by its command alone and with a feedback. Not for: finding the command."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from swayless.design.optimal import (
    Command,
    Feedback,
    LinearPlant,
    detuned,
    input_with_feedback,
    output_at_ticks,
    output_with_feedback,
)
from swayless.design.optimal.task import LARGEST_TICKS
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PERIODS = 1.5  # of the slowest mode: within each such time a swing shows its whole height

NONE = Feedback(0.0, 0.0)
"""The command alone."""


@dataclass(frozen=True, eq=False)
class Move:
    """A command and the plant it was made for.

    Parameters
    ----------
    name : str
    plant : LinearPlant
        The nominal one.
    command : Command
        Zero-order.
    limits : tuple of two floats
        Lowest and highest input.
    start, target : float
        Output before and after.
    """

    name: str
    plant: LinearPlant
    command: Command
    limits: tuple[float, float]
    start: float
    target: float

    @property
    def reference(self) -> FloatArray:
        """Output that the command should make, at ticks 0, 1, ... to its end."""
        return output_at_ticks(self.plant, self.command, start=self.start)

    @property
    def later_ticks(self) -> int:
        """How long after its end it is looked at again: as long as it lasts, and some swings at least."""
        poles = self.plant.ringing_poles_rad_s
        swings_s = _PERIODS * 2.0 * math.pi / float(np.abs(poles).min()) if poles.size else 0.0
        return min(max(self.command.values.size, math.ceil(swings_s / self.command.tick_s)), LARGEST_TICKS)


@dataclass(frozen=True, eq=False)
class Run:
    """What came of a move.

    Parameters
    ----------
    move : Move
    frequency_ratio : float
        Actual frequencies of the plant's modes, of the nominal ones.
    feedback : Feedback
        `NONE` for the command alone.
    output, input : ndarray, shape (n,)
        At ticks 0, 1, ...
    """

    move: Move
    frequency_ratio: float
    feedback: Feedback
    output: FloatArray
    input: FloatArray

    @property
    def label(self) -> str:
        """Which plant."""
        return f"at {100.0 * self.frequency_ratio:g} %"

    @property
    def with_feedback(self) -> bool:
        """Whether there is one."""
        return self.feedback != NONE

    @property
    def farthest(self) -> float:
        """Farthest from the trajectory until the command ends."""
        reference = self.move.reference
        return float(np.abs(self.output[: reference.size] - reference).max())

    @property
    def left(self) -> float:
        """Farthest from the target once the command has ended."""
        return self._off_target(self.move.command.values.size)

    @property
    def left_later(self) -> float:
        """The same, `Move.later_ticks` later."""
        return self._off_target(self.move.command.values.size + self.move.later_ticks)

    def _off_target(self, tick: int) -> float:
        return float(np.abs(self.output[tick:] - self.move.target).max())

    @property
    def share(self) -> float:
        """Largest input, of the limits, about their middle."""
        low, high = self.move.limits
        return float(np.abs(self.input - 0.5 * (low + high)).max() / (0.5 * (high - low)))


def simulated(move: Move, ratios: Sequence[float], feedbacks: Sequence[Feedback]) -> list[Run]:
    """Play a move on each plant, with each feedback.

    Parameters
    ----------
    move : Move
    ratios : sequence of float
        Actual frequencies, of the nominal ones.
    feedbacks : sequence of Feedback
        `NONE` for the command alone.

    Raises
    ------
    DesignError
        If a closed loop is unstable: the message says on which plant.

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> half = Command(np.pi / 30.0, [0.5, 0.5, 0.5], 1.0)
    >>> runs = simulated(Move("half", plant, half, (-1.0, 1.0), 0.0, 1.0), [1.0, 1.2], [NONE])
    >>> [round(run.left, 3) for run in runs]
    [0.0, 0.309]
    """
    return [_run(move, ratio, feedback) for ratio in ratios for feedback in feedbacks]


def _run(move: Move, ratio: float, feedback: Feedback) -> Run:
    plant = detuned(move.plant, ratio)
    command, reference = move.command, move.reference
    ticks = command.values.size + 2 * move.later_ticks
    if feedback == NONE:
        output = output_at_ticks(plant, command, ticks=ticks, start=move.start)
    else:
        try:
            output = output_with_feedback(plant, command, reference, feedback, ticks=ticks)
        except DesignError as error:
            raise DesignError(f"frequencies at {100.0 * ratio:g} %: {error}") from error
    return Run(move, ratio, feedback, output, input_with_feedback(command, reference, output, feedback))


def draw_runs(move: Move, title: str, runs: Sequence[Run]) -> Figure:
    """Draw all runs of a move."""
    from swayless.report.profile import PlottedLoop, PlottedMove, loop_figure

    plotted = PlottedMove(title, move.plant, move.command, move.start, move.target, move.limits)
    alone, together = (
        [PlottedLoop(run.label, run.output, run.input) for run in runs if run.with_feedback == closed]
        for closed in (False, True)
    )
    return loop_figure(plotted, alone, together)
