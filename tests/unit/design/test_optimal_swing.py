"""What a command leaves of each mode, also beside a rigid body, whose eigenvectors are no basis."""

import numpy as np
import pytest

from swayless.design.optimal import LinearPlant, MoveTask, detuned, output_at_ticks, time_optimal
from swayless.design.optimal.sensitivity import swing_left

OFF = [0.9, 1.0, 1.1]


@pytest.mark.parametrize("denominator", [[1.0, 0.0, 0.0], [1.0, 1.0]])
def test_a_plant_that_does_not_ring_leaves_nothing_swinging(denominator):
    plant = LinearPlant.from_transfer_function([1.0], denominator)
    command = time_optimal(MoveTask(plant, 0.02, (-2.0, 2.0), 1.0)).command
    assert swing_left(plant, command, OFF).shape == (0, 3)


def test_a_mode_beside_a_rigid_body_leaves_what_the_partial_fraction_says():
    # 1 / (s^2 (s^2 / w^2 + 1)) = 1 / s^2 - 1 / (s^2 + w^2): a step of 1 makes the mode swing by 1 / w^2.
    w = 10.0
    plant = LinearPlant.from_transfer_function([1.0], [1.0 / w**2, 0.0, 1.0, 0.0, 0.0])
    command = time_optimal(MoveTask(plant, 0.02, (-2.0, 2.0), 1.0)).command
    steps = command.increments
    since_s = command.duration_s - steps.times_s
    expected = [abs(np.exp(1j * w * ratio * since_s) @ steps.amplitudes) / (w * ratio) ** 2 for ratio in OFF]
    assert swing_left(plant, command, OFF)[0] == pytest.approx(expected, rel=1e-6, abs=1e-12)
    assert expected[1] < 1e-12 < expected[0]


TWO_MODES = np.polymul([1.0, 0.4, 4.0], [1.0, 2.0, 100.0])
OTHERS = np.polymul([1.0, 0.44, 4.84], [1.0, 2.2, 121.0])
TRANSFERS = {
    "an oscillator": ([1.0], [0.01, 0.0, 1.0], [1.0], [0.01 / 1.21, 0.0, 1.0]),
    "a rigid body": ([2.0], [0.01, 0.02, 1.0, 0.0, 0.0], [2.0], [0.01 / 1.21, 0.02 / 1.1, 1.0, 0.0, 0.0]),
    "zeros that stay": ([2.0, 1.0, 5.0], [1.0, 0.1, 9.0], [2.42, 1.21, 6.05], [1.0, 0.11, 9.0 * 1.21]),
    "two modes and a lag": (
        [1.0, 3.0],
        np.polymul(TWO_MODES, [1.0, 5.0]),
        [1.1**4, 3.0 * 1.1**4],
        np.polymul(OTHERS, [1.0, 5.0]),
    ),
}


@pytest.mark.parametrize("name", TRANSFERS)
def test_a_detuned_plant_has_the_transfer_function_with_other_frequencies_and_nothing_else(name):
    top, bottom, *off = TRANSFERS[name]
    plant = detuned(LinearPlant.from_transfer_function(top, bottom), 1.1)
    for s in (0.3j, 1.0 + 2.0j, 30.0j):
        answer = plant.c @ np.linalg.solve(s * np.eye(plant.order) - plant.a, plant.b) + plant.d
        assert answer == pytest.approx(np.polyval(off[0], s) / np.polyval(off[1], s), rel=1e-12)


@pytest.mark.parametrize("name", ["an oscillator", "a rigid body", "zeros that stay"])
def test_what_is_said_to_be_left_is_what_the_detuned_plant_swings_by(name):
    plant = LinearPlant.from_transfer_function(*TRANSFERS[name][:2])
    command = time_optimal(MoveTask(plant, 0.02, (-5.0, 5.0), 1.0)).command
    for ratio, said in zip(OFF, swing_left(plant, command, OFF)[0], strict=True):
        actual = detuned(plant, ratio)
        (pole,) = actual.ringing_poles_rad_s
        after = output_at_ticks(actual, command, ticks=command.values.size + 400)[command.values.size :]
        times_s = 0.02 * np.arange(after.size)
        # The swing alone: what decays and turns with the pole, about what is reached at rest.
        wave = np.exp(pole * times_s)
        parts = np.linalg.lstsq(np.column_stack([wave.real, wave.imag]), after - 1.0)[0]
        # A rigid body's end is 1 at every frequency: nothing but the swing is fitted.
        assert np.hypot(*parts) == pytest.approx(said, rel=1e-6, abs=1e-9)
