"""Figures of moves computed ahead: command and output, what is left where they are off, a closed loop.

Not for: finding the command (`swayless.design.optimal`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.design.optimal import Command, LinearPlant, detuned, output_at_ticks, swing_left
from swayless.design.optimal.sensitivity import mode_of
from swayless.design.shaper import FloatArray
from swayless.report.sampling import FEWEST_POINTS
from swayless.report.style import (
    GREY,
    INK,
    TOLERANCE_LINE,
    figure_style,
    legend_above,
    line_style,
    new_figure,
    settle,
)

OFF = (0.9, 1.1)
"""Actual frequencies, of the nominal ones, whose outputs are drawn beside the nominal one."""

SHOWN = (0.7, 1.3)
"""Actual frequencies, of the nominal ones, between which sensitivity is drawn."""

_AFTER_RATIO = 0.3  # of the command, shown after its end, and at least:
_PERIODS_AFTER = 1.5
_LONGEST_RATIO = 2.0  # of the command
_LEAD_RATIO = 0.03  # of the figure, shown before the command


@dataclass(frozen=True, eq=False)
class PlottedMove:
    """A move of a linear plant as figures show it.

    Parameters
    ----------
    title : str
        Above the figure.
    plant : LinearPlant
        The nominal one.
    command : Command
        Zero-order.
    start, target : float
        Output before and after.
    limits : tuple of two floats or None
        Lowest and highest input, drawn where they are given.
    """

    title: str
    plant: LinearPlant
    command: Command
    start: float
    target: float
    limits: tuple[float, float] | None = None

    @property
    def shown_s(self) -> float:
        """How long a figure of it is."""
        duration_s, poles = self.command.duration_s, self.plant.ringing_poles_rad_s
        swings_s = _PERIODS_AFTER * 2.0 * math.pi / float(np.abs(poles).min()) if poles.size else 0.0
        return duration_s + min(max(_AFTER_RATIO * duration_s, swings_s), _LONGEST_RATIO * duration_s)

    def outputs(self, plant: LinearPlant) -> tuple[FloatArray, FloatArray]:
        """Give times and outputs of a plant, also between the ticks: exact, as the command is held there."""
        tick_s, values = self.command.tick_s, self.command.values
        ticks = math.ceil(self.shown_s / tick_s)
        fine = math.ceil(FEWEST_POINTS / ticks)
        command = Command(
            tick_s / fine,
            np.repeat(values, fine),
            self.command.final_value,
            initial_value=self.command.initial_value,
        )
        output = output_at_ticks(plant, command, ticks=ticks * fine, start=self.start)
        return command.tick_s * np.arange(output.size, dtype=np.float64), output


@dataclass(frozen=True, eq=False)
class PlottedLoop:
    """A plant under feedforward, or under feedforward and feedback, from tick to tick.

    Parameters
    ----------
    label : str
        For the legend.
    output, input : ndarray, shape (ticks + 1,)
        What the plant did, and what the actuator was asked for.
    """

    label: str
    output: FloatArray
    input: FloatArray


def move_figure(move: PlottedMove) -> Figure:
    """Draw a command with its limits, the output that it makes, and what each mode leaves where it is off.

    Parameters
    ----------
    move : PlottedMove

    Returns
    -------
    Figure
        For `save_figure`.

    References
    ----------
    Xu and Meckl (2005), figs 4, 5 and 10.

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> half = Command(np.pi / 10.0, [0.5], 1.0)
    >>> figure = move_figure(PlottedMove("two halves", plant, half, 0.0, 1.0, (-1.0, 1.0)))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['Input', 'Output', 'Left (% of the move)']
    """
    rings = move.plant.can_be_off
    with figure_style():
        figure, panels = new_figure(move.title, (2.1, 2.6, 2.6) if rings else (2.1, 2.6))
        inputs, outputs = panels[:2]
        inputs.sharex(outputs)
        _draw_command(inputs, move)
        _draw_outputs(outputs, move)
        if rings:
            _draw_sensitivity(panels[2], move)
        for axes in panels:
            legend_above(axes)
        return settle(figure)


def loop_figure(move: PlottedMove, alone: Sequence[PlottedLoop], together: Sequence[PlottedLoop]) -> Figure:
    """Draw a move on plants that are off: inputs, outputs under feedforward alone, outputs with a feedback.

    Parameters
    ----------
    move : PlottedMove
    alone, together : sequence of PlottedLoop
        Without and with a feedback; there may be none with one.

    References
    ----------
    Xu and Meckl (2005), fig 12.

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> move = PlottedMove("half", plant, Command(np.pi / 10.0, [0.5], 1.0), 0.0, 1.0)
    >>> loop = PlottedLoop("at 90 %", np.array([0.0, 1.0]), np.array([0.5, 1.0]))
    >>> [axes.get_ylabel() for axes in loop_figure(move, [loop], [loop]).axes]
    ['Input', 'Output, feedforward alone', 'Output, with feedback']
    """
    with figure_style():
        heights = (2.3, 2.3, 2.3) if together else (2.1, 2.6)
        figure, panels = new_figure(move.title, heights, sharex=True)
        _draw_limits(panels[0], move)
        for index, loop in enumerate(together or alone):
            _draw_held(panels[0], move.command.tick_s, loop, index)
        for axes, loops in zip(panels[1:], (alone, together), strict=False):
            for index, loop in enumerate(loops):
                times_s = move.command.tick_s * np.arange(loop.output.size)
                axes.plot(times_s, loop.output, label=loop.label, **line_style(index))
            _draw_target(axes, move)
        names = ("Input", "Output, feedforward alone", "Output, with feedback")
        for axes, name in zip(panels, names, strict=False):
            axes.set_ylabel(name)
            legend_above(axes)
        panels[-1].set_xlabel("Time (s)")
        shown_s = move.command.tick_s * max(loop.output.size - 1 for loop in alone)
        panels[-1].set_xlim(-_LEAD_RATIO * shown_s, shown_s)
        return settle(figure)


def _draw_command(axes: Axes, move: PlottedMove) -> None:
    """Draw a command as it is held, from before it begins to after it ends."""
    command = move.command
    times_s = np.concatenate(
        [[-_LEAD_RATIO * move.shown_s], command.times_s, [command.duration_s, move.shown_s]]
    )
    values = np.concatenate([[command.initial_value], command.values, [command.final_value] * 2])
    axes.step(times_s, values, where="post", label="command", **line_style(0))
    _draw_limits(axes, move)
    axes.set_ylabel("Input")
    axes.set_xlim(times_s[0], times_s[-1])


def _draw_limits(axes: Axes, move: PlottedMove) -> None:
    for number, limit in enumerate(move.limits or ()):
        axes.axhline(limit, label="limit" if number == 0 else "_", linewidth=1.2, **TOLERANCE_LINE)


def _draw_outputs(axes: Axes, move: PlottedMove) -> None:
    """Draw the output of the nominal plant, and of plants whose frequencies are off."""
    ratios = OFF if move.plant.can_be_off else ()
    for index, ratio in enumerate((1.0, *ratios)):
        times_s, output = move.outputs(detuned(move.plant, ratio))
        name = "output" if ratio == 1.0 else f"frequencies at {100.0 * ratio:g} %"
        axes.plot(times_s, output, label=name, **line_style(index))
    _draw_target(axes, move)
    axes.set_ylabel("Output")
    axes.set_xlabel("Time (s)")


def _draw_target(axes: Axes, move: PlottedMove) -> None:
    """Mark where the output shall rest, and when the command ends."""
    axes.axhline(move.target, color=GREY, linewidth=0.8, linestyle=(0, (2, 2)))
    axes.axvline(move.command.duration_s, color=INK, linewidth=0.8, linestyle=(0, (1, 2)))


def _draw_held(axes: Axes, tick_s: float, loop: PlottedLoop, index: int) -> None:
    """Draw an input as it is held from tick to tick."""
    times_s = tick_s * np.arange(loop.input.size)
    axes.step(times_s, loop.input, where="post", label=loop.label, **line_style(index))


def _draw_sensitivity(axes: Axes, move: PlottedMove) -> None:
    """Draw what each mode leaves over its actual frequency."""
    ratios = np.linspace(*SHOWN, FEWEST_POINTS)
    lefts = swing_left(move.plant, move.command, ratios) / abs(move.target - move.start)
    for index, (pole, left) in enumerate(zip(move.plant.ringing_poles_rad_s, lefts, strict=True)):
        name = f"mode of {mode_of(complex(pole)).frequency_hz:.4g} Hz"
        axes.plot(100.0 * ratios, 100.0 * left, label=name, **line_style(index))
    axes.set_ylabel("Left (% of the move)")
    axes.set_xlabel("Actual frequency (% of the nominal one)")
    axes.set_xlim(100.0 * SHOWN[0], 100.0 * SHOWN[1])
    axes.set_ylim(bottom=0.0)
