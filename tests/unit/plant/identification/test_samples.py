from __future__ import annotations

import numpy as np
import pytest

from swayless.plant.identification.fitting import fit
from swayless.plant.identification.record import Quantity
from swayless.plant.identification.samples import Samples
from swayless.plant.identification.swing_model import SwingModel
from swayless.plant.identification.waveform import WAVEFORMS

EVEN_S = np.arange(60_000) * 1e-3
RNG = np.random.default_rng(7)
TIMES_S = {
    "even": EVEN_S,
    "gap": np.delete(EVEN_S, slice(20_000, 33_000)),
    "uneven": np.sort(RNG.uniform(0.0, 60.0, EVEN_S.size)),
    "burst": np.sort(np.concatenate([RNG.uniform(3.0, 4.0, 50_000), RNG.uniform(0.0, 60.0, 10_000)])),
}


def samples_at(time_s, noise=0.1):
    time_s = time_s - time_s[0]
    wave = np.exp(-0.05 * time_s) * np.cos(5.0 * time_s) + 0.2 * time_s
    return Samples.of_record(time_s, wave + noise * np.random.default_rng(1).normal(size=time_s.size))


@pytest.mark.parametrize("time_s", TIMES_S.values(), ids=TIMES_S)
def test_fewer_equations_have_the_normal_equations_and_the_squares_of_all_samples(time_s):
    samples = samples_at(time_s)
    fewer = samples.for_waves(6.0)
    assert fewer.time_s.size <= 1024
    model = SwingModel(samples, drift_degree=3)
    parameters = np.array([5.3, 0.04, 0.7, -0.6, 3.0, 2.0, 0.5, -0.2])
    residual, jacobian = model.linearise(parameters)
    less, of_less = SwingModel(fewer, drift_degree=3).linearise(parameters)
    # 1e-12: interpolation leaves 1e-13 of a wave, sums round by as much.
    size = np.linalg.norm(jacobian, axis=0)
    np.testing.assert_allclose(
        of_less.T @ of_less / np.outer(size, size), jacobian.T @ jacobian / np.outer(size, size), atol=1e-12
    )
    np.testing.assert_allclose(
        of_less.T @ less / size, jacobian.T @ residual / size, atol=1e-12 * np.linalg.norm(residual)
    )
    assert less @ less + fewer.rest == pytest.approx(residual @ residual, rel=1e-12)


@pytest.mark.parametrize("waveform", [None, WAVEFORMS[Quantity.acceleration]], ids=["linear", "pendulum"])
def test_a_fit_of_many_samples_ends_at_the_optimum_of_all_of_them(waveform):
    samples = samples_at(TIMES_S["uneven"])
    found = fit(SwingModel(samples, waveform=waveform), np.array([5.01, 0.05, 1.0, 0.0, 0.0, 0.0]))
    residual, jacobian = found.model.linearise(found.parameters)
    left = np.abs(jacobian.T @ residual) / np.linalg.norm(jacobian, axis=0)
    # The search ends within 1e-4 of a standard deviation: so small is the gradient then.
    assert np.max(left) < 1e-3 * np.std(residual)
    np.testing.assert_array_equal(found.residual, residual)
    assert found.squares == pytest.approx(residual @ residual, rel=1e-12)


def test_waves_that_are_not_slow_against_the_sampling_keep_their_samples():
    samples = samples_at(EVEN_S)
    assert samples.for_waves(400.0) is samples
    assert samples.for_waves(100.0, harmonics=5) is samples
    assert samples.for_waves(2.0).time_s.size < samples.for_waves(2.0, harmonics=5).time_s.size
    # No wave above the one for which there are nodes is let in.
    assert 6.0 <= samples.for_waves(6.0).highest_rad_s < 12.0
