"""Blocks with every function of the operator and every diagnostic that their law can have, to compile."""

from dataclasses import replace

from swayless.controller.diagnostics import Diagnostics
from swayless.controller.rope_bound import rope_bounds
from swayless.controller.sway import sway_settings
from swayless.controller.tables import design_facts
from swayless.controller.tracking import TrackingSettings
from tests.compiled.phase_blocks import chosen_by_rope
from tests.properties.test_operator_everything import everything
from tests.unit.controller.blocks import EI, UM_SPLIT, UM_ZV, ZVD, block
from tests.unit.controller.operator_blocks import operated

DESIGN_ID = 0xCAFE_F00D
SMALL = {"inching_speed_m_s": 0.08, "minimum_speed_m_s": 0.03, "command_resolution_m_s": 0.02}
RAMPS = {"acceleration_m_s2": 1.3, "deceleration_m_s2": 0.8, "quick_stop_m_s2": 2.0}
OPTIONS = {
    "step_sizes_m": (0.05, 0.21, 1.0),
    "step_speed_m_s": 0.4,
    "stop_switches": True,
    "slow_speed_m_s": 0.15,
    "limit_margin_m": 0.1,
    "drive_feedback": True,
    "speed_limit": True,
}


def told(settings):
    """The block with every diagnostic."""
    rope, limits = settings.rope, settings.limits
    asked = Diagnostics(
        sway=sway_settings(settings.bank, limits, rope),
        rope_bounds=None if rope is None else rope_bounds(settings.bank, rope),
        tracking=TrackingSettings(limits.max_command / 10 if not settings.number.is_integer else 700, 5, 3),
    )
    settings = replace(settings, diagnostics=asked)
    return replace(settings, diagnostics=replace(asked, facts=design_facts(settings, DESIGN_ID)))


def mixed(number):
    """Rows that take commands at once and rows that wait, small commands, three ramps."""
    return told(operated(block(ZVD, UM_SPLIT, EI, number=number, **SMALL, **RAMPS), **OPTIONS))


def kind_of(kind):
    """One row of a law, and every function but those of `mixed`."""

    def made(number):
        return told(everything(kind, number))

    return made


def by_rope(number):
    """Rows that the measured rope chooses, and their bounds on it."""
    options = {**OPTIONS, "rope_offset_m": (-0.4, 0.6), "start_from_zero": True}
    return told(operated(chosen_by_rope(number), **options))


def contactor(number):
    """A drive that knows two speeds, rows on whole ticks, ways and switches."""
    fast = block(UM_ZV, number=number, acceleration_m_s2=1000.0, inching_speed_m_s=0.2)
    options = {"stop_switches": True, "slow_speed_m_s": 0.3, "limit_margin_m": 0.2}
    return told(operated(fast, contactor_speeds_m_s=(0.2, 0.5), start_from_zero=True, **options))


BLOCKS = {
    "mixed": mixed,
    "phase": kind_of("phase"),
    "modified": kind_of("modified"),
    "original": kind_of("original"),
    "by rope": by_rope,
    "contactor": contactor,
}

ALONE = {
    "steps": {"step_sizes_m": (0.05, 0.21, 1.0)},
    "stop switches": {"stop_switches": True},
    "slow switches": {"slow_speed_m_s": 0.15},
    "ways": {"limit_margin_m": 0.1},
    "feedback": {"drive_feedback": True},
    "speed limit": {"speed_limit": True},
    "start": {"start_from_zero": True},
    "one speed": {"contactor_speeds_m_s": (0.5,)},
}
"""Each function by itself: what one does not need is not printed, and what it needs is."""


def alone(name, number):
    """A block of two rows, one of which waits, and one function."""
    rows, limits = ((ZVD, UM_SPLIT), {}) if name != "one speed" else ((UM_ZV,), {"acceleration_m_s2": 1000.0})
    return operated(block(*rows, number=number, **limits), **ALONE[name])
