"""What every stimulus is built from: blank records, commands in the number type, values held for a while.

Not for: the stimuli themselves.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.controller.settings import ShaperSettings
from swayless.verify.records import COMMAND_TYPES, input_dtype


class Builder:
    """Makes stimuli for one block from one seeded generator.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    seed : int
        Seed of the generator.
    """

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
        """Make records of a block at rest: enabled, row 1, command 0, the rope still, the ends far away."""
        inputs = np.zeros(ticks, dtype=input_dtype(self.settings))
        for name, value in self._untouched.items():
            if name in (inputs.dtype.names or ()):
                inputs[name] = value
        rope = self.settings.rope
        if rope is not None:
            between = self.reals(self.random.uniform(float(rope.shortest), float(rope.longest)))
            inputs["rope_length"] = self.random.choice([rope.shortest, rope.longest, between, between])
            inputs["rope_length_valid"] = True
        return inputs

    @property
    def _untouched(self) -> dict[str, Any]:
        """Inputs that are not 0 or false when nobody touches anything."""
        limits, way = self.settings.limits, self.settings.operator.way
        far = 0 if way is None else way.margin + way.farthest
        return {
            "enable": True,
            "selector": 1,
            "step_size": 1,
            "distance_forward": far,
            "distance_reverse": far,
            "distance_valid": True,
            "drive_ready": True,
            "speed_limit": limits.max_command,
        }

    def reals(self, values: ArrayLike) -> NDArray[Any]:
        """Bring values into the number type; in int32 rounded."""
        exact = np.asarray(values, dtype=np.float64)
        rounded = np.rint(exact) if self.settings.number.is_integer else exact
        return rounded.astype(COMMAND_TYPES[self.settings.number.name])

    def commands(self, values: ArrayLike) -> NDArray[Any]:
        """Fractions of the maximum as commands."""
        return self.reals(np.asarray(values, dtype=np.float64) * self.max)

    def odd(self, largest: float) -> NDArray[Any]:
        """Values that are not finite, huge, tiny, negative zero or otherwise off."""
        if self.settings.number.is_integer:
            half = int(largest) // 2
            return np.array([0, 1, -1, 2**31 - 1, -(2**31), 2**28, -(2**28), half], dtype=np.int32)
        kind = COMMAND_TYPES[self.settings.number.name]
        info = np.finfo(kind)
        values = [0.0, -0.0, np.nan, np.inf, -np.inf, info.max, -info.max, info.tiny, largest / 2, -largest]
        return np.array(values, dtype=kind)

    def held(self, ticks: int, values: NDArray[Any], longest: int) -> NDArray[Any]:
        """Values held for random times up to `longest` ticks."""
        lengths = self.random.integers(1, longest + 1, size=ticks // max(1, longest // 2) + 2)
        positions = np.repeat(self.random.integers(0, len(values), size=lengths.size), lengths)
        positions = np.resize(positions, ticks)
        return values[positions]
