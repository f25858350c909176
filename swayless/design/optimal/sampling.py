"""Linear plants from tick to tick: exact for inputs that stay between ticks. Not for: what to command."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.design.optimal.command import Command
from swayless.design.optimal.linear_plant import LinearPlant
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError


@dataclass(frozen=True, eq=False)
class Sampled:
    """States from tick to tick, x(k+1) = A x(k) + B u(k).

    Parameters
    ----------
    a : ndarray, shape (n, n)
    b : ndarray, shape (n,)
    """

    a: FloatArray
    b: FloatArray

    def reach(self, ticks: int) -> FloatArray:
        """Give [A^(n-1) B, ..., A B, B], shape (states, ticks): what each input has become after `ticks`.

        By doubling, so that rounding grows with the logarithm of the ticks.

        References
        ----------
        Xu and Meckl (2005), eq 6.
        """
        columns, power = self.b[:, np.newaxis], self.a
        while columns.shape[1] < ticks:
            columns, power = np.hstack([power @ columns, columns]), power @ power
        return np.ascontiguousarray(columns[:, columns.shape[1] - ticks :])


def sampled(a: FloatArray, b: FloatArray, tick_s: float) -> Sampled:
    """Sample x' = A x + B u for an input that stays between ticks: exp of [[A, B], [0, 0]] times the tick.

    Parameters
    ----------
    a : ndarray, shape (n, n)
    b : ndarray, shape (n,)
    tick_s : float
        > 0.

    References
    ----------
    Van Loan (1978), "Computing integrals involving the matrix exponential", eq 1.1.

    Examples
    --------
    >>> mass = sampled(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, 1.0]), 0.5)
    >>> mass.a.tolist(), mass.b.tolist()
    ([[1.0, 0.5], [0.0, 1.0]], [0.125, 0.5])
    """
    from scipy.linalg import expm  # here, because it is heavy and only a design needs it

    block = np.zeros((b.size + 1, b.size + 1))
    block[:-1, :-1], block[:-1, -1] = a, b
    exact = expm(block * tick_s)
    return Sampled(exact[:-1, :-1], exact[:-1, -1])


def output_at_ticks(
    plant: LinearPlant, command: Command, *, ticks: int | None = None, start: float = 0.0
) -> FloatArray:
    """Give the output at ticks 0, 1, ... `ticks` of a plant that rests until the command begins.

    Parameters
    ----------
    plant : LinearPlant
        Any, such as one that differs from what the command was designed for.
    command : Command
        Zero-order.
    ticks : int
        Last tick, >= 0; the command's end unless given.
    start : float
        Output before tick 0.

    Raises
    ------
    DesignError
        If the command is not zero-order.

    Examples
    --------
    A mass of 1 kg, pushed for a second and braked for one:

    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> output_at_ticks(mass, Command(1.0, [1.0, -1.0], 0.0), ticks=3).round(12).tolist()
    [0.0, 0.5, 1.0, 1.0]
    """
    if command.hold != "zero-order":
        raise DesignError(f"command.hold = {command.hold!r}: only zero-order commands are simulated here")
    last = command.values.size if ticks is None else ticks
    held = np.append(command.values, np.full(max(0, last + 1 - command.values.size), command.final_value))
    inputs = held[: last + 1] - command.initial_value
    return start + plant.d * inputs + convolved(impulse_response(plant, command.tick_s, last), inputs)


def impulse_response(plant: LinearPlant, tick_s: float, ticks: int) -> FloatArray:
    """Give C A^(k-1) B for k = 1 .. `ticks`: what a unit input during one tick leaves k ticks later."""
    plant = plant.balanced
    reach = sampled(plant.a, plant.b, tick_s).reach(max(ticks, 1))[:, ::-1]
    return np.asarray(plant.c @ reach)[:ticks]


def convolved(response: FloatArray, inputs: FloatArray) -> FloatArray:
    """Give the outputs at ticks 0 .. n of inputs at ticks 0 .. n - 1, or more; shape (n + 1,)."""
    ticks = response.size
    if ticks == 0:
        return np.zeros(1)
    return np.append(0.0, np.convolve(response, inputs[:ticks])[:ticks])
