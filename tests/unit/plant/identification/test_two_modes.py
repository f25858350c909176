from __future__ import annotations

import numpy as np
import pytest

from swayless.errors import PlantError
from swayless.plant.identification import SwingRecord, identify_swing
from tests.unit.plant.identification.swings import Truth

TIME_S = np.linspace(0.0, 100.0, 4001)
FIRST = Truth(0.3, 0.002)


def two(apart_hz, noise, seed=0):
    second = Truth(0.3 + apart_hz, 0.003, 0.6, 1.0)
    value = FIRST.swing(TIME_S) + second.swing(TIME_S) + noise * np.random.default_rng(seed).normal(size=4001)
    return SwingRecord(TIME_S, value), second


@pytest.mark.parametrize("apart_hz", [0.004, 0.01, 0.05, 0.5])
def test_modes_less_than_a_beat_apart_are_told_apart(apart_hz):
    record, second = two(apart_hz, 0.02)
    found = identify_swing(record)
    assert len(found.modes) == 2
    for mode, truth in zip(found.modes, (FIRST, second), strict=True):
        # 3.5 standard deviations: one in two thousand.
        assert abs(mode.frequency_hz - truth.frequency_hz) < 3.5 * mode.frequency_hz_std
        assert abs(mode.damping_ratio - truth.damping_ratio) < 3.5 * mode.damping_ratio_std


def test_modes_that_noise_hides_from_each_other_are_refused_or_covered():
    """At a third of a beat: two modes, a refusal, or one whose uncertainty covers what it stands for."""
    refused = 0
    for seed in range(10):
        record, second = two(0.0035, 0.3, seed)
        try:
            found = identify_swing(record)
        except PlantError as error:
            refused += "does not tell them apart in 100 s: record for longer" in str(error)
            continue
        band = found.modes[0].band(3.5)
        assert (
            band.contains(FIRST.frequency_hz) or band.contains(second.frequency_hz) or band.contains(0.30131)
        )
    assert refused > 0


def test_one_mode_can_be_asked_for():
    record, _ = two(0.05, 0.02)
    assert len(identify_swing(record, modes=1).modes) == 1
    with pytest.raises(PlantError, match="modes = 3: must be 1 or 2"):
        identify_swing(record, modes=3)


@pytest.mark.parametrize("seed", range(8))
def test_noise_is_no_second_mode(seed):
    noise = 0.2 * np.random.default_rng(seed).normal(size=4001)
    found = identify_swing(SwingRecord(TIME_S, FIRST.swing(TIME_S) + noise))
    assert len(found.modes) == 1
    assert found.is_exponential


def test_a_second_mode_just_above_the_floor_is_found():
    noise = 0.1 * np.random.default_rng(5).normal(size=4001)
    floor = identify_swing(SwingRecord(TIME_S, FIRST.swing(TIME_S) + noise)).second_mode_floor
    second = Truth(0.8, 0.0, 1.5 * floor)
    found = identify_swing(SwingRecord(TIME_S, FIRST.swing(TIME_S) + second.swing(TIME_S) + noise))
    assert [round(mode.frequency_hz, 2) for mode in found.modes] == [0.3, 0.8]


@pytest.mark.parametrize("seed", range(6))
def test_a_swing_that_friction_stops_is_no_pair_of_modes(seed):
    envelope = np.maximum(0.0, 1.2 * np.exp(-TIME_S / 100.0) - 0.2 - TIME_S / 120.0)
    noise = 0.02 * np.random.default_rng(seed).normal(size=4001)
    found = identify_swing(SwingRecord(TIME_S, envelope * Truth(0.3).swing(TIME_S) + noise))
    (mode,) = found.modes
    assert (found.is_exponential, found.may_be_two_modes) == (False, False)
    # 3.5 standard deviations: one in two thousand; 5e-4: what two modes in its place would be off.
    assert abs(mode.frequency_hz - 0.3) < 3.5 * mode.frequency_hz_std < 5e-4
    np.testing.assert_allclose(found.fit.envelope(TIME_S)[:2400], envelope[:2400], atol=0.02)


def test_the_band_of_one_mode_in_the_place_of_two_holds_both():
    """At a tenth of a beat: refused, or one band that holds them."""
    covered = 0
    for seed in range(3):
        record, second = two(0.001, 0.01, seed)
        try:
            found = identify_swing(record)
        except PlantError:
            continue
        band = found.modes[0].band()
        assert band.contains(FIRST.frequency_hz)
        assert band.contains(second.frequency_hz)
        covered += not found.is_exponential
    assert covered > 0


@pytest.mark.parametrize(
    "envelope",
    [1.0 - 0.8 * TIME_S / 100.0, 1.0 / (1.0 + TIME_S / 40.0)],
    ids=["friction", "air drag"],
)
def test_a_decay_that_is_not_exponential_is_said_and_leaves_the_frequency_alone(envelope):
    value = envelope * Truth(0.3).swing(TIME_S) + 0.01 * np.random.default_rng(1).normal(size=4001)
    found = identify_swing(SwingRecord(TIME_S, value))
    assert not found.is_exponential
    assert abs(found.modes[0].frequency_hz - 0.3) < 2.0 * found.modes[0].frequency_hz_std < 1e-3
