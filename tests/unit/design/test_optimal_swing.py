"""What a command leaves of each mode, also beside a rigid body, whose eigenvectors are no basis."""

import numpy as np
import pytest

from swayless.design.optimal import LinearPlant, MoveTask, time_optimal
from swayless.design.optimal.sensitivity import swing_left

OFF = [0.9, 1.0, 1.1]


@pytest.mark.parametrize("denominator", [[1.0, 0.0, 0.0], [1.0, 1.0]])
def test_a_plant_that_does_not_ring_leaves_nothing_swinging(denominator):
    plant = LinearPlant.from_transfer_function([1.0], denominator)
    command = time_optimal(MoveTask(plant, 0.02, (-2.0, 2.0), 1.0)).command
    assert swing_left(plant, command, OFF).shape == (0, 3)


def test_a_mode_beside_a_rigid_body_leaves_what_the_partial_fraction_says():
    # 1 / (s^2 (s^2 / w^2 + 1)) = 1 / s^2 - 1 / (s^2 + w^2): the mode alone answers with -sin(w t) / w.
    w = 10.0
    plant = LinearPlant.from_transfer_function([1.0], [1.0 / w**2, 0.0, 1.0, 0.0, 0.0])
    command = time_optimal(MoveTask(plant, 0.02, (-2.0, 2.0), 1.0)).command
    steps = command.increments
    since_s = command.duration_s - steps.times_s
    expected = [abs(np.exp(1j * w * ratio * since_s) @ steps.amplitudes) / w**2 for ratio in OFF]
    assert swing_left(plant, command, OFF)[0] == pytest.approx(expected, rel=1e-6, abs=1e-12)
    assert expected[1] < 1e-12 < expected[0]
