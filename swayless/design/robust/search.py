"""From nearly the optimum to the exact one: what is active is polished, checked and corrected.

An optimum is accepted only when its residual vibration keeps to the worst at every frequency of every line,
and its certificate at every time: then no design is better, however it was found. Not for: units (`design`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swayless.design.minimax import AmplitudeRule
from swayless.design.minimax.response import ComplexArray, IndexArray, Response
from swayless.design.robust.certificate import Certificate
from swayless.design.robust.lines import Line
from swayless.design.robust.stationary import Goal, Optimum, polish
from swayless.design.shaper import FloatArray

_ROUNDS = 12  # of correction; two or three are usual
_ADMITTED = 1e-2  # amplitude or weight with which a newcomer starts
_TOUCH = 1e-8  # relative: peaks and dips beyond the worst by more are not yet covered
_FARTHEST = 0.3  # relative: solutions farther from their start belong to another structure
_COVERED = 1e-6  # relative: how far the certificate may stay below the worst
_NEWCOMER = 20.0  # times _APART: a dip nearer to an impulse is the impulse's own
_TINY = 1e-300  # no weight at all proves nothing, but divides by no zero
_TRIED = 3  # of the lightest peaks, when one of them may be too many
_AT_END = 1e-9  # relative: peaks this near an end of a line are at it
_APART = 1e-3  # in periods of the highest frequency, or in ripples: nearer neighbours are one


def certificate_of(optimum: Optimum) -> Certificate:
    """Read the dual polynomial off the weights and phases of the peaks."""
    weights = np.maximum(optimum.weights, 0.0)
    coefficients = weights / max(float(weights.sum()), _TINY) * np.exp(-1j * optimum.phase)
    return Certificate(coefficients, optimum.frequency * optimum.turn, optimum.duration)


def settle(
    start: Optimum, lines: Sequence[Line], goal: Goal, rule: AmplitudeRule, *, thorough: bool = False
) -> Optimum | None:
    """Polish, check and correct until the conditions hold everywhere; None if they do not come to."""
    for candidate in candidates(start, goal) if thorough else [start]:
        optimum = _settled(candidate, lines, goal, rule)
        if optimum is not None:
            return optimum
    return None


def candidates(start: Optimum, goal: Goal) -> list[Optimum]:
    """List a start, and the same without one of its lightest peaks.

    Where a design happens to touch the worst once more than it must (an EI shaper does), weights are not
    unique and Newton's method is lost with all of them. The upper edge stays where it is what moves.
    """
    droppable = start.weights[:-1] if goal is Goal.REACH else start.weights
    if start.weights.size == 1:
        return [start]
    lightest = np.argsort(droppable, kind="stable")[:_TRIED]
    return [
        start,
        *(with_peaks(start, np.asarray(np.arange(start.weights.size) != peak)) for peak in lightest),
    ]


def with_peaks(optimum: Optimum, kept: NDArray[np.bool_] | IndexArray) -> Optimum:
    """Keep some peaks of an optimum, or put them in another order."""
    return replace(
        optimum,
        frequency=optimum.frequency[kept],
        turn=optimum.turn[kept],
        moving=optimum.moving[kept],
        weights=optimum.weights[kept],
        phase=optimum.phase[kept],
    )


def _settled(start: Optimum, lines: Sequence[Line], goal: Goal, rule: AmplitudeRule) -> Optimum | None:
    """Settle from one start."""
    for _ in range(_ROUNDS):
        optimum = polish(start, goal, rule) if start.times.size > 1 else None
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


@dataclass(frozen=True, eq=False)
class LinePeaks:
    """Local maxima of the residual vibration on all lines, in the order of the lines.

    Parameters
    ----------
    frequency : ndarray, shape (m,)
        Where they lie; at an end of a line to the last bit.
    turn : ndarray of complex, shape (m,)
        `Line.turn`.
    moving : ndarray of bool, shape (m,)
        Whether it lies inside its line.
    value : ndarray of complex, shape (m,)
        Residual vibration.
    """

    frequency: FloatArray
    turn: ComplexArray
    moving: NDArray[np.bool_]
    value: ComplexArray


def alternating(count: int) -> FloatArray:
    """Amplitudes +1, -1, +1, ..."""
    return 1.0 - 2.0 * np.asarray(np.arange(count) % 2, dtype=np.float64)


def peaks_of(times: FloatArray, amplitudes: FloatArray, lines: Sequence[Line]) -> LinePeaks:
    """Find every local maximum of the residual vibration on every line."""
    found = []
    for line in lines:
        frequency = _peak_frequencies(times, amplitudes, line)
        value = np.exp(np.multiply.outer(frequency * line.turn, times - times[-1])) @ amplitudes
        moving = (frequency > line.low) & (frequency < line.high)
        found.append((frequency, np.full(frequency.size, line.turn), moving, value))
    frequencies, turns, movings, values = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return LinePeaks(frequencies, turns, movings, values)


def _peak_frequencies(times: FloatArray, amplitudes: FloatArray, line: Line) -> FloatArray:
    """Find where the residual vibration peaks on a line."""
    duration = float(times[-1])
    response = Response.of_times(times, line.damping_ratio)
    frequency = response.peaks(amplitudes, line.low * duration, line.high * duration).frequency / duration
    for end in (line.low, line.high):
        frequency[np.abs(frequency - end) < _AT_END * end] = end
    return frequency


def _corrected(optimum: Optimum, lines: Sequence[Line], rule: AmplitudeRule) -> tuple[Optimum, bool]:
    """Drop what has the wrong sign, add what is not covered; say whether anything changed."""
    heavy = optimum.weights > 0.0
    if not heavy.all() and heavy.any():
        return with_peaks(optimum, heavy), True
    peaked, more_peaks = _with_further_peaks(optimum, lines)
    timed, other_times = _with_times(optimum, rule)
    both = replace(peaked, times=timed.times, amplitudes=timed.amplitudes)
    return both, more_peaks or other_times


def _with_further_peaks(optimum: Optimum, lines: Sequence[Line]) -> tuple[Optimum, bool]:
    """Add the peaks above the worst; each takes the place of those that were near it."""
    peaks = peaks_of(optimum.times, optimum.amplitudes, lines)
    over = np.abs(peaks.value) > optimum.worst * (1.0 + _TOUCH)
    if not over.any():
        return optimum, False
    near = np.abs(np.subtract.outer(peaks.frequency[over], optimum.frequency)) < _APART
    near &= np.equal.outer(peaks.turn[over], optimum.turn)
    weights = np.where(near.any(axis=1), near @ optimum.weights, _ADMITTED)
    rest = with_peaks(optimum, np.asarray(~near.any(axis=0)))
    merged = replace(
        optimum,
        frequency=np.append(rest.frequency, peaks.frequency[over]),
        turn=np.append(rest.turn, peaks.turn[over]),
        moving=np.append(rest.moving, peaks.moving[over]),
        weights=np.append(rest.weights, weights),
        phase=np.append(rest.phase, np.angle(peaks.value[over])),
    )
    return with_peaks(merged, np.argsort(merged.frequency, kind="stable")), True


def _with_times(optimum: Optimum, rule: AmplitudeRule) -> tuple[Optimum, bool]:
    """Replace impulses that are none and add those that would help, if the certificate is not yet whole."""
    certificate = certificate_of(optimum)
    positive = rule is AmplitudeRule.POSITIVE
    apart = 2.0 * np.pi * _APART / float(np.abs(certificate.rates).max())
    fewer = _merged(optimum, apart) if positive else None
    if fewer is not None:
        return fewer, True
    rising = positive or bool((np.diff(optimum.times) > 0.0).all())
    if rising and certificate.bound(rule) >= optimum.worst * (1.0 - _COVERED):
        return optimum, False
    times = certificate.dips() if positive else certificate.extremes()
    if not positive:
        times = np.concatenate([[0.0], times, [optimum.duration]])
        return _with_impulses(optimum, times, alternating(times.size))
    far = np.abs(np.subtract.outer(times, optimum.times)).min(axis=1) > _NEWCOMER * apart
    new = times[far & (certificate(times)[0] < optimum.worst * (1.0 - _COVERED))]
    admitted = np.full(new.size, _ADMITTED)
    return _with_impulses(optimum, np.append(optimum.times, new), np.append(optimum.amplitudes, admitted))


def _merged(optimum: Optimum, apart: float) -> Optimum | None:
    """Drop impulses that are none, and make one of those that are not apart; None if all is well."""
    kept = optimum.amplitudes > 0.0
    kept[[0, -1]] = True
    times, amplitudes = optimum.times[kept], optimum.amplitudes[kept]
    starts = np.flatnonzero(np.diff(times, prepend=-np.inf) > apart)
    if starts.size == optimum.times.size:
        return None
    first = times[starts]
    first[-1] = optimum.duration  # one that meets the last is the last
    return replace(optimum, times=first, amplitudes=np.add.reduceat(amplitudes, starts))


def _with_impulses(optimum: Optimum, times: FloatArray, amplitudes: FloatArray) -> tuple[Optimum, bool]:
    """Give an optimum other impulses, in order."""
    order = np.argsort(times, kind="stable")
    return replace(optimum, times=times[order], amplitudes=amplitudes[order]), True
