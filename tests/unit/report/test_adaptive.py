"""The learning figure of an adaptive shaper."""

import numpy as np

from swayless.report.adaptive import PlottedLearning, learning_figure


def test_it_shows_vibration_and_coefficients_with_what_they_should_become():
    time_s, wanted = np.linspace(0.0, 9.0, 10_000), np.array([0.3, 0.5, 0.2])
    vibration = np.exp(-time_s)
    found = np.where(time_s[:, None] < 2.0, 1.0 / 3.0, wanted)
    learning = PlottedLearning("Robot: learning", time_s, vibration + 0.1, vibration, found, wanted, 3.0)
    above, below = learning_figure(learning).axes
    assert [line.get_label() for line in above.get_lines()[:2]] == ["measured", "without noise"]
    assert above.get_lines()[1].get_ydata()[0] == 1.0
    texts = [text.get_text() for text in below.get_legend().get_texts()]
    assert texts == ["first", "middle", "last", "eq 4", "in use from here"]
    drawn = {line.get_label(): line for line in below.get_lines()}
    assert [drawn[name].get_ydata()[-1] for name in texts[:3]] == wanted.tolist()
    assert drawn["in use from here"].get_xdata()[0] == 3.0


def test_coefficients_that_are_never_used_are_not_said_to_be():
    time_s, third = np.linspace(0.0, 1.0, 11), np.full((11, 3), 1.0 / 3.0)
    learning = PlottedLearning("Robot", time_s, 0 * time_s, 0 * time_s, third, third[0], None)
    below = learning_figure(learning).axes[1]
    assert "in use from here" not in [text.get_text() for text in below.get_legend().get_texts()]
