"""From a machine file to what its shapers are compared for, and to the figure. Not for: printing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.design.tradeoff import Need
    from swayless.machine import Machine


def machine_need(
    machine: Machine, *, tolerance: float | None = None, longest_overtravel_m: float | None = None
) -> Need:
    """Give what a machine needs of its shapers.

    Parameters
    ----------
    machine : Machine
        As its file describes it; its rows do not matter.
    tolerance : float, optional
        Residual vibration as a ratio; 5 % unless given.
    longest_overtravel_m : float, optional
        How far the machine may go on from full speed, in m.

    Raises
    ------
    DesignError
        If the machine has more than one mode on each rope, or a drive that feels the load.
    """
    from swayless.design import DEFAULT_TOLERANCE
    from swayless.design.tradeoff import Need
    from swayless.errors import DesignError
    from swayless.plant import Band

    plant, drive = machine.plant, machine.drive
    if plant.double_pendulum is not None:
        raise DesignError(
            f"{machine.source}: [crane] sling_length: candidates are compared for one mode, and a double "
            "pendulum has two; leave sling and masses out to compare for a single pendulum"
        )
    if drive.speed_loop is not None:
        raise DesignError(
            f"{machine.source}: [drive] trolley_mass: candidates are compared at one damping ratio, and below"
            " a speed loop it changes with the rope; leave masses and loop out to compare for a pendulum"
        )
    return Need(
        band=Band(*plant.frequency_hz),
        tolerance=DEFAULT_TOLERANCE if tolerance is None else tolerance,
        damping_ratio=plant.damping_ratio,
        on_rope=plant.kind == "crane",
        speed_m_s=drive.max_speed_m_s,
        ramp_up_s=_ramp_s(drive.max_speed_m_s, drive.acceleration_m_s2),
        ramp_down_s=_ramp_s(drive.max_speed_m_s, drive.deceleration_m_s2),
        longest_overtravel_m=longest_overtravel_m,
    )


def _ramp_s(speed_m_s: float, rate_m_s2: float | None) -> float:
    """Time of a ramp to full speed, in seconds; 0 where there is none."""
    return 0.0 if rate_m_s2 is None else speed_m_s / rate_m_s2


def tradeoff(path: Path, axis: str | None = None) -> Figure:
    """Draw robustness against duration and overtravel for the machine of a file."""
    from swayless.machine import load_machine
    from swayless.report import tradeoff_figure

    machine = load_machine(path, axis=axis)
    return tradeoff_figure(machine.name, machine_need(machine))
