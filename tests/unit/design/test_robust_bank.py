"""Banks: as few rows as a tolerance allows, or as exact ones as their number allows."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from swayless.design import GridShaper, Shaper
from swayless.design.robust import RobustDesign
from swayless.design.robust.bank import ContinuousRows, RowDesigner, TickRows, cover, cover_with
from swayless.design.robust.ticks import RobustTaps
from swayless.errors import DesignError
from swayless.plant import pendulum_frequency_hz, pendulum_rope_length_m

FOOT_M = 0.3048
ROUNDING_FT = 0.0006  # the lengths are quoted to a thousandth of a foot
TOUCH = 1.0 + 1e-8  # peaks touch the tolerance to rounding
BOUNDED, ON_TICKS = ContinuousRows("bounded"), TickRows(0.01, "bounded")


def _frequency_hz(rope_ft: float) -> float:
    return pendulum_frequency_hz(rope_ft * FOOT_M)


LOW_HZ, HIGH_HZ = _frequency_hz(29.0), _frequency_hz(9.0)


def _impulses(row: RobustDesign | RobustTaps) -> Shaper | GridShaper:
    return row.shaper if isinstance(row, RobustDesign) else row.taps


def _worst(row: RobustDesign | RobustTaps, damping_ratio: float = 0.0) -> float:
    """Worst residual over the promised band from its definition, 50 times finer than it ripples."""
    impulses = _impulses(row)
    band, lag_s = impulses.guarantee.band, impulses.times_s - impulses.times_s[-1]
    points = 2000 + math.ceil(50.0 * impulses.duration_s * (band.high_hz - band.low_hz))
    turn = 2.0 * math.pi * complex(damping_ratio, math.sqrt(1.0 - damping_ratio**2))
    columns = np.exp(np.multiply.outer(np.linspace(band.low_hz, band.high_hz, points) * turn, lag_s))
    return float(np.abs(columns @ impulses.amplitudes).max())


def _reach_ft(rows: tuple[RobustDesign, ...] | tuple[RobustTaps, ...]) -> list[float]:
    return [pendulum_rope_length_m(_impulses(row).guarantee.band.high_hz) / FOOT_M for row in rows]


def test_kriikku_section_iii_at_3_s_and_5_percent_bounded_rows_reach_these_lengths() -> None:
    rows = cover(LOW_HZ, HIGH_HZ, BOUNDED, duration_s=3.0)
    assert _reach_ft(rows)[:3] == pytest.approx([24.654, 20.230, 9.718], abs=ROUNDING_FT)
    assert len(rows) == 4
    assert all(row.shaper.duration_s == pytest.approx(3.0, rel=1e-12) for row in rows)


def test_kriikku_section_iii_positive_rows_are_seven() -> None:
    assert len(cover(LOW_HZ, HIGH_HZ, ContinuousRows(), duration_s=3.0)) == 7


def test_kriikku_section_iii_three_rows_of_3_s_hold_5_382_percent() -> None:
    rows = cover_with(3, LOW_HZ, HIGH_HZ, BOUNDED, duration_s=3.0)
    tolerances = [row.shaper.guarantee.tolerance for row in rows]
    assert tolerances == pytest.approx([0.05382] * 3, abs=5e-6)  # quoted to four digits
    # The last row's duration is right to 1e-9, which tolerances follow tenfold at most.
    np.testing.assert_allclose(tolerances, tolerances[0], rtol=1e-7)


def test_kriikku_section_iii_rows_of_five_impulses_reach_these_lengths() -> None:
    rows = cover(LOW_HZ, HIGH_HZ, ContinuousRows("unity-magnitude", impulses=5), duration_s=3.0)
    assert _reach_ft(rows) == pytest.approx([24.654, 20.230, 9.830, 9.0], abs=ROUNDING_FT)
    assert all(np.array_equal(row.shaper.amplitudes, [1.0, -1.0, 1.0, -1.0, 1.0]) for row in rows)
    assert all(_worst(row) <= row.shaper.guarantee.tolerance * TOUCH for row in rows)


def test_rows_meet_and_hold_the_tolerance() -> None:
    rows = cover(0.2, 0.6, BOUNDED, tolerance=0.05, longest_duration_s=2.6)
    bands = [row.shaper.guarantee.band for row in rows]
    assert bands[0].low_hz == 0.2
    assert bands[-1].high_hz == 0.6
    assert all(one.high_hz == other.low_hz for one, other in pairwise(bands))
    assert all(row.shaper.duration_s <= 2.6 * (1.0 + 1e-9) for row in rows)
    assert all(_worst(row) <= 0.05 * TOUCH for row in rows)


def test_rows_on_ticks_hold_what_they_promise_and_reach_as_far_to_a_thousandth() -> None:
    rows = cover(LOW_HZ, HIGH_HZ, ON_TICKS, duration_s=3.0)
    assert _reach_ft(rows)[:3] == pytest.approx([24.654, 20.230, 9.718], abs=0.001)
    assert all(row.taps.duration_s == pytest.approx(3.0, rel=1e-12) for row in rows)
    assert all(_worst(row) <= row.taps.guarantee.tolerance <= 0.05 for row in rows)


@pytest.mark.parametrize("tick_s", [0.01, 0.3])
def test_a_number_of_rows_on_ticks_is_balanced_by_what_taps_leave(tick_s: float) -> None:
    rows = cover_with(2, LOW_HZ, HIGH_HZ, TickRows(tick_s, "bounded"), duration_s=4.0)
    left = [row.taps.guarantee.tolerance for row in rows]
    # Three rounds bring the rows of coarse ticks within 1 %, those of fine ones far nearer.
    assert left == pytest.approx([max(left)] * 2, rel=0.01 if tick_s > 0.1 else 1e-5)
    assert all(_worst(row) <= row.taps.guarantee.tolerance * TOUCH for row in rows)


def test_rows_start_where_labels_in_whole_feet_let_them() -> None:
    def next_start_hz(end_hz: float) -> float:
        return _frequency_hz(math.floor(pendulum_rope_length_m(end_hz) / FOOT_M) + 1.0)

    rows = cover(LOW_HZ, HIGH_HZ, BOUNDED, duration_s=3.5, next_start_hz=next_start_hz)
    starts_ft = [pendulum_rope_length_m(row.shaper.guarantee.band.low_hz) / FOOT_M for row in rows]
    assert starts_ft == pytest.approx([29.0, 22.0, 10.0], rel=1e-12)
    assert all(_worst(row) <= row.shaper.guarantee.tolerance * TOUCH for row in rows)


@pytest.mark.parametrize("rows", [BOUNDED, ON_TICKS])
@pytest.mark.parametrize("given", ["duration_s", "longest_duration_s"])
def test_one_length_takes_one_row(
    rows: RowDesigner[RobustDesign] | RowDesigner[RobustTaps], given: str
) -> None:
    (row,) = cover(LOW_HZ, LOW_HZ, rows, **{given: 5.0})  # type: ignore[arg-type, misc, type-var]
    fixed = given == "duration_s"  # then it reaches farther at 1 %
    impulses = _impulses(row)
    assert impulses.guarantee.tolerance == (0.01 if fixed else 0.05)
    assert (impulses.duration_s == pytest.approx(5.0, rel=1e-12)) is fixed
    assert _worst(row) <= impulses.guarantee.tolerance * TOUCH


def test_progress_counts_the_rows() -> None:
    counted: list[int] = []
    cover(0.5, 1.0, BOUNDED, duration_s=1.2, on_row=counted.append)
    assert counted == [1, 2]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: cover(0.2, 0.6, BOUNDED), r"either duration_s or longest_duration_s"),
        (
            lambda: cover(0.2, 0.6, BOUNDED, duration_s=3.0, longest_duration_s=3.0),
            r"either duration_s or longest_duration_s",
        ),
        (lambda: cover_with(0, 0.2, 0.6, BOUNDED, duration_s=3.0), r"rows = 0: must be 1 to 8"),
        (lambda: cover_with(9, 0.2, 0.6, BOUNDED, duration_s=3.0), r"rows = 9: must be 1 to 8"),
        (
            lambda: cover_with(1, 0.2, 0.6, ContinuousRows(), duration_s=2.4),
            r"more rows or a longer duration do",
        ),
        (lambda: cover_with(3, 0.2, 0.3, BOUNDED, duration_s=9.0), r"at 0.01 already; fewer rows"),
        (lambda: cover(0.2, 0.6, BOUNDED, duration_s=0.5), r"too short"),
        (lambda: cover(0.2, 0.6, BOUNDED, duration_s=20.0), r"a longest one instead of a fixed one"),
        (
            lambda: cover(0.2, 0.6, BOUNDED, duration_s=2.6, next_start_hz=lambda end_hz: 0.8 * end_hz),
            r"less overlap, a longer duration or a larger tolerance do",
        ),
        (
            lambda: cover(LOW_HZ, 5.0 * LOW_HZ, ContinuousRows(), duration_s=2.9),
            r"more than 8 rows of 2.9 s; 8 rows of 3 s do",
        ),
    ],
)
def test_refusals_say_what_is_allowed(call: Callable[[], object], message: str) -> None:
    with pytest.raises(DesignError, match=message):
        call()
