"""Draw the figures and print the tables of `visioli-piazzi.md`: `python docs/papers/visioli_piazzi.py`.

The page holds the tables word for word, and the figures stand beside it; a test compares both with what this
script makes. Not for: numbers of other papers.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swayless.design.inversion import (
    PAPER_GAIN,
    InvertedCommand,
    MeasuredMove,
    PolynomialMotion,
    cost,
    invert,
    paper_step,
    scaled_step,
)
from swayless.design.optimal import Command, LinearPlant, output_at_ticks
from swayless.errors import DesignError
from swayless.plant.elastic_drive import ElasticDrive
from swayless.report import figure_bytes
from swayless.report.style import figure_style, legend_above, line_style, new_figure, settle

FOLDER = Path(__file__).with_suffix("")
GAIN, INTEGRAL_TIME_S = 0.05, 0.2
"""Of the loop; the paper's text does not give its own."""

OTHER_GAINS = ((0.05, 0.5), (0.02, 1.0), (0.2, 0.5))
TICK_S = 0.01
MEASURED_S = 4.0
"""T_f of eq 8: the motion, and as long again."""

ITERATIONS = 10
MOTION = PolynomialMotion(2.0, 1.0)
TRUE = (0.00011, 0.0034, 1.0, 0.22, 3.05)
FIRST = {1: (0.0002, 0.004, 1.2, 0.1, 5.0), 2: (0.0001, 0.002, 0.9, 0.1, 5.0)}
PRINTED = {1: (0.00028, 0.004, 1.2, 0.08, 4.99), 2: (0.00089, 0.0016, 0.87, 0.09, 5.05)}
"""Parameters at the tenth iteration, as the paper prints them."""

STEPS = ("printed", "scaled")


def drive(values: Sequence[float], gains: tuple[float, float] = (GAIN, INTEGRAL_TIME_S)) -> ElasticDrive:
    """Make a drive from parameters in the paper's order."""
    return ElasticDrive(values[0], values[1], *gains, *values[2:])


@dataclass(frozen=True, eq=False)
class Iteration:
    """An estimate, the command that it gave, and what the true load then did."""

    estimate: ElasticDrive
    found: InvertedCommand
    measured: MeasuredMove

    @property
    def cost(self) -> float:
        """Eq 8."""
        return cost(MOTION, [self.measured])


def experiment(estimate: ElasticDrive) -> Iteration:
    """Move the true load by the inverse of an estimate."""
    found = invert(*estimate.transfer_function, MOTION, TICK_S)
    actual = drive(TRUE, (estimate.gain, estimate.integral_time_s))
    return Iteration(estimate, found, moved(actual, found.command))


def moved(actual: ElasticDrive, command: Command) -> MeasuredMove:
    """Give what the load does, at each tick."""
    top, bottom = actual.transfer_function
    plant = LinearPlant.from_transfer_function(top.tolist(), bottom.tolist())
    return MeasuredMove(0.0, TICK_S, output_at_ticks(plant, command, ticks=round(MEASURED_S / TICK_S)))


@cache
def run(
    example: int,
    step: str,
    gains: tuple[float, float] = (GAIN, INTEGRAL_TIME_S),
    iterations: int = ITERATIONS,
    faster: float = 1.0,
) -> tuple[Iteration, ...]:
    """Tune for some iterations, fewer where a step leads nowhere; `faster` times the printed step."""
    done = [experiment(drive(FIRST[example], gains))]
    while len(done) < iterations:
        last = done[-1]
        try:
            taken = (
                paper_step(last.estimate, MOTION, [last.measured], gain=PAPER_GAIN * faster)
                if step == "printed"
                else scaled_step(last.estimate, MOTION, [last.measured])
            )
        except DesignError:  # a parameter below 0: no drive, and no experiment
            break
        done.append(experiment(taken.drive))
    return tuple(done)


def uninverted() -> MeasuredMove:
    """Figure 2: the motion itself as the command."""
    ticks = round(MOTION.duration_s / TICK_S)
    values = MOTION.at(TICK_S * (np.arange(ticks) + 0.5))
    return moved(drive(TRUE), Command(TICK_S, values, MOTION.target))


