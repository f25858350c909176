"""Readings that failed: samples that stand alone, far outside of the swing.

Not for: noise, knocks, or a crane that still moves; those last for longer than one sample.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swayless.plant.identification.record import FloatArray

_INNER = (5.0, 95.0)
"""Percentiles between which the swing is told; what failed more often than outside of them is no outlier."""

_FAR, _ALONE = 3.0, 10.0
"""How far out, in ranges of the swing, and against the samples two steps away."""


def outliers(value: FloatArray) -> NDArray[np.int64]:
    """Find samples that differ from their neighbours by far more than the swing does, and others near them.

    Parameters
    ----------
    value : ndarray, shape (n,)
        In the order of time, at least five.

    Examples
    --------
    >>> swing = np.cos(0.3 * np.arange(100))
    >>> swing[40] = 999.0
    >>> outliers(swing)
    array([40])
    """
    padded = np.pad(value, 1, mode="reflect")
    alone = np.abs(value - (padded[:-2] + padded[2:]) / 2.0)
    beside = np.pad(alone, 2, mode="reflect")
    swing = float(np.ptp(np.percentile(value, _INNER)))
    far = (alone > _FAR * swing) & (alone > _ALONE * np.maximum(beside[:-4], beside[4:]))
    return np.flatnonzero(far) if swing > 0.0 else np.empty(0, dtype=np.int64)
