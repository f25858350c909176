"""All that a motion profile can play: every tick of its table, and every stop.

In the number type, operation by operation as the block does, so that what is proved is what runs. Not for:
running the block tick by tick (`profile`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType
from swayless.controller.profile.model import ProfileModel, StopLaw
from swayless.controller.profile.pieces import Pieces, dtype_of
from swayless.design.shaper import FloatArray


@dataclass(frozen=True)
class Extremes:
    """Least and largest of all that can be played, of a move by 1.

    Parameters
    ----------
    shape : tuple of two floats
        Of the input, of table and stops, and 0 and the one that holds at the end.
    rest : tuple of two floats
        Of the position of rest after a stop, and 0.
    """

    shape: tuple[float, float]
    rest: tuple[float, float]

    def with_those_of(self, other: Extremes) -> Extremes:
        """Give the extremes of both.

        Examples
        --------
        >>> Extremes((0.0, 1.0), (0.0, 0.0)).with_those_of(Extremes((-2.0, 0.5), (0.5, 1.5)))
        Extremes(shape=(-2.0, 1.0), rest=(0.0, 1.5))
        """
        shape, rest = (*self.shape, *other.shape), (*self.rest, *other.rest)
        return Extremes((min(shape), max(shape)), (min(rest), max(rest)))


@dataclass(frozen=True, eq=False)
class PlayedMove:
    """A move by 1, in the number type.

    Parameters
    ----------
    shape : ndarray, shape (n,)
        Input at each tick.
    states : ndarray, shape (n + 1, order)
        Of the model, before tick 0 .. n.
    """

    shape: FloatArray
    states: FloatArray

    @property
    def aborts(self) -> FloatArray:
        """States and last input where a stop may begin, at ticks 1 .. n - 1; shape (n - 1, order + 1)."""
        return np.column_stack([self.states[1:-1], self.shape[:-1]])


@dataclass(frozen=True, eq=False)
class PlayedStops:
    """Stops of a move by 1, in the number type.

    Parameters
    ----------
    inputs : ndarray, shape (m, k)
        A column for each abort.
    rests : ndarray, shape (k,)
        Position of rest after it.
    """

    inputs: FloatArray
    rests: FloatArray

    @property
    def extremes(self) -> Extremes:
        """Of these stops alone."""
        inputs, rests = self.inputs, self.rests
        return Extremes((float(inputs.min()), float(inputs.max())), (float(rests.min()), float(rests.max())))


def played_move(pieces: Pieces, model: ProfileModel, number: NumberType) -> PlayedMove:
    """Play the table, and run the model beside it.

    Parameters
    ----------
    pieces : Pieces
    model : ProfileModel
    number : NumberType
        ``double`` or ``float``.

    Examples
    --------
    A mass that is pushed for two ticks and braked for one:

    >>> from swayless.controller.number import number_type
    >>> mass = ProfileModel([[0.0, 1.0], [0.0, 0.0]], [0.5, 1.0], [1.0, 0.0], 0.0)
    >>> played_move(Pieces([2, 1], [[1.0], [-2.0]]), mass, number_type("double")).states[:, 0].tolist()
    [0.0, 0.5, 2.0, 3.0]
    """
    shape = pieces.values(number).astype(dtype_of(number))
    states = _states(model, shape)
    return PlayedMove(shape.astype(np.float64), states.astype(np.float64))


def played_stops(stop: StopLaw, aborts: FloatArray, number: NumberType) -> PlayedStops:
    """Play the stops of some aborts.

    Parameters
    ----------
    stop : StopLaw
    aborts : ndarray, shape (k, order + 1)
        Of `PlayedMove.aborts`.
    number : NumberType
        ``double`` or ``float``.

    Examples
    --------
    >>> from swayless.controller.number import number_type
    >>> stop = StopLaw(Pieces([1], [[[0.0, -1.0, 0.0]]]), [1.0, 0.5, 0.0], [[1, 1]])
    >>> played_stops(stop, [[0.5, 1.0, 1.0], [2.0, 2.0, 1.0]], number_type("double")).rests.tolist()
    [1.0, 3.0]
    """
    dtype = dtype_of(number)
    known = np.asarray(aborts).astype(dtype)
    # Coefficients of each stop, then its values: in this order the block has few sums to do.
    coefficients = _summed(stop.pieces.coefficients.astype(dtype)[..., np.newaxis, :], known)
    inputs = stop.pieces.valued(coefficients, number)
    rests = _summed(stop.rest.astype(dtype), known)
    return PlayedStops(inputs.astype(np.float64), rests.astype(np.float64))


def _states(model: ProfileModel, shape: NDArray[Any]) -> NDArray[Any]:
    """Run the model: rounding of each tick is part of the next, so that there is no other way."""
    dtype = shape.dtype
    steps = np.column_stack([model.change, model.input]).astype(dtype).T.copy()
    states = np.zeros((shape.size + 1, model.order), dtype)
    for tick, value in enumerate(shape):
        now = states[tick]
        change = steps[0] * now[0]
        for column, state in zip(steps[1:-1], now[1:], strict=True):
            change = change + column * state
        states[tick + 1] = now + (change + steps[-1] * value)
    return states


def _summed(weights: NDArray[Any], values: NDArray[Any]) -> NDArray[Any]:
    """Sum products over the last axis from left to right, as a row of additions in a program does."""
    total = weights[..., 0] * values[..., 0]
    for index in range(1, weights.shape[-1]):
        total = total + weights[..., index] * values[..., index]
    return np.asarray(total)
