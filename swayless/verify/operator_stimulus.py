"""What the operator, the ends of the travel and the drive do to a block. Not for: blocks without them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from swayless.controller.settings import ShaperSettings
from swayless.verify.builder import Builder

Inputs = NDArray[np.void]
Habit = Callable[[Builder, Inputs], None]


def hurried(build: Builder, ticks: int) -> Inputs:
    """Make records of a hurried operator: commands to and fro, other rows, nothing held to its end."""
    inputs = build.blank(ticks)
    levels = np.array([0.0, 0.0, 1.0, -1.0, 0.5, -0.3, 0.04])
    inputs["command"] = build.commands(build.held(ticks, levels, build.last + build.ramp))
    inputs["selector"] = build.held(ticks, np.arange(build.rows + 1), 6 * build.last + 20)
    return inputs


def pressed(build: Builder, inputs: Inputs) -> None:
    """Press step buttons: short, long, both at once, of every size and of none."""
    ticks, longest = inputs.size, 2 * (build.last + build.ramp)
    for name in ("step_forward", "step_reverse"):
        presses = build.held(ticks, np.array([False, False, True]), 6)
        inputs[name] = presses & build.held(ticks, np.array([False, True]), longest)
    inputs["selector"] = build.held(ticks, np.arange(build.rows + 1), 3 * longest)
    inputs["step_size"] = build.held(ticks, np.array([1, 1, 1, 2, 2, 3, 0, 4, 255], dtype=np.uint8), longest)
    inputs["command"][build.held(ticks, np.array([True, True, True, False]), longest)] = 0


def switched(build: Builder, inputs: Inputs) -> None:
    """Make and leave switches at both ends, at any moment, alone and together."""
    for name in inputs.dtype.names or ():
        if name.startswith(("stop_", "slow_")):
            seldom = [True] + [False] * (5 if name.startswith("stop_") else 2)
            inputs[name] = build.held(inputs.size, np.array(seldom), 20)


def measured_ways(build: Builder, inputs: Inputs) -> None:
    """Come nearer to both ends and go away again, jump, tremble where it matters, and be no distances."""
    ticks, limits, way = inputs.size, build.settings.limits, build.settings.operator.way
    margin = 0.0 if way is None else float(way.margin)
    full_m = build.max / limits.units_per_m_s * build.settings.tick_s
    stop_m = full_m * (build.ramp + build.last)
    pace = build.held(ticks, np.array([0.0, 1.0, -1.0, 0.5, -0.7]), 3 * (build.last + build.ramp))
    place_m = np.abs(np.mod(np.cumsum(pace) * full_m, 4.0 * stop_m) - 2.0 * stop_m)
    jump_m = build.held(ticks, np.array([0.0, 0.0, 0.0, -1.0, 0.5, 9.0]) * stop_m, 4 * build.last + 20)
    tremble_m = build.random.normal(0.0, 5e-3, ticks) * build.held(ticks, np.array([0.0, 1.0]), 100)
    is_near = build.held(ticks, np.array([False, False, True]), 4 * build.last + 20)
    per_m = 1000.0 if build.settings.number.is_integer else 1.0
    for name, way_m in (("distance_forward", place_m), ("distance_reverse", 2.0 * stop_m - place_m)):
        wrong = build.held(ticks, np.array([False] * 9 + [True]), 20)
        odd = build.held(ticks, build.odd(stop_m * per_m), 5)
        found = np.where(is_near, margin, (way_m + jump_m) * per_m) + tremble_m * per_m
        inputs[name] = np.where(wrong, odd, build.reals(found))
    # What is not valid is counted down by the references themselves: the crane comes to the end.
    inputs["distance_valid"] = build.held(ticks, np.array([True, False]), build.last + build.ramp)


def tripped(build: Builder, inputs: Inputs) -> None:
    """Trip the drive and bring it back, at rest and at speed; let it lag, stand, and report what is none."""
    ticks, names = inputs.size, inputs.dtype.names or ()
    if "drive_ready" in names:
        inputs["drive_ready"] = build.held(ticks, np.array([True] * 14 + [False]), 3 * build.last + 30)
    if "actual_speed" in names:
        levels = np.array([0.0, 0.0, 0.4, -0.4, 1.0, -1.0, 2.0])
        speeds = build.commands(build.held(ticks, levels, 2 * (build.last + build.ramp)))
        wrong = build.held(ticks, np.array([False] * 5 + [True]), 20)
        inputs["actual_speed"] = np.where(wrong, build.held(ticks, build.odd(build.max), 5), speeds)


def tuned(build: Builder, inputs: Inputs) -> None:
    """Set the speed limit and the offset of the rope, within their ranges, beyond them, and to no number."""
    ticks, names = inputs.size, inputs.dtype.names or ()
    if "speed_limit" in names:
        limits = build.commands(build.held(ticks, np.array([1.0, 1.0, 0.5, 0.1, 0.0, -1.0, 3.0]), 200))
        wrong = build.held(ticks, np.array([False] * 9 + [True]), 50)
        inputs["speed_limit"] = np.where(wrong, build.held(ticks, build.odd(build.max), 20), limits)
    offsets = build.settings.operator.rope_offset
    if offsets is not None:
        low, high = (float(end) for end in offsets)
        reals = build.reals(
            build.held(ticks, np.array([0.0, 0.0, low, high, 0.3 * high, 2.0 * low - 1.0]), 200)
        )
        wrong = build.held(ticks, np.array([False] * 9 + [True]), 50)
        inputs["rope_offset"] = np.where(wrong, build.held(ticks, build.odd(high), 20), reals)


def habits(settings: ShaperSettings) -> list[tuple[str, Habit]]:
    """List what can be done to a block beyond its command, knob, stops and rope.

    Parameters
    ----------
    settings : ShaperSettings
        The block.

    Returns
    -------
    list of tuple
        Name, and what does it to inputs; empty for a block without such inputs.
    """
    operator = settings.operator
    feedback = operator.has_drive_feedback or settings.diagnostics.tracking is not None
    found = (
        (operator.steps is not None, "step buttons", pressed),
        (operator.has_switches, "switches at the ends", switched),
        (operator.way is not None, "ways to the ends", measured_ways),
        (feedback, "drive trips", tripped),
        (operator.is_tuned, "tuning", tuned),
    )
    return [(name, habit) for is_there, name, habit in found if is_there]


def touched(build: Builder, inputs: Inputs) -> Inputs:
    """Copy inputs with everything at once that the block has inputs for.

    Parameters
    ----------
    build : Builder
        Of the block.
    inputs : structured ndarray, shape (ticks,)
        Whatever else happens.
    """
    inputs = inputs.copy()
    for _, habit in habits(build.settings):
        habit(build, inputs)
    return inputs
