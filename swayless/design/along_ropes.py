"""What impulses leave on the ropes of a crane whose damping changes with the rope: a driven trolley's.

There frequency and damping go together along one curve, and a promise for ropes is one for that curve: held
at its own damping on every rope. Not for: bands at one damping ratio (`robustness`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from swayless.design.residual import residual_vibration
from swayless.design.robustness import WIDEST_RATIO
from swayless.design.shaper import FloatArray, Impulses
from swayless.errors import DesignError
from swayless.plant import Band, DrivenRopes, pendulum_frequency_hz

_SAMPLES_PER_PERIOD = 128  # of the duration, over the pendulum's frequency; V^2 holds hardly anything faster
_FEWEST = 65
_PLACES = 2049  # of ropes among which those of a band are looked for: 0.5 % apart
_REACHES = (2.0, 4.0, WIDEST_RATIO)  # in frequency, of ropes to either side, until both ends are found
_NEAR = 0.99  # of the tolerance: a sampled maximum this high may be above it between samples
_PEAK_ACCURACY = 1e-7  # relative, of the rope of a maximum, where what is left is flat
_EDGE_ACCURACY = 1e-13  # relative, of the last rope held


@dataclass(frozen=True)
class HeldRopes:
    """Ropes on which impulses leave little.

    Parameters
    ----------
    range_m : tuple of two floats
        Shortest and longest of a connected range.
    worst_residual_ratio : float
        Largest residual vibration on them.
    """

    range_m: tuple[float, float]
    worst_residual_ratio: float


def residual_on_ropes(impulses: Impulses, ropes: DrivenRopes, rope_length_m: FloatArray) -> FloatArray:
    """Residual vibration at the true mode of each rope; infinite where no vibration is clearly the swing.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or anything else with times and amplitudes.
    ropes : DrivenRopes
        Their modes.
    rope_length_m : ndarray
        > 0.

    Examples
    --------
    A shaper for the pendulum leaves 8 % of a load whose drive lags by 0.1 s; one for the true mode nothing:

    >>> from swayless.design import design_shaper
    >>> from swayless.plant import ServoDrive, pendulum_mode
    >>> ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 6000.0, 0.1), (4.0, 4.0))
    >>> shapers = [design_shaper("zv", mode) for mode in (pendulum_mode(4.0), ropes.mode(4.0))]
    >>> [round(float(residual_on_ropes(shaper, ropes, np.array(4.0))), 4) for shaper in shapers]
    [0.0845, 0.0]
    """
    frequency_hz, ratio = ropes.modes(rope_length_m)
    vibrates = np.isfinite(frequency_hz)
    left = residual_vibration(
        impulses, np.where(vibrates, frequency_hz, 1.0), damping_ratio=np.where(vibrates, ratio, 0.0)
    )
    return np.where(vibrates, left, np.inf)


def held_ropes(
    impulses: Impulses, ropes: DrivenRopes, rope_length_m: float, *, tolerance: float
) -> HeldRopes:
    """Find the connected range of ropes around one, on which at most the tolerance is left.

    Each rope counts with its own frequency and its own damping. The range is cut at `WIDEST_RATIO` of
    pendulum frequency to either side.

    Parameters
    ----------
    impulses : Impulses
        A shaper, or taps.
    ropes : DrivenRopes
        Their modes.
    rope_length_m : float
        Where the range is sought, > 0.
    tolerance : float
        Residual vibration as a ratio.

    Raises
    ------
    DesignError
        If more is left on that rope already.

    Examples
    --------
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import ServoDrive
    >>> ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 6000.0, 0.1), (4.0, 4.0))
    >>> held = held_ropes(design_shaper("zvd", ropes.mode(4.0)), ropes, 4.0, tolerance=0.05)
    >>> [round(end_m, 3) for end_m in held.range_m], round(held.worst_residual_ratio, 6)
    ([2.961, 5.578], 0.05)
    """
    here = float(residual_on_ropes(impulses, ropes, np.array(rope_length_m)))
    if not here <= tolerance:
        raise DesignError(
            f"the impulses leave {here:.6g} on {rope_length_m:.6g} m of rope: more than the tolerance"
            f" {tolerance!r}"
        )
    for reach in _REACHES:
        around_m = rope_length_m / reach**2, rope_length_m * reach**2
        lengths_m, left = _profile(impulses, ropes, around_m, (_NEAR * tolerance, tolerance))
        beyond_m = lengths_m[left > tolerance]
        if (beyond_m < rope_length_m).any() and (beyond_m > rope_length_m).any():
            break
    middle = int(np.searchsorted(lengths_m, rope_length_m))
    lengths_m, left = np.insert(lengths_m, middle, rope_length_m), np.insert(left, middle, here)
    outside = np.concatenate([[-1], np.flatnonzero(left > tolerance), [left.size]])
    gap = int(np.searchsorted(outside, middle))
    first, last = int(outside[gap - 1]) + 1, int(outside[gap]) - 1
    ends_m = [float(lengths_m[first]), float(lengths_m[last])]
    for side, (inside, beyond) in enumerate(((first, first - 1), (last, last + 1))):
        if 0 <= beyond < left.size:
            ends_m[side] = _edge(
                impulses, ropes, float(lengths_m[inside]), float(lengths_m[beyond]), tolerance
            )
    edges = residual_on_ropes(impulses, ropes, np.array(ends_m))
    worst = max(float(left[first : last + 1].max()), float(edges.max()))
    return HeldRopes((ends_m[0], ends_m[1]), worst)


def worst_on_ropes(impulses: Impulses, ropes: DrivenRopes, range_m: tuple[float, float]) -> float:
    """Largest residual vibration over a range of ropes, its ends included and its maxima refined.

    Parameters
    ----------
    impulses, ropes
        As for `held_ropes`.
    range_m : tuple of two floats
        Shortest and longest rope, > 0.
    """
    return float(_profile(impulses, ropes, range_m, (0.0, math.inf))[1].max())


def highest_hump(impulses: Impulses, ropes: DrivenRopes, rope_length_m: float, band: Band) -> float:
    """Largest residual vibration that is a maximum among the ropes of a band: 0 where there is none.

    Parameters
    ----------
    impulses, ropes, rope_length_m
        As for `held_ropes`.
    band : Band
        Frequencies of the ropes, which connect with the one given.
    """
    around_m = rope_length_m * np.geomspace(WIDEST_RATIO**-2, WIDEST_RATIO**2, _PLACES)
    frequency_hz, _ = ropes.modes(around_m)
    outside = np.flatnonzero(~((frequency_hz >= band.low_hz) & (frequency_hz <= band.high_hz)))
    middle = _PLACES // 2
    first = int(outside[outside < middle].max(initial=0))
    last = int(outside[outside > middle].min(initial=_PLACES - 1))
    _, left = _profile(impulses, ropes, (float(around_m[first]), float(around_m[last])), (0.0, math.inf))
    humps = left[1:-1][(left[1:-1] >= left[:-2]) & (left[1:-1] >= left[2:])]
    return float(humps.max(initial=0.0))


def _profile(
    impulses: Impulses, ropes: DrivenRopes, range_m: tuple[float, float], refined: tuple[float, float]
) -> tuple[FloatArray, FloatArray]:
    """Evaluate what is left at samples, and at maxima between them whose samples lie in a range."""
    # Evenly over the pendulum's frequency, in units of the lowest: 1 to the root of the ratio of the ropes.
    widest = math.sqrt(range_m[1] / range_m[0])
    span_hz = pendulum_frequency_hz(range_m[1]) * (widest - 1.0)
    cycles = float(impulses.times_s[-1] - impulses.times_s[0]) * span_hz
    samples = max(_FEWEST, 1 + math.ceil(_SAMPLES_PER_PERIOD * cycles))
    lengths_m = range_m[1] / np.linspace(widest, 1.0, samples) ** 2
    lengths_m[0], lengths_m[-1] = range_m
    left = residual_on_ropes(impulses, ropes, lengths_m)
    inner = left[1:-1]
    top = (inner >= left[:-2]) & (inner >= left[2:]) & (inner > refined[0]) & (inner <= refined[1])
    peaks = [
        _peak(impulses, ropes, float(lengths_m[at]), float(lengths_m[at + 2])) for at in np.flatnonzero(top)
    ]
    if not peaks:
        return lengths_m, left
    peaks_m, heights = np.array(peaks).T
    slots = np.searchsorted(lengths_m, peaks_m)
    return np.insert(lengths_m, slots, peaks_m), np.insert(left, slots, heights)


def _peak(impulses: Impulses, ropes: DrivenRopes, low_m: float, high_m: float) -> tuple[float, float]:
    """Refine a maximum between two ropes: where it is, and how high."""
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(
        lambda length_m: -float(residual_on_ropes(impulses, ropes, np.array(length_m))),
        bounds=(low_m, high_m),
        method="bounded",
        options={"xatol": _PEAK_ACCURACY * high_m},
    )
    return float(found.x), -float(found.fun)


def _edge(
    impulses: Impulses, ropes: DrivenRopes, inside_m: float, beyond_m: float, tolerance: float
) -> float:
    """Where the tolerance is crossed between a rope that is held and one that is not: the last one held."""
    while abs(beyond_m - inside_m) > _EDGE_ACCURACY * inside_m:
        middle_m = 0.5 * (inside_m + beyond_m)
        if float(residual_on_ropes(impulses, ropes, np.array(middle_m))) <= tolerance:
            inside_m = middle_m
        else:
            beyond_m = middle_m
    return inside_m
