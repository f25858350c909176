"""What a command must have done at its end, so that the plant rests, and rests where it differs a little.

A ringing pole that is repeated in a Jordan chain makes the command's transform vanish there with its
derivatives; one that is split makes it vanish on both sides (extra insensitive). Either way the final state
is the one in which the augmented plant rests under the final input: one rule for eqs 21-24, 27, 29, 30, 32
and 36.

Not for: solving for the command.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.design.optimal.linear_plant import (
    LinearPlant,
    check_apart,
    mode_vectors,
    shown,
    uncontrolled,
)
from swayless.design.optimal.sampling import Sampled, sampled
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

LARGEST_ROBUST_ORDER = 6
"""Most repetitions of a pole: each costs time, and its conditions differ less and less from the others'."""

LARGEST_SPLIT_RATIO = 0.5


@dataclass(frozen=True)
class Robustness:
    """Against errors of the plant's ringing poles.

    Parameters
    ----------
    order : int
        How many derivatives of the residual vibration in the frequency vanish too, 0 to 6.
    split_ratio : float or None
        Instead: nothing is left at the frequencies (1 - split) and (1 + split) of each mode, and little
        between; above 0 and below 0.5.

    Raises
    ------
    DesignError
        If a value is out of range, or both are given.
    """

    order: int = 0
    split_ratio: float | None = None

    def __post_init__(self) -> None:
        if isinstance(self.order, bool) or not 0 <= self.order <= LARGEST_ROBUST_ORDER:
            raise DesignError(
                f"robust order = {self.order!r}: must be a whole number from 0 to {LARGEST_ROBUST_ORDER}"
            )
        if self.split_ratio is None:
            return
        if self.order:
            raise DesignError("robust order and split: poles are either repeated or split, give one of them")
        if not 0.0 < self.split_ratio < LARGEST_SPLIT_RATIO:
            raise DesignError(
                f"split_ratio = {self.split_ratio!r}: must be above 0 and below {LARGEST_SPLIT_RATIO:g}"
            )

    @property
    def asked(self) -> bool:
        """Whether anything is repeated or split."""
        return self.order > 0 or self.split_ratio is not None


@dataclass(frozen=True, eq=False)
class Rest:
    """Linear conditions on a command from rest after which everything rests: rows(n) @ u = final.

    Parameters
    ----------
    system : Sampled
        Plant and chains from tick to tick.
    kept : ndarray, shape (r, states)
        Which combinations of their states count.
    final : ndarray, shape (r,)
        Their values at the end.
    """

    system: Sampled
    kept: FloatArray
    final: FloatArray

    def rows(self, ticks: int) -> FloatArray:
        """Give the conditions on a command of so many ticks, shape (r, ticks), rows of length 1 at most."""
        return np.asarray(self.kept @ self.system.reach(ticks))


def rest_conditions(
    plant: LinearPlant, tick_s: float, change: float, robustness: Robustness | None = None
) -> Rest:
    """Set up the conditions for a change of the output, from rest to rest.

    Parameters
    ----------
    plant : LinearPlant
        Stable but for poles at 0 and on the imaginary axis, and controllable.
    tick_s : float
        > 0.
    change : float
        Output at the end less output at the start.
    robustness : Robustness
        None is asked for unless given.

    Raises
    ------
    DesignError
        If nothing rings that robustness could be against, poles are too near, or the tick hides a pole.

    References
    ----------
    Xu and Meckl (2005), eqs 22-33 (repeated poles) and 35, 36 (split ones).

    Examples
    --------
    >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    >>> chain = rest_conditions(plant, 0.005, 1.0, Robustness(order=1)).final[2:]
    >>> (chain / abs(chain).max()).round(12).tolist()
    [-1.0, 0.0]
    """
    robustness = robustness or Robustness()
    plant = plant.balanced
    state, held = plant.equilibrium(change)
    chains = _chains(plant, robustness)
    kept: list[FloatArray] = [np.eye(plant.order) if robustness.split_ratio is None else _not_ringing(plant)]
    systems, finals = [sampled(plant.a, plant.b, tick_s)], [state]
    _check_sampled(plant, systems[0], tick_s)
    skipped = 0 if robustness.split_ratio is not None else 1
    for mode, pole, length in chains:
        a, b = jordan_chain(pole, length)
        b *= _participation(plant, mode)
        systems.append(sampled(a, b, tick_s))
        finals.append(np.asarray(np.linalg.solve(a, -held * b), dtype=np.float64))
        # The last link of a chain is the plant's own mode, which is kept already.
        kept.append(np.eye(b.size)[: 2 * (length - skipped)])
    selection = _diagonal(kept)
    system = Sampled(_diagonal([each.a for each in systems]), np.concatenate([each.b for each in systems]))
    return Rest(system, selection, selection @ np.concatenate(finals))


