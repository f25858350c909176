"""The constants of a motion profile's plant: from tick to tick, and how it stops. Not for: making them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.controller.profile.pieces import Pieces
from swayless.design.shaper import FloatArray
from swayless.errors import ControllerError


@dataclass(frozen=True, eq=False)
class ProfileModel:
    """A plant from tick to tick: z(k+1) = z + M z + b s, position c z + d s.

    Changes are stored, and not A = I + M: they are small, and keep all their digits in float.

    Parameters
    ----------
    change : ndarray, shape (n, n)
        M.
    input : ndarray, shape (n,)
        b.
    output : ndarray, shape (n,)
        c.
    feedthrough : float
        d.

    Raises
    ------
    ControllerError
        If shapes do not fit.
    """

    change: FloatArray
    input: FloatArray
    output: FloatArray
    feedthrough: float

    def __post_init__(self) -> None:
        for name in ("change", "input", "output"):
            object.__setattr__(self, name, _fixed(getattr(self, name)))
        n = self.input.size
        if n < 1 or [self.change.shape, self.input.shape, self.output.shape] != [(n, n), (n,), (n,)]:
            raise ControllerError(
                f"profile: model of shapes {self.change.shape}, {self.input.shape}, {self.output.shape}:"
                " must be (n, n), (n,) and (n,)"
            )

    @property
    def order(self) -> int:
        """Number of states."""
        return self.input.size


@dataclass(frozen=True, eq=False)
class StopLaw:
    """Inputs that bring the plant to rest, linear in v: the states and the last input before the abort.

    Parameters
    ----------
    pieces : Pieces
        Gains of each tick of the stop, rows of n + 1: its input is their product with v.
    rest : ndarray, shape (n + 1,)
        Position of rest: rest @ v.
    ranges : ndarray of int, shape (r, 2)
        First and last tick of each range in which it may begin; at least one, from tick 1 on, rising.

    Raises
    ------
    ControllerError
        If shapes do not fit, or ranges do not rise.
    """

    pieces: Pieces
    rest: FloatArray
    ranges: NDArray[np.int64]

    def __post_init__(self) -> None:
        object.__setattr__(self, "rest", _fixed(self.rest))
        if self.rest.ndim != 1 or self.pieces.coefficients.shape[2:] != self.rest.shape:
            raise ControllerError(
                f"profile: stop of gains {self.pieces.coefficients.shape} and rest {self.rest.shape}: must be"
                " (p, d + 1, n + 1) and (n + 1,)"
            )
        ranges = np.array(self.ranges, dtype=np.int64)
        ranges.flags.writeable = False
        object.__setattr__(self, "ranges", ranges)
        rises = ranges.ndim == 2 and ranges.shape[1] == 2 and ranges.size > 0 and ranges[0, 0] >= 1
        # A tick lies between two ranges: else they are one.
        if not (rises and (np.diff(ranges) >= 0).all() and (ranges[1:, 0] > ranges[:-1, 1] + 1).all()):
            raise ControllerError(
                f"profile: stop of ranges {ranges.tolist()}: must be first and last tick of each, rising,"
                " from 1 on, apart from each other"
            )

    @property
    def ticks(self) -> int:
        """Ticks that a stop lasts."""
        return self.pieces.ticks


def _fixed(values: FloatArray) -> FloatArray:
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array
