"""What a record could not show, in words: short ones, drift, noise, damping below resolution, other modes.

Not for: the numbers that it did show.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from swayless.cli.console import counted, per_cent
from swayless.cli.identify_input import AllFound, Found
from swayless.machine.identified_record import ReadRecord
from swayless.plant.identification import IdentifiedMode, IdentifiedSwing, Quantity
from swayless.plant.identification.falling import DRAG, FRICTION, FallingFit
from swayless.plant.identification.noise import loud_part
from swayless.plant.identification.pendulum_swing import first_angle_rad
from swayless.plant.identification.waveform import WAVEFORMS

_ENOUGH_SWINGS = 3.0
_FALLS = {
    FRICTION: "straight, as of dry friction",
    DRAG: "ever slower, as of air drag",
    None: "friction, air drag, or two modes at almost one frequency",
}
_ENOUGH_SAMPLES = 4.0
"""In a swing, at the usual interval; beyond two every frequency has its images."""


def remarks(found: AllFound) -> Iterator[str]:
    """Say of every record what it could not show, and of the ropes whether they agree.

    Parameters
    ----------
    found : AllFound
    """
    each_of = [list(of_record(each)) for each in found.records]
    common = [remark for remark in each_of[0] if all(remark in others for others in each_of)]
    yield from common
    for each, its in zip(found.records, each_of, strict=True):
        yield from (f"{each.source}: {remark}" for remark in its if remark not in common)
    offset = found.offset
    if offset is None:
        return
    if not offset.is_consistent:
        yield "rope offset: the ropes do not agree on one; its uncertainty is widened to cover them"
    if offset.slope is None:
        yield "rope offset: two lengths cannot show whether the scale is right: measure a third"
    elif offset.scale_is_doubtful:
        slope = f"{offset.slope:.4f} +- {offset.slope_std:.2g}"
        yield f"rope offset: {slope} m of pendulum for each metre shown: check the scale of the encoder"


def of_record(found: Found) -> Iterator[str]:
    """Say what one record could not show.

    Parameters
    ----------
    found : Found
    """
    if found.swing is not None and found.read is not None:
        yield from _of_swing(found.swing, found.read)
    elif found.decrement is not None:
        yield f"peaks: {found.decrement.peaks} read over {found.decrement.swings:g} swings"
        yield f"noise: a peak was read to {found.decrement.reading_std:.2g}, one standard deviation"
    else:
        yield "damping: a stopwatch does not show it; record the swing, or read off peaks (--peaks)"
    if found.swing is None or found.swing.is_exponential:
        yield from _of_damping(found.modes[0])


def _of_damping(mode: IdentifiedMode) -> Iterator[str]:
    if mode.damping_is_below_resolution:
        yield (
            "damping: below what this record resolves; it may be 0, and is at most"
            f" {mode.damping_range()[1]:.2g}: record for longer to see it"
        )


def _of_swing(swing: IdentifiedSwing, read: ReadRecord) -> Iterator[str]:
    first = swing.modes[0].amplitude or 1.0
    colour = (
        ", more of it near the swing than elsewhere: uncertainty widened" if swing.noise.is_coloured else ""
    )
    yield f"noise: {per_cent(swing.noise.rms / first, 2)} of the first amplitude, rms{colour}"
    if swing.swings < _ENOUGH_SWINGS:
        yield (
            f"too short: {swing.swings:.2g} swings, in which frequency, damping and drift are hard to tell"
            " apart: record ten or more"
        )
    a_swing = swing.modes[0].mode.damped_period_s / swing.record.interval_s
    if a_swing < _ENOUGH_SAMPLES:
        yield (
            f"samples: {a_swing:.2g} in a swing; a faster swing would look the same: record"
            f" {_ENOUGH_SAMPLES:g} or more in each"
        )
    if read.time_unit_is_assumed:
        yield "time: nothing says its unit; taken for seconds"
    if read.missing:
        yield f"missing: {counted(read.missing, 'sample')} without a value, left out"
    if len(swing.modes) == 1 and not swing.may_be_two_modes:
        floor = per_cent(swing.second_mode_floor / first, 2)
        near = 1.0 / swing.record.duration_s
        yield (
            f"second mode: none seen; one of less than {floor} of the first, or within {near:.2g} Hz of it,"
            " may not have been"
        )
    elif len(swing.modes) > 1:
        yield "second mode: seen; a shaper for the first alone leaves it to swing"
    yield from _of_middle(swing, first)
    if not swing.is_exponential:
        fall = swing.fit.fall.exponent if isinstance(swing.fit, FallingFit) else None
        average = "the damping ratio is an average, and the uncertainty is widened"
        yield f"decay: not exponential ({_FALLS[fall]}): {average}"
    if swing.may_be_two_modes:
        yield (
            "second mode: two close ones explain the record as well as such a decay, and the band covers"
            " them: say --modes 1 or 2"
        )
    loud = loud_part(swing.fit)
    if loud is not None:
        start_s, end_s = (float(swing.record.time_s[0]) + each for each in (loud.start_s, loud.end_s))
        yield (
            f"uneven: from {start_s:.4g} to {end_s:.4g} s the fit leaves {loud.ratio:.2g} times as much as"
            " elsewhere: was the swing free there? (--start, --end)"
        )
    yield from _of_size(swing, read)


def _of_middle(swing: IdentifiedSwing, first: float) -> Iterator[str]:
    degree = swing.fit.model.drift_degree
    shape = "straight" if degree == 1 else "bent"
    drift = per_cent(swing.drift / first, 2)
    yield f"drift: {drift} of the first amplitude over the record, {shape}, removed"


def _of_size(swing: IdentifiedSwing, read: ReadRecord) -> Iterator[str]:
    """Say whether the frequency was corrected for the size of the swing, and whether that is certain."""
    quantity, mode = read.record.quantity, swing.modes[0]
    if quantity is Quantity.value:
        yield "large swing: not corrected for, the unit of the values is not known (--unit deg, rad, m, ...)"
    is_bent = swing.fit.model.waveform is not None
    if is_bent:
        yield (
            f"large swing: {math.degrees(first_angle_rad(swing.fit)):.3g} deg at first,"
            f" {per_cent(swing.slowed_ratio, 2)} slower than a small one; the frequency is that of small ones"
        )
    if not swing.is_decided:
        scale = WAVEFORMS[quantity].angle_per_value(2.0 * math.pi * mode.frequency_hz)
        angle = scale * (mode.amplitude or 0.0)
        taken = "was taken for a load on a rope" if is_bent else "was not taken for a load on a rope"
        yield (
            f"large swing: the record does not show whether it is one, and {taken}; the uncertainty"
            f" covers both, {per_cent(angle**2 / 16.0, 2)} apart: say --pendulum or --linear"
        )
