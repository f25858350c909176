"""Small blocks that follow a spacing, built from plain numbers."""

from dataclasses import replace

import numpy as np

from swayless.controller import (
    Bank,
    Row,
    ShaperSettings,
    SpeedLimits,
    command_limits,
    number_type,
)
from swayless.controller.rope import RopeSettings, rope_settings
from swayless.controller.spaced_taps import SpacedTaps, spaced_taps
from swayless.controller.spacing import Spacing, rope_spacing
from swayless.design import design_shaper
from swayless.plant import Mode
from tests.unit.controller.blocks import COUNTS_PER_M_S, GUARANTEE, TICK_S


def settings_of(taps, rope, *, tick_s=TICK_S, **limits):
    """Settings of one row."""
    limits.setdefault("max_speed_m_s", 0.5)
    limits.setdefault("acceleration_m_s2", 1.0)
    if taps.number.is_integer:
        limits.setdefault("units_per_m_s", COUNTS_PER_M_S)
    limits.setdefault("deceleration_m_s2", limits["acceleration_m_s2"])
    limits.setdefault("quick_stop_m_s2", limits["acceleration_m_s2"])
    speeds = command_limits(SpeedLimits(**limits), tick_s=tick_s, number=taps.number)
    return ShaperSettings(Bank((Row("row 1", "zvd", taps),)), speeds, rope)


def spaced_block(number="double", law="modified", *, amplitudes, ticks, **limits):
    """Settings of taps with these spacings, one a unit of position from 1 on: `position_of` finds them."""
    kind = number_type(number)
    spacing = Spacing(tuple(kind.scalar(1 + k) for k in range(len(ticks))), tuple(ticks))
    taps = SpacedTaps(np.array(amplitudes), spacing, law, TICK_S, GUARANTEE, kind)
    far = kind.scalar(100)
    rope = RopeSettings(kind.scalar(1), far, far, far, far, kind.scalar(1))
    return settings_of(taps, rope, **limits)


def position_of(settings, ticks):
    """Position at which the spacing is so many ticks."""
    spacing = settings.bank.rows[0].taps.spacing
    return spacing.starts[spacing.ticks.index(ticks)]


def rope_block(number="double", law="modified", *, family="zvd", tick_s=TICK_S, tolerance=0.05, **limits):
    """Settings of a family on a rope of 3 to 9 m."""
    kind = number_type(number)
    spacing = rope_spacing((3.0, 9.0), 0.0, tick_s=tick_s, number=kind)
    shaper = design_shaper(family, Mode(1.0))
    guarantee = replace(shaper.guarantee, tolerance=tolerance)
    taps = spaced_taps(shaper, spacing, law, tick_s=tick_s, guarantee=guarantee, number=kind)
    rope = rope_settings((3.0, 9.0), 0.4, tick_s=tick_s, number=kind)
    return settings_of(taps, rope, tick_s=tick_s, **limits)
