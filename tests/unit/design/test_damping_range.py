"""The worst of a damping range is on its border: against dense sampling of what lies inside."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.design import Guarantee, Shaper, residual_vibration, worst_residual_promised
from swayless.plant import Band, Mode


@pytest.mark.parametrize("seed", range(8))
def test_no_damping_ratio_inside_a_range_leaves_more_than_its_border(seed: int) -> None:
    rng = np.random.default_rng(seed)
    times_s = np.append(0.0, np.cumsum(rng.uniform(0.05, 0.6, 6)))
    promise = Guarantee(1.0, Mode(1.0, 0.02), Band(0.6, 2.2), 1.0, highest_damping_ratio=0.2)
    shaper = Shaper(times_s, rng.dirichlet(np.ones(7)), "random", promise, "none")
    worst = worst_residual_promised(shaper, promise)
    frequency_hz, damping_ratio = np.meshgrid(np.linspace(0.6, 2.2, 801), np.linspace(0.02, 0.2, 181))
    inside = residual_vibration(shaper, frequency_hz, damping_ratio=damping_ratio).max()
    assert inside <= worst * (1.0 + 1e-12)  # rounding
    # Samples are 0.002 Hz and 0.001 apart, and V is flat at its largest or met at a corner.
    assert inside >= worst * (1.0 - 1e-3)
