"""A command computed ahead as feedforward, and feedback that holds the plant to its trajectory.

Not for: tuning the feedback.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from swayless.design.optimal.command import Command
from swayless.design.optimal.linear_plant import LinearPlant
from swayless.design.optimal.sampling import Sampled, convolved, sampled
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError


@dataclass(frozen=True)
class Feedback:
    """What a difference e of output and reference adds to the command: P e + D (e - e of a tick ago) / tick.

    Parameters
    ----------
    proportional : float
        P, in units of the input for one of the output; 0 for none.
    derivative_s : float
        D, the same times seconds.
    """

    proportional: float
    derivative_s: float


def output_with_feedback(
    plant: LinearPlant, command: Command, reference: ArrayLike, feedback: Feedback, *, ticks: int
) -> FloatArray:
    """Give the output at ticks 0 .. `ticks` of a plant under feedforward and feedback together.

    Parameters
    ----------
    plant : LinearPlant
        The actual one, with d = 0.
    command : Command
        Zero-order feedforward.
    reference : array_like, shape (m,)
        Trajectory at ticks 0, 1, ...; its last value stays. The output starts at the first.
    feedback : Feedback
    ticks : int
        Last tick, >= 1.

    Raises
    ------
    DesignError
        If the input moves the output at once, or the closed loop is unstable.

    References
    ----------
    Xu and Meckl (2005), fig 12.

    Examples
    --------
    A mass of 1.1 kg in the place of 1 kg is brought back to its trajectory:

    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0 / 1.1], [1.0, 0.0])
    >>> command = Command(0.1, [1.0] * 10 + [-1.0] * 10, 0.0)
    >>> reference = [0.0, *np.cumsum(np.cumsum([*command.values]) * 0.01 - 0.005 * command.values)]
    >>> output = output_with_feedback(mass, command, reference, Feedback(4.0, 4.0), ticks=80)
    >>> output[[20, 80]].round(3)
    array([1.009, 1.   ])
    """
    if plant.d != 0.0:
        raise DesignError("feedback: the input moves the output at once (d is not 0): give it a lag")
    plant = plant.balanced
    given = np.asarray(reference, dtype=np.float64)
    wanted = np.append(given, np.full(max(0, ticks - given.size), given[-1]))[:ticks] - given[0]
    forward = np.append(command.values, np.full(max(0, ticks - command.values.size), command.final_value))
    open_loop = sampled(plant.a, plant.b, command.tick_s)
    rate = feedback.derivative_s / command.tick_s
    gain = feedback.proportional + rate
    # States of the plant, and the difference of a tick ago.
    order = plant.order
    closed = np.zeros((order + 1, order + 1))
    closed[:-1, :-1] = open_loop.a - gain * np.outer(open_loop.b, plant.c)
    closed[:-1, -1] = -rate * open_loop.b
    closed[-1, :-1] = -plant.c
    fastest = float(np.abs(np.linalg.eigvals(closed)).max())
    if fastest > 1.0 + 1e-9:
        raise DesignError(
            f"feedback P = {feedback.proportional:g}, D = {feedback.derivative_s:g} s: unstable, grows"
            f" {fastest:.6g} times a tick: other gains are needed"
        )
    inputs = {
        "plant": (np.append(open_loop.b, 0.0), forward[:ticks] - command.initial_value + gain * wanted),
        "difference": (np.eye(order + 1)[-1], wanted),
    }
    answers = [
        convolved(plant.c @ Sampled(closed, into).reach(ticks)[:-1, ::-1], values)
        for into, values in inputs.values()
    ]
    return np.asarray(given[0] + sum(answers))


def input_with_feedback(
    command: Command, reference: ArrayLike, output: ArrayLike, feedback: Feedback
) -> FloatArray:
    """Give what feedforward and feedback together ask of the actuator, at the ticks of an output.

    Parameters
    ----------
    command : Command
        Zero-order feedforward.
    reference : array_like, shape (m,)
        Trajectory at ticks 0, 1, ...; its last value stays.
    output : array_like, shape (n,)
        What `output_with_feedback` gave.
    feedback : Feedback

    Examples
    --------
    >>> command = Command(0.5, [2.0], 0.0)
    >>> input_with_feedback(command, [0.0, 1.0], [0.0, 0.5, 1.0], Feedback(1.0, 0.5)).tolist()
    [2.0, 1.0, -0.5]
    """
    actual = np.asarray(output, dtype=np.float64)
    forward, wanted = (
        np.append(values, np.full(max(0, actual.size - values.size), last))[: actual.size]
        for values, last in (
            (command.values, command.final_value),
            (np.asarray(reference, dtype=np.float64), np.asarray(reference)[-1]),
        )
    )
    off = wanted - actual
    rate = np.diff(off, prepend=0.0) / command.tick_s
    return np.asarray(forward + feedback.proportional * off + feedback.derivative_s * rate)
