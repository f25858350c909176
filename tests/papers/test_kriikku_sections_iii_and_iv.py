"""Kriikku, Singer and Singhose (1997), sections III and IV: the paper's page, its figures and numbers."""

from __future__ import annotations

import importlib.util
import json
import math
import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from scipy.optimize import linprog

from swayless.design import Shaper, design_shaper, partial_sums, residual_vibration, worst_residual
from swayless.design.robust import specified_insensitivity
from swayless.errors import DesignError
from swayless.plant import pendulum_mode

PAGE = Path(__file__).parents[2] / "docs" / "papers" / "kriikku-1997.md"
FOOT = 0.01  # lengths are quoted to a hundredth of a foot
TENTH = 0.0005  # residuals are quoted to a tenth of a percent


def loaded(path: Path) -> ModuleType:
    """The script that makes the page's tables and figures."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


paper = loaded(PAGE.parent / "kriikku_1997.py")


@pytest.fixture(scope="module")
def rows() -> list[Shaper]:
    """Three rows of 3.0 s by the algorithm, with as many impulses as it takes."""
    return paper.algorithm_rows()


def eq_1(shaper: Shaper, rope_ft: float) -> float:
    """Equation 1 without damping, of a rope length, with a pendulum of g / L."""
    angles = math.sqrt(9.80665 / (0.3048 * rope_ft)) * shaper.times_s
    return math.hypot(shaper.amplitudes @ np.cos(angles), shaper.amplitudes @ np.sin(angles))


def reaches_ft(shapers: list[Shaper]) -> list[float]:
    return [paper.held_ft(shaper)[1] for shaper in shapers]


# Section III: specified insensitivity, fig 6.


def test_fig_6_an_si_shaper_touches_the_tolerance_at_both_ends_and_between_and_never_passes_it():
    for shaper in paper.specified_rows().values():
        frequency_hz = np.linspace(paper.frequency_hz(20.0), paper.frequency_hz(4.0), 20001)
        residual = residual_vibration(shaper, frequency_hz)
        assert residual.max() <= 0.05 * (1.0 + 1e-9)
        inside = np.flatnonzero((residual[1:-1] > residual[:-2]) & (residual[1:-1] > residual[2:]))
        # Two humps between the ends; a grid of 20000 steps misses their tops by less than 1e-8.
        assert [*residual[[0, -1]], *residual[1:-1][inside]] == pytest.approx([0.05] * 4, abs=1e-7)


def test_fig_6_unity_magnitude_is_a_seventh_shorter_than_positive_amplitudes():
    durations_s = {name: shaper.duration_s for name, shaper in paper.specified_rows().items()}
    assert durations_s == pytest.approx({"positive": 4.9426, "unity magnitude": 4.2785}, abs=5e-5)


def least_on_points(duration_s: float, points_hz: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """Positive amplitudes of a duration that leave the least at some frequencies only: a linear program."""
    times_s = np.linspace(0.0, duration_s, 241)
    directions = np.exp(2j * np.pi * np.arange(64) / 64)  # |z| as a 64-gon: 0.1 % off at most
    waves = np.exp(2j * np.pi * np.outer(points_hz, times_s))
    planes = np.real(directions[:, np.newaxis, np.newaxis] * waves).reshape(-1, times_s.size)
    solved = linprog(
        [*np.zeros(times_s.size), 1.0],
        A_ub=np.column_stack([planes, -np.ones(len(planes))]),
        b_ub=np.zeros(len(planes)),
        A_eq=[[*np.ones(times_s.size), 0.0]],
        b_eq=[1.0],
    )
    return float(solved.fun), times_s, solved.x[:-1]


@pytest.mark.parametrize(("points", "left"), [(3, 0.104), (10, 0.053)])
def test_fig_6_eq_1_at_three_frequencies_leaves_twice_the_tolerance_between_them_and_at_ten_nearly_none(
    points, left
):
    # The paper applies eq 1 at N frequencies, and finds 3 to 10 often sufficient.
    band = paper.band_of(20.0, 4.0)
    points_hz = np.linspace(band.low_hz, band.high_hz, points)
    too_short_s, enough_s = 1.0, 1.001 * specified_insensitivity(band).shaper.duration_s
    for _ in range(16):  # a tenth of a millisecond
        middle_s = 0.5 * (too_short_s + enough_s)
        holds = least_on_points(middle_s, points_hz)[0] <= 0.05
        too_short_s, enough_s = (too_short_s, middle_s) if holds else (middle_s, enough_s)
    _, times_s, amplitudes = least_on_points(enough_s, points_hz)
    frequency_hz = np.linspace(band.low_hz, band.high_hz, 2001)
    everywhere = np.abs(amplitudes @ np.exp(2j * np.pi * np.outer(times_s, frequency_hz)))
    # The 64-gon, and times on a grid of 20 ms, may each be worth a thousandth.
    assert everywhere.max() == pytest.approx(left, abs=1e-3)


# Section III: unity magnitude, fig 7.


def test_fig_7_three_impulses_of_unity_magnitude_switch_fully_on_and_off_and_take_two_thirds_of_zv():
    shaper, positive = (design_shaper(name, pendulum_mode(24.0 * 0.3048)) for name in ("um-zv", "zv"))
    assert shaper.amplitudes.tolist() == [1.0, -1.0, 1.0]
    assert partial_sums(shaper).tolist() == [1.0, 0.0, 1.0]
    assert shaper.duration_s / positive.duration_s == pytest.approx(2.0 / 3.0, rel=1e-14)


# Section III: the fixed-duration algorithm.


def test_steps_3_and_4_each_row_holds_5_percent_from_its_start_and_not_beyond_its_end(rows):
    for shaper in rows:
        start_ft, end_ft = paper.held_ft(shaper)
        inside = max(eq_1(shaper, rope_ft) for rope_ft in np.linspace(end_ft, start_ft, 2001))
        assert inside <= 0.05 * (1.0 + 1e-9)
        assert eq_1(shaper, end_ft) == pytest.approx(0.05, rel=1e-9)
        assert eq_1(shaper, end_ft - 0.01) > 0.05
        assert shaper.duration_s == pytest.approx(3.0, rel=1e-12)


def test_step_5_each_row_starts_where_the_one_before_ends(rows):
    starts_ft = [paper.held_ft(shaper)[0] for shaper in rows]
    assert starts_ft == pytest.approx([29.0, *reaches_ft(rows)[:-1]], rel=1e-12)


def test_the_three_rows_end_at_24_65_20_23_and_9_72_ft(rows):
    assert reaches_ft(rows) == pytest.approx([24.65, 20.23, 9.72], abs=FOOT)
    assert [shaper.times_s.size for shaper in rows] == [5, 5, 7]


def test_with_five_impulses_the_three_rows_end_at_24_65_20_23_and_9_83_ft():
    assert reaches_ft(paper.algorithm_rows(5)) == pytest.approx([24.65, 20.23, 9.83], abs=FOOT)


def test_every_row_is_of_unity_magnitude_as_eq_3_asks(rows):
    for shaper in rows:
        assert shaper.amplitudes.tolist() == [(-1.0) ** i for i in range(shaper.times_s.size)]


def test_section_3_one_row_holds_20_to_8_ft_in_3_7_s_and_the_next_all_the_rest():
    # The paper supposes a first row of 20 to 8 ft. Any second one of that duration then reaches 4 ft.
    duration_s = specified_insensitivity(
        paper.band_of(20.0, 8.0), amplitudes="unity-magnitude"
    ).shaper.duration_s
    assert duration_s == pytest.approx(3.676, abs=5e-4)
    second = specified_insensitivity(paper.band_of(8.0, 4.0), amplitudes="unity-magnitude")
    assert second.shaper.duration_s < duration_s


# Section IV: the crane, fig 8.


def test_fig_8_nine_inches_after_40_cycles_were_25_inches_before():
    left = math.exp(-2.0 * math.pi * 40.0 * 0.004 / math.sqrt(1.0 - 0.004**2))
    assert 9.0 / left == pytest.approx(24.6, abs=0.05)


def test_section_4_the_damping_of_0_004_takes_at_most_0_13_percentage_points_off_what_is_left(rows):
    bands = [paper.band_of(29.0, 24.0), paper.band_of(24.0, 19.0), paper.band_of(19.0, 9.0)]
    for shaper, band in zip(rows, bands, strict=True):
        damped = worst_residual(shaper, band, damping_ratio=0.004)
        assert worst_residual(shaper, band) - 1.3e-3 < damped < worst_residual(shaper, band)


# Section IV: switch lengths, figs 9 and 10.


def test_figs_9_and_10_the_algorithm_s_rows_leave_6_6_7_8_and_11_1_percent_between_the_paper_s_lengths(rows):
    assert paper.left_by(rows) == pytest.approx([0.0663, 0.0781, 0.1115], abs=TENTH)


def test_figs_9_and_10_with_five_impulses_the_last_row_leaves_12_3_percent():
    assert paper.left_by(paper.algorithm_rows(5)) == pytest.approx([0.0663, 0.0781, 0.1226], abs=TENTH)


def test_figs_9_and_10_rows_from_29_24_and_19_ft_end_at_9_00_ft_and_leave_5_percent_but_for_two_gaps():
    shapers = paper.rows_from_paper_lengths()
    assert reaches_ft(shapers) == pytest.approx([24.65, 19.51, 9.00], abs=FOOT)
    assert shapers[2].times_s.size == 7
    assert paper.left_by(shapers) == pytest.approx([0.0663, 0.0614, 0.0500], abs=TENTH)


def test_figs_9_and_10_switched_where_they_cross_at_24_35_and_19_26_ft_those_rows_leave_5_8_percent():
    shapers = paper.rows_from_paper_lengths()
    for earlier, later, crossing_ft, left in zip(
        shapers, shapers[1:], (24.3496, 19.2624), (0.0575, 0.0556), strict=False
    ):
        residuals = [eq_1(shaper, crossing_ft) for shaper in (earlier, later)]
        assert residuals[0] == pytest.approx(residuals[1], abs=1e-5)  # the length is given to 1e-4 ft
        assert residuals[0] == pytest.approx(left, abs=5e-5)


def test_figs_9_and_10_row_2_of_the_algorithm_holds_5_percent_again_near_9_ft(rows):
    ropes_ft = np.linspace(9.0, 9.46, 101)
    assert max(eq_1(rows[1], rope_ft) for rope_ft in ropes_ft) < 0.05 < eq_1(rows[1], 9.47)


# Section IV: UM ZV, fig 11.


def test_fig_11_the_three_um_zv_shapers_hold_20_percent_if_switched_a_little_earlier():
    held_ft = [paper.held_ft(shaper) for shaper in paper.um_zv_rows()]
    assert np.ravel(held_ft) == pytest.approx([30.61, 19.58, 20.41, 13.06, 14.03, 8.98], abs=FOOT)


def test_section_4_fixed_duration_is_better_over_five_sixths_of_the_ropes_but_not_near_a_um_zv_design(rows):
    ropes_ft = np.linspace(9.0, 29.0, 2001)
    frequency_hz = [paper.frequency_hz(rope_ft) for rope_ft in ropes_ft]

    def left(shapers: list[Shaper], switches_ft: tuple[float, float]) -> np.ndarray:
        used = 2 - np.searchsorted(sorted(switches_ft), ropes_ft)
        residuals = np.array([residual_vibration(shaper, frequency_hz) for shaper in shapers])
        return residuals[used, np.arange(ropes_ft.size)]

    fixed = left(rows, (reaches_ft(rows)[0], reaches_ft(rows)[1]))
    um_zv = left(paper.um_zv_rows(), (20.0, 13.0))
    assert np.mean(fixed < um_zv) == pytest.approx(0.844, abs=2e-3)  # counted on 2001 ropes
    assert um_zv[ropes_ft == 24.0] < fixed[ropes_ft == 24.0]


# The page.


def test_every_table_of_the_page_is_what_the_script_prints():
    page = PAGE.read_text(encoding="utf-8")
    for name, table in paper.tables().items():
        assert table in page, f"{name}:\n{table}"


def test_every_figure_of_the_page_was_drawn_from_the_designs_of_today():
    page = PAGE.read_text(encoding="utf-8")
    figures = paper.figures()
    assert {path.stem for path in paper.FOLDER.glob("*")} == set(figures)
    for name, (figure, shapers) in figures.items():
        assert f"(kriikku_1997/{name}.svg)" in page
        assert figure.axes
        svg = (paper.FOLDER / f"{name}.svg").read_text(encoding="utf-8")
        drawn = json.loads(re.findall(r"<!-- (\[\[.*\]\]) -->", svg)[-1])
        fresh = json.loads(paper.drawn_from(shapers))
        assert len(drawn) == len(fresh)
        for stored, computed in zip(drawn, fresh, strict=True):
            assert stored == pytest.approx(computed, abs=2e-6)  # stored to six decimals
        assert "<path" in svg


def test_3_s_are_too_short_for_the_whole_range_at_once():
    shaper = specified_insensitivity(paper.band_of(29.0, 9.0), amplitudes="unity-magnitude").shaper
    assert shaper.duration_s > 3.0
    with pytest.raises(DesignError, match="too short"):
        paper.fixed_duration(0.5, paper.frequency_hz(29.0), amplitudes="unity-magnitude")
