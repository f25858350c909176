"""Shapers for several modes at once, by convolution.

Not for: one program over several bands, which is shorter but not a product of shapers.
"""

from __future__ import annotations

import numpy as np

from swayless.design.robustness import proven_shaper
from swayless.design.shaper import Shaper
from swayless.plant import Mode

_COINCIDENT = 1e-12
"""Impulses nearer than this part of the duration fall together: their times differ by rounding."""

_CANCELLED = 1e-15
"""Merged amplitudes below this part of the largest are what rounding leaves of impulses that cancel."""


def convolve(
    first: Shaper, *others: Shaper, mode: Mode | None = None, tolerance: float | None = None
) -> Shaper:
    """Convolve shapers: the result suppresses every mode that one of them suppresses.

    Its impulses stand at all sums of times, with the products of amplitudes; coincident ones are merged.
    What one shaper holds, the others may spoil or improve, so the guarantee is proved again.

    Parameters
    ----------
    first, *others : Shaper
        Shapers of single modes, in any order but for the defaults below.
    mode : Mode, optional
        The mode of the new guarantee; by default that of the first shaper's.
    tolerance : float, optional
        Its tolerance, as a ratio; by default that of the first shaper's.

    Returns
    -------
    Shaper
        Duration: the sum of the durations. Guarantee: the band held around `mode`.

    Raises
    ------
    DesignError
        If no band is held around the mode at the tolerance.

    Examples
    --------
    Hook and load of a crane:

    >>> from swayless.design import design_shaper
    >>> load, hook = design_shaper("zv", Mode(0.2)), design_shaper("zv", Mode(0.5))
    >>> both = convolve(load, hook)
    >>> both.times_s, both.amplitudes
    (array([0. , 1. , 2.5, 3.5]), array([0.25, 0.25, 0.25, 0.25]))
    """
    times_s, amplitudes = first.times_s, first.amplitudes
    for other in others:
        times_s = np.add.outer(times_s, other.times_s).ravel()
        amplitudes = np.multiply.outer(amplitudes, other.amplitudes).ravel()
    rising = np.argsort(times_s, kind="stable")
    times_s, amplitudes = times_s[rising], amplitudes[rising]
    starts = np.flatnonzero(np.diff(times_s, prepend=-np.inf) > _COINCIDENT * times_s[-1])
    times_s, amplitudes = times_s[starts], np.add.reduceat(amplitudes, starts)
    kept = np.abs(amplitudes) > _CANCELLED * np.abs(amplitudes).max()
    shapers = (first, *others)
    return proven_shaper(
        times_s[kept],
        amplitudes[kept],
        mode or first.guarantee.mode,
        tolerance=tolerance or first.guarantee.tolerance,
        family="*".join(shaper.family for shaper in shapers),
        source="; ".join(dict.fromkeys(shaper.source for shaper in shapers)),
    )
