"""How long the shortest shaper for a band lasts, over the width of the band: what no design can beat.

Not for: one band (`swayless.design.robust`).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

import numpy as np

from swayless.design.robust import Amplitudes, RobustDesign, specified_insensitivity
from swayless.design.robustness import DEFAULT_TOLERANCE, overtravel_s
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import Band


@dataclass(frozen=True, eq=False)
class Frontier:
    """The shortest shapers for bands of rising width, all from one frequency up.

    Parameters
    ----------
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule.
    low_hz : float
        Where all bands start.
    ratios : ndarray, shape (n,)
        Highest frequency of each band over the lowest, rising.
    designs : tuple of RobustDesign
        One for each ratio.
    """

    amplitudes: Amplitudes
    low_hz: float
    ratios: FloatArray
    designs: tuple[RobustDesign, ...]

    @property
    def durations_s(self) -> FloatArray:
        """Durations, shape (n,), in seconds."""
        return np.array([design.shaper.duration_s for design in self.designs])

    @property
    def lower_bounds_s(self) -> FloatArray:
        """Durations proved too short, shape (n,), in seconds."""
        return np.array([design.lower_bound_s for design in self.designs])

    @property
    def overtravels_s(self) -> FloatArray:
        """Ways of the shapers per unit of speed, shape (n,), in m per m/s."""
        return np.array([overtravel_s(design.shaper) for design in self.designs])


def frontier(
    low_hz: float,
    ratios: Sequence[float] | FloatArray,
    *,
    tolerance: float = DEFAULT_TOLERANCE,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
) -> Frontier:
    """Design the shortest shaper for each of several bands from one frequency up.

    Parameters
    ----------
    low_hz : float
        Lowest frequency of every band, > 0.
    ratios : sequence of float
        Highest frequency of each band over the lowest: at least 1, rising, at most 8.
    tolerance, damping_ratio, amplitudes
        As for `specified_insensitivity`.

    Returns
    -------
    Frontier
        Without the widths at which no optimum is found, if there are such: the next wider shaper holds them.

    Raises
    ------
    DesignError
        If a value is out of range, or the widest band has no shaper.

    Examples
    --------
    A band needs no more time than a wider one, and over whole stretches of widths as much:

    >>> frontier(1.0, [1.3, 1.4, 1.8]).durations_s.round(4)
    array([0.8003, 0.8003, 0.9558])
    """
    widths = np.asarray(ratios, dtype=np.float64)
    if widths.ndim != 1 or widths.size == 0 or widths[0] < 1.0 or np.any(np.diff(widths) <= 0.0):
        raise DesignError(f"ratios = {widths.tolist()}: must start at 1 or above and rise")
    design = partial(
        specified_insensitivity, tolerance=tolerance, damping_ratio=damping_ratio, amplitudes=amplitudes
    )
    designs = {float(widths[-1]): design(Band(low_hz, low_hz * widths[-1]))}
    for ratio in widths[-2::-1].tolist():
        with suppress(DesignError):
            designs[ratio] = design(Band(low_hz, low_hz * ratio))
    found = sorted(designs)
    return Frontier(amplitudes, low_hz, np.array(found), tuple(designs[ratio] for ratio in found))
