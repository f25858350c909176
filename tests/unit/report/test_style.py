"""One style for every figure."""

from __future__ import annotations

import itertools

from swayless.report.style import ALARM, line_style, new_figure


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
