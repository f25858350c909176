"""Impulses +1, -1, ..., +1 of a given number: published rows, brute force, bounded optima, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design.minimax import AmplitudeRule
from swayless.design.robust import NotHeldError, exact
from swayless.design.robust.lines import Line
from swayless.design.robust.unity import least, shortest, widest
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import pendulum_frequency_hz, pendulum_rope_length_m

_FOOT_M = 0.3048


def _worst(times: FloatArray, line: Line) -> FloatArray:
    """Residual vibration from its definition, worst over a line, of times in the last axis."""
    frequency = np.linspace(line.low, line.high, 2001 if times.ndim == 1 else 60)
    signs = (-1.0) ** np.arange(times.shape[-1])
    lag = times - times[..., -1:]
    total = np.zeros((*times.shape[:-1], frequency.size), dtype=np.complex128)
    for i, sign in enumerate(signs):
        total += sign * np.exp(np.multiply.outer(lag[..., i], frequency * line.turn))
    worst: FloatArray = np.abs(total).max(axis=-1)
    return worst


def test_kriikku_gantry_rows_of_3_s_with_five_impulses() -> None:
    reached_ft = [29.0]
    for _ in range(3):
        start_hz = pendulum_frequency_hz(reached_ft[-1] * _FOOT_M)
        optimum = widest(3.0 * start_hz, 0.0, 0.05, 5)
        end_hz = start_hz * float(optimum.frequency[-1])
        reached_ft.append(pendulum_rope_length_m(end_hz) / _FOOT_M)
    assert np.round(reached_ft[1:], 2).tolist() == [24.65, 20.23, 9.83]


@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
def test_least_is_not_beaten_by_any_five_impulses_on_a_grid(damping_ratio: float) -> None:
    line, duration = Line(1.0, 1.25, damping_ratio), 0.5
    optimum = least([line], duration, 5)
    grid = np.linspace(0.0, 1.0, 41)
    first, second, third = np.array(
        [(a, b, c) for a in grid[1:-1] for b in grid[grid > a] for c in grid[grid > b] if c < 1.0]
    ).T
    times = duration * np.column_stack([0.0 * first, first, second, third, np.ones_like(first)])
    best = float(_worst(times, line).min())
    # 60 frequencies miss at most 0.1 % of a peak; a step of the grid costs up to a third.
    assert optimum.worst * 0.999 < best < optimum.worst * 1.35


@pytest.mark.parametrize(
    ("tolerance", "high", "damping_ratio", "count"),
    [(0.05, 1.2, 0.0, 5), (0.05, 1.5, 0.0, 7), (0.01, 1.2, 0.0, 7), (0.2, 1.5, 0.2, 5), (0.01, 1.5, 0.0, 9)],
)
def test_the_bounded_optimum_is_found_where_it_has_so_many_impulses(
    tolerance: float, high: float, damping_ratio: float, count: int
) -> None:
    lines = [Line(1.0, high, damping_ratio)]
    bounded = exact.shortest(lines, tolerance, AmplitudeRule.BOUNDED)
    assert bounded.times.size == count
    # Both are solved to rounding.
    assert shortest(lines, tolerance, count).duration == pytest.approx(bounded.duration, rel=1e-10)


def test_several_lines_are_held_together() -> None:
    lines = [Line(1.0, 1.1, 0.0), Line(1.0, 1.1, 0.1)]
    optimum = shortest(lines, 0.08, 5)
    assert max(float(_worst(optimum.times, line)) for line in lines) <= 0.08 * (1.0 + 1e-9)
    assert optimum.duration >= exact.shortest(lines, 0.08, AmplitudeRule.BOUNDED).duration * (1.0 - 1e-9)


@settings(max_examples=5, deadline=None, derandomize=True)
@given(
    st.floats(0.35, 0.6),
    st.floats(1.01, 1.3),
    st.floats(0.0, 0.2),
    st.sampled_from([3, 5]),
    st.floats(0.02, 0.2),
)
def test_what_is_found_keeps_its_promise_or_is_refused(
    duration: float, high: float, damping_ratio: float, count: int, tolerance: float
) -> None:
    line = Line(1.0, high, damping_ratio)
    for solve in (lambda: least([line], duration, count), lambda: shortest([line], tolerance, count)):
        try:
            optimum = solve()
        except DesignError as error:
            assert "impulses" in str(error)  # noqa: PT017 - a refusal is one of two right answers
            continue
        assert optimum.times.size == count
        assert float(_worst(optimum.times, line)) <= optimum.worst * (1.0 + 1e-9)
        assert np.array_equal(optimum.amplitudes, (-1.0) ** np.arange(count))


def test_the_widest_band_is_held_and_ends_at_the_tolerance() -> None:
    optimum = widest(0.5, 0.05, 0.1, 5)
    edge = float(optimum.frequency[-1])
    assert float(_worst(optimum.times, Line(1.0, edge, 0.05))) == pytest.approx(0.1, rel=1e-9)
    assert float(_worst(optimum.times, Line(1.0, edge * 1.001, 0.05))) > 0.1


def test_three_impulses_at_one_frequency_are_the_vector_diagram() -> None:
    optimum = shortest([Line(1.0, 1.0, 0.0)], 0.05, 3)
    # 2 cos(pi T) - 1 = V: three unit vectors, the outer two a half turn T to each side.
    assert optimum.duration == pytest.approx(math.acos(0.5 * 1.05) / math.pi, rel=1e-9)  # solved to rounding


def test_too_few_impulses_are_refused_with_what_they_leave() -> None:
    with pytest.raises(DesignError, match=r"3 impulses .* leave 16\.\d % on the band at best; more impulses"):
        shortest([Line(1.0, 1.2, 0.0)], 0.05, 3)


def test_too_many_impulses_are_refused_with_how_many_are_as_good() -> None:
    with pytest.raises(DesignError, match=r"no better than 5, .* ask for 5"):
        shortest([Line(1.0, 1.2, 0.0)], 0.05, 9)


def test_a_duration_that_holds_nothing_is_refused() -> None:
    with pytest.raises(DesignError, match="on the lowest frequency at best"):
        widest(0.2, 0.0, 0.05, 5)


def test_a_tolerance_missed_by_little_is_refused_with_what_is_left_at_the_peaks() -> None:
    # Samples alone see 0.994 %, between which the peaks are higher.
    with pytest.raises(NotHeldError, match=r"leave 1\.0\d % on the band at best"):
        shortest([Line(1.0, 1.5, 0.0)], 0.01, 7)


@pytest.mark.parametrize("count", [1, 4])
def test_numbers_of_impulses_that_cannot_be_are_refused(count: int) -> None:
    with pytest.raises(DesignError, match=rf"impulses = {count}: must be odd and at least 3"):
        least([Line(1.0, 1.1, 0.0)], 0.5, count)
