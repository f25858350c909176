"""What a block is put through: every input toggled, in every way an operator and a fault would.

A stimulus is a structured array with the fields of the generated input structure, one record per tick.
Not for: running anything.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swayless.controller.settings import ShaperSettings
from swayless.verify.builder import Builder
from swayless.verify.operator_stimulus import habits, hurried, touched
from swayless.verify.rope_stimulus import hoisted, misread, wandering


@dataclass(frozen=True, eq=False)
class Stimulus:
    """Inputs of a block, tick by tick.

    Parameters
    ----------
    name : str
        What it is.
    inputs : structured ndarray, shape (ticks,)
        Fields as in `input_dtype`.
    """

    name: str
    inputs: NDArray[np.void]


def step_and_release(build: Builder) -> Stimulus:
    """Step to full speed and release, on every row, both ways."""
    leg = build.ramp * 2 + build.last * 3 + 10
    parts = []
    for selector in range(build.rows + 1):
        for direction in (1.0, -1.0, 0.37):
            part = build.blank(2 * leg)
            part["selector"] = selector
            part["command"][:leg] = build.commands(np.full(leg, direction))
            parts.append(part)
    return Stimulus("steps", np.concatenate(parts))


def jogs(build: Builder) -> Stimulus:
    """Short presses of every length up to twice the longest delay, on every row."""
    parts = []
    longest = 2 * (build.ramp + build.last)
    for selector in range(1, build.rows + 1):
        for press in np.unique(np.geomspace(1, longest, 12).astype(int)):
            part = build.blank(press + int(build.random.integers(1, longest)))
            part["selector"] = selector
            part["command"][:press] = build.commands(np.full(press, build.random.choice([1.0, -1.0])))
            parts.append(part)
    return Stimulus("pendant jogs", np.concatenate(parts))


def joystick(build: Builder, ticks: int) -> Stimulus:
    """Move a random joystick: wandering, held, noisy; out of range at times."""
    inputs = build.blank(ticks)
    wander = np.clip(np.cumsum(build.random.normal(0.0, 0.03, ticks)), -1.2, 1.2)
    levels = build.held(ticks, np.array([0.0, 0.0, 0.5, -0.5, 1.0, -1.0, 1.5, 0.01]), 3 * build.last + 20)
    noisy = build.held(ticks, np.array([False, True]), 5 * build.last + 50)
    inputs["command"] = build.commands(np.where(noisy, wander, levels))
    inputs["selector"] = build.held(ticks, np.arange(build.rows + 1), 20 * build.last + 200)
    return Stimulus("random joystick", inputs)


def knob(build: Builder, ticks: int) -> Stimulus:
    """Turn the knob every few ticks, to invalid positions too, and toggle enable."""
    inputs = build.blank(ticks)
    levels = build.held(ticks, np.array([0.0, 1.0, -1.0, 0.3]), 2 * (build.last + build.ramp))
    inputs["command"] = build.commands(levels)
    inputs["selector"] = build.held(ticks, np.array([*range(build.rows + 1), build.rows + 1, 255]), 5)
    inputs["enable"] = build.held(ticks, np.array([True, True, True, False]), 40)
    return Stimulus("knob", inputs)


def stops(build: Builder, ticks: int) -> Stimulus:
    """Quick and emergency stops of every length, at any moment, alone and together."""
    inputs = build.blank(ticks)
    levels = build.held(ticks, np.array([0.0, 0.0, 1.0, -1.0, 0.4]), build.last + build.ramp)
    inputs["command"] = build.commands(levels)
    inputs["selector"] = build.held(ticks, np.arange(build.rows + 1), 4 * build.last + 8)
    rare = np.array([False] * 19 + [True])
    inputs["quick_stop"] = build.held(ticks, rare, 30)
    inputs["emergency_stop"] = build.held(ticks, rare, 30)
    return Stimulus("stops", inputs)


def bad_input(build: Builder, ticks: int) -> Stimulus:
    """Commands that are not finite, huge, tiny or negative zero; everything flaps at once."""
    inputs = build.blank(ticks)
    inputs["command"] = build.held(ticks, build.odd(build.max), 60)
    inputs["selector"] = build.random.integers(0, 256, ticks)
    inputs["enable"] = build.held(ticks, np.array([True, False]), 100)
    inputs["quick_stop"] = build.held(ticks, np.array([False] * 9 + [True]), 50)
    inputs["emergency_stop"] = build.held(ticks, np.array([False] * 9 + [True]), 50)
    return Stimulus("bad input", inputs)


def stimuli(settings: ShaperSettings, *, ticks: int, seed: int = 1) -> Iterator[Stimulus]:
    """Make every stimulus for a block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    ticks : int
        Length of each random stimulus.
    seed : int
        Seed of the random ones.

    Yields
    ------
    Stimulus
        Steps, pendant jogs, random joystick, knob, stops and bad input; where the rope or a position is
        measured, while that is held still, then some of them while it moves and while it is read wrongly,
        and, where taps follow a spacing, while it wanders through all spacings. Where there are buttons for
        steps, switches, distances, feedback or something to set: each of these, and all at once.
    """
    build = Builder(settings, seed)
    made = [step_and_release(build), jogs(build)]
    made += [random_stimulus(build, ticks) for random_stimulus in (joystick, knob, stops, bad_input)]
    yield from made
    if settings.rope is not None:
        for stimulus in made[:5]:
            yield Stimulus(f"{stimulus.name}, hoisting", hoisted(build, stimulus.inputs))
        yield Stimulus("rope read wrongly", misread(build, hoisted(build, joystick(build, ticks).inputs)))
    if settings.is_spaced:
        yield Stimulus("steps, every spacing", wandering(build, made[0].inputs))
    yield from _operated(build, ticks)


def _operated(build: Builder, ticks: int) -> Iterator[Stimulus]:
    """Make the stimuli of what only some blocks have inputs for."""
    for name, habit in habits(build.settings):
        inputs = hurried(build, ticks)
        habit(build, inputs)
        yield Stimulus(name, inputs)
    if habits(build.settings):
        inputs = stops(build, ticks).inputs
        inputs = inputs if build.settings.rope is None else misread(build, hoisted(build, inputs))
        yield Stimulus("everything at once", touched(build, inputs))


def soak(settings: ShaperSettings, *, ticks: int, seed: int = 2) -> Stimulus:
    """Make one long stimulus that mixes all the others' habits.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    ticks : int
        Its length.
    seed : int
        Seed.
    """
    build = Builder(settings, seed)
    inputs = joystick(build, ticks).inputs
    inputs["quick_stop"] = build.held(ticks, np.array([False] * 199 + [True]), 50)
    inputs["emergency_stop"] = build.held(ticks, np.array([False] * 199 + [True]), 50)
    if settings.rope is not None:
        inputs = misread(build, hoisted(build, inputs), one_in=50)
    inputs = touched(build, inputs)
    return Stimulus(f"soak of {ticks} ticks", inputs)
