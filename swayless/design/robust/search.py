"""From a coarse optimum to the exact one: what is active is read off, polished, checked everywhere, corrected.

An optimum is accepted only when its residual vibration keeps to the worst at every frequency of every line,
and its certificate at every time: then no design is better, however it was found. Not for: units (`design`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import Response
from swayless.design.robust.certificate import Certificate
from swayless.design.robust.coarse import Coarse
from swayless.design.robust.lines import Line
from swayless.design.robust.stationary import Goal, Optimum, polish
from swayless.design.shaper import FloatArray

_ROUNDS = 12  # of correction; two or three are usual
_ACTIVE = 2e-3  # amplitudes and weights below this in a coarse optimum are its distance to the exact one
_ADMITTED = 1e-2  # amplitude or weight with which a newcomer starts
_TOUCH = 1e-8  # relative: peaks and dips beyond the worst by more are not yet covered
_FARTHEST = 0.3  # relative: solutions farther from their start belong to another structure
_COVERED = 1e-6  # relative: how far the certificate may stay below the worst
_NEWCOMER = 20.0  # times _APART: a dip nearer to an impulse is the impulse's own
_APART = 1e-3  # in periods of the highest frequency, or in ripples: nearer neighbours are one


def certificate_of(optimum: Optimum) -> Certificate:
    """Read the dual polynomial off the weights and phases of the peaks."""
    weights = np.maximum(optimum.weights, 0.0)
    coefficients = weights / weights.sum() * np.exp(-1j * optimum.phase)
    return Certificate(coefficients, optimum.frequency * optimum.turn, optimum.duration)


def settle(start: Optimum | None, lines: Sequence[Line], goal: Goal, rule: AmplitudeRule) -> Optimum | None:
    """Polish, check and correct until the conditions hold everywhere; None if they do not come to."""
    if start is None:
        return None
    for _ in range(_ROUNDS):
        optimum = polish(start, goal, rule)
        if optimum is None or not is_near(optimum, start):
            return None
        if goal is Goal.REACH:
            lines = [replace(line, high=float(optimum.frequency[-1])) for line in lines]
        start, changed = _corrected(optimum, lines, rule)
        if not changed:
            return optimum
    return None


def is_near(optimum: Optimum, start: Optimum) -> bool:
    """Whether Newton's method stayed where the start was, in the order of a shaper."""
    durations = abs(optimum.duration - start.duration) < _FARTHEST * start.duration
    frequencies = np.abs(optimum.frequency / start.frequency - 1.0).max() < _FARTHEST
    return bool(durations and frequencies)


def first_guess(
    coarse: Coarse, lines: Sequence[Line], rule: AmplitudeRule, worst: float, goal: Goal
) -> Optimum | None:
    """Read impulses and peaks off a coarse optimum."""
    positive = rule is AmplitudeRule.POSITIVE
    times, amplitudes = _clusters(coarse) if positive else _switches(coarse)
    if times.size < 2:
        return None
    bare = Optimum(times, amplitudes, *_no_peaks(), worst)
    peaks = _peaks(bare_like(coarse, bare), lines)
    frequency, turn, moving, value = peaks
    spot = np.where(
        coarse.turn[:, np.newaxis] == turn, np.abs(np.subtract.outer(coarse.frequency, frequency)), np.inf
    )
    weights = np.bincount(spot.argmin(axis=1), coarse.weights, frequency.size)
    kept = weights > _ACTIVE * weights.max()
    kept[-1] |= goal is Goal.REACH  # the upper edge is what moves
    weights = np.maximum(weights, 1e-6)
    return replace(
        bare,
        frequency=frequency[kept],
        turn=turn[kept],
        moving=moving[kept],
        weights=weights[kept] / weights[kept].sum(),
        phase=np.angle(value[kept]),
    )


def bare_like(coarse: Coarse, bare: Optimum) -> Optimum:
    """The coarse optimum's own impulses, whose peaks its weights belong to."""
    return replace(bare, times=coarse.times, amplitudes=coarse.amplitudes)


def _no_peaks():  # type: ignore
    return np.empty(0), np.empty(0, dtype=complex), np.empty(0, dtype=bool), np.empty(0), np.empty(0)


def _clusters(coarse: Coarse) -> tuple[FloatArray, FloatArray]:
    """Mass and place of each bump of a grid of positive amplitudes; the outermost at the ends."""
    mass = coarse.amplitudes
    valley = np.flatnonzero((mass[1:-1] < mass[:-2]) & (mass[1:-1] <= mass[2:])) + 1
    starts = np.concatenate([[0], valley])
    amplitudes = np.add.reduceat(mass, starts)
    times = np.add.reduceat(mass * coarse.times, starts) / amplitudes
    kept = amplitudes > _ACTIVE
    times, amplitudes = times[kept], amplitudes[kept] / amplitudes[kept].sum()
    times[0], times[-1] = 0.0, coarse.times[-1]
    return times, amplitudes