def left(measured: MeasuredMove) -> float:
    """Largest error after the motion."""
    late = measured.times_s > MOTION.duration_s
    return float(np.abs(measured.error(MOTION)[late]).max())


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Lay out a Markdown table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def short(value: float) -> str:
    """Print a cost; below 1e-9 only that, as another computer may round otherwise."""
    return f"{value:.5f}" if value >= 1e-4 else f"{value:.2g}" if value >= 1e-9 else "below 1e-9"


def costs_table() -> str:
    """Figures 7 and 12."""
    runs = [run(example, step) for example in FIRST for step in STEPS]
    rows = [(str(i + 1), *(short(each[i].cost) for each in runs)) for i in range(ITERATIONS)]
    heads = [f"example {example}, {step} step" for example in FIRST for step in STEPS]
    return table(("iteration", *heads), rows)


def parameters_table() -> str:
    """Parameters after ten iterations, and what of them a motion shows."""
    rows = [("true", *values_of(drive(TRUE)))]
    for example, first in FIRST.items():
        rows += [
            (f"example {example}, first", *values_of(drive(first))),
            ("tenth, the paper's print", *values_of(drive(PRINTED[example], (GAIN, 1.0)))),
            ("tenth, printed step", *values_of(run(example, "printed")[-1].estimate)),
            ("tenth, scaled step", *values_of(run(example, "scaled")[-1].estimate)),
        ]
    return table(("", "J_m", "D_m", "m", "c", "k", "c/m", "k/m"), rows)


def values_of(each: ElasticDrive) -> tuple[str, ...]:
    """Print parameters, and the ratios."""
    ratios = each.damping / each.load_mass, each.stiffness / each.load_mass
    return tuple(f"{value:.3g}" for value in (*each.tuned, *ratios))


def gains_table() -> str:
    """Tune with other gains of the loop."""
    rows = []
    for gains in ((GAIN, INTEGRAL_TIME_S), *OTHER_GAINS):
        cells = [f"{gains[0]:g}", f"{gains[1]:g} s"]
        for example in FIRST:
            printed = run(example, "printed", gains)
            second = run(example, "scaled", gains, 2)[-1]
            fall = 100.0 * (1.0 - printed[-1].cost / printed[0].cost)
            cells += [f"{printed[0].cost:.4f}", f"{fall:.1f} %", short(second.cost)]
        rows.append(cells)
    heads = ("first cost", "falls in ten printed steps by", "after one scaled step")
    return table(("K_p", "T_i", *(f"example {each}: {head}" for each in FIRST for head in heads)), rows)


def faster_table() -> str:
    """Tune with larger steps down the gradient."""
    rows = [
        (f"{faster:g}", *(last_of(run(each, "printed", faster=faster)) for each in FIRST))
        for faster in (1.0, 10.0, 100.0, 1000.0)
    ]
    return table(("times the printed step", "example 1, last cost", "example 2, last cost"), rows)


def last_of(done: Sequence[Iteration]) -> str:
    """Print the last cost, and where it is not that of the tenth iteration."""
    ended = "" if len(done) == ITERATIONS else f" at iteration {len(done)}: the next J_m is below 0"
    return f"{done[-1].cost:.5f}{ended}"


def loads_table() -> str:
    """Figures 2, 4, 6, 9 and 11: how far the load is off its motion."""
    rows = [row("fig 2: the motion itself as the command", uninverted())]
    for example, first, tenth in ((1, "4", "6"), (2, "9", "11")):
        done = run(example, "printed")
        rows += [
            row(f"fig {first}: example {example}, first iteration", done[0].measured),
            row(f"fig {tenth}: tenth, printed step", done[-1].measured),
            row("tenth, scaled step", run(example, "scaled")[-1].measured),
        ]
    # Those of example 2 make a loop that is unstable with these gains.
    rows.append(row("the paper's parameters after example 1", experiment(drive(PRINTED[1])).measured))
    return table(("", "largest error", "after the motion", "cost"), rows)


def row(name: str, measured: MeasuredMove) -> tuple[str, ...]:
    """Print errors of one move."""
    largest = float(np.abs(measured.error(MOTION)).max())
    small = [f"{value:.4f}" if value > 1e-4 else "below 1e-4" for value in (largest, left(measured))]
    return (name, *small, short(cost(MOTION, [measured])))


