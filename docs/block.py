"""Draw the timing diagrams of `block.md`: `python docs/block.py`.

Each one is a run of the reference on a small machine. A test plays it again, and compares.
Not for: what the diagrams mean (the page), or how they are drawn (`block_drawing.py`).
"""

from __future__ import annotations

import json
import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

from block_drawing import draw
from block_scenes import SCENES, Moment, Scene

from swayless.controller import CommandShaper, ShaperInput, ShaperOutput, ShaperSettings
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.functions import undisturbed
from swayless.machine.running import shaper_settings
from swayless.report import figure_bytes

FOLDER = Path(__file__).with_suffix("")
STORED_EVERY = 10
"""Every tenth tick stands in the file, for the test that compares."""


@dataclass(frozen=True)
class Played:
    """A scene as it was played: one entry for each tick."""

    time_s: list[float]
    position_m: list[float]
    inputs: list[ShaperInput]
    outputs: list[ShaperOutput]


def settings_of(text: str) -> ShaperSettings:
    """Design a machine, and give its block."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "yard.toml")
        path.write_text(text)
        return shaper_settings(design_machine(load_machine(path)))


def play(scene: Scene) -> Played:
    """Run a scene on the reference."""
    settings = settings_of(scene.machine)
    shaper, inputs, played = CommandShaper(settings), undisturbed(settings), Played([], [], [], [])
    changes, position_m, reference = list(scene.changes), 0.0, 0.0
    for tick in range(round(scene.last_s / settings.tick_s)):
        time_s = tick * settings.tick_s
        while changes and changes[0][0] <= time_s + 1e-9:
            inputs = inputs._replace(**changes.pop(0)[1])
        now = inputs._replace(**scene.world(Moment(time_s, position_m, reference)))
        output = shaper.step(now)
        reference = output.reference
        position_m += reference * settings.tick_s
        for values, value in zip(
            (played.time_s, played.position_m, played.inputs, played.outputs),
            (time_s, position_m, now, output),
            strict=True,
        ):
            values.append(value)
    return played


def drawn_from(played: Played) -> str:
    """Give what a figure was drawn from, to compare."""
    kept = played.outputs[::STORED_EVERY]
    return json.dumps([[round(float(out.reference), 6) for out in kept], [out.status for out in kept]])


def shortened(svg: str) -> str:
    """Write each path on one line, rounded to a hundredth of a point, which nobody sees."""

    def rounded(path: re.Match[str]) -> str:
        return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path[0].replace("\n", ""))

    return re.sub(r' d="[^"]*"', rounded, svg)


def main() -> None:
    """Write every figure."""
    FOLDER.mkdir(exist_ok=True)
    for name, scene in SCENES.items():
        played = play(scene)
        text = shortened(figure_bytes(draw(scene, played), "svg").decode())
        (FOLDER / f"{name}.svg").write_text(f"{text}<!-- {drawn_from(played)} -->\n", encoding="utf-8")


if __name__ == "__main__":
    main()
