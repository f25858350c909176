"""Kriikku, Singer and Singhose (1997), section III: fixed-duration shapers of the 15-ton gantry crane."""

from __future__ import annotations

import pytest

from swayless.design.robust import RobustDesign
from swayless.design.robust.bank import ContinuousRows, cover, cover_with
from swayless.plant import pendulum_frequency_hz, pendulum_rope_length_m

FOOT_M = 0.3048
RANGE_HZ = tuple(pendulum_frequency_hz(rope_ft * FOOT_M) for rope_ft in (29.0, 9.0))
ROUNDING_FT = 0.006  # the lengths are quoted to a hundredth of a foot


def _switch_lengths_ft(rows: tuple[RobustDesign, ...]) -> list[float]:
    return [pendulum_rope_length_m(row.shaper.guarantee.band.high_hz) / FOOT_M for row in rows]


def test_section_iii_at_3_s_and_5_percent_takes_four_bounded_rows() -> None:
    rows = cover(*RANGE_HZ, ContinuousRows("bounded"), duration_s=3.0)
    ends_ft = _switch_lengths_ft(rows)
    assert ends_ft[:3] == pytest.approx([24.65, 20.23, 9.72], abs=ROUNDING_FT)
    assert len(rows) == 4
    assert ends_ft[3] <= 9.0
    assert [row.shaper.times_s.size for row in rows[:3]] == [5, 5, 7]
    assert all(row.shaper.duration_s == pytest.approx(3.0, rel=1e-12) for row in rows)


def test_section_iii_three_rows_of_3_s_hold_5_4_percent_and_no_three_hold_less() -> None:
    rows = cover_with(3, *RANGE_HZ, ContinuousRows("bounded"), duration_s=3.0)
    assert len(rows) == 3
    assert rows[0].shaper.guarantee.tolerance == pytest.approx(0.054, abs=5e-4)


def test_section_iii_positive_amplitudes_take_seven_rows_of_3_s() -> None:
    rows = cover(*RANGE_HZ, ContinuousRows(), duration_s=3.0)
    assert len(rows) == 7