def tables() -> dict[str, str]:
    """All tables of the page."""
    return {
        "figs 2, 4, 6, 9, 11": loads_table(),
        "figs 7, 12": costs_table(),
        "parameters": parameters_table(),
        "gains": gains_table(),
        "larger steps": faster_table(),
    }


def draw_load(axes: Axes, measured: MeasuredMove, index: int, label: str) -> None:
    """Draw what a load did."""
    axes.plot(measured.times_s, measured.position, label=label, **line_style(index))


def draw_command(axes: Axes, found: InvertedCommand, index: int, label: str) -> None:
    """Draw a command as it is held."""
    shown = round(MEASURED_S / TICK_S)
    values = np.append(found.command.values, np.full(shown, found.command.final_value))[:shown]
    axes.step(TICK_S * np.arange(shown), values, where="post", label=label, **line_style(index))


def plain_figure() -> Figure:
    """Figure 2."""
    with figure_style():
        figure, (axes,) = new_figure("Fig 2: the motion itself as the command", [2.6])
        draw_load(axes, uninverted(), 0, "load")
        axes.plot(uninverted().times_s, MOTION.at(uninverted().times_s), label="motion", **line_style(1))
        axes.set(xlabel="time [s]", ylabel="position")
        legend_above(axes)
        return settle(figure)


def example_figure(example: int) -> Figure:
    """Figures 3 to 6, or 8 to 11."""
    numbers = {1: "3 to 6", 2: "8 to 11"}[example]
    cases = {
        "first iteration": run(example, "printed")[0],
        "tenth, printed step": run(example, "printed")[-1],
        "tenth, scaled step": run(example, "scaled")[-1],
    }
    with figure_style():
        figure, (commands, loads) = new_figure(f"Figs {numbers}: example {example}", [2.2, 2.2], sharex=True)
        for index, (label, each) in enumerate(cases.items()):
            draw_command(commands, each.found, index, label)
            draw_load(loads, each.measured, index, label)
        commands.set_ylabel("command")
        loads.set(ylabel="load", xlabel="time [s]")
        legend_above(commands)
        return settle(figure)


def costs_figure() -> Figure:
    """Figures 7 and 12."""
    with figure_style():
        figure, (axes,) = new_figure("Figs 7 and 12: cost against iteration", [3.0])
        for index, (example, step) in enumerate((e, s) for e in FIRST for s in STEPS):
            values = [np.log10(max(each.cost, 1e-9)) for each in run(example, step)]
            label = f"{example}, {step}"
            axes.plot(range(1, ITERATIONS + 1), values, label=label, **line_style(index))
        axes.set(xlabel="iteration", ylabel="log10 of the cost, or -9")
        legend_above(axes)
        return settle(figure)


def figures() -> dict[str, tuple[Figure, list[float]]]:
    """All figures of the page, each with costs from which it was drawn."""
    costs = {
        (example, step): [each.cost for each in run(example, step)] for example in FIRST for step in STEPS
    }
    both = {example: [costs[example, "printed"][0], costs[example, "printed"][-1]] for example in FIRST}
    return {
        "fig-2": (plain_figure(), [cost(MOTION, [uninverted()])]),
        "fig-3-to-6": (example_figure(1), both[1]),
        "fig-8-to-11": (example_figure(2), both[2]),
        "fig-7-and-12": (costs_figure(), [*both[1], *both[2]]),
    }


def drawn_from(costs: Sequence[float]) -> str:
    """Say what a figure shows, so that a test can tell whether it still would."""
    return json.dumps([round(each, 6) for each in costs])


def shortened(svg: str) -> str:
    """Write each path of a figure on one line, rounded to a hundredth of a point, which nobody sees."""

    def rounded(path: re.Match[str]) -> str:
        return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path[0].replace("\n", ""))

    return re.sub(r' d="[^"]*"', rounded, svg)


def main() -> None:
    """Write the figures and print the tables."""
    FOLDER.mkdir(exist_ok=True)
    for name, (figure, costs) in figures().items():
        text = shortened(figure_bytes(figure, "svg").decode())
        (FOLDER / f"{name}.svg").write_text(f"{text}<!-- {drawn_from(costs)} -->\n", encoding="utf-8")
    for name, text in tables().items():
        print(f"{name}\n\n{text}")


if __name__ == "__main__":
    main()
