"""Magee and Book, figs 16 and 17: a flexible arm that draws circles, and what shaping does to its vibration.

A circle of 3 ft in 9 s, eight laps, 50 Hz, first resonance 3.7 to 5.5 Hz over the circle. The paper does not
say what makes its arm ring without shaping; here the arm is undamped, and it is the start of the circle.
"""

import math

import numpy as np
import pytest

from swayless.controller import number_type
from swayless.controller.number import amplitudes_on_lattice
from swayless.controller.rope import RopeSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.controller.spacing import sampled_spacing
from swayless.controller.spacing_laws import spaced_filter
from swayless.design import design_shaper
from swayless.plant import Mode
from swayless.plant.simulation import FlexibleArm
from tests.unit.controller.blocks import GUARANTEE
from tests.unit.controller.spaced_blocks import settings_of

TICK_S, LAP_S, LAPS, DIAMETER_M = 0.02, 9.0, 8, 0.9144
BAND_HZ = (3.7, 5.5)
ARM = FlexibleArm.over_circle(*BAND_HZ, DIAMETER_M)
ANGLE = 2.0 * math.pi / LAP_S * TICK_S * np.arange(round(LAPS * LAP_S / TICK_S))
REACH_M = ARM.reach_m + 0.5 * DIAMETER_M * np.cos(ANGLE)
ACROSS_M = 0.5 * DIAMETER_M * np.sin(ANGLE)


def shaped(law, family):
    """The circle across the arm, shaped by the spacing of each tick's reach."""
    double = number_type("double")
    places = np.linspace(REACH_M.min(), REACH_M.max(), 60)
    spacing = sampled_spacing(places, ARM.frequency_at(places), 0.0, tick_s=TICK_S, number=double)
    assert spacing.ticks == (4, 5, 6)
    numerators = amplitudes_on_lattice(design_shaper(family, Mode(1.0)).amplitudes, double.amplitude_bits)
    amplitudes = np.array(numerators) / 2.0**double.amplitude_bits
    taps = SpacedTaps(amplitudes, spacing, law, TICK_S, GUARANTEE, double)
    rope = RopeSettings(REACH_M.min(), REACH_M.max(), 1.0, 1.0, 1.0, TICK_S)
    shape = spaced_filter(settings_of(taps, rope, tick_s=TICK_S, max_speed_m_s=1.0))
    references = []
    for command, reach in zip(ACROSS_M.tolist(), REACH_M.tolist(), strict=True):
        shape.turn(reach, 0.0)
        references.append(shape.run(command, 1))
    return np.array(references)


def band_db(commands_m):
    """Power of the tip's acceleration between 3.7 and 5.5 Hz, from the second lap on, in dB."""
    reach = np.append(REACH_M, REACH_M[-1])
    arm = ARM.simulate(
        np.array(commands_m), np.broadcast_to(reach, (len(commands_m), reach.size)), tick_s=TICK_S
    )
    record = arm.tip_m_s2[:, round(LAP_S / TICK_S) :]
    spectrum = np.abs(np.fft.rfft(record * np.hanning(record.shape[1])))
    hertz = np.fft.rfftfreq(record.shape[1], TICK_S)
    inside = (hertz >= BAND_HZ[0]) & (hertz <= BAND_HZ[1])
    return 10.0 * np.log10((spectrum[:, inside] ** 2).sum(axis=1))


@pytest.mark.parametrize("family", ["zv", "zvd"])
def test_figs_16_and_17_original_shaping_shakes_the_arm_and_modified_shaping_calms_it(family):
    none, original, modified = band_db([ACROSS_M, shaped("original", family), shaped("modified", family)])
    print(f"{family}: original {original - none:+.1f} dB, modified {modified - none:+.1f} dB")
    # The paper: +12 dB, -20 dB, and nearly 32 dB between them.
    assert original - none >= 12.0
    assert modified - none <= (-14.0 if family == "zv" else -20.0)
    assert original - modified >= 32.0
