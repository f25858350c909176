"""A proof counts only frequencies that are asked for."""

import pytest

from swayless.design.robust import exact, specified_insensitivity
from swayless.plant import Band


@pytest.mark.parametrize(
    ("ratio", "tolerance", "damping_ratio"),
    [(3.3482814037785054, 0.05774083985250555, 0.015042222362880886), (2.0, 0.05, 0.0)],
)
def test_no_proof_rests_on_a_peak_outside_the_band(monkeypatch, ratio, tolerance, damping_ratio):
    proofs = []

    def recorded(optimum):
        proofs.append(optimum.frequency)
        return certificate_of(optimum)

    certificate_of = exact.certificate_of
    monkeypatch.setattr(exact, "certificate_of", recorded)
    design = specified_insensitivity(
        Band(1.0, ratio), tolerance=tolerance, damping_ratio=damping_ratio, amplitudes="bounded"
    )
    assert 0.0 < design.gap_ratio < 3e-3
    for frequency in proofs:
        assert frequency.min() >= 1.0
        assert frequency.max() <= ratio


def test_a_peak_beyond_the_band_proves_nothing():
    lines = [exact.Line(1.0, 2.0, 0.0)]
    optimum = exact.shortest(lines, 0.05, exact.AmplitudeRule.POSITIVE)
    assert exact._on_lines(optimum, lines)
    assert not exact._on_lines(optimum, [exact.Line(1.0, 1.5, 0.0)])
    assert not exact._on_lines(optimum, [exact.Line(1.0, 2.0, 0.01)])
