"""The load of a machine file as the plant of a move, with the machine's own limits.

Not for: plants of their own (`swayless.machine.profile_plant`).
"""

from __future__ import annotations

from pathlib import Path

from swayless.design.optimal import LinearPlant
from swayless.machine.machine_file import Machine, load_machine
from swayless.machine.plant_section import FREQUENCY, LENGTH
from swayless.machine.problems import Table
from swayless.machine.profile_plant import load_below_trolley
from swayless.plant import Mode, pendulum_frequency_hz

LOAD_KEYS = ("rope_length", "frequency")
"""Options that say which load of a machine with a range is meant."""


def read_machine(
    path: Path, options: Table, *, axis: str | None
) -> tuple[str, LinearPlant | None, dict[str, object]]:
    """Take the load below a trolley as a plant: its speed in, the load's position out.

    Parameters
    ----------
    path : Path
        A machine file.
    options : Table
        Says which load, by one of `LOAD_KEYS`.
    axis : str or None
        Which axis, for a file that has axes.

    Returns
    -------
    name : str
        Of the machine.
    plant : LinearPlant or None
        None where the load is missing or wrong.
    limits : dict
        Tick, speed and acceleration, by the keys of ``[move]``.

    Raises
    ------
    FileError
        If the machine file is wrong.
    """
    machine = load_machine(path, axis=axis)
    reason = _no_such_plant(machine)
    if reason is not None:
        options.report.problems.append(f"{options.report.file}: {reason}")
    limits: dict[str, object] = {"tick": machine.controller.tick_s, "limit": machine.drive.max_speed_m_s}
    if machine.drive.acceleration_m_s2 is not None:
        limits["rate_limit"] = machine.drive.acceleration_m_s2
    frequency_hz = _frequency_hz(machine, options)
    if frequency_hz is None:
        return machine.name, None, limits
    return machine.name, load_below_trolley(Mode(frequency_hz, machine.plant.damping_ratio)), limits


def _no_such_plant(machine: Machine) -> str | None:
    """Say why a machine has another plant than this, if it has."""
    if machine.plant.double_pendulum is not None or machine.drive.speed_loop is not None:
        return "a load below a hook, or a drive that feels the load: write a [plant] of its own"
    if machine.drive.contactor:
        return "[drive] contactor = true: a contactor drive cannot follow a command with values between"
    return None


def _frequency_hz(machine: Machine, options: Table) -> float | None:
    """Read which load is meant; it must lie in the machine's range."""
    options.need_one_of(*LOAD_KEYS)
    rope_m, asked_hz = (
        options.take(key, check, None) for key, check in zip(LOAD_KEYS, (LENGTH, FREQUENCY), strict=True)
    )
    if rope_m is not None and machine.plant.rope_length_m is None:
        options.place("rope_length").wrong(rope_m, "this machine has no rope lengths: give --frequency")
        return None
    frequency_hz = asked_hz if rope_m is None else pendulum_frequency_hz(rope_m)
    low_hz, high_hz = machine.plant.frequency_hz
    if frequency_hz is None or low_hz * (1.0 - 1e-9) <= frequency_hz <= high_hz * (1.0 + 1e-9):
        return frequency_hz
    if rope_m is not None and machine.plant.rope_length_m is not None:
        shortest_m, longest_m = machine.plant.rope_length_m
        allowed = f"must be {shortest_m:g} to {longest_m:g} m, the machine's rope"
        options.place("rope_length").wrong(rope_m, allowed)
    else:
        options.place("frequency").wrong(
            asked_hz, f"must be {low_hz:.6g} to {high_hz:.6g} Hz, as the machine's"
        )
    return None
