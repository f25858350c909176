"""Ropes and positions for stimuli: held still, moved in every way, and read wrongly. Not for: commands."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swayless.controller.rope import RopeSettings
from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import spacing_of
from swayless.verify.builder import Builder

SPEEDS = np.array([0.0, 0.0, 0.0, 1.0, -1.0, 0.5, -0.3, 0.02])
"""Hoist speeds, as parts of the fastest."""

NOISE = 0.01
"""Noise of a measured hoist speed, as a part of the fastest."""


def rope_of(settings: ShaperSettings) -> RopeSettings:
    """Give the measured rope of a block that has one."""
    assert settings.rope is not None  # noqa: S101 - only such blocks are given ropes
    return settings.rope


def hoisted(build: Builder, inputs: NDArray[np.void]) -> NDArray[np.void]:
    """Copy inputs with a rope that is hoisted up and down, in and out of moves, with rests and noise.

    Parameters
    ----------
    build : Builder
        Of the block; it has a measured rope.
    inputs : structured ndarray, shape (ticks,)
        Whatever else happens.
    """
    rope, inputs = rope_of(build.settings), inputs.copy()
    shortest, span = float(rope.shortest), float(rope.longest - rope.shortest)
    parts = build.held(inputs.size, SPEEDS, build.last + 2 * build.ramp)
    way = np.cumsum(parts) * float(rope.hoist_speed) * build.settings.tick_s
    turned = np.mod(way + span * build.random.uniform(0.0, 2.0), 2.0 * span)
    noisy = build.held(inputs.size, np.array([False, False, True]), 4 * build.last)
    parts = np.where(turned < span, parts, -parts) + noisy * build.random.normal(0.0, NOISE, inputs.size)
    inputs["rope_length"] = build.reals(shortest + np.minimum(turned, 2.0 * span - turned))
    inputs["hoist_speed"] = build.reals(parts * float(rope.hoist_speed))
    return inputs


def wandering(build: Builder, inputs: NDArray[np.void]) -> NDArray[np.void]:
    """Copy inputs with a position that wanders through all spacings, to and fro over each place of change.

    Parameters
    ----------
    build : Builder
        Of the block; its taps follow a spacing.
    inputs : structured ndarray, shape (ticks,)
        Whatever else happens.
    """
    rope, inputs = rope_of(build.settings), inputs.copy()
    starts = build.reals(spacing_of(build.settings).starts)
    below = starts - 1 if build.settings.number.is_integer else np.nextafter(starts, starts[0] - 1)
    places = np.unique(np.clip([starts, below], rope.shortest, rope.longest))
    ways = build.random.choice([1, 1, 1, -1], inputs.size)
    turned = np.mod(np.cumsum(ways), max(2 * places.size - 2, 1))
    order = np.minimum(turned, 2 * places.size - 2 - turned)
    longest = max(1, inputs.size // (6 * places.size))
    stays = build.random.integers(1, longest + 1, inputs.size)
    moves = np.searchsorted(np.cumsum(stays), np.arange(inputs.size), side="right")
    inputs["rope_length"] = places[order[moves]]
    inputs["hoist_speed"] = 0
    return inputs


def misread(build: Builder, inputs: NDArray[np.void], *, one_in: int = 3) -> NDArray[np.void]:
    """Copy inputs with readings of the rope that are wrong: stuck, far off, flagged, no numbers.

    Parameters
    ----------
    build : Builder
        Of the block; it has a measured rope.
    inputs : structured ndarray, shape (ticks,)
        With a rope that moves.
    one_in : int
        One stretch of readings in so many is wrong, of length and speed each.
    """
    inputs, rope = inputs.copy(), rope_of(build.settings)
    ticks = np.arange(inputs.size)
    rare = np.arange(one_in) == 0
    stuck = build.held(inputs.size, rare, 100)
    last_free = np.maximum.accumulate(np.where(stuck, 0, ticks))
    inputs["rope_length"] = inputs["rope_length"][last_free]
    for field, longest in (("rope_length", float(rope.longest)), ("hoist_speed", float(rope.hoist_speed))):
        wrong = build.held(inputs.size, rare, 50)
        odd = build.held(inputs.size, build.odd(longest), 20)
        inputs[field] = np.where(wrong, odd, inputs[field])
    inputs["rope_length_valid"] = ~build.held(inputs.size, rare, 50)
    return inputs
