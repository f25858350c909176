"""Rows under Magee and Book's laws: their taps at multiples of a spacing over a measured rope or position.

Not for: what a file says of them (`following_row`), nor for the laws (`swayless.controller`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from swayless.controller.measured import ARM_ANGLE, ARM_POSITION
from swayless.controller.number import NumberType, as_written, number_type
from swayless.controller.rope import MM_PER_M, RopeSettings, rope_settings
from swayless.controller.spaced_taps import SpacedTaps, SpacingLaw, spaced_taps, worst_truncated_residual
from swayless.controller.spacing import Spacing, rope_spacing, sampled_spacing
from swayless.design import GridShaper, Guarantee, Shaper, guarantee_of
from swayless.errors import ControllerError, DesignError
from swayless.machine.arm_positions import ArmPositions
from swayless.machine.following_row import design_within
from swayless.machine.row_section import RowSection
from swayless.plant import Band

_MEASURED = {"m": ARM_POSITION, "rad": ARM_ANGLE}


@dataclass(frozen=True)
class Followed:
    """What a spaced law follows: a rope, or the position of an arm.

    Parameters
    ----------
    rope_length_m : tuple of two floats or None
        Shortest and longest rope; None for an arm.
    hoist_speed_m_s : float or None
        Fastest that the rope's length changes; None for an arm.
    positions : ArmPositions or None
        Positions of an arm, with the fastest that they change; None for a crane.
    damping_ratio : float
        The same everywhere, at least 0 and below 1.
    """

    rope_length_m: tuple[float, float] | None
    hoist_speed_m_s: float | None
    positions: ArmPositions | None
    damping_ratio: float

    def spacing(self, tick_s: float) -> Spacing:
        """Spacing over ropes in m, or positions in their unit, in double.

        Raises
        ------
        ControllerError
            If half a period is shorter than a tick, or too long.
        """
        double = number_type("double")
        if self.positions is not None:
            places, frequency_hz = self.positions.places, self.positions.frequency_hz
            return sampled_spacing(places, frequency_hz, self.damping_ratio, tick_s=tick_s, number=double)
        assert self.rope_length_m is not None  # noqa: S101 - checked when the file was read
        return rope_spacing(self.rope_length_m, self.damping_ratio, tick_s=tick_s, number=double)

    def settings(self, *, tick_s: float, number: NumberType) -> RopeSettings:
        """Make the constants of what is measured.

        Raises
        ------
        ControllerError
            If a value is out of range.
        """
        if self.positions is not None:
            assert self.positions.speed_per_s is not None  # noqa: S101 - checked when the file was read
            ends = (self.positions.places[0], self.positions.places[-1])
            speed, measured = self.positions.speed_per_s, _MEASURED[self.positions.unit]
            return rope_settings(ends, speed, tick_s=tick_s, number=number, measured=measured)
        assert self.rope_length_m is not None  # noqa: S101 - as above
        assert self.hoist_speed_m_s is not None  # noqa: S101 - as above
        return rope_settings(self.rope_length_m, self.hoist_speed_m_s, tick_s=tick_s, number=number)


@dataclass(frozen=True, eq=False)
class SpacedDesign:
    """A row for every position.

    Parameters
    ----------
    shaper : Shaper
        As it is where the machine vibrates slowest.
    taps : SpacedTaps
        The same as multiples of the spacing, and what they hold at any position.
    """

    shaper: Shaper
    taps: SpacedTaps


def design_spaced_row(
    row: RowSection, followed: Followed, band: Band, law: SpacingLaw, *, tick_s: float, number: str
) -> SpacedDesign:
    """Design a row for every position.

    A spacing is cut to whole ticks, so the taps stand a little too near to each other everywhere.

    Parameters
    ----------
    row : RowSection
        What is asked for, made for the slowest mode.
    followed : Followed
        What is measured.
    band : Band
        Frequencies of the machine over all positions.
    law : "original" or "modified"
        What happens when the spacing changes.
    tick_s : float
        Length of a tick.
    number : str
        Number type.

    Raises
    ------
    DesignError
        If the family does not exist for the tolerance, its impulses are not half a damped period apart, or
        the tick is too coarse.
    """
    try:
        spacing = typed_spacing(followed.spacing(tick_s), number_type(number))
    except ControllerError as error:
        raise DesignError(f"{error}") from error
    anything = Guarantee(1.0, row.mode, band, 1.0)

    def taps_of(shaper: Shaper) -> tuple[SpacedTaps, float]:
        kind = number_type(number)
        taps = spaced_taps(shaper, spacing, law, tick_s=tick_s, guarantee=anything, number=kind)
        return taps, worst_truncated_residual(taps)

    shaper, taps, worst = design_within(row, taps_of, tick_s=tick_s)
    held = guarantee_of(shaper, row.mode, tolerance=row.tolerance)
    promise = replace(anything, tolerance=row.tolerance, worst_residual_ratio=worst)
    return SpacedDesign(replace(shaper, guarantee=held), replace(taps, guarantee=promise))


def typed_spacing(spacing: Spacing, number: NumberType) -> Spacing:
    """Bring a spacing over m or rad into a number type; in int32 over thousandths of them.

    A whole number belongs to the piece that has begun.

    Raises
    ------
    ControllerError
        If pieces are too short for the number type.
    """
    starts: tuple[Any, ...] = tuple(map(number.scalar, spacing.starts))
    if number.is_integer:
        starts = tuple(math.ceil(as_written(start) * MM_PER_M) for start in spacing.starts)
    for place, (start, after) in zip(spacing.starts, pairwise(starts), strict=False):
        if start == after:
            raise ControllerError(
                f"number = {number.name!r}: the spacing changes twice between {place:.6g} and the next place "
                f"that {number.name} has; a coarser tick, or number = 'double', does"
            )
    return Spacing(starts, spacing.ticks)


def taps_at_the_slowest(
    amplitudes: tuple[float, ...], widest_ticks: int, promise: Guarantee, tick_s: float
) -> GridShaper:
    """Give spaced taps on ticks, where the machine vibrates slowest, and what they hold there.

    Parameters
    ----------
    amplitudes : tuple of float
        As stored.
    widest_ticks : int
        Widest spacing.
    promise : Guarantee
        What they hold everywhere, made for the slowest mode.
    tick_s : float
        Length of a tick.
    """
    delays = np.arange(len(amplitudes)) * widest_ticks
    still = GridShaper(delays, np.array(amplitudes), tick_s, promise)
    return replace(still, guarantee=guarantee_of(still, promise.mode, tolerance=promise.tolerance))
