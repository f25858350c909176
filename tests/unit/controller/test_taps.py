"""What taps, banks and settings refuse, and what quantising keeps."""

from dataclasses import dataclass

import numpy as np
import pytest

from swayless.controller import Bank, Row, Taps, number_type, quantised_taps
from swayless.controller.taps import RopeRows
from swayless.design.residual import residual_vibration
from swayless.design.robustness import guarantee_of
from swayless.errors import ControllerError
from swayless.plant import Mode
from tests.unit.controller.blocks import GUARANTEE, TICK_S, UM_SPLIT, ZVD, block, taps

REFUSED = [
    ([0, 2], [0.5], "must be non-empty and of one length"),
    ([], [], "must be non-empty and of one length"),
    ([1, 2], [0.5, 0.5], r"must start at 0 and increase, got \[1, 2\]"),
    ([0, 2, 2], [0.5, 0.25, 0.25], r"must start at 0 and increase, got \[0, 2, 2\]"),
    ([0, 2], [0.5, 0.25], "do not sum to exactly 1 in double"),
    (
        [0, 2, 4],
        [1.5, -1.0, 0.5],
        "would take the reference from 0.5 to 1.5 times the step; allowed is 0 to 1",
    ),
]


@pytest.mark.parametrize(("delays", "amplitudes", "message"), REFUSED)
def test_taps_refuse(delays, amplitudes, message):
    with pytest.raises(ControllerError, match=message):
        Taps(np.array(delays, dtype=int), np.array(amplitudes), TICK_S, GUARANTEE, number_type("double"))


def test_taps_refuse_amplitudes_off_the_lattice_of_their_type():
    with pytest.raises(ControllerError, match="do not sum to exactly 1 in float"):
        Taps(
            np.array([0, 2]),
            np.array([0.5 + 2.0**-30, 0.5 - 2.0**-30]),
            TICK_S,
            GUARANTEE,
            number_type("float"),
        )


@pytest.mark.parametrize("tick_s", [0.0, -1.0, np.inf, np.nan])
def test_taps_refuse_a_tick_that_is_none(tick_s):
    with pytest.raises(ControllerError, match=r"tick_s = .*: must be finite and > 0"):
        taps(ZVD, tick_s=tick_s)


def test_taps_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        taps(ZVD).amplitudes[0] = 0.3


@dataclass(frozen=True)
class Impulses:
    """The least that the design room calls impulses."""

    times_s: np.ndarray
    amplitudes: np.ndarray


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_quantised_taps_hold_the_guarantee_in_every_number_type(number):
    mode, kind = Mode(0.5, 0.02), number_type(number)
    ratio = np.exp(-np.pi * 0.02 / np.sqrt(1.0 - 0.02**2))
    amplitudes = np.array([1.0, 2.0 * ratio, ratio**2]) / (1.0 + ratio) ** 2  # ZVD
    delays, tick_s = np.array([0, 1000, 2000]), mode.damped_period_s / 2000
    held = guarantee_of(Impulses(delays * tick_s, amplitudes), mode, tolerance=0.05)
    made = quantised_taps(delays, amplitudes, tick_s, held, kind)
    assert sum(made.numerators) == 1 << kind.amplitude_bits
    left = residual_vibration(made, mode.frequency_hz, damping_ratio=0.02)
    # Three amplitudes, each moved by at most a unit of the lattice, and rounding of the exponentials.
    assert left <= 3 * 2.0**-kind.amplitude_bits + 1e-12


def test_quantised_taps_refuse_what_does_not_hold_the_guarantee():
    with pytest.raises(ControllerError, match=r"leave .* % where 5 % is promised between 0.49 and 0.51 Hz"):
        quantised_taps(np.array([0, 3]), np.array([0.5, 0.5]), TICK_S, GUARANTEE, number_type("double"))


def test_a_bank_refuses_what_does_not_fit_together():
    row = Row("a", "zvd", taps(ZVD))
    for rows, message in (
        ((), "1 to 254 rows, got 0"),
        ((row,) * 255, "1 to 254 rows, got 255"),
        ((row, Row("b", "zvd", taps(ZVD, tick_s=0.01))), "one tick and one number type"),
        ((row, Row("b", "zvd", taps(ZVD, number="float"))), "one tick and one number type"),
        ((Row("b", "none", taps(((0, 1.0),))),), "a single tap shapes nothing"),
    ):
        with pytest.raises(ControllerError, match=message):
            Bank(rows)
    with pytest.raises(ControllerError, match="2 rope intervals for 1 rows"):
        Bank((row,), RopeRows((6.0, 3.0), (9.0, 7.0)))


def test_row_tables_hold_the_unshaped_row_and_the_exact_moments():
    settings = block(ZVD, UM_SPLIT)
    unshaped, zvd, split = settings.row_tables
    assert (unshaped.amplitudes, unshaped.tail, unshaped.moment) == ((1.0,), 0, 0)
    assert (zvd.moment, zvd.waits) == (4, False)
    assert (float(split.moment), split.waits) == (pytest.approx(-0.9 - 2.8 + 7.0, rel=1e-15), True)


def test_sums_of_products_beyond_64_bits_are_refused():
    tall = tuple((k, 1.0 if k % 2 == 0 else -1.0) for k in range(17))
    with pytest.raises(ControllerError, match="exceed 64 bits: lower counts_per_m_s"):
        block(tall, number="int32", units_per_m_s=2.0**29)
    block(tall[:15], number="int32", units_per_m_s=2.0**29)
