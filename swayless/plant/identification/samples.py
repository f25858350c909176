"""The samples of a record, and fewer equations that say the same of waves that are slow against the sampling.

Over a part of the record that is short against its waves every model is a polynomial, to rounding: its values
m at q nodes decide those at all samples of the part, P m. With P = Q R the squares are
|y - P m|^2 = |Q' y - R m|^2 + |y - Q Q' y|^2, so that q equations stand for all samples of the part, and
least squares, their minimum and Fisher's information are those of all samples: nothing is averaged away.

Not for: which model it is.

References
----------
L. N. Trefethen, *Approximation Theory and Approximation Practice* (2013), chapter 8: interpolation of entire
functions in Chebyshev nodes. G. Golub and C. Van Loan, *Matrix Computations* (2013), section 5.3: least
squares by QR.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from swayless.plant.identification.record import FloatArray

_NODES = 32
_REACH_RAD = 11.0
"""Half of the phase over a part: interpolation leaves 1e-13 of a wave and of decays up to a third of it."""

_FEWEST_PARTS = 4
_WORTH = 2
"""Samples for each equation from which on there is something to be gained."""

_ROWS = 128
"""Rows that are reduced to a triangle at once."""

_AT_ONCE = 100_000
"""Samples whose polynomials are in memory at the same time."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Values at times, or equations for the values that a model has at nodes.

    Parameters
    ----------
    time_s : ndarray, shape (n,)
        From 0 on: of the samples, or of the nodes.
    value : ndarray, shape (n,)
        The record, or the right sides of the equations.
    duration_s : float
        Of the record.
    highest_rad_s : float
        Frequency above which waves look like slower ones, or for which there are too few nodes.
    weights : ndarray or None, shape (parts, q, q)
        The equations of each part for values at its q nodes; None for samples.
    rest : float
        Sum of squares that no model of slow waves explains.
    """

    time_s: FloatArray
    value: FloatArray
    duration_s: float
    highest_rad_s: float
    weights: FloatArray | None = None
    rest: float = 0.0
    _fewer: dict[int, Samples] = field(default_factory=dict, repr=False)

    @classmethod
    def of_record(cls, time_s: FloatArray, value: FloatArray) -> Samples:
        """Give the samples of a record, whose times begin at 0 and rise."""
        return cls(time_s, value, float(time_s[-1]), float(np.pi / np.median(np.diff(time_s))))

    def left_sides(self, values: FloatArray) -> FloatArray:
        """Put values of a model, or of its derivatives, shape (n,) or (n, k), into the equations."""
        if self.weights is None:
            return values
        parts = self.weights.shape[0]
        return np.asarray((self.weights @ values.reshape(parts, _NODES, -1)).reshape(values.shape))

    def for_waves(self, frequency_rad_s: float, *, harmonics: int = 1) -> Samples:
        """Give fewer equations that say the same of slow waves; the samples themselves where they are few.

        Parameters
        ----------
        frequency_rad_s : float
            Highest frequency of the waves.
        harmonics : int
            Number of the highest harmonic that the waves have.

        Examples
        --------
        >>> time_s = np.linspace(0.0, 100.0, 50_001)
        >>> wave = np.cos(2.0 * time_s)
        >>> fewer = Samples.of_record(time_s, wave).for_waves(2.0)
        >>> fewer.time_s.size
        512
        >>> bool(np.allclose(fewer.left_sides(np.cos(2.0 * fewer.time_s)), fewer.value))
        True
        """
        least = frequency_rad_s * harmonics * self.duration_s / (2.0 * _REACH_RAD)
        # Powers of 2: most models of a record share their equations.
        parts = max(_FEWEST_PARTS, 2 ** int(np.ceil(np.log2(least))))
        if _WORTH * _NODES * parts > self.time_s.size:
            return self
        if parts not in self._fewer:
            self._fewer[parts] = _condensed(self, parts)
        highest = 2.0 * _REACH_RAD * parts / (self.duration_s * harmonics)
        return replace(self._fewer[parts], highest_rad_s=min(self.highest_rad_s, highest))


def _condensed(samples: Samples, parts: int) -> Samples:
    """Replace the samples of each part of a record by equations for values at its nodes."""
    node = -np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)
    by_value = np.linalg.inv(np.polynomial.chebyshev.chebvander(node, _NODES - 1))
    width_s = samples.duration_s / parts
    triangle, part = _triangular(*_polynomials(samples, parts))
    return Samples(
        time_s=(width_s * (part[:, None] + (node + 1.0) / 2.0)).ravel(),
        value=triangle[:, :_NODES, _NODES].ravel(),
        duration_s=samples.duration_s,
        highest_rad_s=samples.highest_rad_s,
        weights=triangle[:, :_NODES, :_NODES] @ by_value,
        rest=float(np.sum(triangle[:, _NODES, _NODES] ** 2)),
    )


def _polynomials(samples: Samples, parts: int) -> tuple[FloatArray, NDArray[np.int64]]:
    """Give a row for each sample, polynomials and value, and its part; of many samples some at a time."""
    place = samples.time_s * (parts / samples.duration_s)
    part = np.minimum(place.astype(np.int64), parts - 1)
    inside = 2.0 * (place - part) - 1.0
    rows, of_rows = [], []
    for low in range(0, part.size, _AT_ONCE):
        some = slice(low, low + _AT_ONCE)
        table = np.empty((inside[some].size, _NODES + 1))
        table[:, :_NODES] = np.polynomial.chebyshev.chebvander(inside[some], _NODES - 1)
        table[:, _NODES] = samples.value[some]
        triangle, of_triangle = _triangular(table, part[some])
        rows.append(triangle.reshape(-1, _NODES + 1))
        of_rows.append(np.repeat(of_triangle, _NODES + 1))
    return np.concatenate(rows), np.concatenate(of_rows)


def _triangular(rows: FloatArray, part: NDArray[np.int64]) -> tuple[FloatArray, NDArray[np.int64]]:
    """Reduce the rows of each part to a triangle, shape (parts, q + 1, q + 1): QR of some rows at a time.

    The parts rise; small blocks stay in the cache, and in one thread.
    """
    while True:
        first = np.searchsorted(part, part)
        rank = np.arange(part.size) - first
        begins = rank % _ROWS == 0
        blocks = np.zeros((int(begins.sum()), _ROWS, _NODES + 1))
        blocks[np.cumsum(begins) - 1, rank % _ROWS] = rows
        triangle, of_block = np.asarray(np.linalg.qr(blocks, mode="r")), part[begins]
        if (np.diff(of_block) > 0).all():
            return triangle, of_block
        rows, part = triangle.reshape(-1, _NODES + 1), np.repeat(of_block, _NODES + 1)
