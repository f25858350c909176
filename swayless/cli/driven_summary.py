"""What the true mode of a driven crane gains: each row beside the one for a pendulum, on the same crane.

Not for: simulating, nor for the tables of a move (`swayless.cli.simulation_summary`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from swayless.cli.simulated_plant import servo_drive
from swayless.plant import pendulum_mode, servo_drive_mode

if TYPE_CHECKING:
    from swayless.cli.simulated_case import Case, Simulation
    from swayless.machine import DesignFile

_DIGITS = 9


def gain_lines(design: DesignFile, simulation: Simulation) -> Iterator[str]:
    """Say on each rope how the load swings, and what the rows leave beside those for a pendulum.

    Parameters
    ----------
    design : DesignFile
        Whose block moved; without a speed loop there is nothing to say.
    simulation : Simulation
        The move.
    """
    for rope in _ropes(design, simulation):
        (low_m, length_m), mode = rope["rope_length_m"], rope["mode"]
        yield (
            f"on {length_m:.4g} m: trolley, load and speed loop swing at {mode['frequency_hz']:.4f} Hz,"
            f" damping ratio {mode['damping_ratio']:.4f}; a pendulum at"
            f" {mode['pendulum_frequency_hz']:.4f} Hz, {mode['pendulum_damping_ratio']:g}"
        )
        for row in rope["rows"]:
            was = "" if low_m == length_m else f", hoisted from {low_m:.4g} m"
            yield (
                f"on {length_m:.4g} m{was}: {row['moved_by']}, made for the true mode, leaves"
                f" {100.0 * row['residual_ratio']:.2f} %; made for a pendulum,"
                f" {100.0 * row['pendulum_residual_ratio']:.2f} %"
            )


def gain_document(design: DesignFile, simulation: Simulation) -> dict[str, Any]:
    """Give the same for machines: an object with `true_mode`; empty without a speed loop.

    Parameters
    ----------
    design, simulation
        As for `gain_lines`.
    """
    ropes = list(_ropes(design, simulation))
    return {"true_mode": ropes} if ropes else {}


def _ropes(design: DesignFile, simulation: Simulation) -> Iterator[dict[str, Any]]:
    """Give the mode at the end of each rope, and every row beside that for a pendulum."""
    loop, own = design.drive.speed_loop, design.plant.damping_ratio
    if loop is None:
        return
    for site, cases in simulation.sites():
        end_m = site.length_m if site.hoist is None else site.hoist.to_m
        true, pendulum = servo_drive_mode(servo_drive(loop), end_m, own), pendulum_mode(end_m, own)
        yield {
            "rope_length_m": [site.length_m, end_m],
            "mode": {
                "frequency_hz": round(true.frequency_hz, _DIGITS),
                "damping_ratio": round(true.damping_ratio, _DIGITS),
                "pendulum_frequency_hz": round(pendulum.frequency_hz, _DIGITS),
                "pendulum_damping_ratio": pendulum.damping_ratio,
            },
            "rows": list(_rows(cases)),
        }


def _rows(cases: list[Case]) -> Iterator[dict[str, Any]]:
    """Put each row of the block beside the one for a pendulum."""
    naive = {case.contender.knob: case for case in cases if case.contender.for_pendulum}
    for case in cases:
        knob = case.contender.knob
        if knob in naive and not case.contender.for_pendulum:
            yield {
                "moved_by": case.contender.name,
                "knob": knob,
                "residual_m": round(case.residual_m, _DIGITS),
                "residual_ratio": round(case.residual_ratio, _DIGITS),
                "pendulum_residual_m": round(naive[knob].residual_m, _DIGITS),
                "pendulum_residual_ratio": round(naive[knob].residual_ratio, _DIGITS),
            }
