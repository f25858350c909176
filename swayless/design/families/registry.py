"""The table of families, and the one call that designs any of them.

Not for: how impulses are found (`closed_form`, `insensitive`, `unity_magnitude`).
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from functools import partial
from types import MappingProxyType

from swayless.design.families import closed_form, insensitive, unity_magnitude
from swayless.design.families.family import Family
from swayless.design.robustness import DEFAULT_TOLERANCE, proven_shaper
from swayless.design.shaper import Shaper
from swayless.errors import DesignError
from swayless.plant import Mode

_TOLERANCE = frozenset({"tolerance"})
_UNITY = "Singhose, Singer and Seering (1997), unity magnitude"
_MULTI_HUMP = "Singhose, Porter, Tuttle and Singer (1997), multi-hump"


def _derivative_family(name: str, title: str, order: int) -> Family:
    """Describe the family whose vibration vanishes with its first `order` derivatives."""
    solve = partial(closed_form.derivative_shaper, order=order)
    return Family(name, title, "Magee and Book, eqs 13-16", solve, zero_orders=order)


_IN_ORDER = (
    _derivative_family("zv", "zero vibration", 0),
    _derivative_family("zvd", "zero vibration and derivative", 1),
    _derivative_family("zvdd", "zero vibration and two derivatives", 2),
    _derivative_family("zvddd", "zero vibration and three derivatives", 3),
    Family(
        name="zvm",
        title="zero vibration and any number of derivatives",
        source="Magee and Book, eqs 13-16",
        solve=closed_form.derivative_shaper,
        parameters=frozenset({"order"}),
    ),
    Family(
        name="ei",
        title="extra-insensitive",
        source="Singhose, Seering and Singer (1994), extra-insensitive",
        solve=insensitive.one_hump,
        parameters=_TOLERANCE,
    ),
    Family(
        name="ei2",
        title="extra-insensitive with two humps",
        source=_MULTI_HUMP,
        solve=insensitive.two_hump,
        parameters=_TOLERANCE,
        zero_orders=0,
    ),
    Family(
        name="ei3",
        title="extra-insensitive with three humps",
        source=_MULTI_HUMP,
        solve=insensitive.three_hump,
        parameters=_TOLERANCE,
    ),
    Family(
        name="mzv",
        title="modified zero vibration",
        source="vector diagram of three impulses 135 degrees apart",
        solve=closed_form.modified_zero_vibration,
        zero_orders=0,
    ),
    Family(
        name="um-zv",
        title="unity-magnitude zero vibration",
        source="Kriikku, Singer and Singhose (1997), eqs 1-3",
        solve=unity_magnitude.zero_vibration,
        negative=True,
        zero_orders=0,
    ),
    Family(
        name="um-zvd",
        title="unity-magnitude zero vibration and derivative",
        source=_UNITY,
        solve=unity_magnitude.zero_slope,
        negative=True,
        zero_orders=1,
    ),
    Family(
        name="um-ei",
        title="unity-magnitude extra-insensitive",
        source=_UNITY,
        solve=unity_magnitude.one_hump,
        parameters=_TOLERANCE,
        negative=True,
    ),
    Family(
        name="oatf",
        title="optimal arbitrary time-delay filter",
        source="Rhim and Book, eq 4",
        solve=closed_form.delay_filter,
        parameters=frozenset({"delay_s"}),
        negative=True,
        zero_orders=0,
    ),
)

FAMILIES: Mapping[str, Family] = MappingProxyType({family.name: family for family in _IN_ORDER})
"""Every family by name, in the order in which they are documented."""


def design_shaper(
    family: str,
    mode: Mode,
    *,
    tolerance: float = DEFAULT_TOLERANCE,
    order: int | None = None,
    delay_s: float | None = None,
) -> Shaper:
    """Design a shaper of a named family for one mode, and prove the band it holds.

    Parameters
    ----------
    family : str
        A name in `FAMILIES`.
    mode : Mode
        The vibration to suppress.
    tolerance : float
        Residual vibration as a ratio, above 0 and below 1: of the guarantee, and of the humps of the
        families that have them.
    order : int, optional
        Number of vanishing derivatives, for ``"zvm"`` only.
    delay_s : float, optional
        Spacing of the impulses in seconds, for ``"oatf"`` only.

    Returns
    -------
    Shaper
        With the band held at `tolerance` as its guarantee.

    Raises
    ------
    DesignError
        If the family is unknown, takes or lacks a parameter, or does not exist at this damping or tolerance.

    Examples
    --------
    >>> shaper = design_shaper("ei", Mode(0.5), tolerance=0.05)
    >>> shaper.times_s, shaper.amplitudes.round(4)
    (array([0., 1., 2.]), array([0.2625, 0.475 , 0.2625]))
    >>> round(shaper.guarantee.band.low_hz, 4), round(shaper.guarantee.band.high_hz, 4)
    (0.4001, 0.5999)
    """
    chosen = FAMILIES.get(family)
    if chosen is None:
        near = ", ".join(difflib.get_close_matches(family, FAMILIES)) or ", ".join(FAMILIES)
        raise DesignError(f"family {family!r} is unknown; did you mean: {near}?")
    parameters = chosen.check_parameters({"order": order, "delay_s": delay_s})
    if "tolerance" in chosen.parameters:
        parameters["tolerance"] = tolerance
    times_s, amplitudes = chosen.solve(mode, **parameters)
    return proven_shaper(
        times_s, amplitudes, mode, tolerance=tolerance, family=chosen.name, source=chosen.source
    )
