from __future__ import annotations

import numpy as np
import pytest

from swayless.plant.identification.start import starts


@pytest.mark.parametrize("kept", [1.0, 0.3])
def test_the_energy_of_noise_does_not_depend_on_missing_samples(kept):
    rng = np.random.default_rng(4)
    time_s = np.arange(4000) * 0.01
    time_s = time_s[(rng.random(time_s.size) < kept) | (time_s == 0.0)]
    highest = np.mean([starts(time_s, rng.normal(size=time_s.size), 1)[0].energy for _ in range(30)])
    # The highest of m energies of white noise, each exponential of mean 1, is log(m) + 0.58 on the average:
    # 10 for the 2000 frequencies and some decays. Its mean over 30 records has a deviation of 0.24.
    assert 8.5 < highest < 11.5
