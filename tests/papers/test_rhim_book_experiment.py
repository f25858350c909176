"""Rhim and Book, figs 6 to 9: the experiment by simulation, its page, figures and numbers."""

from __future__ import annotations

import importlib.util
import json
import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from swayless.controller.adaptive.delays import check_delay
from swayless.errors import ControllerError

PAGE = Path(__file__).parents[2] / "docs" / "papers" / "rhim-book.md"


def loaded(path: Path) -> ModuleType:
    """The script that makes the page's tables and figures."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


paper = loaded(PAGE.parent / "rhim_book.py")


def test_fig_6_the_vibration_falls_to_the_noise_after_the_transfer_and_stays():
    rms = paper.shown().rms_of_cycles()
    assert rms[0] > 9.0
    # Asked is twice the noise; the second cycle still has what the first one left, decaying by its damping.
    assert rms[1] < 2.5
    assert rms[2:].max() < 0.05


def test_fig_6_the_coefficients_start_from_a_third_and_converge_to_eq_4_in_the_first_cycle():
    coefficients = paper.shown().coefficients
    assert coefficients[0] == pytest.approx(np.full(3, 1.0 / 3.0), abs=1e-14)
    assert np.abs(coefficients.sum(axis=1) - 1.0).max() == 0.0
    wanted = paper.analytic(paper.DELAY_TICKS).amplitudes
    # 5 % of noise over a window of 200 samples.
    assert coefficients[paper.CYCLE_TICKS] == pytest.approx(wanted, abs=2e-3)


def test_figs_7_and_8_the_minimum_comes_to_16_hz_with_the_first_window_and_stays():
    times_s, levels = paper.contour()
    near = (paper.HERTZ > 10.0) & (paper.HERTZ < 20.0)
    lowest_hz = paper.HERTZ[near][levels[:, near].argmin(axis=1)]
    first_window_s = 0.001 * (paper.RAMP_TICKS + 101 + 200)
    assert (lowest_hz[times_s > first_window_s] == 16.0).all()  # on a grid of half hertz
    assert lowest_hz[0] != 16.0


def test_fig_9_the_minimum_of_the_converged_shaper_is_at_16_hz():
    magnitude = paper.magnitudes(paper.shown().coefficients[-1:])[0]
    near = (paper.HERTZ > 4.0) & (paper.HERTZ < 20.0)
    assert paper.HERTZ[near][magnitude[near].argmin()] == 16.0
    assert magnitude[0] == pytest.approx(1.0, abs=1e-15)
    assert paper.left_behind(paper.DELAY_TICKS) < 1e-3


@pytest.mark.parametrize("delay_ticks", paper.DELAYS_TICKS)
def test_other_delays_all_show_very_similar_results(delay_ticks):
    rms = paper.delays()[delay_ticks][1]
    assert rms[0] > 9.0
    assert rms[1] < 2.5
    assert rms[2:].max() < 0.1


def test_a_delay_of_half_a_period_is_refused_where_the_mode_is_known():
    with pytest.raises(ControllerError, match=r"must be at most 0\.95"):
        check_delay(31, 0.001, paper.MODE, 1.0)


def test_eqs_13_to_16_as_printed_drift_on_noise_and_the_block_does_not():
    found = paper.variants()
    for printed in list(found)[:2]:
        for rms in found[printed]:
            assert rms[-1] > 1.3  # and rising: more than the noise itself
    assert max(rms[2:].max() for rms in found["here"]) < 0.1


def test_every_table_of_the_page_is_what_the_script_prints():
    page = PAGE.read_text(encoding="utf-8")
    for name, table in paper.tables().items():
        assert table in page, f"{name}:\n{table}"


def test_every_figure_of_the_page_was_drawn_from_the_numbers_of_today():
    page = PAGE.read_text(encoding="utf-8")
    figures = paper.figures()
    assert {path.stem for path in paper.FOLDER.glob("*")} == set(figures)
    for name, (figure, shown) in figures.items():
        assert f"(rhim_book/{name}.svg)" in page
        assert figure.axes
        svg = (paper.FOLDER / f"{name}.svg").read_text(encoding="utf-8")
        drawn = json.loads(re.findall(r"<!-- (\[\[.*\]\]) -->", svg)[-1])
        # Four digits are stored; sums differ in their last bits between libraries.
        assert np.array(drawn) == pytest.approx(np.array(shown), abs=1.1e-4)
        assert "<path" in svg
