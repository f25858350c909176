"""Draw the figures and print the tables of `xu-meckl-2005.md`: `python docs/papers/xu_meckl_2005.py`.

The page holds the tables word for word, and the figures stand beside it; a test compares both with what this
script makes. Not for: numbers of other papers.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.design.optimal import (
    Command,
    Feedback,
    LinearPlant,
    MoveTask,
    OptimalCommand,
    Robustness,
    input_with_feedback,
    least_energy,
    output_at_ticks,
    output_with_feedback,
    residual_amplitude,
    time_optimal,
    track,
)
from swayless.design.shaper import FloatArray
from swayless.report import figure_bytes
from swayless.report.style import figure_style, legend_above, line_style, new_figure, settle

FOLDER = Path(__file__).with_suffix("")
W0_RAD_S = 10.0
PERIOD_S = 2.0 * math.pi / W0_RAD_S
TICK_S = 0.005
LIMIT = 5.0
"""Largest input either way; the paper's text does not give its own."""

SPLIT = 0.1
TOLERANCE = 0.02
TRACKED_TICKS = 200
SHOWN_TICKS = 300
RELAXED = (1.0, 1.1, 1.25, 1.5, 2.0)
FEEDBACK = Feedback(2.0, 0.15)
"""The paper does not give its feedback: ours makes the closed loop damped at 0.43."""

NOMINAL, FIRST, SECOND = Robustness(), Robustness(1), Robustness(2)
EXTRA_INSENSITIVE = Robustness(split_ratio=SPLIT)
NAMES = {
    NOMINAL: "not robust",
    FIRST: "1st-order robust",
    SECOND: "2nd-order robust",
    EXTRA_INSENSITIVE: "EI",
}


def oscillator(ratio: float = 1.0) -> LinearPlant:
    """Eq 19, 1 / (s^2 / w^2 + 1), with w so many times w0."""
    return LinearPlant.from_transfer_function([1.0], [1.0 / (W0_RAD_S * ratio) ** 2, 0.0, 1.0])


def task(robustness: Robustness, limit: float = LIMIT) -> MoveTask:
    """From 0 to 1."""
    return MoveTask(oscillator(), TICK_S, (-limit, limit), 1.0, robustness=robustness)


@cache
def fastest(robustness: Robustness, limit: float = LIMIT) -> OptimalCommand:
    """Figures 4 and 5: the fewest ticks."""
    return time_optimal(task(robustness, limit))


@cache
def relaxed(ratio: float) -> OptimalCommand:
    """Figure 8: the least energy in so many times the fewest ticks, 1st-order robust."""
    return least_energy(task(FIRST), math.ceil(ratio * fastest(FIRST).ticks - 1e-9))


def trajectory() -> FloatArray:
    """Ours, as the paper's is lost with its figure: the polynomial of degree 5 from rest to rest in 1 s."""
    k = np.arange(1, TRACKED_TICKS + 1) / TRACKED_TICKS
    return 10.0 * k**3 - 15.0 * k**4 + 6.0 * k**5


@cache
def tracked(robustness: Robustness) -> OptimalCommand:
    """Figures 9 and 11: along the trajectory."""
    return track(task(robustness), trajectory(), TOLERANCE)


def zvd_step() -> Command:
    """Figure 7: a step of 1 through a ZVD shaper of the mode; 60 ticks are half a period."""
    return Command(PERIOD_S / 120.0, np.repeat([0.25, 0.75], 60), 1.0)


def left(command: Command, ratio: float) -> float:
    """Compute what a command leaves swinging where the frequency is so many times w0."""
    return float(residual_amplitude(command, ratio * W0_RAD_S / (2.0 * math.pi)))


def peak(command: Command) -> float:
    """Largest output on the way or after, of the nominal plant."""
    return float(output_at_ticks(oscillator(), command, ticks=2 * command.values.size).max())


def closed_loop(ratio: float, robustness: Robustness = FIRST) -> FloatArray:
    """Figure 12: feedforward and feedback on a plant whose frequency is off."""
    command = fastest(robustness).command
    reference = output_at_ticks(oscillator(), command)
    return output_with_feedback(oscillator(ratio), command, reference, FEEDBACK, ticks=SHOWN_TICKS)


def largest_input(output: FloatArray) -> float:
    """Compute what feedforward and feedback together ask of the actuator for an output."""
    command = fastest(FIRST).command
    reference = output_at_ticks(oscillator(), command)
    return float(np.abs(input_with_feedback(command, reference, output, FEEDBACK)).max())


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Lay out a Markdown table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def percent(ratio: float) -> str:
    """Print a ratio in percent, to a tenth."""
    return f"{100.0 * ratio:.1f} %"


