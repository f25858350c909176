"""Draw the figures and print the tables of `magee-book-1992.md`: `python docs/papers/magee_book_1992.py`.

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
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from swayless.controller import (
    Bank,
    CommandShaper,
    Row,
    ShaperInput,
    ShaperSettings,
    SpeedLimits,
    command_limits,
    number_type,
)
from swayless.controller.rope import RopeSettings
from swayless.controller.spaced_taps import SpacedTaps, SpacingLaw
from swayless.controller.spacing import Spacing
from swayless.controller.spacing_laws import spaced_filter
from swayless.design import Guarantee
from swayless.machine import ControllerSection, DriveSection, Machine, PlantSection, RowSection
from swayless.machine.arm_positions import ArmPositions
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.plant import Band, Mode, pendulum_rope_length_m
from swayless.plant.simulation import FlexibleArm
from swayless.report import figure_bytes
from swayless.report.style import ALARM, GREY, INK, figure_style, line_style, new_figure, settle

Floats: TypeAlias = NDArray[np.float64]
Impulses: TypeAlias = dict[tuple[int, int], list[int]]
"""Samples that each tap releases at each tick, by tick and tap."""

FOLDER = Path(__file__).with_suffix("")

TICK_S, LAP_S, LAPS, DIAMETER_M = 0.02, 9.0, 8, 0.9144
LAP_TICKS = round(LAP_S / TICK_S)
BAND_HZ = (3.7, 5.5)
MIDDLE_HZ = math.sqrt(BAND_HZ[0] * BAND_HZ[1])
ARM = FlexibleArm.over_circle(*BAND_HZ, DIAMETER_M)
DAMPED = FlexibleArm.over_circle(*BAND_HZ, DIAMETER_M, 0.01)
ANGLE = 2.0 * math.pi / LAP_TICKS * np.arange(LAPS * LAP_TICKS + 1)
REACH_M = ARM.reach_m + 0.5 * DIAMETER_M * np.cos(ANGLE)
ACROSS_M = 0.5 * DIAMETER_M * np.sin(ANGLE)[:-1]

LAWS = ("original", "modified", "fixed", "phase")
ANYTHING = 0.5  # a tolerance that does not matter here: the taps are as they are
NO_LIMITS = DriveSection("m/s", None, 10.0, None, None, None, 0.0, 0.0, 0.0)
PAPER = ("the paper", "+12", "-20", "", "")

FOUR = (1 / 16, 2 / 16, 4 / 16, 9 / 16)
"""Amplitudes of four taps: every sum of some of them is another."""

BEFORE, AFTER = 30, 17
"""Ticks before and after a change of the spacing; the longest delay is 15."""

FIGS_10_TO_14: dict[str, tuple[SpacingLaw, int, int]] = {
    "fig 10: a spacing of four": ("original", 4, 4),
    "fig 11: original, from four to five leaves gaps": ("original", 4, 5),
    "fig 12: original, from five to four makes a surplus": ("original", 5, 4),
    "fig 13: modified, from four to five; blue: added": ("modified", 4, 5),
    "fig 14: modified, from five to four; blue: what is kept": ("modified", 5, 4),
}


@cache
def block(law: str, family: str) -> ShaperSettings:
    """Design the block of a law for the arm; of the fixed law for the middle of its frequencies."""
    positions = np.linspace(REACH_M.min(), REACH_M.max(), 61)
    frequency_hz = np.clip(ARM.frequency_at(positions), *BAND_HZ)
    if law == "phase":
        ropes_m = (pendulum_rope_length_m(BAND_HZ[1]), pendulum_rope_length_m(BAND_HZ[0]))
        plant = PlantSection("crane", ropes_m, BAND_HZ, 0.0, None, 1.0)
    else:
        arm = ArmPositions("m", tuple(positions.tolist()), tuple(frequency_hz.tolist()), 1.0)
        plant = PlantSection("arm", None, BAND_HZ, 0.0, positions=arm)
    mode = Mode(MIDDLE_HZ if law == "fixed" else BAND_HZ[0])
    row = RowSection(family, family, mode, None, ANYTHING, None, None)
    controller = ControllerSection(TICK_S, "double", law)
    return shaper_settings(design_machine(Machine("ralf", "ralf.toml", plant, NO_LIMITS, controller, (row,))))


def shaped(law: str, family: str, commands: Floats) -> Floats:
    """Run a block along the circle: it reads the reach, or the length of the pendulum as fast as the arm."""
    shaper = CommandShaper(block(law, family))
    places = REACH_M if law != "phase" else pendulum_m(ARM.frequency_at(REACH_M))
    readings = zip(commands.tolist(), places.tolist(), (np.diff(places) / TICK_S).tolist(), strict=False)
    inputs = (ShaperInput(command, 1, rope_length=place, hoist_speed=v) for command, place, v in readings)
    return np.array([shaper.step(each).reference for each in inputs])


def pendulum_m(frequency_hz: Floats) -> Floats:
    """Lengths of the pendulums of these frequencies, g / w^2."""
    return np.asarray(pendulum_rope_length_m(1.0) / frequency_hz**2)


def rounded(values: Floats, step_m: float) -> Floats:
    """Round to whole steps."""
    return np.asarray(np.round(values / step_m) * step_m)


def each_law(family: str, commands: Floats) -> list[Floats]:
    """Commands unshaped, and by each law."""
    return [commands, *(shaped(law, family, commands) for law in LAWS)]


def each_law_as_speeds(family: str, commands: Floats) -> list[Floats]:
    """Do the same with speeds, and add the references up."""
    speeds = np.diff(commands, append=0.0) / TICK_S
    return [TICK_S * np.cumsum(references) for references in each_law(family, speeds)]


@cache
def started() -> dict[str, list[Floats]]:
    """Commands of the undamped arm, which rings because the circle starts: by family, or as speeds."""
    return {
        "zv": each_law("zv", ACROSS_M),
        "zvd": each_law("zvd", ACROSS_M),
        "zvd, shaped as speeds": each_law_as_speeds("zvd", ACROSS_M),
    }


@cache
def excited() -> dict[str, list[Floats]]:
    """Commands of the arm with 1 % of damping, by what excites it."""
    noise, coarse_m = np.random.default_rng(1992).standard_normal(ACROSS_M.size), rounded(ACROSS_M, 0.005)
    return {
        "commands rounded to 2 mm": each_law("zvd", rounded(ACROSS_M, 0.002)),
        "commands rounded to 5 mm": each_law("zvd", coarse_m),
        "the same, shaped as speeds": each_law_as_speeds("zvd", coarse_m),
        "noise of 1 mm rms on the commands": each_law("zvd", ACROSS_M + 0.001 * noise),
        "references rounded to 5 mm": [rounded(each, 0.005) for each in started()["zvd"]],
    }


RECORD_TICKS = (LAPS - 1) * LAP_TICKS
HERTZ = np.fft.rfftfreq(RECORD_TICKS, TICK_S)
INSIDE = (BAND_HZ[0] <= HERTZ) & (BAND_HZ[1] >= HERTZ)


def spectra(arm: FlexibleArm, cases: dict[str, list[Floats]]) -> dict[str, Floats]:
    """Power of the tip's acceleration at `HERTZ`, from the second lap on: unshaped, and by each law."""
    commands = np.array([command for each in cases.values() for command in each])
    reach = np.broadcast_to(REACH_M, (len(commands), REACH_M.size))
    record = arm.simulate(commands, reach, tick_s=TICK_S).tip_m_s2[:, -RECORD_TICKS:]
    power = np.abs(np.fft.rfft(record * np.hanning(RECORD_TICKS))) ** 2
    return dict(zip(cases, power.reshape(len(cases), -1, HERTZ.size), strict=True))


