"""What swings: the ``[crane]`` or ``[arm]`` section of a machine file.

Not for: how fast it travels (`swayless.machine.drive_section`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from swayless.machine.checks import one_or_two, quantity
from swayless.machine.problems import Table
from swayless.plant import pendulum_frequency_hz

PlantKind: TypeAlias = Literal["crane", "arm"]

LENGTH = quantity("length", 1e-3, 1e4)
FREQUENCY = quantity("frequency", 1e-3, 1e4)
DAMPING = quantity("ratio", 0.0, 1.0, below_high=True)


@dataclass(frozen=True)
class PlantSection:
    """The range of modes that a machine has.

    Parameters
    ----------
    kind : {"crane", "arm"}
        A load on a rope, or anything else with one vibration.
    rope_length_m : tuple of two floats or None
        Shortest and longest rope; None if the file gives frequencies.
    frequency_hz : tuple of two floats
        Lowest and highest undamped natural frequency; from the ropes where these are given.
    damping_ratio : float
        At least 0 and below 1.
    """

    kind: PlantKind
    rope_length_m: tuple[float, float] | None
    frequency_hz: tuple[float, float]
    damping_ratio: float


def read_plant(kind: PlantKind, table: Table) -> PlantSection | None:
    """Read the keys of the plant section that say what swings; None where that stays unknown."""
    rope_length_m = None
    if kind == "crane":
        table.need_one_of("rope_length", "frequency")
        rope_length_m = table.take("rope_length", one_or_two(LENGTH), None)
        frequency_hz = table.take("frequency", one_or_two(FREQUENCY), None)
    else:
        frequency_hz = table.need("frequency", one_or_two(FREQUENCY))
    damping_ratio = table.take("damping_ratio", DAMPING, 0.0)
    if rope_length_m is not None:
        shortest_m, longest_m = rope_length_m
        frequency_hz = pendulum_frequency_hz(longest_m), pendulum_frequency_hz(shortest_m)
    if frequency_hz is None or damping_ratio is None:
        return None
    return PlantSection(kind, rope_length_m, frequency_hz, damping_ratio)