def lasting(command: Command) -> str:
    """Print ticks and seconds."""
    return f"{command.values.size} ticks, {command.duration_s:.3f} s"


def moves_table() -> str:
    """Figures 4, 5, 7 and 10."""
    rows = []
    for robustness, name in NAMES.items():
        found = fastest(robustness)
        fewer = f"{found.ticks - 1} ticks would take {percent(found.fewer_utilisation_ratio or math.nan)}"
        command = found.command
        rows.append(
            (name, lasting(command), fewer, *(percent(left(command, each)) for each in (0.9, 1.0, 1.1)))
        )
    step = zvd_step()
    rows.append(
        ("ZVD-shaped step", f"{PERIOD_S:.3f} s", "", *(percent(left(step, each)) for each in (0.9, 1.0, 1.1)))
    )
    return table(("move", "takes", "of the limit", "left at 0.9 w0", "at w0", "at 1.1 w0"), rows)


def limits_table() -> str:
    """Figure 5 against figure 7, over the limit."""
    rows = []
    for limit in (1.0, 1.2, 2.0, 3.0, 4.0, 5.0, 10.0):
        found = fastest(FIRST, limit)
        rows.append((f"{limit:g}", lasting(found.command), percent(found.command.duration_s / PERIOD_S)))
    return table(("limit of the input", "1st-order robust move", "of the ZVD-shaped step"), rows)


def energy_table() -> str:
    """Figure 8."""
    rows = []
    for ratio in RELAXED:
        command = relaxed(ratio).command
        energy = TICK_S * float(command.values @ command.values)
        largest = float(np.abs(command.values).max())
        rows.append((lasting(command), f"{energy:.3f}", f"{largest:.2f}", f"{peak(command):.3f}"))
    return table(("k", "energy (s)", "largest input", "largest output"), rows)


def tracking_table() -> str:
    """Figures 9 and 11."""
    rows = []
    for robustness in (FIRST, EXTRA_INSENSITIVE):
        command = tracked(robustness).command
        off = [
            float(np.abs(output_at_ticks(oscillator(each), command)[1:] - trajectory()).max())
            for each in (1.0, 1.1)
        ]
        rows.append(
            (
                NAMES[robustness],
                *(f"{each:.3f}" for each in off),
                *(percent(left(command, each)) for each in (0.9, 1.0, 1.1)),
            )
        )
    return table(
        ("input", "farthest off at w0", "at 1.1 w0", "left at 0.9 w0", "left at w0", "left at 1.1 w0"), rows
    )


def loop_table() -> str:
    """Figure 12: what is left 0.5 s and more after the end, without and with feedback, and what it takes."""
    rows = []
    after = fastest(FIRST).ticks + 100
    for ratio in (0.9, 1.0, 1.1):
        alone = output_at_ticks(oscillator(ratio), fastest(FIRST).command, ticks=SHOWN_TICKS)
        together = closed_loop(ratio)
        lefts = (percent(float(np.abs(y[after:] - 1.0).max())) for y in (alone, together))
        rows.append((f"{ratio:g} w0", *lefts, f"{largest_input(together):.2f}"))
    return table(("plant", "feedforward alone", "with feedback", "largest input then"), rows)


def tables() -> dict[str, str]:
    """All tables of the page."""
    return {
        "figs 4, 5, 7, 10": moves_table(),
        "fig 5 against fig 7": limits_table(),
        "fig 8": energy_table(),
        "figs 9, 11": tracking_table(),
        "fig 12": loop_table(),
    }


def draw_input(axes: Axes, command: Command, index: int, label: str) -> None:
    """Draw a command as it is held, from before it begins to after it ends."""
    times_s = np.concatenate([[-0.05], command.times_s, [command.duration_s, TICK_S * SHOWN_TICKS]])
    values = np.concatenate([[0.0], command.values, [command.final_value] * 2])
    axes.step(times_s, values, where="post", label=label, **line_style(index))


def draw_output(axes: Axes, output: FloatArray, index: int, label: str, tick_s: float = TICK_S) -> None:
    """Draw outputs at ticks."""
    axes.plot(tick_s * np.arange(output.size), output, label=label, **line_style(index))


