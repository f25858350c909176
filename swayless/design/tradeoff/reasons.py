"""Why a candidate stands where it does, in one sentence. Not for: ranking (`recommending`)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from swayless.design.tradeoff.candidates import SLOWER_RAMP, Candidate
from swayless.design.tradeoff.need import Need
from swayless.design.tradeoff.placing import positions_needed
from swayless.plant import Band, pendulum_rope_length_m


def reason(candidate: Candidate, need: Need, best: Candidate) -> str:
    """Say in one sentence what a candidate does, what it costs, and what else to know of it.

    Parameters
    ----------
    candidate : Candidate
        Of `best` or any other.
    need : Need
        The machine.
    best : Candidate
        The one that is recommended before all others.

    Examples
    --------
    >>> from swayless.design.tradeoff.candidates import family_candidate
    >>> need = Need(Band(0.9, 1.1))
    >>> ei = family_candidate("ei", need)
    >>> reason(ei, need, ei)
    'holds the whole range and stops within 0.492 m, sooner than all else that does'
    """
    clauses = [f"{_holds(candidate, need)} {_stops(candidate, need, best)}", *_remarks(candidate, need)]
    return "; ".join(clauses)


def _holds(candidate: Candidate, need: Need) -> str:
    """Say what it holds, and what it leaves where it does not."""
    worst = _per_cent(candidate.worst_residual_ratio)
    if candidate.whole:
        return "holds the whole range and"
    if not candidate.held:
        return f"holds nothing of the range, leaves up to {worst}, and"
    share = f"{math.floor(1000.0 * candidate.share) / 10.0:g} %"  # never more than it holds
    where = ", ".join(_part(band, need) for band in candidate.held[:2])
    more = " and more" if len(candidate.held) > 2 else ""
    return f"holds {share} of the range ({where}{more}), leaves up to {worst} elsewhere, and"


def _stops(candidate: Candidate, need: Need, best: Candidate) -> str:
    """Say where it stops, beside the limit and the best."""
    stop = f"stops within {candidate.overtravel_m:.3g} m"
    limit_m = need.longest_overtravel_m
    if limit_m is not None and candidate.overtravel_m > limit_m * (1.0 + 1e-9):
        return f"{stop}, {candidate.overtravel_m - limit_m:.3g} m too far"
    if not candidate.whole:
        return stop
    if candidate is best:
        return f"{stop}, sooner than all else that does"
    later_m = candidate.overtravel_m - best.overtravel_m
    return f"{stop}, {later_m:.3g} m farther than {best.name}" if best.whole and later_m > 0.0 else stop


def _remarks(candidate: Candidate, need: Need) -> Iterator[str]:
    """Say what else there is to know."""
    if not candidate.rows:
        yield from _of_ramps(candidate, need)
        return
    if candidate.lower_bound_s is not None:
        bound_s = math.floor(1000.0 * candidate.lower_bound_s) / 1000.0  # never more than is proved
        kind = "bounded" if candidate.negative else "positive"
        yield f"it is proved that no {kind} shaper of {bound_s:g} s or less does"
    if len(candidate.rows) > 1:
        ends = ", ".join(_end(row.guarantee.band.high_hz, need) for row in candidate.rows[:-1])
        yield f"the row has to be chosen by knob or encoder, with switches at {ends}"
    if len(candidate.rows) == 1 and not candidate.whole:
        positions = positions_needed(candidate.rows[0].guarantee.band, need.ratio)
        yield f"{positions} positions of the knob would cover the range"
    if candidate.negative:
        yield (
            f"its negative amplitudes (peak factor {candidate.peak_factor:.3g}) make a new command wait, so "
            f"that every jog lasts {candidate.duration_s:.3g} s or more"
        )


def _of_ramps(candidate: Candidate, need: Need) -> Iterator[str]:
    """Say what a plain ramp does not do."""
    if candidate.name == SLOWER_RAMP:
        acceleration = need.speed_m_s / candidate.duration_s
        yield f"it is a ramp of {candidate.duration_s:.3g} s, {acceleration:.3g} m/s2, without a shaper"
    elif candidate.whole:
        yield "moves that reach full speed need no shaper"
    jog = _per_cent(candidate.jog_residual_ratio)
    yield f"jogs that do not reach full speed leave up to {jog} of the swing of a full-speed step"


def _part(band: Band, need: Need) -> str:
    """Write a part of the range in the measure of the machine."""
    if need.on_rope:
        low_m, high_m = pendulum_rope_length_m(band.high_hz), pendulum_rope_length_m(band.low_hz)
        return f"{low_m:.3g} to {high_m:.3g} m"
    return f"{band.low_hz:.3g} to {band.high_hz:.3g} Hz"


def _end(frequency_hz: float, need: Need) -> str:
    """Write a switching point in the measure of the machine."""
    return f"{pendulum_rope_length_m(frequency_hz):.3g} m" if need.on_rope else f"{frequency_hz:.3g} Hz"


def _per_cent(ratio: float) -> str:
    """Write a ratio in per cent."""
    return f"{100.0 * ratio:.3g} %"
