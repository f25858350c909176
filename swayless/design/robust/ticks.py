"""Robust designs on the controller's own ticks: the guarantee is on what runs.

Not for: shapers of named families (`grid`), switches on whole ticks alone (`whole_ticks`), nor for number
types (the controller's taps).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from swayless.design.grid_shaper import GridShaper, check_tick
from swayless.design.robust.demand import TOLERANCES
from swayless.design.robust.specified import (
    Amplitudes,
    RobustDesign,
    fixed_duration,
    least_residual,
    specified_insensitivity,
)
from swayless.design.robust.tick_program import TickProgram
from swayless.design.robust.whole_ticks import (
    CoarseTickError,
    whole_tick_fixed_duration,
    whole_tick_taps,
)
from swayless.errors import DesignError
from swayless.plant import Band

_MOST_EXTRA = 8  # ticks beyond the ideal duration; where these do not help, the tick is too coarse
_ADVISED = 3  # tolerances tried for a message
_STEP = 1e-3  # of such tolerances
_ON_TICK = 1e-9  # relative: a duration this little below a whole tick is on it


@dataclass(frozen=True, eq=False)
class RobustTaps:
    """Taps that hold a band on whole ticks, beside the ideal shaper that they follow.

    Parameters
    ----------
    taps : GridShaper
        Their guarantee is proved on these very numbers.
    ideal : RobustDesign
        The best shaper in continuous time, whose lower bound holds for the taps too.
    """

    taps: GridShaper
    ideal: RobustDesign


def specified_insensitivity_on_ticks(
    band: Band | Sequence[Band],
    tick_s: float,
    *,
    tolerance: float = 0.05,
    damping_ratio: float | tuple[float, float] = 0.0,
    amplitudes: Amplitudes = "positive",
    impulses: int | None = None,
) -> RobustTaps:
    """Design taps on the fewest ticks that leave at most the tolerance over a band, or over several.

    Fewer ticks than the ideal shaper's proved bound cannot hold the bands; from there on each number of ticks
    is solved as a linear program until one does. Bounded taps may have levels between 0 and 1.

    Parameters
    ----------
    band : Band or sequence of Band
        Undamped natural frequencies, as for `specified_insensitivity`.
    tick_s : float
        Tick of the controller, > 0.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float or (float, float)
        One value, or the lowest and highest: 0 to 0.2.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule. "unity-magnitude" is for drives that know no level between: switches on whole ticks alone
        (`whole_tick_taps`).
    impulses : int, optional
        With "unity-magnitude": exactly so many.

    Returns
    -------
    RobustTaps

    Raises
    ------
    DesignError
        If a value is out of range, or the tick is too coarse.

    Examples
    --------
    >>> design = specified_insensitivity_on_ticks(Band(0.85, 1.15), 0.05)
    >>> design.taps.delays_ticks.tolist(), round(design.ideal.shaper.duration_s, 3)
    ([0, 9, 10, 19], 0.941)
    """
    check_tick(tick_s)

    def designed(tolerance: float) -> RobustDesign:
        return specified_insensitivity(
            band, tolerance=tolerance, damping_ratio=damping_ratio, amplitudes=amplitudes, impulses=impulses
        )

    ideal = designed(tolerance)
    if amplitudes == "unity-magnitude":
        return _on_whole_ticks(ideal, tick_s, designed)
    program, promise = TickProgram(tick_s, amplitudes, ideal.shaper), ideal.shaper.guarantee
    fewest = max(1, math.ceil(ideal.lower_bound_s / tick_s))
    for last in range(fewest, fewest + _MOST_EXTRA + 1):
        taps = program.holding(promise, last)
        if taps is not None:
            return RobustTaps(taps, ideal)
    what = " and ".join(f"{band.low_hz:g} to {band.high_hz:g} Hz" for band in promise.bands)
    raise DesignError(
        f"tick_s = {tick_s!r}: {fewest + _MOST_EXTRA} ticks do not hold {what} at {100 * tolerance:g} %; a "
        f"finer tick does (the ideal shaper lasts {ideal.shaper.duration_s:.6g} s)"
    )


def _on_whole_ticks(
    ideal: RobustDesign, tick_s: float, designed: Callable[[float], RobustDesign]
) -> RobustTaps:
    """Move an ideal shaper to whole ticks, or say at which tolerance a shaper can be, having tried it."""
    try:
        return RobustTaps(whole_tick_taps(ideal.shaper, tick_s), ideal)
    except CoarseTickError as refusal:
        worst = refusal.worst
        for _ in range(_ADVISED):
            enough = math.ceil(worst / _STEP) * _STEP
            if enough > TOLERANCES[1]:
                break
            try:
                whole_tick_taps(designed(enough).shaper, tick_s)
            except CoarseTickError as again:
                worst = max(again.worst, enough + _STEP)
            else:
                raise DesignError(f"{refusal}, a tolerance of {enough:g} does") from refusal
        raise


def fixed_duration_on_ticks(
    duration_s: float,
    low_hz: float,
    tick_s: float,
    *,
    tolerance: float = 0.05,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
    impulses: int | None = None,
) -> RobustTaps:
    """Design taps of a given duration that hold the tolerance from `low_hz` up as far as any on these ticks.

    Parameters
    ----------
    duration_s : float
        Time of the last tap, rounded down to whole ticks.
    low_hz : float
        Lowest frequency to hold, > 0.
    tick_s : float
        Tick of the controller, > 0.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float
        Over the whole band, 0 to 0.2.
    amplitudes, impulses
        As for `specified_insensitivity_on_ticks`.

    Returns
    -------
    RobustTaps
        The upper edge of the taps' band is right to 1e-8 of itself, and held by the taps.

    Raises
    ------
    DesignError
        If a value is out of range, the duration is too short for any band, or the tick is too coarse.

    References
    ----------
    Kriikku, Singer and Singhose (1997), section III, steps 3 and 4.

    Examples
    --------
    >>> design = fixed_duration_on_ticks(1.2, 0.8, 0.15)
    >>> edges_hz = [each.guarantee.band.high_hz for each in (design.taps, design.ideal.shaper)]
    >>> [round(edge_hz, 3) for edge_hz in edges_hz]
    [1.353, 1.714]
    """
    last = last_tick(duration_s, tick_s)
    ideal = fixed_duration(
        last * tick_s,
        low_hz,
        tolerance=tolerance,
        damping_ratio=damping_ratio,
        amplitudes=amplitudes,
        impulses=impulses,
    )
    if amplitudes == "unity-magnitude":
        return RobustTaps(whole_tick_fixed_duration(ideal.shaper, tick_s), ideal)
    return RobustTaps(TickProgram(tick_s, amplitudes, ideal.shaper).widest(last), ideal)


def least_residual_on_ticks(
    duration_s: float,
    band: Band | Sequence[Band],
    tick_s: float,
    *,
    damping_ratio: float = 0.0,
    amplitudes: Amplitudes = "positive",
    impulses: int | None = None,
) -> RobustTaps:
    """Design taps of a given duration that leave the least worst residual over a band, or over several.

    Parameters
    ----------
    duration_s : float
        Time of the last tap, rounded down to whole ticks.
    band, tick_s, amplitudes, impulses
        As for `specified_insensitivity_on_ticks`.
    damping_ratio : float
        Over all bands, 0 to 0.2.

    Returns
    -------
    RobustTaps
        The tolerance of the taps' guarantee is what they leave.

    Raises
    ------
    DesignError
        If a value is out of range.

    Examples
    --------
    Eleven ticks a period: EI promises 5 %, and no taps that last a period leave less than 5.28 %.

    >>> design = least_residual_on_ticks(1.0, Band(0.80027, 1.19973), 1.0 / 11.0)
    >>> round(design.taps.guarantee.tolerance, 4), round(design.ideal.shaper.guarantee.tolerance, 4)
    (0.0528, 0.05)
    """
    whole_s = last_tick(duration_s, tick_s) * tick_s
    ideal = least_residual(
        whole_s, band, damping_ratio=damping_ratio, amplitudes=amplitudes, impulses=impulses
    )
    return taps_after(ideal, tick_s, amplitudes)


def taps_after(ideal: RobustDesign, tick_s: float, amplitudes: Amplitudes) -> RobustTaps:
    """Find the taps that leave least of all that an ideal design holds, as long as it is.

    Parameters
    ----------
    ideal : RobustDesign
        Its duration is rounded down to whole ticks.
    tick_s : float
        Tick of the controller, > 0.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule of the ideal design.

    Returns
    -------
    RobustTaps
        The tolerance of the taps' guarantee is what they leave.
    """
    if amplitudes == "unity-magnitude":
        anything = replace(ideal.shaper, guarantee=replace(ideal.shaper.guarantee, tolerance=1.0))
        taps = whole_tick_fixed_duration(anything, tick_s)
        left = replace(taps.guarantee, tolerance=taps.guarantee.worst_residual_ratio)
        return RobustTaps(replace(taps, guarantee=left), ideal)
    last = last_tick(ideal.shaper.duration_s, tick_s)
    return RobustTaps(
        TickProgram(tick_s, amplitudes, ideal.shaper).least(ideal.shaper.guarantee, last), ideal
    )


def last_tick(duration_s: float, tick_s: float) -> int:
    """Round a duration down to whole ticks; a hair below one counts as on it."""
    check_tick(tick_s)
    if not (math.isfinite(duration_s) and duration_s > 0.0):
        raise DesignError(f"duration_s = {duration_s!r}: must be finite and > 0")
    last = math.floor(duration_s / tick_s * (1.0 + _ON_TICK))
    if last < 1:
        raise DesignError(f"duration_s = {duration_s!r}: must be at least a tick, {tick_s:g} s")
    return last