def jordan_chain(pole_rad_s: complex, length: int) -> tuple[FloatArray, FloatArray]:
    """Give A, B of q_i' = p q_i + |p| q_(i+1), the last one driven by |p| u: real and imaginary parts.

    The paper's chain has 1 for |p|; with |p| all of its states are of the size of the input.

    Parameters
    ----------
    pole_rad_s : complex
        Above the real axis.
    length : int
        Links, >= 1.

    References
    ----------
    Xu and Meckl (2005), eqs 1 and 22.

    Examples
    --------
    >>> jordan_chain(2j, 1)[0].tolist(), jordan_chain(2j, 1)[1].tolist()
    ([[0.0, -2.0], [2.0, 0.0]], [2.0, 0.0])
    """
    size = abs(pole_rad_s)
    turn = np.array([[pole_rad_s.real, -pole_rad_s.imag], [pole_rad_s.imag, pole_rad_s.real]])
    a = np.kron(np.eye(length), turn) + size * np.eye(2 * length, k=2)
    return a, size * np.eye(2 * length)[2 * length - 2]


def _participation(plant: LinearPlant, pole: complex) -> float:
    """How large a pole's part of the states is under an input of 1: chains in this unit are as large."""
    _, before = mode_vectors(plant, pole)
    return float(abs(before @ plant.b) / abs(pole))


def _chains(plant: LinearPlant, robustness: Robustness) -> list[tuple[complex, complex, int]]:
    """Give the plant's pole, and pole and length, of each chain that robustness adds."""
    if not robustness.asked:
        return []
    poles = plant.ringing_poles_rad_s
    if poles.size == 0:
        raise DesignError("robust or extra insensitive: nothing rings in this plant, leave it out")
    check_apart(plant)
    split = robustness.split_ratio
    if split is None:
        return [(complex(pole), complex(pole), robustness.order + 1) for pole in poles]
    factors = (1.0 - split, 1.0 + split)
    return [(complex(pole), complex(pole) * factor, 1) for pole in poles for factor in factors]


def _not_ringing(plant: LinearPlant) -> FloatArray:
    """Give rows W, shape (k, n), with W A = M W, for all poles that do not ring: their states are W x."""
    from scipy.linalg import schur

    ringing = plant.ringing_poles_rad_s
    both = np.concatenate([ringing, ringing.conj()])
    near = 1e-6 * np.abs(both).max()

    def stays(real: float, imaginary: float) -> bool:
        return bool(np.abs(both - complex(real, imaginary)).min() > near)

    _, vectors, count = schur(plant.a.T, output="real", sort=stays)
    return np.asarray(vectors[:, :count].T)


def _check_sampled(plant: LinearPlant, system: Sampled, tick_s: float) -> None:
    """Refuse a tick at which poles cannot be told apart."""
    poles = plant.poles_rad_s
    lost = uncontrolled(system.a, system.b, np.exp(poles * tick_s))
    if lost.any():
        raise DesignError(
            f"tick_s = {tick_s:.12g}: from tick to tick the input does not move the pole at"
            f" {shown(poles[lost][0])} rad/s, which turns by half turns or meets another;"
            " another tick is needed"
        )


def _diagonal(blocks: list[FloatArray]) -> FloatArray:
    from scipy.linalg import block_diag

    return np.asarray(block_diag(*blocks), dtype=np.float64)
