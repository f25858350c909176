"""What measured moves leave unexplained, if a drive were the true one.

If a drive were the truth, the load would do what it makes of the command that was given. For the estimate
whose inverse was the command, that is the motion that was asked for: what it leaves is the error of the
motion itself, and half of its mean square is the cost. The drive that leaves least explains the moves best.

Not for: finding a better drive (`tuning`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from swayless.design.inversion.motion import PolynomialMotion
from swayless.design.inversion.response import motion_response
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant.elastic_drive import TUNED, ElasticDrive, Ratio, product


@dataclass(frozen=True, eq=False)
class MeasuredMove:
    """Positions of the load while it moved.

    Parameters
    ----------
    first_s : float
        Time of the first, from the start of the motion.
    step_s : float
        From one to the next, > 0.
    position : ndarray, shape (n,)
        At least two, finite.

    Raises
    ------
    DesignError
        If a value is out of range.
    """

    first_s: float
    step_s: float
    position: FloatArray

    def __post_init__(self) -> None:
        if not (np.isfinite(self.first_s) and np.isfinite(self.step_s) and self.step_s > 0.0):
            raise DesignError(
                f"first_s = {self.first_s!r}, step_s = {self.step_s!r}: must be finite, step > 0"
            )
        if self.position.ndim != 1 or self.position.size < 2 or not np.isfinite(self.position).all():
            raise DesignError(f"position of shape {self.position.shape}: must be (n,), n >= 2, and finite")

    @property
    def times_s(self) -> FloatArray:
        """Time of each position, shape (n,)."""
        return self.first_s + self.step_s * np.arange(self.position.size, dtype=np.float64)

    def error(self, motion: PolynomialMotion) -> FloatArray:
        """How far the load was off its motion, shape (n,): Visioli and Piazzi (2008), eq 11."""
        return np.asarray(self.position - motion.at(self.times_s), dtype=np.float64)


def cost(motion: PolynomialMotion, moves: Sequence[MeasuredMove]) -> float:
    """Give the mean of the squared error, halved, over all moves.

    References
    ----------
    Visioli and Piazzi (2008), eq 8, for one move; by the trapezoidal rule.

    Examples
    --------
    >>> late = MeasuredMove(0.0, 0.5, np.array([0.0, 0.0, 0.0, 0.5, 1.0, 1.0]))
    >>> cost(PolynomialMotion(1.0, 1.0), [late])
    0.15
    """
    return float(np.mean([0.5 * mean(move.error(motion) ** 2) for move in moves]))


def mean(values: FloatArray) -> float:
    """Give the mean over time, by the trapezoidal rule."""
    return float(np.trapezoid(values)) / (values.size - 1)


def with_values(drive: ElasticDrive, values: FloatArray) -> ElasticDrive:
    """Give a drive with other parameters of `TUNED`; the gains stay."""
    return replace(drive, **dict(zip(TUNED, values.tolist(), strict=True)))


@dataclass(frozen=True, eq=False)
class Misfit:
    """Moves, and what commanded them.

    Parameters
    ----------
    commanded : ElasticDrive
        The estimate whose inverse was the command.
    motion : PolynomialMotion
        What it should have done.
    moves : sequence of MeasuredMove
        What it did.
    """

    commanded: ElasticDrive
    motion: PolynomialMotion
    moves: Sequence[MeasuredMove]

    def left(self, drive: ElasticDrive) -> FloatArray:
        """Give what a drive leaves unexplained of all moves, one after the other."""
        (explained,) = self._responses(drive, [Ratio(np.ones(1), np.ones(1))])
        measured = np.concatenate([move.position for move in self.moves])
        return np.asarray(measured - self.motion.start - explained)

    def slopes(self, drive: ElasticDrive) -> FloatArray:
        """Give how what a drive explains changes with the logarithm of each parameter, shape (n, 5)."""
        return np.column_stack(self._responses(drive, drive.sensitivities)) * drive.tuned

    def cost(self, drive: ElasticDrive) -> float:
        """Give the cost that a drive leaves unexplained."""
        places = np.cumsum([move.position.size for move in self.moves])[:-1]
        return float(np.mean([0.5 * mean(each**2) for each in np.split(self.left(drive), places)]))

    def _responses(self, drive: ElasticDrive, ratios: Sequence[Ratio]) -> list[FloatArray]:
        """Give what each ratio makes of the motion that a drive would have made of the command."""
        own, inverse = drive.transfer_function, self.commanded.transfer_function
        top = product(own.numerator, inverse.denominator)
        bottom = product(own.denominator, inverse.numerator)
        answers = [
            motion_response(product(top, ratio.numerator), product(bottom, ratio.denominator), self.motion)
            for ratio in ratios
        ]
        return [
            np.concatenate(
                [each.on_grid(move.first_s, move.step_s, move.position.size) for move in self.moves]
            )
            for each in answers
        ]