def _switches(coarse: Coarse) -> tuple[FloatArray, FloatArray]:
    """Times at which the level of the reference passes one half, with unity amplitudes."""
    level = np.cumsum(coarse.amplitudes)[:-1]
    middle = (coarse.times[1:] + coarse.times[:-1]) / 2.0
    at = np.flatnonzero((level[1:] > 0.5) != (level[:-1] > 0.5))
    share = (0.5 - level[at]) / (level[at + 1] - level[at])
    inner = middle[at] + share * (middle[at + 1] - middle[at])
    width = coarse.times[1]
    first = [level[0] * width] if level[0] < 0.5 else []
    last = [coarse.times[-1] - (1.0 - level[-1]) * width] if level[-1] > 0.5 else []
    times = np.concatenate([[0.0], first, inner, last, coarse.times[-1:]])
    return times, (-1.0) ** np.arange(times.size)


def _peaks(optimum: Optimum, lines: Sequence[Line]):  # type: ignore
    """Every local maximum of the residual vibration on every line: frequency, turn, moving, value."""
    found = []
    duration = float(optimum.times[-1])
    for line in lines:
        response = Response.of_times(optimum.times, line.damping_ratio)
        peaks = response.peaks(optimum.amplitudes, line.low * duration, line.high * duration)
        frequency = peaks.frequency / duration
        edge = (np.abs(frequency - line.low) < 1e-9) | (np.abs(frequency - line.high) < 1e-9)
        frequency = np.where(np.abs(frequency - line.low) < 1e-9, line.low, frequency)
        frequency = np.where(np.abs(frequency - line.high) < 1e-9, line.high, frequency)
        found.append((frequency, np.full(frequency.size, line.turn), ~edge, peaks.value))
    return tuple(np.concatenate(parts) for parts in zip(*found, strict=True))


def _corrected(optimum: Optimum, lines: Sequence[Line], rule: AmplitudeRule) -> tuple[Optimum, bool]:
    """Drop what has the wrong sign, add what is not covered; say whether anything changed."""
    kept = optimum.weights > 0.0
    if not kept.all():
        return replace(
            optimum,
            frequency=optimum.frequency[kept],
            turn=optimum.turn[kept],
            moving=optimum.moving[kept],
            weights=optimum.weights[kept],
            phase=optimum.phase[kept],
        ), True
    low = np.array([[l.low, l.high] for l in lines])
    optimum2, c1 = _with_peaks(optimum, lines)
    optimum3, c2 = _with_times(optimum, rule)
    return replace(optimum2, times=optimum3.times, amplitudes=optimum3.amplitudes), c1 or c2


def _with_peaks(optimum: Optimum, lines: Sequence[Line]) -> tuple[Optimum, bool]:
    frequency, turn, moving, value = _peaks(optimum, lines)
    over = np.abs(value) > optimum.worst * (1.0 + _TOUCH)
    if not over.any():
        return optimum, False
    near = (turn[over][:, None] == optimum.turn) & (
        np.abs(np.subtract.outer(frequency[over], optimum.frequency)) < _APART
    )
    replaced = near.any(axis=0)
    weight = np.where(near.any(axis=1), (near * optimum.weights).sum(axis=1), _ADMITTED)
    keep = ~replaced
    merged = replace(
        optimum,
        frequency=np.append(optimum.frequency[keep], frequency[over]),
        turn=np.append(optimum.turn[keep], turn[over]),
        moving=np.append(optimum.moving[keep], moving[over]),
        weights=np.append(optimum.weights[keep], weight),
        phase=np.append(optimum.phase[keep], np.angle(value[over])),
    )
    order = np.argsort(merged.frequency, kind="stable")
    return replace(
        merged,
        frequency=merged.frequency[order],
        turn=merged.turn[order],
        moving=merged.moving[order],
        weights=merged.weights[order],
        phase=merged.phase[order],
    ), True


def _with_times(optimum: Optimum, rule: AmplitudeRule) -> tuple[Optimum, bool]:
    """Replace impulses that are none and add those that would help, if the certificate is not yet whole."""
    certificate = certificate_of(optimum)
    positive = rule is AmplitudeRule.POSITIVE
    apart = 2.0 * np.pi * _APART / float(np.abs(certificate.rates).max())
    kept = (optimum.amplitudes > 0.0) if positive else np.full(optimum.times.size, True)
    kept &= np.diff(optimum.times, prepend=-1.0) > (apart if positive else 0.0)
    kept[[0, -1]] = True
    if not kept.all() and positive:
        return _with_impulses(optimum, optimum.times[kept], optimum.amplitudes[kept])
    if kept.all() and certificate.bound(rule) >= optimum.worst * (1.0 - _COVERED):
        return optimum, False
    times = certificate.dips() if positive else certificate.extremes()
    if not positive:
        times = np.concatenate([[0.0], times, [optimum.duration]])
        return _with_impulses(optimum, times, (-1.0) ** np.arange(times.size))
    far = np.abs(np.subtract.outer(times, optimum.times)).min(axis=1) > _NEWCOMER * apart
    new = times[far & (certificate(times)[0] < optimum.worst * (1.0 - _COVERED))]
    admitted = np.full(new.size, _ADMITTED)
    return _with_impulses(optimum, np.append(optimum.times, new), np.append(optimum.amplitudes, admitted))


def _with_impulses(optimum: Optimum, times: FloatArray, amplitudes: FloatArray) -> tuple[Optimum, bool]:
    """Give an optimum other impulses, in order."""
    order = np.argsort(times, kind="stable")
    return replace(optimum, times=times[order], amplitudes=amplitudes[order]), True