def moves_figure(title: str, commands: dict[str, Command]) -> Figure:
    """Draw inputs above, outputs of a plant 10 % off below."""
    with figure_style():
        figure, (inputs, nominal, off) = new_figure(title, [2.0, 2.0, 2.0], sharex=True)
        for index, (label, command) in enumerate(commands.items()):
            draw_input(inputs, command, index, label)
            for axes, ratio in ((nominal, 1.0), (off, 1.1)):
                ticks = round(TICK_S * SHOWN_TICKS / command.tick_s)
                output = output_at_ticks(oscillator(ratio), command, ticks=ticks)
                draw_output(axes, output, index, label, command.tick_s)
        for axes, label in ((inputs, "input"), (nominal, "output at w0"), (off, "output at 1.1 w0")):
            axes.set_ylabel(label)
        legend_above(inputs)
        off.set_xlabel("time [s]")
        return settle(figure)


def sensitivity_figure() -> Figure:
    """Figure 10: what is left over the actual frequency."""
    ratios = np.linspace(0.7, 1.3, 301)
    commands = {name: fastest(robustness).command for robustness, name in NAMES.items()}
    with figure_style():
        figure, (axes,) = new_figure("Fig 10: what is left where the frequency is off", [3.2])
        for index, (label, command) in enumerate({**commands, "ZVD": zvd_step()}.items()):
            curve = residual_amplitude(command, ratios * W0_RAD_S / (2.0 * math.pi))
            axes.plot(ratios, 100.0 * curve, label=label, **line_style(index))
        axes.set(xlabel="actual frequency / w0", ylabel="left [%]", ylim=(0.0, 30.0))
        legend_above(axes)
        return settle(figure)


def loop_figure() -> Figure:
    """Figure 12: outputs without and with feedback, 10 % off either way."""
    with figure_style():
        figure, panels = new_figure("Fig 12: feedforward alone, and with feedback", [2.0, 2.0], sharex=True)
        for axes, ratio in zip(panels, (0.9, 1.1), strict=True):
            alone = output_at_ticks(oscillator(ratio), fastest(FIRST).command, ticks=SHOWN_TICKS)
            draw_output(axes, alone, 0, "feedforward alone")
            draw_output(axes, closed_loop(ratio), 1, "with feedback")
            axes.set_ylabel(f"output at {ratio:g} w0")
        legend_above(panels[0])
        panels[-1].set_xlabel("time [s]")
        return settle(figure)


def figures() -> dict[str, tuple[Figure, list[OptimalCommand]]]:
    """All figures of the page, each with the commands that it shows."""
    two = {NAMES[each]: fastest(each).command for each in (NOMINAL, FIRST)}
    zvd = {NAMES[FIRST]: fastest(FIRST).command, "ZVD-shaped step": zvd_step()}
    several = {f"k = {relaxed(ratio).ticks}": relaxed(ratio).command for ratio in RELAXED}
    along = {NAMES[each]: tracked(each).command for each in (FIRST, EXTRA_INSENSITIVE)}
    return {
        "fig-4-and-5": (
            moves_figure("Figs 4 and 5: the fastest moves, |u| <= 5", two),
            [fastest(NOMINAL), fastest(FIRST)],
        ),
        "fig-7": (
            moves_figure("Figs 5 and 7: 1st-order robust, and a ZVD-shaped step", zvd),
            [fastest(FIRST)],
        ),
        "fig-8": (
            moves_figure("Fig 8: least energy, 1st-order robust", several),
            [relaxed(ratio) for ratio in RELAXED],
        ),
        "fig-9-and-11": (
            moves_figure("Figs 9 and 11: along a trajectory", along),
            [tracked(FIRST), tracked(EXTRA_INSENSITIVE)],
        ),
        "fig-10": (sensitivity_figure(), [fastest(each) for each in NAMES]),
        "fig-12": (loop_figure(), [fastest(FIRST)]),
    }


def drawn_from(commands: Sequence[OptimalCommand]) -> str:
    """Say what a figure shows, so that a test can tell whether it still would: length, and largest input."""
    return json.dumps([[each.ticks, round(float(np.abs(each.command.values).max()), 3)] for each in commands])


def shortened(svg: str) -> str:
    """Write each path of a figure on one line, rounded to a hundredth of a point, which nobody sees."""

    def rounded(path: re.Match[str]) -> str:
        return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path[0].replace("\n", ""))

    return re.sub(r' d="[^"]*"', rounded, svg)


def main() -> None:
    """Write the figures and print the tables."""
    FOLDER.mkdir(exist_ok=True)
    for name, (figure, commands) in figures().items():
        text = shortened(figure_bytes(figure, "svg").decode())
        (FOLDER / f"{name}.svg").write_text(f"{text}<!-- {drawn_from(commands)} -->\n", encoding="utf-8")
    for name, text in tables().items():
        print(f"{name}\n\n{text}")


if __name__ == "__main__":
    main()