@cache
def start_spectra() -> dict[str, Floats]:
    """Spectra of the undamped arm, which rings because the circle starts."""
    return spectra(ARM, started())


@cache
def excited_spectra() -> dict[str, Floats]:
    """Spectra of the arm with 1 % of damping, by what excites it."""
    return spectra(DAMPED, excited())


def against_none_db(found: dict[str, Floats]) -> dict[str, Floats]:
    """Vibration in the band by each law, against no shaping, in dB."""
    levels_db = {name: 10.0 * np.log10(power[:, INSIDE].sum(axis=1)) for name, power in found.items()}
    return {name: level_db[1:] - level_db[0] for name, level_db in levels_db.items()}


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Lay out a Markdown table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def tables() -> dict[str, str]:
    """All tables of the page."""

    def rows(found: dict[str, Floats]) -> list[list[str]]:
        levels_db = against_none_db(found)
        return [[name, *(f"{level:+.1f}" for level in levels)] for name, levels in levels_db.items()]

    return {
        "the start alone": table(["undamped, start of the circle", *LAWS], rows(start_spectra())),
        "excitations": table(["1 % damping, zvd", *LAWS], [*rows(excited_spectra()), PAPER]),
    }


@cache
def impulses(law: SpacingLaw, old: int, new: int) -> Impulses:
    """Find what each tap releases at each tick, when the spacing changes at tick 0.

    Samples are sent one at a time, in an input that never rests, and taps are known by their amplitudes.
    """
    double = number_type("double")
    band = Guarantee(ANYTHING, Mode(1.0), Band(1.0, 2.0), ANYTHING)
    taps = SpacedTaps(np.array(FOUR), Spacing((4.0, 5.0), (4, 5)), law, TICK_S, band, double)
    limits = command_limits(SpeedLimits(max_speed_m_s=10.0), tick_s=TICK_S, number=double)
    rope = RopeSettings(1.0, 9.0, 99.0, 99.0, 99.0, TICK_S)
    settings = ShaperSettings(Bank((Row("four", "four", taps),)), limits, rope)
    found: Impulses = {(n, tap): [] for n in range(AFTER) for tap in range(1, 5)}
    for sample in range(-BEFORE, AFTER):
        shape = spaced_filter(settings)
        for n in range(-BEFORE, AFTER):
            shape.turn(float(old if n < 0 else new), 0.0)
            for tap in _taps_in(16 * shape.run(float(n == sample), 1)):
                if n >= 0:
                    found[n, tap].append(sample)
    return found


