"""Whether a record can be of the motion that was commanded, and what makes a record seem not to be.

A record in another unit, with another sign, or of a sensor that stands still is a motion that no drive makes:
all drives bring their load to where the command ends. One that is late, or on a slightly wrong scale, is
explained in part, by parameters that are bent.

Not for: finding the drive (`tuning`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swayless.design.inversion.misfit import MeasuredMove, Misfit, cost
from swayless.design.inversion.motion import PolynomialMotion
from swayless.design.inversion.tuning import Step, scaled_step
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant.elastic_drive import ElasticDrive

LEAST_EXPLAINED = 0.5
"""Of the cost: a best fit that explains less explains nothing."""

LARGEST_DOUBT = 0.1
"""Of the motion: parameters that were found beside a larger one say nothing of the drive."""

_LARGE = 0.05  # of the travel: what stays below is noise, which nothing explains
_SHOWS = 0.25  # of the squares that parameters alone leave: a doubt that leaves less has a cause
_SMALLEST_SCALE = 0.005
_RANK = 1e-9  # of the largest singular value: masses, dampings and stiffnesses show by their ratios only


@dataclass(frozen=True)
class Doubt:
    """What besides parameters would explain a record.

    Parameters
    ----------
    what : {"lag_s", "scale_ratio"}
        The load was recorded late, in s (before its time where negative); or so many times too large.
    size : float
    """

    what: str
    size: float

    def __str__(self) -> str:
        return f"a lag of {self.size:g} s" if self.what == "lag_s" else f"a scale of {self.size:g}"

    def share(self, motion: PolynomialMotion) -> float:
        """How much of a motion it is: of its duration, or of its travel."""
        return abs(self.size) / motion.duration_s if self.what == "lag_s" else abs(self.size - 1.0)


def check_explained(
    drive: ElasticDrive, motion: PolynomialMotion, moves: Sequence[MeasuredMove]
) -> Doubt | None:
    """Refuse moves that no drive explains, and say what a drive alone does not explain of others.

    Parameters
    ----------
    drive : ElasticDrive
        The estimate whose inverse commanded the moves.
    motion : PolynomialMotion
        What the load should have done.
    moves : sequence of MeasuredMove
        What it did.

    Returns
    -------
    Doubt or None
        What leaves the least, if it leaves less than a quarter of the squares that parameters alone leave.

    Raises
    ------
    DesignError
        If what the best drive leaves is large, above a twentieth of the travel in the root of its mean
        square, and more than half of the cost; or if the doubt is more than a tenth of the motion.

    Examples
    --------
    >>> drive = ElasticDrive(0.0002, 0.004, 0.05, 0.2, 1.2, 0.1, 5.0)
    >>> motion = PolynomialMotion(2.0, 1.0)
    >>> wide = MeasuredMove(0.0, 0.02, 1.05 * motion.at(0.02 * np.arange(250)))
    >>> doubt = check_explained(drive, motion, [wide])
    >>> doubt.what, round(doubt.size, 2)
    ('scale_ratio', 1.05)
    """
    best = scaled_step(drive, motion, moves)
    measured, left = cost(motion, moves), best.expected_cost
    too_little = left > (1.0 - LEAST_EXPLAINED) * measured
    if too_little and np.sqrt(2.0 * left) > _LARGE * abs(motion.travel):
        raise DesignError(_unexplained(motion, moves, f"best one leaves {left:.4g} of it, half at most is"))
    doubt = _doubt(Misfit(drive, motion, moves), best)
    if doubt is not None and doubt.share(motion) > LARGEST_DOUBT:
        raise DesignError(_unexplained(motion, moves, f"best one leaves {doubt}, a tenth at most is"))
    return doubt


def _unexplained(motion: PolynomialMotion, moves: Sequence[MeasuredMove], what: str) -> str:
    """Say what cannot be, and what may be the cause."""
    ends = float(np.mean([move.position[-1] for move in moves]))
    return (
        f"no drive explains the motion: its cost is {cost(motion, moves):.4g}, the {what} allowed; the load"
        f" ends at {ends:.6g}, the target is {motion.target:g}: another unit or sign, a sensor that stands"
        " still, another command, or a first guess too far off, for which a record that ends with the motion"
        " is better"
    )


def _doubt(misfit: Misfit, best: Step) -> Doubt | None:
    """Fit each cause together with the parameters, and give the one that leaves the least."""
    left, slopes = misfit.left(best.drive), misfit.slopes(best.drive)
    alone, _ = _fitted(slopes, left)
    explained = np.concatenate([move.position for move in misfit.moves]) - misfit.motion.start - left
    places = np.cumsum([move.position.size for move in misfit.moves])[:-1]
    slower = [
        -np.gradient(part, move.step_s)
        for part, move in zip(np.split(explained, places), misfit.moves, strict=True)
    ]
    causes = {
        "lag_s": (np.concatenate(slower), 0.5 * min(move.step_s for move in misfit.moves)),
        "scale_ratio": (explained, _SMALLEST_SCALE),
    }
    tried = {
        what: (*_fitted(np.column_stack([slopes, cause]), left), least)
        for what, (cause, least) in causes.items()
    }
    what = min(tried, key=lambda each: tried[each][0])
    stays, size, least = tried[what]
    if stays > _SHOWS * alone or abs(size) < least:
        return None
    return Doubt(what, float(f"{size + (what == 'scale_ratio'):.3g}"))


def _fitted(columns: FloatArray, left: FloatArray) -> tuple[float, float]:
    """Give the squares that the best mixture of columns leaves, and how much of the last one is in it."""
    mixture, *_ = np.linalg.lstsq(columns, left, rcond=_RANK)
    rest = left - columns @ mixture
    return float(rest @ rest), float(mixture[-1])
