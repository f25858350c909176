"""How the taps of a row answer a step that the swing wants. Not for: how large that step is (`hoist`).

A wanted step of the trolley's speed is made by a few steps, one at each tap of the row, that

- excite the swing as the wanted step would,
- are 0 in sum, so that the reference comes back to the command, and
- move the trolley by nothing, so that the way to a stop does not depend on what is still to be answered.

They go up as far as down. Where that would pass the largest command, steps that excite nothing are added and
they go only down: the reference stays within the maximum, and nothing is cut off.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from swayless.controller.settings import ShaperSettings
from swayless.design.shaper import FloatArray

LEANING = 2.0**-6
"""Part of the largest command: commands nearer to it than that, unless they shrink, make answers lean."""

LARGEST_STEP = 1.0
"""Of an answer, for a wanted step of 1: answers that keep the way and take larger ones are not used."""

_SOLVED = 1e-5
"""Largest error of an equation that counts as solved: lags are whole quanta, of 1e-6 rad at most."""

_LATTICE = 2.0**-24
"""Answers are multiples of it, exact in every number type: the last digit of a solver does not show."""


class Answer(NamedTuple):
    """Steps at the taps of a row for a wanted step of 1.

    Parameters
    ----------
    even : tuple of float
        They answer it.
    lean : tuple of float
        They excite nothing; added once or taken away once they make the answer go only up, or only down. All
        0 where a row has too few taps for that.
    """

    even: tuple[float, ...]
    lean: tuple[float, ...]


def answers(settings: ShaperSettings) -> tuple[Answer, ...]:
    """Find the answer of every row, row 0 included.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of a block with a phase clock.
    """
    clock = settings.clock
    assert clock is not None  # noqa: S101 - only a phase law asks
    found = [Answer((0.0,), (0.0,))]  # row 0 has no swing to care for
    for row in settings.bank.rows:
        phases_rad = row.taps.lags.astype(np.float64) * clock.quantum_rad
        found.append(answer(phases_rad, row.taps.amplitudes, row.taps.guarantee.mode.damping_ratio))
    return tuple(found)


def leaning_from(settings: ShaperSettings) -> Any:
    """Find the command from which on answers lean, in the number type.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.
    """
    most = settings.limits.max_command
    if settings.number.is_integer:
        return int(most) - int(int(most) * LEANING)
    return most - (most * settings.number.scalar(LEANING))


def answer(phases_rad: FloatArray, amplitudes: FloatArray, damping_ratio: float) -> Answer:
    """Find the smallest answer of taps at these phases.

    Where no answer keeps the way, as with two taps, it is the smallest that returns to the command; where
    there is none either, the taps themselves give the step back.

    Parameters
    ----------
    phases_rad : ndarray, shape (n,)
        Undamped phases w t of the taps, the first 0, increasing.
    amplitudes : ndarray, shape (n,)
        Of the taps, in sum 1.
    damping_ratio : float
        Of the swing.

    Returns
    -------
    Answer
        Its steps, in the order of the taps.

    Examples
    --------
    >>> found = answer(np.pi * np.arange(3.0), np.array([0.25, 0.5, 0.25]), 0.0)
    >>> found.even, found.lean
    ((0.25, -0.5, 0.25), (0.25, 0.0, -0.25))
    """
    swing = np.exp(complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2)) * phases_rad)
    way = phases_rad / phases_rad[-1]
    demands = np.array([np.ones_like(way), swing.real, swing.imag, way])
    even = _smallest(demands, np.array([0.0, 1.0, 0.0, 0.0]))
    if even is None:
        even = _smallest(demands[:3], np.array([0.0, 1.0, 0.0]))
    if even is None:
        even = np.eye(way.size)[0] - amplitudes
    return Answer(_on_lattice(even), _on_lattice(_leaning(demands, even)))


def _on_lattice(steps: FloatArray) -> tuple[float, ...]:
    """Round to the lattice, with no negative zero."""
    return tuple((np.rint(steps / _LATTICE) * _LATTICE + 0.0).tolist())


def _smallest(demands: FloatArray, wanted: FloatArray) -> FloatArray | None:
    """Find the smallest solution of the equations; None if there is none, or none that is small."""
    found = np.linalg.lstsq(demands, wanted, rcond=_SOLVED)[0].astype(np.float64)
    is_solved = np.abs(demands @ found - wanted).max() <= _SOLVED
    return found if is_solved and np.abs(found).max() <= LARGEST_STEP else None


def _leaning(demands: FloatArray, even: FloatArray) -> FloatArray:
    """Find steps that excite nothing and lift an answer until its sums so far are never negative."""
    unit_way = np.array([0.0, 0.0, 0.0, -1.0])
    lean = np.linalg.lstsq(demands, unit_way, rcond=_SOLVED)[0].astype(np.float64)
    height, depth = np.cumsum(lean)[:-1], np.abs(np.cumsum(even))[:-1]
    is_solved = np.abs(demands[:3] @ lean).max() <= _SOLVED and height.min() > _SOLVED
    return lean * float((depth / height).max()) if is_solved else np.zeros_like(even)
