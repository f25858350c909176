"""Where to put a family on a range: the mode for which its band covers most of it, and how many it takes.

Not for: designing for a whole range (`swayless.design.robust`).
"""

from __future__ import annotations

import math

from swayless.design.families import design_shaper
from swayless.design.shaper import Shaper
from swayless.design.tradeoff.need import Need
from swayless.plant import Band, Mode

_TOUCHING = 1e-9  # relative: bands this near to each other meet


def relative_band(family: str, *, tolerance: float, damping_ratio: float) -> Band:
    """Band that a family holds at a tolerance, for a mode at 1 Hz: bands scale with the mode.

    Parameters
    ----------
    family : str
        A family that needs neither order nor delay.
    tolerance, damping_ratio : float
        As for `design_shaper`.

    Raises
    ------
    DesignError
        If the family does not exist there.

    Examples
    --------
    >>> band = relative_band("ei", tolerance=0.05, damping_ratio=0.0)
    >>> round(band.low_hz, 4), round(band.high_hz, 4)
    (0.8003, 1.1997)
    """
    return design_shaper(family, Mode(1.0, damping_ratio), tolerance=tolerance).guarantee.band


def placed_shaper(family: str, need: Need) -> Shaper:
    """Design a family for the mode at which its band covers most of a range.

    A band that is wide enough is put in the middle, as far from both ends by ratio. A narrower one holds the
    most metres of rope where the rope is longest, and the most Hz where the frequency is highest.

    Raises
    ------
    DesignError
        If the family does not exist at this tolerance and damping.

    Examples
    --------
    >>> shaper = placed_shaper("zvd", Need(Band(0.2, 0.4)))
    >>> round(shaper.guarantee.band.low_hz, 9)
    0.2
    """
    unit = relative_band(family, tolerance=need.tolerance, damping_ratio=need.damping_ratio)
    low_hz, high_hz = need.band.low_hz / unit.low_hz, need.band.high_hz / unit.high_hz
    middle_hz = math.sqrt(low_hz * high_hz)
    frequency_hz = min(middle_hz, low_hz) if need.on_rope else max(middle_hz, high_hz)
    return design_shaper(family, Mode(frequency_hz, need.damping_ratio), tolerance=need.tolerance)


def anchored_shaper(family: str, need: Need) -> Shaper:
    """Design a family for the mode whose band starts at the lowest frequency of a range.

    Raises
    ------
    DesignError
        If the family does not exist at this tolerance and damping.

    Examples
    --------
    >>> round(anchored_shaper("ei3", Need(Band(0.2, 0.4))).guarantee.band.low_hz, 9)
    0.2
    """
    unit = relative_band(family, tolerance=need.tolerance, damping_ratio=need.damping_ratio)
    mode = Mode(need.band.low_hz / unit.low_hz, need.damping_ratio)
    return design_shaper(family, mode, tolerance=need.tolerance)


def positions_needed(held: Band, ratio: float) -> int:
    """Count the knob positions of one family that cover a range of frequencies.

    Parameters
    ----------
    held : Band
        What one of them holds; the others hold bands of the same ratio.
    ratio : float
        Highest frequency of the range over the lowest, >= 1.

    Examples
    --------
    A rope range of 10 : 1 is one of sqrt(10) in frequency:

    >>> zv = relative_band("zv", tolerance=0.05, damping_ratio=0.0)
    >>> positions_needed(zv, 10.0**0.5)
    19
    """
    if ratio <= 1.0:
        return 1
    return max(1, math.ceil(math.log(ratio) / math.log(held.high_hz / held.low_hz) * (1.0 - _TOUCHING)))
