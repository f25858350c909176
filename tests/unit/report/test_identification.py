from __future__ import annotations

import numpy as np
import pytest

from swayless.plant.identification import Quantity, SwingRecord, identify_swing
from swayless.report.identification import MOST_SAMPLES, identification_figure
from swayless.report.save import figure_bytes


def found(samples=2001, *, second=0.0, quantity=Quantity.position):
    time_s = 3.0 + np.linspace(0.0, 40.0, samples)
    noise = 0.01 * np.random.default_rng(1).normal(size=samples)
    value = np.exp(-0.02 * time_s) * np.cos(2.0 * time_s) + second * np.cos(5.0 * time_s) + 0.2 + noise
    return identify_swing(SwingRecord(time_s, value, quantity))


def test_the_figure_shows_record_fit_envelope_and_what_is_left():
    swing = found()
    figure = identification_figure("swing.csv", swing, unit="mm", unit_size=1e-3)
    top, bottom = figure.axes
    measured, fit, lower, upper = top.lines
    np.testing.assert_array_equal(measured.get_xdata(), swing.record.time_s)
    np.testing.assert_allclose(measured.get_ydata(), 1e3 * swing.record.value)
    # The fit follows the samples to their noise of 10 mm.
    drawn = np.interp(swing.record.time_s, fit.get_xdata(), fit.get_ydata())
    assert np.std(drawn - 1e3 * swing.record.value) == pytest.approx(10.0, rel=0.1)
    assert (upper.get_ydata() >= fit.get_ydata() - 1e-9).all()
    assert (lower.get_ydata() <= fit.get_ydata() + 1e-9).all()
    np.testing.assert_allclose(bottom.lines[0].get_ydata(), 1e3 * swing.fit.residual)
    assert (top.get_ylabel(), bottom.get_ylabel()) == ("Swing (mm)", "Left over (mm)")


def test_two_modes_have_no_envelope():
    assert len(identification_figure("swing.csv", found(second=0.5)).axes[0].lines) == 2


def test_long_records_are_thinned_out():
    top = identification_figure("swing.csv", found(samples=3 * MOST_SAMPLES)).axes[0]
    assert top.lines[0].get_xdata().size <= MOST_SAMPLES


def test_the_same_figure_has_the_same_bytes():
    first, second = (figure_bytes(identification_figure("swing.csv", found(201)), "svg") for _ in range(2))
    assert first == second
