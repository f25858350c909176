"""What is active in a refined optimum: its impulses, and the peaks that hold them where they are.

Not for: whether that is right, which `search` finds out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust.central_path import least_worst
from swayless.design.robust.lines import Line
from swayless.design.robust.refined import Refined
from swayless.design.robust.search import LinePeaks, alternating, peaks_of, with_peaks
from swayless.design.robust.stationary import Goal, Optimum
from swayless.design.shaper import FloatArray

_ACTIVE = 2e-3  # amplitudes and weights below this in a refined optimum are its distance to the exact one
_USED = 1e-4  # the same, where what is dropped is made up for
_NEIGHBOURS = 5e-3  # in cycles of the highest frequency: nearer times stand for one impulse between them
_APART = 1e-9  # relative to the duration: nearer switches undo each other
_SETTLED = 0.01  # a level this near to 0 or 1 is there
_ROUNDS = 12  # of peaks that other amplitudes at the same times bring up; two or three are usual
_TOUCH = 1e-6  # relative
_GAP = 1e-5  # relative, of amplitudes solved again


def first_guess(
    found: Refined, lines: Sequence[Line], rule: AmplitudeRule, worst: float, goal: Goal
) -> Optimum:
    """Read impulses and peaks off a refined optimum, as a start for Newton's method."""
    times, amplitudes = _impulses(found, rule)
    peaks = peaks_of(found.times, found.amplitudes, lines)
    away = np.abs(np.subtract.outer(found.frequency, peaks.frequency))
    away[np.not_equal.outer(found.turn, peaks.turn)] = np.inf
    weights = np.bincount(away.argmin(axis=1), found.weights, peaks.frequency.size)
    kept = weights > _ACTIVE * weights.max()
    kept[-1] |= goal is Goal.REACH  # the upper edge is what moves
    weights = np.maximum(weights / weights.sum(), _ACTIVE)
    return with_peaks(_optimum(times, amplitudes, peaks, weights, worst), kept)


def cleaned(found: Refined, lines: Sequence[Line], rule: AmplitudeRule) -> Optimum:
    """Make a design of a refined optimum: a few impulses, and what they leave without more ado.

    Positive amplitudes are solved again at the times of the impulses. This is the design where Newton's
    method finds no structure that it can prove, as where several optima leave the same.
    """
    if rule is AmplitudeRule.POSITIVE:
        times = _without_neighbours(found, max(line.high for line in lines))
        amplitudes = _solved_again(times, lines)
    else:
        times = _switches(found)
        amplitudes = alternating(times.size)
    edge = replace(lines[-1], low=lines[-1].high)  # the upper edge stands last, whether or not it is a peak
    peaks = peaks_of(times, amplitudes, [*lines, edge])
    worst = float(np.abs(peaks.value).max())
    even = np.full(peaks.frequency.size, 1.0 / peaks.frequency.size)
    return _optimum(times, amplitudes, peaks, even, worst)


def _optimum(
    times: FloatArray, amplitudes: FloatArray, peaks: LinePeaks, weights: FloatArray, worst: float
) -> Optimum:
    """Put impulses and peaks together."""
    phase = np.angle(peaks.value)
    return Optimum(times, amplitudes, peaks.frequency, peaks.turn, peaks.moving, weights, phase, worst)


def _impulses(found: Refined, rule: AmplitudeRule) -> tuple[FloatArray, FloatArray]:
    """Read the impulses off a refined optimum and its certificate, the outermost at the ends.

    Bounded references switch where the dual polynomial is flat; positive amplitudes belong to the dip that is
    nearest.
    """
    amplitudes, duration = found.amplitudes, float(found.times[-1])
    if rule is AmplitudeRule.BOUNDED:
        times = np.concatenate([[0.0], found.certificate.extremes(), [duration]])
        times = times[np.diff(times, prepend=-1.0) > _APART * duration]
        return times, alternating(times.size)
    dips = found.certificate.dips()
    nearest = np.abs(np.subtract.outer(found.times, dips)).argmin(axis=1)
    mass, moment = (np.bincount(nearest, each, dips.size) for each in (amplitudes, amplitudes * found.times))
    kept = mass > _ACTIVE
    times, amplitudes = moment[kept] / mass[kept], mass[kept] / mass[kept].sum()
    times[0], times[-1] = 0.0, duration
    return times, amplitudes


def _switches(found: Refined) -> FloatArray:
    """Switch where levels between 0 and 1 say, so that the reference covers the same distance."""
    level, duration = np.cumsum(found.amplitudes)[:-1], float(found.times[-1])
    state = np.where(np.minimum(level, 1.0 - level) < _SETTLED, np.round(level), 0.5)
    state = np.concatenate([[0.0], state, [1.0]])  # before and after
    edges = np.concatenate([[0.0], found.times, [duration]])
    area = np.concatenate([[0.0], level, [1.0]]) * np.diff(edges)
    first = np.flatnonzero(np.diff(state, prepend=-1.0))
    runs = list(zip(state[first], edges[first], np.append(edges[first[1:]], duration), strict=True))
    switches: list[float] = []
    for (before, *_), (run, left, right), (after, *_), covered in zip(
        runs, runs[1:], [*runs[2:], runs[-1]], np.add.reduceat(area, first)[1:], strict=False
    ):
        if run != 0.5:
            switches += [left] if before == 1.0 - run else []
        elif before != after:
            switches += [right - covered if after else left + covered]
        else:
            half = (covered if before == 0.0 else right - left - covered) / 2.0
            switches += [(left + right) / 2.0 - half, (left + right) / 2.0 + half]
    times = np.array(switches)
    times[0], times[-1] = 0.0, duration
    return times


def _without_neighbours(found: Refined, highest: float) -> FloatArray:
    """Merge the times that stand for one impulse, and drop those without any; the ends stay."""
    used = found.amplitudes > _USED
    used[[0, -1]] = True
    times, mass = found.times[used], np.maximum(found.amplitudes[used], _USED)
    starts = np.flatnonzero(np.diff(times, prepend=-math.inf) > _NEIGHBOURS / highest)
    merged: FloatArray = np.add.reduceat(mass * times, starts) / np.add.reduceat(mass, starts)
    merged[0], merged[-1] = 0.0, times[-1]
    return merged


def _solved_again(times: FloatArray, lines: Sequence[Line]) -> FloatArray:
    """Find the positive amplitudes at given times that leave the least."""
    amplitudes = np.full(times.size, 1.0 / times.size)
    peaks = peaks_of(times, amplitudes, lines)
    rates = peaks.frequency * peaks.turn
    for _ in range(_ROUNDS):
        columns = np.exp(np.multiply.outer(rates, times - times[-1]))
        centre = least_worst(columns, np.zeros(rates.size), sum_to_one=True, resolved=_TOUCH, gap=_GAP)
        amplitudes = centre.variables / centre.variables.sum()
        peaks = peaks_of(times, amplitudes, lines)
        over = np.abs(peaks.value) > centre.worst * (1.0 + _TOUCH)
        if not over.any():
            break
        rates = np.append(rates, (peaks.frequency * peaks.turn)[over])
    return amplitudes