def _taps_in(sixteenths: float) -> list[int]:
    """Give the taps whose amplitudes add up to this."""
    taps, left = [], round(sixteenths)
    for tap in (4, 3, 2, 1):
        if left >= 16 * FOUR[tap - 1]:
            left -= round(16 * FOUR[tap - 1])
            taps.append(tap)
    return taps


def impulse_figure() -> Figure:
    """Figs 10 to 14: which sample each tap releases at each tick."""
    with figure_style():
        figure, panels = new_figure("Which sample each tap releases", [1.35] * 5, sharex=True)
        for panel, (title, case) in zip(panels, FIGS_10_TO_14.items(), strict=True):
            panel.set_title(title)
            _draw_impulses(panel, impulses(*case), impulses("original", *case[1:]))
        panels[-1].set_xlabel("Tick; the spacing changes at 0")
        return settle(figure)


def _draw_impulses(panel: Axes, found: Impulses, original: Impulses) -> None:
    for (n, tap), samples in found.items():
        colour = INK if samples == original[n, tap] else line_style(0)["color"]
        text = " ".join(map(str, samples))
        if len(samples) != 1:
            text, colour = text or "gap", ALARM
        panel.text(n, tap, text, ha="center", va="center", fontsize=7.0, color=colour)
    panel.set(xlim=(-0.6, AFTER - 0.4), ylim=(4.6, 0.4), yticks=[1, 2, 3, 4], xticks=range(AFTER))
    panel.set_ylabel("Tap")
    panel.grid(visible=False)


SHOWN, SHOWN_HZ = "commands rounded to 5 mm", 12


def shown_db() -> Floats:
    """Spectra of figs 16 and 17 up to 12 Hz, no shaping and each law, in dB below the top of no shaping.

    Lines are summed over 1 / 9 Hz, the resolution of one lap.
    """
    power = excited_spectra()[SHOWN][:, : SHOWN_HZ * round(LAP_S) * (LAPS - 1)]
    levels_db = 10.0 * np.log10(power.reshape(len(power), -1, LAPS - 1).sum(axis=-1))
    return np.asarray(levels_db - levels_db[0].max())


def spectrum_figure() -> Figure:
    """Figs 16 and 17, and the same of the fixed and the phase law."""
    levels_db = shown_db()
    hertz = (0.5 + np.arange(levels_db.shape[-1])) / LAP_S
    pairs = {"Fig 16: original": (1,), "Fig 17: modified": (2,), "Not in the paper": (3, 4)}
    with figure_style():
        figure, panels = new_figure("Acceleration of the tip over seven laps", [2.0] * 3, sharex=True)
        for panel, (title, drawn) in zip(panels, pairs.items(), strict=True):
            panel.set_title(title)
            panel.axvspan(*BAND_HZ, color=GREY, alpha=0.15, linewidth=0.0)
            panel.plot(hertz, levels_db[0], color=GREY, label="no shaping")
            for index in drawn:
                panel.plot(hertz, levels_db[index], label=LAWS[index - 1], **line_style(index - 1))
            panel.set_ylabel("dB")
            panel.set_ylim(-70.0, 30.0)
            panel.legend(loc="upper right", ncols=3)
        panels[-1].set_xlabel("Frequency (Hz); shaded: the first resonance over the circle")
        panels[-1].set_xlim(0.0, SHOWN_HZ)
        return settle(figure)


def figures() -> dict[str, tuple[Figure, object]]:
    """All figures of the page, each with the numbers that it shows."""
    found = [[*key, *samples] for case in FIGS_10_TO_14.values() for key, samples in impulses(*case).items()]
    return {
        "fig-10-to-14": (impulse_figure(), found),
        "fig-16-and-17": (spectrum_figure(), shown_db().round(2).tolist()),
    }


def drawn_from(shown: object) -> str:
    """Write down what a figure was drawn from: matplotlib's versions differ in their bytes, not in this."""
    return json.dumps(shown)


def shortened(svg: str) -> str:
    """Write each path of a figure on one line, rounded to a hundredth of a point, which nobody sees."""

    def on_one_line(path: re.Match[str]) -> str:
        return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path[0].replace("\n", ""))

    return re.sub(r' d="[^"]*"', on_one_line, svg)


def main() -> None:
    """Write the figures and print the tables."""
    FOLDER.mkdir(exist_ok=True)
    for name, (figure, shown) in figures().items():
        text = shortened(figure_bytes(figure, "svg").decode())
        (FOLDER / f"{name}.svg").write_text(f"{text}<!-- {drawn_from(shown)} -->\n", encoding="utf-8")
    for name, text in tables().items():
        print(f"{name}\n\n{text}")


if __name__ == "__main__":
    main()
