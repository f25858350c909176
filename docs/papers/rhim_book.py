"""Draw the figures and print the tables of `rhim-book.md`: `python docs/papers/rhim_book.py`.

The page holds the tables word for word, and the figures stand beside it; a test compares both with what this
script makes. Not for: numbers of other papers.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from swayless.controller.adaptive import AdaptiveInput, AdaptiveSettings, AdaptiveShaper
from swayless.design import design_shaper, residual_vibration
from swayless.design.shaper import Shaper
from swayless.plant import Mode
from swayless.plant.simulation.flexible_robot import FlexibleRobot
from swayless.report import figure_bytes
from swayless.report.style import ALARM, GREY, figure_style, line_style, new_figure, settle

Floats: TypeAlias = NDArray[np.float64]
Step: TypeAlias = Callable[[float, float], tuple[float, Sequence[float]]]
"""From command and measured vibration to reference and coefficients."""

FOLDER = Path(__file__).with_suffix("")

TICK_S, CYCLE_TICKS, RAMP_TICKS, TRAVEL_TICKS = 0.001, 4000, 300, 900
MODE = Mode(16.0, 0.01)
DELAY_TICKS = 25
DELAYS_TICKS = (8, 10, 15, 20, 25, 28, 40, 45)
NOISE = 0.05
CYCLES, TABLE_CYCLES = 6, 12
SETTLED_TICKS = 150
"""After a command has changed, so long until every variant takes what is left for free vibration."""


def trajectory() -> list[float]:
    """Speeds of fig 5: out and back in 4 s, ramps of 0.3 s, rests of 0.5 s."""
    ticks = np.arange(CYCLE_TICKS // 2)
    corners = np.cumsum([0, RAMP_TICKS, TRAVEL_TICKS, RAMP_TICKS])
    one = np.interp(ticks, corners, [0.0, 1.0, 1.0, 0.0])
    return np.concatenate([one, -one]).tolist()


@cache
def unshaped_m_s2() -> float:
    """Amplitude of the tip's acceleration that an unshaped ramp leaves: the unit of all below."""
    robot = FlexibleRobot(MODE, TICK_S)
    record = [robot.step(speed) for speed in trajectory()[: 2 * RAMP_TICKS]]
    return max(map(abs, record[RAMP_TICKS + 2 :]))


def here(delay_ticks: int) -> Step:
    """Make the adaptive shaper of swayless, with a drive that can do eight times the command."""
    shaper = AdaptiveShaper(
        AdaptiveSettings(delay_ticks, TICK_S, 1.0, unshaped_m_s2(), CYCLE_TICKS, max_reference=8.0)
    )

    def step(command: float, vibration: float) -> tuple[float, Sequence[float]]:
        output = shaper.step(AdaptiveInput(command, vibration))
        return output.reference, output.coefficient

    return step


class ToTheLetter:
    """Eqs 13-16 as they are printed, at every sample of the paper's residual period, each set used at once.

    Parameters
    ----------
    delay_ticks : int
        Delay.
    forgetting : float
        The paper gives none.
    """

    def __init__(self, delay_ticks: int, forgetting: float) -> None:
        self.delay, self.forgetting = delay_ticks, forgetting
        self.p = [[1e7 * (row == column) for column in range(3)] for row in range(3)]
        self.gamma = [1e7] * 3
        self.commands = self.vibrations = [0.0] * (2 * delay_ticks + 1)
        self.tick = self.rest = 0

    def __call__(self, command: float, vibration: float) -> tuple[float, Sequence[float]]:
        """Run one tick."""
        self.rest = self.rest + 1 if command == self.commands[-1] else 0
        self.commands = [*self.commands[1:], command]
        self.vibrations = [*self.vibrations[1:], vibration / unshaped_m_s2()]
        if self.rest >= 2 * self.delay and self.tick > RAMP_TICKS:
            self.adapt(self.vibrations[:: -self.delay])
        self.tick += 1
        total = sum(self.gamma)
        coefficients = [gamma / total for gamma in self.gamma]
        if self.tick <= CYCLE_TICKS:
            return command, coefficients
        return _product(coefficients, self.commands[:: -self.delay]), coefficients

    def adapt(self, w: Sequence[float]) -> None:
        """Eqs 13 to 15."""
        pw, wp = (
            [_product(row, w) for row in self.p],
            [_product(column, w) for column in zip(*self.p, strict=True)],
        )
        k = [each / (self.forgetting + _product(w, pw)) for each in pw]
        left = _product(w, self.gamma)
        self.gamma = [(g - each * left) / self.forgetting for g, each in zip(self.gamma, k, strict=True)]
        self.p = [
            [(old - each * across) / self.forgetting for old, across in zip(row, wp, strict=True)]
            for row, each in zip(self.p, k, strict=True)
        ]


