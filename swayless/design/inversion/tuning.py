"""Parameters of an elastic drive corrected by measured moves, one experiment after another.

The command of a move is the inverse of an estimated drive; what the load then does wrong says how the
estimate is wrong. Two steps lead from one estimate to the next: the paper's, down the gradient of the cost,
and a scaled one.

Not for: reading records, or the command of the next move (`inverse`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swayless.design.inversion.misfit import MeasuredMove, Misfit, mean, with_values
from swayless.design.inversion.motion import PolynomialMotion
from swayless.design.optimal.linear_plant import LinearPlant
from swayless.design.optimal.sampling import Sampled, convolved
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError, PlantError
from swayless.plant.elastic_drive import ElasticDrive, Ratio

PAPER_GAIN = 1e-3
PAPER_WEIGHTS = (1e-3, 1e-3, 1.0, 1.0, 10.0)
"""Step size and diagonal of R^-1, in the order of `TUNED`: Visioli and Piazzi (2008), section 5.1."""

_ROUNDS = 60
_HALVINGS = 12
_CONVERGED = 1e-6  # of what is left: a step that gains less is the last
_NOTHING = 1e-9  # of the travel: what is left of an exact record
_LONGEST = 1.0  # of a step, in logarithms: farther, a line says nothing
_KNOWN_TO = 0.5  # in logarithms: how well each parameter is known before the record


@dataclass(frozen=True, eq=False)
class Step:
    """From one estimate to the next.

    Parameters
    ----------
    drive : ElasticDrive
        The next estimate.
    expected_cost : float
        Cost that the next estimate leaves unexplained: noise, and what the model does not know.
    """

    drive: ElasticDrive
    expected_cost: float


def gradient(drive: ElasticDrive, motion: PolynomialMotion, moves: Sequence[MeasuredMove]) -> FloatArray:
    """Give the derivative of the cost by each parameter of `TUNED`, from measured positions alone.

    Raises
    ------
    DesignError
        If the drive has no damping.

    References
    ----------
    Visioli and Piazzi (2008), eqs 10 and 14 to 19: the measured positions pass through P1 + P2 + P3, here
    straight from one to the next.
    """
    _check_damping(drive)
    each = [
        [-mean(move.error(motion) * _filtered(ratio, move, motion.start)) for ratio in drive.sensitivities]
        for move in moves
    ]
    return np.asarray(np.mean(each, axis=0))


def paper_step(
    drive: ElasticDrive,
    motion: PolynomialMotion,
    moves: Sequence[MeasuredMove],
    *,
    gain: float = PAPER_GAIN,
    weights: Sequence[float] = PAPER_WEIGHTS,
) -> Step:
    """Take one step down the gradient.

    Parameters
    ----------
    drive : ElasticDrive
        The estimate whose inverse commanded the moves.
    motion : PolynomialMotion
        What the load should have done.
    moves : sequence of MeasuredMove
        What it did.
    gain, weights
        Step size, and the diagonal of R^-1.

    Raises
    ------
    DesignError
        If the drive has no damping, or the step leads to a drive that cannot be.

    References
    ----------
    Visioli and Piazzi (2008), eq 9.
    """
    values = drive.tuned - gain * np.asarray(weights) * gradient(drive, motion, moves)
    try:
        stepped = with_values(drive, values)
    except PlantError as error:
        raise DesignError(f"the step leads to {error}; take a smaller one, or the scaled one") from error
    return Step(stepped, Misfit(drive, motion, moves).cost(stepped))


def scaled_step(drive: ElasticDrive, motion: PolynomialMotion, moves: Sequence[MeasuredMove]) -> Step:
    """Take the step that explains the moves best: Gauss and Newton in logarithms, searched along each line.

    All of it on the record, without another experiment: see `Misfit`. Each parameter is held to its value as
    one known to within a half, with what stays unexplained as noise: so noise moves none that the motion
    hardly shows, and load mass, damping and stiffness change by their ratios only.

    Parameters are those of `paper_step`.

    Raises
    ------
    DesignError
        If the drive has no damping.

    References
    ----------
    Nocedal and Wright (2006), "Numerical optimization", section 10.3.
    """
    _check_damping(drive)
    misfit = Misfit(drive, motion, moves)
    place = _Place(drive, np.zeros(drive.tuned.size), misfit.left(drive))
    nothing = (_NOTHING * motion.travel) ** 2 * place.left.size
    for _ in range(_ROUNDS):
        if place.left @ place.left <= nothing:
            break
        step, noise = _gauss_newton(place, misfit.slopes(place.drive))
        reached = _along(step, misfit, place, noise)
        if reached is None:
            break
        gained = 1.0 - reached.objective(noise) / place.objective(noise)
        place = reached
        if gained < _CONVERGED:
            break
    return Step(place.drive, misfit.cost(place.drive))


@dataclass(frozen=True, eq=False)
class _Place:
    """An estimate, how far it is from the first one in logarithms, and what it leaves unexplained."""

    drive: ElasticDrive
    moved: FloatArray
    left: FloatArray

    def objective(self, noise: float) -> float:
        """Give what is minimised: the squares that are left, and how far the parameters moved."""
        return float(self.left @ self.left + noise**2 * (self.moved @ self.moved))


def _gauss_newton(place: _Place, slopes: FloatArray) -> tuple[FloatArray, float]:
    """Give the step in logarithms, no part of it above 1, and the weight of what is known before."""
    size = place.moved.size
    free, *_ = np.linalg.lstsq(slopes, place.left, rcond=None)
    noise = float(np.linalg.norm(place.left - slopes @ free)) / np.sqrt(max(1, place.left.size - size))
    weight = noise / _KNOWN_TO
    held = np.vstack([slopes, weight * np.eye(size)])
    step, *_ = np.linalg.lstsq(held, np.append(place.left, -weight * place.moved), rcond=None)
    return step / max(1.0, float(np.abs(step).max()) / _LONGEST), weight


def _along(step: FloatArray, misfit: Misfit, place: _Place, noise: float) -> _Place | None:
    """Go a step, halved until it leaves less than there is; None where no share of it does."""
    for share in 0.5 ** np.arange(_HALVINGS):
        try:
            drive = with_values(place.drive, place.drive.tuned * np.exp(share * step))
        except PlantError:  # an unstable loop: a shorter step leads to a stable one
            continue
        reached = _Place(drive, place.moved + share * step, misfit.left(drive))
        if reached.objective(noise) < place.objective(noise):
            return reached
    return None


def _filtered(ratio: Ratio, move: MeasuredMove, start: float) -> FloatArray:
    """Pass positions, straight from one to the next, through a transfer function at rest."""
    from scipy.linalg import expm  # here, because it is heavy

    plant = LinearPlant.from_transfer_function(ratio.numerator.tolist(), ratio.denominator.tolist())
    inputs = move.position - start
    order = plant.order
    block = np.zeros((order + 2, order + 2))
    block[:order, :order], block[:order, order] = plant.a * move.step_s, plant.b * move.step_s
    block[order, order + 1] = 1.0
    exact = expm(block)
    late, early = exact[:order, order + 1], exact[:order, order] - exact[:order, order + 1]
    answers = (
        convolved(plant.c @ Sampled(exact[:order, :order], into).reach(inputs.size - 1)[:, ::-1], values)
        for into, values in ((early, inputs), (late, inputs[1:]))
    )
    return np.asarray(plant.d * inputs + sum(answers))


def _check_damping(drive: ElasticDrive) -> None:
    """Refuse a transmission without damping: its logarithm, and the zero that it makes, are not there."""
    if drive.damping == 0.0:
        raise DesignError("damping = 0: tuning needs a first guess > 0")
