"""Gaps between ranges."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import DesignError
from swayless.report.ranges import TOUCHING_RATIO, Range, uncovered

NUMBERS = st.floats(-1.0, 11.0)
RANGES = st.lists(st.tuples(NUMBERS, NUMBERS).map(lambda pair: (min(pair), max(pair))), max_size=8)
WHOLE = (0.0, 10.0)


@pytest.mark.parametrize(
    ("ranges", "gaps"),
    [
        ([], [(0.0, 10.0)]),
        ([(-1.0, 11.0)], []),
        ([(0.0, 10.0)], []),
        ([(2.0, 3.0)], [(0.0, 2.0), (3.0, 10.0)]),
        ([(5.0, 10.0), (0.0, 5.0)], []),
        ([(0.0, 4.0), (6.0, 10.0)], [(4.0, 6.0)]),
        ([(0.0, 9.0), (1.0, 2.0), (9.5, 10.0)], [(9.0, 9.5)]),
        ([(-5.0, -1.0), (12.0, 13.0)], [(0.0, 10.0)]),
    ],
)
def test_gaps_are_what_no_range_covers(ranges: list[Range], gaps: list[Range]) -> None:
    assert uncovered(ranges, WHOLE) == gaps


def test_ranges_that_miss_each_other_by_rounding_touch() -> None:
    assert uncovered([(0.0, 5.0), (5.0 + 1e-12, 10.0)], WHOLE) == []
    assert uncovered([(0.0, 5.0), (5.0 + 1e-6, 10.0)], WHOLE) == [(5.0, 5.0 + 1e-6)]


@settings(derandomize=True, deadline=None)
@given(RANGES, st.floats(0.0, 10.0))
def test_a_point_lies_in_a_range_or_in_a_gap(ranges: list[Range], point: float) -> None:
    gaps = uncovered(ranges, WHOLE)
    held = any(low <= point <= high for low, high in ranges)
    assert not (held and any(low < point < high for low, high in gaps))
    # A point that is neither lies in a gap that is too narrow to count.
    neighbours = [
        (low - 10.0 * TOUCHING_RATIO, high + 10.0 * TOUCHING_RATIO) for low, high in [*ranges, *gaps]
    ]
    assert any(low <= point <= high for low, high in neighbours)


@settings(derandomize=True, deadline=None)
@given(RANGES)
def test_gaps_rise_and_stay_inside_the_whole(ranges: list[Range]) -> None:
    ends = [end for gap in uncovered(ranges, WHOLE) for end in gap]
    assert ends == sorted(ends)
    assert all(0.0 <= end <= 10.0 for end in ends)


@pytest.mark.parametrize(
    ("ranges", "whole"),
    [
        ([(3.0, 2.0)], WHOLE),
        ([(math.nan, 2.0)], WHOLE),
        ([], (5.0, 5.0)),
        ([], (5.0, 1.0)),
        ([], (0.0, math.inf)),
    ],
)
def test_falling_or_infinite_ranges_are_refused(ranges: list[Range], whole: Range) -> None:
    with pytest.raises(DesignError, match="must be finite and rise"):
        uncovered(ranges, whole)
