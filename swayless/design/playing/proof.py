"""What is left when a played table, or a stop, has ended: by the plant itself, for the inputs that run.

Not for: number types; whoever plays gives what was played.
"""

from __future__ import annotations

import numpy as np

from swayless.design.playing.shape_model import ShapeModel
from swayless.design.shaper import FloatArray


def missed_by_move(model: ShapeModel, shape: FloatArray) -> FloatArray:
    """Give the states after a move by 1, less those at rest at position 1; shape (states, 1).

    Parameters
    ----------
    model : ShapeModel
    shape : ndarray, shape (n,)
        Inputs that were played.

    Examples
    --------
    >>> from swayless.design.optimal import LinearPlant
    >>> from swayless.design.playing.shape_model import shape_model
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> missed_by_move(shape_model(mass, 1.0), np.array([1.0, -1.0, 0.5])).tolist()
    [[0.25], [0.5]]
    """
    return np.asarray(model.system.reach(shape.size) @ shape - model.at_rest)[:, np.newaxis]


def missed_by_stops(
    model: ShapeModel, states: FloatArray, inputs: FloatArray, rests: FloatArray
) -> FloatArray:
    """Give the states after stops, less those at rest where the controller says; shape (states, k).

    Parameters
    ----------
    model : ShapeModel
    states : ndarray, shape (k, states)
        In which the stops began.
    inputs : ndarray, shape (m, k)
        That were played, a column for each stop.
    rests : ndarray, shape (k,)
        Where the controller says that it rests.
    """
    ticks = len(inputs)
    moved = np.linalg.matrix_power(model.system.a, ticks) @ states.T + model.system.reach(ticks) @ inputs
    return np.asarray(moved - np.outer(model.at_rest, rests))


def error_ratio(model: ShapeModel, missed: FloatArray, sizes: FloatArray) -> float:
    """Give how far the kept states are from rest at most, of given sizes.

    Parameters
    ----------
    model : ShapeModel
    missed : ndarray, shape (states, k)
        Of `missed_by_move` or `missed_by_stops`.
    sizes : ndarray, shape (r,)
        What counts as 1, such as `ShapeModel.sizes` of the move.
    """
    return float((np.abs(model.kept @ missed) / sizes[:, np.newaxis]).max(initial=0.0))


def swing_ratio(model: ShapeModel, missed: FloatArray) -> float:
    """Give the largest swing of the position about where it rests, by the modes that need not rest.

    The sum of their amplitudes when all inputs have been played: it is never exceeded, and where nothing is
    damped it is reached, or nearly, some time.

    Parameters
    ----------
    model : ShapeModel
    missed : ndarray, shape (states, k)
        Of `missed_by_move` or `missed_by_stops`.
    """
    return float(np.abs(model.swings @ missed).sum(axis=0).max(initial=0.0))


def noise_gain(model: ShapeModel, shape: FloatArray, input_error: float, rest_error: float) -> float:
    """Give how far errors of inputs can take the states from rest, each of its largest in a move by 1.

    Parameters
    ----------
    model : ShapeModel
    shape : ndarray, shape (n,)
        Inputs of the move.
    input_error : float
        Largest error of each of them, >= 0; signs may be the worst.
    rest_error : float
        Largest error of the one that holds the plant at the end, >= 0.

    Examples
    --------
    A mass is pushed and braked; errors of 0.01 make it faster by 0.02 at the worst, 2 % of its largest speed:

    >>> from swayless.design.optimal import LinearPlant
    >>> from swayless.design.playing.shape_model import shape_model
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> noise_gain(shape_model(mass, 1.0), np.array([1.0, -1.0]), 0.01, 0.0)
    0.02
    """
    gains = input_error * np.abs(model.kept @ model.system.reach(shape.size)).sum(axis=1)
    if model.hold_ratio != 0.0:
        gains = gains + rest_error * np.abs(model.final / model.hold_ratio)
    return float((gains / model.sizes(shape)).max())


def largest_step(before: FloatArray, inputs: FloatArray, after: FloatArray) -> float:
    """Give the largest change from tick to tick of stops, or of a move, with the joins at both ends.

    Parameters
    ----------
    before, after : ndarray, shape (k,)
        Input of the tick before, and the one that stays.
    inputs : ndarray, shape (m, k)
        That are played between.

    Examples
    --------
    >>> largest_step(np.zeros(1), np.array([[1.0], [-1.0]]), np.zeros(1))
    2.0
    """
    return float(np.abs(np.diff(np.vstack([before, inputs, after]), axis=0)).max(initial=0.0))
