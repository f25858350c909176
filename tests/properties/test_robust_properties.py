"""Whatever band, damping and tolerance: a robust design holds, and its proof leaves next to nothing open."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design import worst_residual
from swayless.design.robust import specified_insensitivity
from swayless.plant import Band


@settings(derandomize=True, deadline=None, max_examples=25)
@given(
    low_hz=st.floats(0.05, 20.0),
    ratio=st.floats(1.0, 8.0),
    damping_ratio=st.one_of(st.just(0.0), st.floats(0.0, 0.2)),
    tolerance=st.floats(0.02, 0.2),
    amplitudes=st.sampled_from(["positive", "bounded"]),
)
def test_every_band_is_held_within_the_proved_gap(
    low_hz: float, ratio: float, damping_ratio: float, tolerance: float, amplitudes: str
) -> None:
    band = Band(low_hz, low_hz * ratio)
    design = specified_insensitivity(
        band,
        tolerance=tolerance,
        damping_ratio=damping_ratio,
        amplitudes=amplitudes,  # type: ignore[arg-type]
    )
    # Peaks touch the tolerance to rounding.
    assert worst_residual(design.shaper, band, damping_ratio=damping_ratio) <= tolerance * (1.0 + 1e-8)
    assert 0.0 < design.gap_ratio <= 0.003