def _product(a: Sequence[float], b: Sequence[float]) -> float:
    """Inner product of three numbers each: numpy takes longer to begin."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


class Run(NamedTuple):
    """An experiment: acceleration of the tip in units of `unshaped_m_s2`, with noise, and coefficients."""

    measured: Floats
    vibration: Floats
    coefficients: Floats

    def rms_of_cycles(self) -> Floats:
        """Rms of the true vibration in the residual periods of each cycle, in units of the noise."""
        command = np.array(trajectory())
        rests = np.convolve(np.abs(np.diff(command, prepend=command[-1])) > 1e-12, np.ones(SETTLED_TICKS))
        free = rests[:CYCLE_TICKS] == 0.0
        return np.asarray(
            np.sqrt(np.mean(self.vibration.reshape(-1, CYCLE_TICKS)[:, free] ** 2, axis=1)) / NOISE
        )


def experiment(step: Step, cycles: int) -> Run:
    """Repeat the trajectory with a measurement noise of 5 % rms."""
    robot, unit = FlexibleRobot(MODE, TICK_S), unshaped_m_s2()
    noise = NOISE * unit * np.random.default_rng(16).standard_normal(cycles * CYCLE_TICKS)
    vibrations, coefficients = [0.0], []
    for command, error in zip(trajectory() * cycles, noise.tolist(), strict=True):
        reference, found = step(command, vibrations[-1] + error)
        vibrations.append(robot.step(reference))
        coefficients.append(found)
    vibration = np.array(vibrations[1:]) / unit
    return Run(vibration + noise / unit, vibration, np.array(coefficients))


@cache
def shown() -> Run:
    """Run the experiment of the figures: 25 ms."""
    return experiment(here(DELAY_TICKS), CYCLES)


def analytic(delay_ticks: int) -> Shaper:
    """Design the shaper of eq 4 for the mode that nobody has told the block."""
    return design_shaper("oatf", MODE, delay_s=delay_ticks * TICK_S)


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Lay out a Markdown table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


@cache
def delays() -> dict[int, tuple[Floats, Floats]]:
    """For each delay the coefficients learned, and the rms of each cycle."""
    runs = {delay: experiment(here(delay), CYCLES) for delay in DELAYS_TICKS}
    return {delay: (run.coefficients[-1], run.rms_of_cycles()) for delay, run in runs.items()}


@cache
def variants() -> dict[str, list[Floats]]:
    """Rms of each cycle, of the equations as printed and of the block, for 10 ms and 25 ms."""
    made: dict[str, Callable[[int], Step]] = {
        "eqs 13-16 as printed, nothing forgotten": lambda delay: ToTheLetter(delay, 1.0),
        "eqs 13-16 as printed, forgetting factor 0.999": lambda delay: ToTheLetter(delay, 0.999),
        "here": here,
    }
    return {
        name: [experiment(make(delay), TABLE_CYCLES).rms_of_cycles() for delay in (10, 25)]
        for name, make in made.items()
    }


def tables() -> dict[str, str]:
    """All tables of the page."""
    heads = ("delay", "cos w Td", "eq 4", "learned", "cycle 1", "cycle 2", "cycle 3", f"cycle {CYCLES}")
    rows = [
        (
            f"{delay} ms",
            f"{np.cos(2.0 * np.pi * MODE.frequency_hz * delay * TICK_S):.2f}",
            " ".join(f"{c:.3f}" for c in analytic(delay).amplitudes),
            " ".join(f"{c:.3f}" for c in learned),
            *(f"{rms[cycle]:.2f}" for cycle in (0, 1, 2, CYCLES - 1)),
        )
        for delay, (learned, rms) in delays().items()
    ]
    cycles = (0, 1, 2, 5, TABLE_CYCLES - 1)
    return {
        "delays": table(heads, rows),
        "variants": table(
            ("delay, cycle", *(f"{delay} ms, {cycle + 1}" for delay in (10, 25) for cycle in cycles)),
            [
                (name, *(f"{rms[cycle]:.2f}" for rms in found for cycle in cycles))
                for name, found in variants().items()
            ],
        ),
    }


BIN_TICKS = 50


def acceleration_figure() -> Figure:
    """Fig 6: acceleration of the tip, and the coefficients."""
    run = shown()
    times_s = TICK_S * np.arange(0, run.measured.size, BIN_TICKS)
    bins = run.measured.reshape(-1, BIN_TICKS)
    with figure_style():
        figure, panels = new_figure("Delay 25 ms, noise 5 %", [2.0, 2.0], sharex=True)
        panels[0].set_title("Fig 6, top: measured acceleration of the tip")
        panels[0].fill_between(
            times_s, bins.min(axis=1), bins.max(axis=1), color=line_style(0)["color"], lw=0.0
        )
        panels[0].set_ylabel("Unshaped ramp = 1")
        panels[1].set_title("Fig 6, bottom: coefficients; grey: eq 4")
        for index in range(3):
            panels[1].axhline(analytic(DELAY_TICKS).amplitudes[index], color=GREY, linewidth=0.8)
            label = f"after {25 * index} ms"
            panels[1].plot(times_s, run.coefficients[::BIN_TICKS, index], label=label, **line_style(index))
        panels[1].legend(loc="upper right", ncols=3)
        panels[1].set(ylim=(0.2, 0.55), xlim=(0.0, times_s[-1]), xlabel="Time (s)", ylabel="Coefficient")
        return settle(figure)


HERTZ = np.arange(0.0, 50.25, 0.5)


def magnitudes(coefficients: Floats) -> Floats:
    """Magnitude of C(z) at `HERTZ`: one row for each set of coefficients."""
    lags_s = DELAY_TICKS * TICK_S * np.arange(3)
    return np.asarray(np.abs(coefficients @ np.exp(-2j * np.pi * np.outer(lags_s, HERTZ))))


@cache
def contour() -> tuple[Floats, Floats]:
    """Figs 7 and 8: times and magnitudes of the coefficients along the first 4 s."""
    ticks = np.arange(0, CYCLE_TICKS, BIN_TICKS)
    return TICK_S * ticks, magnitudes(shown().coefficients[ticks])


def magnitude_figure() -> Figure:
    """Figs 7 to 9: magnitude of the shaper over frequency while it learns, and in the end."""
    times_s, levels = contour()
    with figure_style():
        figure, panels = new_figure("Magnitude of the shaper, delay 25 ms", [2.4, 2.0])
        panels[0].set_title("Figs 7 and 8: while it learns, in the first cycle")
        lines = panels[0].contour(times_s, HERTZ, levels.T, levels=[0.05, 0.2, 0.4, 0.6, 0.8], cmap="viridis")
        panels[0].clabel(lines, fontsize=7.0)
        panels[0].axhline(MODE.frequency_hz, color=ALARM, linewidth=0.8)
        panels[0].set(xlabel="Time (s)", ylabel="Frequency (Hz)")
        panels[1].set_title("Fig 9: in the end")
        panels[1].plot(HERTZ, magnitudes(shown().coefficients[-1:])[0], **line_style(0))
        panels[1].axvline(MODE.frequency_hz, color=ALARM, linewidth=0.8)
        panels[1].set(
            xlabel="Frequency (Hz); vermilion: the vibration, 16 Hz", ylabel="Magnitude", xlim=(0, 50)
        )
        return settle(figure)


def left_behind(delay_ticks: int) -> float:
    """Residual vibration by design of the coefficients learned, at the mode."""
    coefficients = delays()[delay_ticks][0]
    design = analytic(delay_ticks)
    learned = Shaper(design.times_s, coefficients, design.family, design.guarantee, design.source)
    return float(residual_vibration(learned, MODE.frequency_hz, damping_ratio=MODE.damping_ratio))


def figures() -> dict[str, tuple[Figure, object]]:
    """All figures of the page, each with the numbers that it shows."""
    every_half_cycle = shown().coefficients[:: CYCLE_TICKS // 2].round(4).tolist()
    return {
        "fig-6": (acceleration_figure(), every_half_cycle),
        "fig-7-to-9": (magnitude_figure(), contour()[1][::8, ::8].round(4).tolist()),
    }


def shortened(svg: str) -> str:
    """Write each path of a figure on one line, rounded to a hundredth of a point, which nobody sees."""

    def on_one_line(path: re.Match[str]) -> str:
        return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path[0].replace("\n", ""))

    return re.sub(r' d="[^"]*"', on_one_line, svg)


def main() -> None:
    """Write the figures and print the tables."""
    FOLDER.mkdir(exist_ok=True)
    for name, (figure, numbers) in figures().items():
        text = shortened(figure_bytes(figure, "svg").decode())
        (FOLDER / f"{name}.svg").write_text(f"{text}<!-- {json.dumps(numbers)} -->\n", encoding="utf-8")
    for name, text in tables().items():
        print(f"{name}\n\n{text}")


if __name__ == "__main__":
    main()
