"""Compare two runs of a block, field by field and bit for bit. Not for: tolerances; there are none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Comparison:
    """One verdict.

    Parameters
    ----------
    max_ulp : int
        Largest distance in units in the last place (whole steps for integers); 0 when equal.
    max_abs : float
        Largest absolute difference.
    first_difference : str or None
        Tick, field and both values of the first difference; None when every bit is equal.
    """

    max_ulp: int
    max_abs: float
    first_difference: str | None

    @property
    def is_equal(self) -> bool:
        """Whether every bit of every field was equal."""
        return self.first_difference is None


def compare(expected: NDArray[np.void], actual: NDArray[np.void]) -> Comparison:
    """Compare structured output arrays bit for bit.

    Parameters
    ----------
    expected, actual : structured ndarray, shape (ticks,)
        Outputs of the reference and of the generated code.

    Examples
    --------
    >>> kind = [("reference", "f8")]
    >>> compare(np.array([(0.0,)], kind), np.array([(5e-324,)], kind))
    Comparison(max_ulp=1, max_abs=5e-324, first_difference='tick 0, reference: expected 0.0, got 5e-324')
    """
    if expected.shape != actual.shape:
        return Comparison(0, 0.0, f"expected {expected.size} ticks, got {actual.size}")
    max_ulp, max_abs = 0, 0.0
    first: tuple[int, str] | None = None
    for name in expected.dtype.names or ():
        want, got = expected[name], actual[name]
        distance = np.abs(_ordered(want) - _ordered(got))
        if not distance.any():
            continue
        tick = int(np.flatnonzero(distance)[0])
        first = min(first or (tick, name), (tick, name), key=lambda found: found[0])
        max_ulp = max(max_ulp, int(distance.max()))
        with np.errstate(invalid="ignore", over="ignore"):
            gaps = np.abs(want.astype(np.float64) - got.astype(np.float64))
        max_abs = max(max_abs, float(np.nan_to_num(gaps, nan=np.inf).max()))
    if first is None:
        return Comparison(0, 0.0, None)
    tick, name = first
    text = f"tick {tick}, {name}: expected {expected[name][tick]}, got {actual[name][tick]}"
    return Comparison(max_ulp, max_abs, text)


def _ordered(values: NDArray[np.generic]) -> NDArray[np.object_] | NDArray[np.int64]:
    """Bit patterns as integers in numeric order, so that neighbours differ by 1; -0.0 differs from 0.0."""
    if values.dtype.kind != "f":
        return values.astype(np.int64)
    size = values.dtype.itemsize
    bits = np.ascontiguousarray(values).view(f"i{size}").astype(np.int64)
    lowest = np.int64(-(2 ** (8 * size - 1)))
    # A negative pattern counts down from -1 (that is -0.0), one below the pattern of 0.0.
    return np.where(bits < 0, lowest - bits - 1, bits)
