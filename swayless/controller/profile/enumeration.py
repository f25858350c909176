"""All that a motion profile can play: every tick of its table, and every stop from every tick.

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
        Of the position of rest after a stop.
    """

    shape: tuple[float, float]
    rest: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Played:
    """Everything of a move by 1, in the number type.

    Parameters
    ----------
    shape : ndarray, shape (n,)
        Input at each tick.
    states : ndarray, shape (n + 1, order)
        Of the model, before tick 0 .. n.
    stops : ndarray, shape (m, n - 1)
        Inputs of the stop that begins at tick 1 .. n - 1, one in each column.
    rests : ndarray, shape (n - 1,)
        Position of rest after it.
    """

    shape: FloatArray
    states: FloatArray
    stops: FloatArray
    rests: FloatArray


def enumerated(pieces: Pieces, model: ProfileModel, stop: StopLaw, number: NumberType) -> Played:
    """Play the table, and every stop from every tick of it.

    Parameters
    ----------
    pieces : Pieces
    model : ProfileModel
    stop : StopLaw
    number : NumberType
        ``double`` or ``float``.

    Examples
    --------
    A mass that is pushed for two ticks and stopped by one, from either tick of an abort:

    >>> from swayless.controller.number import number_type
    >>> mass = ProfileModel([[0.0, 1.0], [0.0, 0.0]], [0.5, 1.0], [1.0, 0.0], 0.0)
    >>> stop = StopLaw([[0.0, -1.0, 0.0]], [1.0, 0.5, 0.0])
    >>> played = enumerated(Pieces([2, 1], [[1.0], [-2.0]]), mass, stop, number_type("double"))
    >>> played.states[:, 0].tolist(), played.stops.tolist(), played.rests.tolist()
    ([0.0, 0.5, 2.0, 3.0], [[-1.0, -2.0]], [1.0, 3.0])
    """
    dtype = dtype_of(number)
    shape = pieces.values(number).astype(dtype)
    states = _states(model, shape)
    known = np.column_stack([states[1:-1], shape[:-1]])
    stops = _summed(stop.gains.astype(dtype)[:, np.newaxis, :], known[np.newaxis, :, :])
    rests = _summed(stop.rest.astype(dtype), known)
    return Played(*(np.asarray(each, dtype=np.float64) for each in (shape, states, stops, rests)))


def extremes_of(played: Played, hold_ratio: float) -> Extremes:
    """Give the least and the largest of all that can be played."""
    inputs = np.concatenate([played.shape, played.stops.ravel(), [0.0, hold_ratio]])
    rests = np.append(played.rests, 0.0)
    return Extremes((float(inputs.min()), float(inputs.max())), (float(rests.min()), float(rests.max())))


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
