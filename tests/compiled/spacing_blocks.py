"""Blocks whose taps follow a spacing, to compile: a rope and every optional part, an arm, and jumps."""

from dataclasses import replace

from swayless.controller import Bank, Row, number_type
from swayless.controller.measured import ARM_ANGLE
from swayless.controller.rope import rope_settings
from swayless.controller.spaced_taps import spaced_taps
from swayless.controller.spacing import sampled_spacing
from swayless.design import design_shaper
from swayless.plant import Mode
from tests.unit.controller.spaced_blocks import rope_block, settings_of, spaced_block

LOOSE = 0.2
"""Residual promised, which the law does not read: spacings of few ticks, which lap rings often, leave it."""

EVERYTHING = {
    "minimum_speed_m_s": 0.03,
    "inching_speed_m_s": 0.08,
    "command_resolution_m_s": 0.02,
    "deceleration_m_s2": 0.7,
    "quick_stop_m_s2": 2.0,
}


def rope(law, number):
    """Rows of two and five taps on a rope, and every optional part."""
    base = rope_block(number, law, family="zv", tick_s=0.2, tolerance=LOOSE, **EVERYTHING)
    shaper = design_shaper("zvddd", Mode(1.0))
    guarantee = replace(shaper.guarantee, tolerance=LOOSE)
    spacing = base.bank.rows[0].taps.spacing
    taps = spaced_taps(shaper, spacing, law, tick_s=0.2, guarantee=guarantee, number=base.number)
    return replace(base, bank=Bank((*base.bank.rows, Row("far", "zvddd", taps))))


def arm(law, number):
    """A damped arm whose frequency rises and falls over its angle, from below 0 on."""
    kind, tick_s, angles = number_type(number), 0.02, (-0.5, 0.2, 0.9)
    spacing = sampled_spacing(angles, [2.0, 5.5, 3.0], 0.02, tick_s=tick_s, number=kind)
    shaper = design_shaper("zvd", Mode(1.0, 0.02))
    guarantee = replace(shaper.guarantee, tolerance=LOOSE)
    taps = spaced_taps(shaper, spacing, law, tick_s=tick_s, guarantee=guarantee, number=kind)
    reach = rope_settings((angles[0], angles[-1]), 1.5, tick_s=tick_s, number=kind, measured=ARM_ANGLE)
    return settings_of(taps, reach, tick_s=tick_s)


def jumping(law, number):
    """Spacings far apart, of which a reading of any tick may be any."""
    return spaced_block(number, law, amplitudes=[0.25, 0.5, 0.25], ticks=[3, 4, 5, 9, 14])


BLOCKS = {"rope": rope, "arm": arm, "jumping": jumping}
