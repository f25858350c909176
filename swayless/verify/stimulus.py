"""What a block is put through: every input toggled, in every way an operator and a fault would.

A stimulus is a structured array with the fields of the generated input structure, one record per tick.
Not for: running anything.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.controller.number import NumberType
from swayless.controller.settings import ShaperSettings

COMMAND_TYPES: dict[str, Any] = {"double": np.float64, "float": np.float32, "int32": np.int32}
"""Array type of a command in each number type."""


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


def input_dtype(settings: ShaperSettings) -> np.dtype[np.void]:
    """Record type of the inputs of a block, laid out as the C structure is."""
    real = COMMAND_TYPES[settings.number.name]
    fields = [
        ("enable", np.bool_),
        ("emergency_stop", np.bool_),
        ("quick_stop", np.bool_),
        ("command", real),
        ("selector", np.uint8),
    ]
    if settings.rope is not None:
        fields += [("rope_length", real), ("hoist_speed", real), ("rope_length_valid", np.bool_)]
    return np.dtype(fields, align=True)


def output_dtype(number: NumberType) -> np.dtype[np.void]:
    """Record type of the outputs, laid out as the C structure is."""
    real = COMMAND_TYPES[number.name]
    return np.dtype(
        [
            ("reference", real),
            ("stop_distance", real),
            ("stop_time_s", real),
            ("stop_time_ticks", np.uint32),
            ("residual_bound", real),
            ("row", np.uint8),
            ("settled", np.bool_),
            ("active", np.bool_),
            ("error", np.bool_),
            ("status", np.uint32),
        ],
        align=True,
    )


class _Builder:
    """Makes stimuli for one block from one seeded generator."""

    def __init__(self, settings: ShaperSettings, seed: int) -> None:
        self.settings = settings
        self.random = np.random.default_rng(seed)
        self.rows = len(settings.bank.rows)
        self.last = settings.longest_delay_ticks
        limits = settings.limits
        slowest = min(limits.acceleration_step, limits.deceleration_step)
        self.ramp = int(limits.max_command / slowest) + 1
        self.max = float(limits.max_command)

    def blank(self, ticks: int) -> NDArray[np.void]:
        inputs = np.zeros(ticks, dtype=input_dtype(self.settings))
        inputs["enable"] = True
        inputs["selector"] = 1
        return inputs

    def commands(self, values: ArrayLike) -> NDArray[Any]:
        """Fractions of the maximum as commands."""
        scaled = np.asarray(values, dtype=np.float64) * self.max
        if self.settings.number.is_integer:
            return np.rint(scaled).astype(np.int32)
        return scaled.astype(COMMAND_TYPES[self.settings.number.name])

    def held(self, ticks: int, values: NDArray[Any], longest: int) -> NDArray[Any]:
        """Values held for random times up to `longest` ticks."""
        lengths = self.random.integers(1, longest + 1, size=ticks // max(1, longest // 2) + 2)
        positions = np.repeat(self.random.integers(0, len(values), size=lengths.size), lengths)
        positions = np.resize(positions, ticks)
        return values[positions]


def step_and_release(build: _Builder) -> Stimulus:
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


def jogs(build: _Builder) -> Stimulus:
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


def joystick(build: _Builder, ticks: int) -> Stimulus:
    """Move a random joystick: wandering, held, noisy; out of range at times."""
    inputs = build.blank(ticks)
    wander = np.clip(np.cumsum(build.random.normal(0.0, 0.03, ticks)), -1.2, 1.2)
    levels = build.held(ticks, np.array([0.0, 0.0, 0.5, -0.5, 1.0, -1.0, 1.5, 0.01]), 3 * build.last + 20)
    noisy = build.held(ticks, np.array([False, True]), 5 * build.last + 50)
    inputs["command"] = build.commands(np.where(noisy, wander, levels))
    inputs["selector"] = build.held(ticks, np.arange(build.rows + 1), 20 * build.last + 200)
    return Stimulus("random joystick", inputs)


def knob(build: _Builder, ticks: int) -> Stimulus:
    """Turn the knob every few ticks, to invalid positions too, and toggle enable."""
    inputs = build.blank(ticks)
    levels = build.held(ticks, np.array([0.0, 1.0, -1.0, 0.3]), 2 * (build.last + build.ramp))
    inputs["command"] = build.commands(levels)
    inputs["selector"] = build.held(ticks, np.array([*range(build.rows + 1), build.rows + 1, 255]), 5)
    inputs["enable"] = build.held(ticks, np.array([True, True, True, False]), 40)
    return Stimulus("knob", inputs)


def stops(build: _Builder, ticks: int) -> Stimulus:
    """Quick and emergency stops of every length, at any moment, alone and together."""
    inputs = build.blank(ticks)
    levels = build.held(ticks, np.array([0.0, 0.0, 1.0, -1.0, 0.4]), build.last + build.ramp)
    inputs["command"] = build.commands(levels)
    inputs["selector"] = build.held(ticks, np.arange(build.rows + 1), 4 * build.last + 8)
    rare = np.array([False] * 19 + [True])
    inputs["quick_stop"] = build.held(ticks, rare, 30)
    inputs["emergency_stop"] = build.held(ticks, rare, 30)
    return Stimulus("stops", inputs)


def bad_input(build: _Builder, ticks: int) -> Stimulus:
    """Commands that are not finite, huge, tiny or negative zero; everything flaps at once."""
    inputs = build.blank(ticks)
    if build.settings.number.is_integer:
        odd = np.array([0, 1, -1, 2**31 - 1, -(2**31), 2**28, -(2**28), int(build.max) // 2], dtype=np.int32)
    else:
        kind = COMMAND_TYPES[build.settings.number.name]
        info = np.finfo(kind)
        odd = np.array(
            [0.0, -0.0, np.nan, np.inf, -np.inf, info.max, -info.max, info.tiny, build.max / 2, -build.max],
            dtype=kind,
        )
    inputs["command"] = build.held(ticks, odd, 60)
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
        Steps, pendant jogs, random joystick, knob, stops and bad input.
    """
    build = _Builder(settings, seed)
    yield step_and_release(build)
    yield jogs(build)
    for random_stimulus in (joystick, knob, stops, bad_input):
        yield random_stimulus(build, ticks)


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
    build = _Builder(settings, seed)
    inputs = joystick(build, ticks).inputs
    inputs["quick_stop"] = build.held(ticks, np.array([False] * 199 + [True]), 50)
    inputs["emergency_stop"] = build.held(ticks, np.array([False] * 199 + [True]), 50)
    return Stimulus(f"soak of {ticks} ticks", inputs)
