"""What `swayless simulate` gives: tables, a document for machines, records, and what a figure shows.

Not for: simulating.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from swayless.cli.console import per_cent, print_line, print_table
from swayless.cli.driven_summary import gain_document, gain_lines
from swayless.cli.simulated_control import rope_of
from swayless.cli.simulated_place import is_arm, place_head, place_text, place_unit, shown, shown_unit
from swayless.cli.simulated_remarks import notable
from swayless.plant import pendulum_frequency_hz

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from swayless.cli.simulated_case import Case, Simulation
    from swayless.machine import DesignFile, PlantRecord
    from swayless.plant.simulation.trajectory import FloatArray

_MM = 1000.0
_DIGITS = 9


def print_simulation(design: DesignFile, simulation: Simulation, within_m: float) -> None:
    """Print one table of a move: rope by rope, the block's rows, unshaped, and plain ramps.

    Parameters
    ----------
    design : DesignFile
        Whose block moved.
    simulation : Simulation
        The move.
    within_m : float
        How near to its end the load rests.
    """
    angle = () if is_arm(design.plant) else ("[deg]",)
    heads = (
        place_head(design.plant),
        "moved by",
        "left [mm]",
        *angle,
        "[%]",
        "peak [mm]",
        "travel [m]",
        "stands [s]",
        "rests [s]",
    )
    rows = [_row(design, case, within_m) for case in simulation.cases]
    print_table(f"{design.name}: {move_text(design, simulation)}", heads, rows)
    for line in (*gain_lines(design, simulation), *simulation.remarks):
        print_line(line)


def print_note(design: DesignFile, within_m: float) -> None:
    """Say what the heads of the tables mean."""
    unshaped = "v / w" if is_arm(design.plant) else "v sqrt(L / g)"
    stand = "hoist" if design.plant.position is None else "position"
    print_line(
        f"left: amplitude of the sway once reference and {stand} stand, before it decays;"
        f" %: of {unshaped}, the sway of an unshaped step; peak: largest sway at any tick;"
        " stands: from the press until the reference is 0; rests: until the load stays within"
        f" {_MM * within_m:.4g} mm of its end"
    )


def _row(design: DesignFile, case: Case, within_m: float) -> list[str]:
    angle_rad, rests_s = residual_rad(design, case), case.rests_s(within_m)
    return [
        place_text(design.plant, case.site),
        case.contender.name,
        f"{_MM * case.residual_m:.1f}",
        *([] if angle_rad is None else [f"{math.degrees(angle_rad):.3f}"]),
        f"{100.0 * case.residual_ratio:.2f}",
        f"{_MM * case.peak_sway_m:.0f}",
        f"{case.travel_m:.3f}",
        f"{case.stands_s:.2f}",
        "-" if rests_s is None else f"{rests_s:.2f}",
    ]


def move_text(design: DesignFile, simulation: Simulation) -> str:
    """Say what was asked for: how long, how fast, with which hoist or sweep, and wind."""
    move, plant = simulation.move, design.plant
    what, unit = "hoist" if plant.position is None else "sweep", shown_unit(plant)
    press = f"{simulation.held_s:g} s" if move.distance_m is None else f"{move.distance_m:g} m"
    text = f"{press} at {simulation.speed_m_s:.4g} m/s"
    if move.start_s:
        text += f" from {move.start_s:g} s"
    if move.hoist is not None:
        way = move.hoist
        low, high, rate = (shown(plant, value) for value in (way.from_m, way.to_m, way.rate_m_s))
        text += f", {what} {low:g} to {high:g} {unit} at {rate:g} {unit}/s"
        text += f" from {way.start_s:g} s"
    if move.wind is not None:
        text += f", wind {move.wind.push_m_s2:g} m/s2 from {move.wind.start_s:g} s"
        text += "" if move.wind.duration_s is None else f" for {move.wind.duration_s:g} s"
    return text if move.name is None else f"{move.name}: {text}"


def residual_rad(design: DesignFile, case: Case) -> float | None:
    """Angle from the suspension to the load where its sway turns; None for an arm."""
    if is_arm(design.plant):
        return None
    pendulum = design.plant.double_pendulum
    below_m = float(case.left.rope_length_m[-1]) + (0.0 if pendulum is None else pendulum.sling_length_m)
    return math.asin(case.residual_m / below_m)


def simulation_document(design: DesignFile, simulation: Simulation, within_m: float) -> dict[str, Any]:
    """Give a move and all that came of it, for machines.

    Parameters
    ----------
    design, simulation, within_m
        As for `print_simulation`.
    """
    return {
        "move": move_text(design, simulation),
        "speed_m_s": simulation.speed_m_s,
        "pressed_s": simulation.pressed_s,
        "held_s": simulation.held_s,
        "cases": [_case_document(design, case, within_m) for case in simulation.cases],
        **gain_document(design, simulation),
        "remarks": list(simulation.remarks),
    }


def _case_document(design: DesignFile, case: Case, within_m: float) -> dict[str, Any]:
    site, numbers = (
        case.site,
        {
            "residual_m": case.residual_m,
            "residual_rad": residual_rad(design, case),
            "residual_ratio": case.residual_ratio,
            "peak_sway_m": case.peak_sway_m,
            "travel_m": case.travel_m,
            "stands_s": case.stands_s,
            "rests_s": case.rests_s(within_m),
        },
    )
    ends = [site.length_m, site.length_m] if site.hoist is None else [site.hoist.from_m, site.hoist.to_m]
    has_positions, on_rope = design.plant.position is not None, not is_arm(design.plant)
    hertz = pendulum_frequency_hz(float(case.left.rope_length_m[-1]))
    return {
        "moved_by": case.contender.name,
        "knob": case.contender.knob,
        **({"for_pendulum": True} if case.contender.for_pendulum else {}),
        "status": [bit.name for bit in notable(case.contender.status)],
        "rope_length_m": ends if on_rope else None,
        **({"position": ends} if has_positions else {}),
        "frequency_hz": None if on_rope else round(hertz, _DIGITS),
        **{key: None if value is None else round(value, _DIGITS) for key, value in numbers.items()},
    }


def record_text(design: DesignFile, cases: list[Case]) -> str:
    """Give a record of one rope as CSV: time, rope, and reference, trolley and sway of every case.

    Of an arm it has frequencies in the place of ropes, and behind them positions, if the arm has some.

    Parameters
    ----------
    design : DesignFile
        Whose block moved.
    cases : list of Case
        On one rope.
    """
    run = cases[0].run
    heads, columns = ["time_s", "rope_length_m"], [run.time_s, run.rope_length_m]
    if is_arm(design.plant):
        heads[1], columns[1] = "frequency_hz", pendulum_frequency_hz(1.0) / np.sqrt(run.rope_length_m)
    if design.plant.position is not None:
        site = cases[0].site
        heads.append(f"position_{design.plant.position.unit}")
        columns.append(rope_of(site.hoist, site.length_m, run.time_s))
    for case in cases:
        name = case.contender.name.replace(",", "")
        heads += [f"{name}: {what}" for what in ("reference_m_s", "trolley_m", "sway_m")]
        columns += [reference_of(case), case.run.trolley_m, case.run.sway_m]
    stream = io.StringIO()
    np.savetxt(stream, np.column_stack(columns), "%.9g", ",", header=",".join(heads), comments="")
    return stream.getvalue()


def reference_of(case: Case) -> FloatArray:
    """Give the reference as each tick begins, and 0 once it has ended."""
    reference = np.zeros(case.run.time_s.size)
    reference[: case.contender.reference_m_s.size] = case.contender.reference_m_s
    return reference


def figures(design: DesignFile, simulation: Simulation) -> Iterator[Figure]:
    """Draw each rope of a move: the block's rows and, in grey, unshaped."""
    from swayless.report.simulation import SimulatedRun, simulation_figure

    for site, cases in simulation.sites():
        time_s = cases[0].run.time_s
        held = (time_s >= simulation.pressed_s) & (time_s < simulation.pressed_s + simulation.held_s)
        plant = design.plant
        where = "" if site.hoist is not None else f", {place_text(plant, site)} {place_unit(plant)}"
        places_m = None if site.hoist is None else rope_of(site.hoist, 0.0, time_s)
        yield simulation_figure(
            f"{design.name}: {move_text(design, simulation)}{where}",
            time_s,
            np.where(held, simulation.speed_m_s, 0.0),
            [
                SimulatedRun(
                    case.contender.name,
                    reference_of(case),
                    case.run.sway_m,
                    case.residual_m,
                    shaped=case.contender.knob > 0,
                )
                for case in cases
                if case.contender.knob is not None
            ],
            places=None if places_m is None else (_place_name(plant), shown(plant, 1.0) * places_m),
            tolerance=_tolerance(design, cases),
        )


def _place_name(plant: PlantRecord) -> str:
    return "Rope (m)" if plant.position is None else f"Position ({shown_unit(plant)})"


def _tolerance(design: DesignFile, cases: list[Case]) -> tuple[str, float] | None:
    """Give what the rows promise of an unshaped step, at the most, and how much sway that is."""
    worst = max(cases, key=lambda case: case.residual_m)
    if worst.residual_ratio == 0.0:
        return None
    tolerance = max(shaper.guarantee.tolerance for shaper in design.shapers)
    return f"{per_cent(tolerance)} of an unshaped step", tolerance * worst.residual_m / worst.residual_ratio
