"""What is left when a played table, or a stop, has ended: by the plant itself, for the inputs that run.

Not for: number types; whoever plays gives what was played.
"""

from __future__ import annotations

import numpy as np

from swayless.design.playing.shape_model import ShapeModel
from swayless.design.shaper import FloatArray


def final_error_ratio(model: ShapeModel, shape: FloatArray) -> float:
    """Give how far the states are from rest at position 1 after a move, each of its largest in the move.

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
    >>> final_error_ratio(shape_model(mass, 1.0), np.array([1.0, -1.0]))
    0.0
    """
    missed = model.kept @ (model.system.reach(shape.size) @ shape) - model.final
    return float((np.abs(missed) / model.sizes(shape)).max())


def error_after_stops(
    model: ShapeModel, sizes: FloatArray, states: FloatArray, inputs: FloatArray, rests: FloatArray
) -> float:
    """Give how far the states are from rest after stops, of given sizes.

    Parameters
    ----------
    model : ShapeModel
    sizes : ndarray, shape (r,)
        What counts as 1, such as `ShapeModel.sizes` of the move.
    states : ndarray, shape (k, states)
        In which the stops began.
    inputs : ndarray, shape (m, k)
        That were played, a column for each stop.
    rests : ndarray, shape (k,)
        Where the controller says that it rests.
    """
    ticks = len(inputs)
    moved = np.linalg.matrix_power(model.system.a, ticks) @ states.T + model.system.reach(ticks) @ inputs
    missed = model.kept @ moved - np.outer(model.final, rests)
    return float((np.abs(missed) / sizes[:, np.newaxis]).max(initial=0.0))


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
