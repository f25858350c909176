"""What swings: the ``[crane]`` or ``[arm]`` section of a machine file.

Not for: how fast it travels (`swayless.machine.drive_section`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from swayless.machine.arm_positions import MOST_POSITIONS, POSITION_KEYS, ArmPositions, read_positions
from swayless.machine.checks import one_or_two, quantity, some
from swayless.machine.problems import Table
from swayless.plant import Band, Mode, pendulum_frequency_hz
from swayless.plant.double_pendulum import double_pendulum_modes

PlantKind: TypeAlias = Literal["crane", "arm"]

LENGTH = quantity("length", 1e-3, 1e4)
FREQUENCY = quantity("frequency", 1e-3, 1e4)
DAMPING = quantity("ratio", 0.0, 1.0, below_high=True)
HOIST_SPEED = quantity("speed", 1e-4, 1e2)
MASS = quantity("mass", 1e-3, 1e9)

_DOUBLE_PENDULUM = {"sling_length": LENGTH, "hook_mass": MASS, "load_mass": MASS}


@dataclass(frozen=True)
class DoublePendulum:
    """A load on a sling below a hook on a rope: each rope length has two modes.

    Parameters
    ----------
    sling_length_m : float
        From the hook to the load's centre of gravity, > 0.
    hook_mass_kg, load_mass_kg : float
        Masses, > 0.
    """

    sling_length_m: float
    hook_mass_kg: float
    load_mass_kg: float

    def modes(self, rope_length_m: float) -> tuple[Mode, Mode]:
        """Give the undamped modes on one rope, the lower first."""
        return double_pendulum_modes(rope_length_m, self.sling_length_m, self.hook_mass_kg, self.load_mass_kg)


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
        Lowest and highest undamped natural frequency; from the ropes where these are given. Of a double
        pendulum these are frequencies of the lower mode.
    damping_ratio : float
        At least 0 and below 1.
    double_pendulum : DoublePendulum or None
        Sling and masses, if the file gives them.
    hoist_speed_m_s : float or None
        Fastest that the rope's length changes, if the file gives it.
    positions : ArmPositions or None
        Where an arm has which frequency, if the file says so.
    """

    kind: PlantKind
    rope_length_m: tuple[float, float] | None
    frequency_hz: tuple[float, float]
    damping_ratio: float
    double_pendulum: DoublePendulum | None = None
    hoist_speed_m_s: float | None = None
    positions: ArmPositions | None = None


def read_plant(kind: PlantKind, table: Table) -> PlantSection | None:
    """Read the keys of the plant section that say what swings; None where that stays unknown."""
    rope_length_m = double_pendulum = hoist_speed_m_s = positions = None
    if kind == "crane":
        double_pendulum = _read_double_pendulum(table)
        table.need_one_of("rope_length", "frequency")
        rope_length_m = table.take("rope_length", one_or_two(LENGTH), None)
        frequency_hz = table.take("frequency", one_or_two(FREQUENCY), None)
    else:
        positions, frequency_hz = _read_arm(table)
    damping_ratio = table.take("damping_ratio", DAMPING, 0.0)
    if kind == "crane":
        hoist_speed_m_s = table.take("hoist_speed", HOIST_SPEED, None)
    if rope_length_m is not None:
        lower = rope_bands(rope_length_m, double_pendulum)[0]
        frequency_hz = lower.low_hz, lower.high_hz
    if frequency_hz is None or damping_ratio is None:
        return None
    return PlantSection(
        kind, rope_length_m, frequency_hz, damping_ratio, double_pendulum, hoist_speed_m_s, positions
    )


def _read_arm(table: Table) -> tuple[ArmPositions | None, tuple[float, float] | None]:
    """Read the frequencies of an arm, and the positions where it has them if the file gives those."""
    if not any(key in table.raw for key in POSITION_KEYS):
        frequency_hz = table.need("frequency", one_or_two(FREQUENCY))
        table.asked.extend(POSITION_KEYS)
        return None, frequency_hz
    frequencies_hz = table.need("frequency", some(FREQUENCY, at_most=MOST_POSITIONS))
    positions = read_positions(table, frequencies_hz)
    return positions, None if positions is None else (
        min(positions.frequency_hz),
        max(positions.frequency_hz),
    )


def rope_bands(
    rope_length_m: tuple[float, float], double_pendulum: DoublePendulum | None
) -> tuple[Band, ...]:
    """Give the band of each mode over a range of ropes, lower mode first.

    A shorter rope adds to the stiffness of the sway, as a quadratic form, and leaves the masses as they are:
    so every mode's frequency rises (Rayleigh; Courant and Fischer), and the ends of the range are the
    extremes.

    Parameters
    ----------
    rope_length_m : tuple of two floats
        Shortest and longest rope, > 0.
    double_pendulum : DoublePendulum or None
        Sling and masses; None for a single pendulum.

    Examples
    --------
    >>> [(round(band.low_hz, 3), round(band.high_hz, 3)) for band in rope_bands((2.0, 10.0), None)]
    [(0.158, 0.352)]
    """
    shortest_m, longest_m = rope_length_m
    if double_pendulum is None:
        return (Band(pendulum_frequency_hz(longest_m), pendulum_frequency_hz(shortest_m)),)
    lows, highs = double_pendulum.modes(longest_m), double_pendulum.modes(shortest_m)
    return tuple(Band(low.frequency_hz, high.frequency_hz) for low, high in zip(lows, highs, strict=True))


def _read_double_pendulum(table: Table) -> DoublePendulum | None:
    """Read sling and masses, which stand there all together or not at all, beside a rope length."""
    values = [table.take(key, check, None) for key, check in _DOUBLE_PENDULUM.items()]
    given = [key for key in _DOUBLE_PENDULUM if key in table.raw]
    if not given:
        return None
    for key in _DOUBLE_PENDULUM:
        if key not in table.raw:
            table.place(key).problem(f"missing: a double pendulum has {', '.join(_DOUBLE_PENDULUM)}")
    if "frequency" in table.raw:
        table.place("frequency").wrong(
            table.raw["frequency"], "a double pendulum has two for each rope: give rope_length"
        )
    sling_length_m, hook_mass_kg, load_mass_kg = values
    if sling_length_m is None or hook_mass_kg is None or load_mass_kg is None:
        return None
    return DoublePendulum(sling_length_m, hook_mass_kg, load_mass_kg)
