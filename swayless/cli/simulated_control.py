"""What is asked of a simulated crane: buttons pressed, the rope, and references with and without a shaper.

Not for: what the crane makes of them (`swayless.cli.simulated_plant`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from swayless.controller import CommandShaper, ShaperSettings
from swayless.controller.rope import MM_PER_M
from swayless.errors import ControllerError
from swayless.machine.functions import undisturbed

if TYPE_CHECKING:
    from swayless.machine.design_document import DriveRecord
    from swayless.machine.move_section import Hoist, MoveSection
    from swayless.plant.simulation.trajectory import FloatArray

MOST_TICKS = 200_000
"""Longest move that is simulated."""

_ROUNDING = 1e-9  # of the longest rope: what a design file rounds to 12 digits is read as it stands there


@dataclass(frozen=True)
class Press:
    """A button held: full command from tick `first` to `last`, the latter not included."""

    first: int
    last: int

    @property
    def ticks(self) -> int:
        """How long."""
        return self.last - self.first


def press_of(
    move: MoveSection, speed_m_s: float, drive: DriveRecord, settle_s: float, tick_s: float
) -> Press:
    """Work out from when to when the button is held.

    Parameters
    ----------
    move : MoveSection
        Way, or time, or neither.
    speed_m_s : float
        The command while it is held.
    drive : DriveRecord
        Ramps, which are part of the way.
    settle_s : float
        How long a press is that settles.
    tick_s : float
        Length of a tick.

    Raises
    ------
    ControllerError
        If the move has too many ticks.
    """
    held_s = settle_s
    if move.duration_s is not None:
        held_s = move.duration_s
    elif move.distance_m is not None:
        held_s = _time_for(move.distance_m, speed_m_s, drive)
    end_s = max(move.start_s + held_s, hoist_end_s(move.hoist))
    if end_s > MOST_TICKS * tick_s:
        raise ControllerError(
            f"a move of {end_s:g} s in ticks of {tick_s:g} s: at most {MOST_TICKS} ticks are simulated"
        )
    first = round(move.start_s / tick_s)
    return Press(first, first + max(1, round(held_s / tick_s)))


def _time_for(distance_m: float, speed_m_s: float, drive: DriveRecord) -> float:
    """Time for which a button is held to go so far, ramps included; a short one does not reach the speed."""
    up, down = (
        0.0 if ramp is None else 0.5 / ramp for ramp in (drive.acceleration_m_s2, drive.deceleration_m_s2)
    )
    ramps_m = (up + down) * speed_m_s**2
    if distance_m < ramps_m and up > 0.0:
        return 2.0 * up * math.sqrt(distance_m / (up + down))
    return distance_m / speed_m_s + (up - down) * speed_m_s


def rope_of(hoist: Hoist | None, length_m: float, time_s: FloatArray) -> FloatArray:
    """Give the rope at these times: one that stands, or one that is hoisted.

    Parameters
    ----------
    hoist : Hoist or None
        At a steady speed.
    length_m : float
        Of a rope that stands.
    time_s : ndarray
        Times.
    """
    if hoist is None:
        return np.full_like(time_s, length_m)
    return np.interp(time_s, [hoist.start_s, hoist_end_s(hoist)], [hoist.from_m, hoist.to_m])


def hoist_end_s(hoist: Hoist | None) -> float:
    """When a hoist stands again; 0 without one."""
    return 0.0 if hoist is None else hoist.start_s + abs(hoist.to_m - hoist.from_m) / hoist.rate_m_s


class Shaped(NamedTuple):
    """What a block made of a press: references in m/s, tick by tick, and all status bits that it showed."""

    reference_m_s: FloatArray
    status: int


def shaped_reference(
    settings: ShaperSettings, knob: int, press: Press, speed_m_s: float, rope: tuple[Hoist | None, float]
) -> Shaped:
    """Run the controller through a press, until the reference rests at 0.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    knob : int
        Position of the selector.
    press : Press
        When the button is held.
    speed_m_s : float
        The command then.
    rope : Hoist or None, and float
        What a block with a measured rope reads.

    Returns
    -------
    Shaped
        After the last reference they are 0.
    """
    shaper, per_m_s = CommandShaper(settings), settings.limits.units_per_m_s
    released = undisturbed(settings)._replace(selector=knob)
    held = released._replace(command=_scalar(settings, speed_m_s * per_m_s))
    readings = _readings(settings, press, *rope)
    references: list[float] = []
    status = 0
    for tick in count(-1):  # the tick before the move is one of 0, for which some blocks wait
        inputs = held if press.first <= tick < press.last else released
        if readings:
            length, speed = readings[min(max(tick, 0), len(readings) - 1)]
            inputs = inputs._replace(rope_length=length, hoist_speed=speed)
        output = shaper.step(inputs)
        references.append(float(output.reference))
        status |= int(output.status) if tick >= 0 else 0
        if tick >= max(press.last, len(readings)) and output.settled and output.reference == 0:
            break
    return Shaped(np.array(references[1:]) / per_m_s, status)


def _readings(
    settings: ShaperSettings, press: Press, hoist: Hoist | None, length_m: float
) -> list[tuple[Any, Any]]:
    """Rope length as each tick begins, and its change per second, until the hoist stands; [] without one."""
    own = settings.rope
    if own is None:
        return []
    tick_s, per_m = settings.tick_s, MM_PER_M if settings.number.is_integer else 1
    last = max(press.last, math.ceil(hoist_end_s(hoist) / tick_s)) + 2
    rope_m = rope_of(hoist, length_m, tick_s * np.arange(last + 1.0))
    speed = per_m * np.diff(rope_m) / tick_s
    # The ends of the range are rounded too: a reading that only rounding puts beyond one is that end.
    length = per_m * rope_m[:-1]
    within = np.clip(length, float(own.shortest), float(own.longest))
    rounding = 1.0 if settings.number.is_integer else _ROUNDING * float(abs(within).max())
    length = np.where(abs(length - within) < rounding, within, length)
    return [
        (_scalar(settings, value), _scalar(settings, rate))
        for value, rate in zip(length.tolist(), speed.tolist(), strict=True)
    ]


def _scalar(settings: ShaperSettings, value: float) -> Any:
    return settings.number.scalar(round(value) if settings.number.is_integer else value)


def plain_ramp(press: Press, ticks: int, speed_m_s: float) -> FloatArray:
    """Give the reference of a press that is ramped and not shaped: straight to the speed in so many ticks.

    Parameters
    ----------
    press : Press
        When the button is held; a shorter press than the ramp does not reach the speed.
    ticks : int
        Of the ramp, at least 1, which is a jump.
    speed_m_s : float
        To reach.

    Examples
    --------
    >>> plain_ramp(Press(1, 4), 2, 0.5).tolist()
    [0.0, 0.25, 0.5, 0.5, 0.25]
    """
    held = np.zeros(press.last + ticks - 1)
    held[press.first : press.last] = speed_m_s / ticks
    sums = np.concatenate([np.zeros(ticks), np.cumsum(held)])
    return np.asarray(sums[ticks:] - sums[:-ticks])
