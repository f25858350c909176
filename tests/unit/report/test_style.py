"""One style for every figure."""

from __future__ import annotations

import itertools

import pytest

from swayless.report.style import ALARM, figure_style, line_style, new_figure


def test_thirty_designs_differ_in_colour_or_dashes_and_neighbours_in_both() -> None:
    looks = [(line_style(number)["color"], str(line_style(number)["linestyle"])) for number in range(30)]
    assert len(set(looks)) == 30
    for (colour, dashes), (next_colour, next_dashes) in itertools.pairwise(looks):
        assert colour != next_colour
        assert dashes != next_dashes


def test_no_design_is_drawn_in_the_colour_of_what_is_not_held() -> None:
    assert ALARM not in {line_style(number)["color"] for number in range(30)}


def test_long_names_widen_the_figure() -> None:
    usual, _ = new_figure("title", [1.0, 2.0], labels=["short"])
    wide, _ = new_figure("title", [1.0, 2.0], labels=["short", "a name of more than sixteen letters"])
    assert usual.get_size_inches().tolist() == [7.5, 3.0]
    assert wide.get_size_inches()[0] > 9.0


@pytest.mark.parametrize("letter", ["n", "N"])
def test_long_titles_break_within_the_figure_and_leave_the_panels_their_height(letter: str) -> None:
    with figure_style():
        usual, (panel,) = new_figure("title", [3.0])
        figure, (below,) = new_figure(" ".join([letter * 6] * 25), [3.0])
        for each in (usual, figure):
            each.draw_without_rendering()
    extent = figure.texts[0].get_window_extent()
    assert 0.0 < extent.x0 < extent.x1 < 750.0  # of 7.5 in, at 100 dots an inch
    assert figure.get_suptitle().split() == [letter * 6] * 25
    # 2 %: the room of a line is that of the usual one.
    assert below.get_window_extent().height == pytest.approx(panel.get_window_extent().height, rel=0.02)
