"""Every solved family against independent solutions at 30 digits, and against its own equations."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from swayless.design import design_shaper, residual_vibration, worst_residual
from swayless.plant import Mode

EXACT = json.loads(Path(__file__).with_name("exact_values.json").read_text())


def label(row):
    return f"{row['family']}-{row['tolerance']}-{row['damping_ratio']}"


def designed(row):
    mode = Mode(1.0, row["damping_ratio"])
    return design_shaper(row["family"], mode, tolerance=row["tolerance"])


@pytest.mark.parametrize("row", EXACT, ids=label)
def test_times_and_amplitudes_equal_the_independent_solution(row):
    shaper = designed(row)
    # A few roundings of numbers of order 1, times the condition of the equations: 250 at worst.
    assert shaper.times_s == pytest.approx(row["times_s"], abs=1e-13)
    assert shaper.amplitudes == pytest.approx(row["amplitudes"], abs=1e-13)


@pytest.mark.parametrize("row", EXACT, ids=label)
def test_the_worst_residual_in_the_promised_band_is_the_tolerance(row):
    shaper = designed(row)
    worst = worst_residual(shaper, shaper.guarantee.band, damping_ratio=row["damping_ratio"])
    assert worst == pytest.approx(row["tolerance"], rel=1e-9)


@pytest.mark.parametrize("row", [row for row in EXACT if "ei" in row["family"]], ids=label)
def test_the_humps_stand_at_the_tolerance_between_zeros(row):
    shaper = designed(row)
    band = shaper.guarantee.band  # with much damping it has no upper end, but the marks stay below 3 Hz
    frequency_hz = np.linspace(band.low_hz, min(band.high_hz, 3.0), 400_001)
    ratio = residual_vibration(shaper, frequency_hz, damping_ratio=row["damping_ratio"])
    inner = ratio[1:-1]
    humps = inner[(inner > ratio[:-2]) & (inner >= ratio[2:])]
    zeros = inner[(inner < ratio[:-2]) & (inner <= ratio[2:])]
    # V rises by at most 2 pi t_n = 13 per Hz: 8e-5 beside a zero at this spacing, squared beside a hump.
    expected = {"ei": 1, "ei2": 2, "ei3": 3, "um-ei": 1}[row["family"]]
    assert humps == pytest.approx(np.full(expected, row["tolerance"]), abs=1e-6)
    assert zeros == pytest.approx(np.zeros(expected + 1), abs=1e-4)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05, 0.1, 0.2])
def test_um_zv_satisfies_its_two_equations(damping_ratio):
    shaper = design_shaper("um-zv", Mode(1.0, damping_ratio))
    phase = 2.0 * math.pi * complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2)) * shaper.times_s
    assert abs(np.exp(phase) @ shaper.amplitudes) < 2e-15  # three terms of order 1
