"""`swayless design recommend`: everything that could serve a machine, ranked, with the reasons."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from swayless.cli.options import AxisOption, JsonOption

if TYPE_CHECKING:
    from swayless.design.tradeoff import Need, Recommendation, Refusal
    from swayless.machine import Machine

NOTE = (
    "leaves: at most, in any part of the range; m per m/s: way that it adds once released, per m/s of speed; "
    "stop: way from full speed to rest, ramp included; bound: time in s proved too short for any of its kind"
)
"""What the heads of the table mean."""

ROUNDING = 1e-6
"""A share is rounded down to 0.1 %, but a whole one that is short by rounding stays whole."""

COLUMNS = ("", "candidate", "holds", "leaves", "time [s]", "m per m/s", "stop [m]", "peak", "bound")

MachineArgument = Annotated[
    Path, typer.Argument(metavar="MACHINE.toml", help="A machine file.", show_default=False)
]
ToleranceOption = Annotated[
    str, typer.Option(metavar="V", help="Residual vibration allowed, as a part of the unshaped one.")
]
OvertravelOption = Annotated[
    str | None,
    typer.Option(
        metavar="M",
        help="Longest way from full speed to rest once released, such as '1.5 m'; any unless given.",
    ),
]


def recommend(
    machine: MachineArgument,
    tolerance: ToleranceOption = "5 %",
    longest_overtravel: OvertravelOption = None,
    axis: AxisOption = None,
    json: JsonOption = False,
) -> None:
    """Rank every family, robust shaper, bank and plain ramp for a machine, and say why.

    First comes what holds the machine's whole range within the longest overtravel, the shortest overtravel
    first; then what falls least short. The rows of the machine file do not matter.

    Examples
    --------
    swayless design recommend crane.toml
    swayless design recommend crane.toml --tolerance "3 %" --longest-overtravel "1.5 m"
    """
    from swayless.cli.console import print_json, progress
    from swayless.cli.option_table import option_table, refuse
    from swayless.cli.tradeoff import machine_need
    from swayless.design.tradeoff import recommend as ranked_for
    from swayless.machine import load_machine
    from swayless.machine.plant_section import LENGTH
    from swayless.machine.row_section import TOLERANCE

    problems: list[str] = []
    options = option_table({"tolerance": tolerance, "longest_overtravel": longest_overtravel}, problems)
    ratio = options.take("tolerance", TOLERANCE, None)
    limit_m = options.take("longest_overtravel", LENGTH, None)
    refuse(problems)
    described = load_machine(machine, axis=axis)
    need = machine_need(described, tolerance=ratio, longest_overtravel_m=limit_m)
    with progress() as show:
        ranked, refused = ranked_for(need, on_candidate=lambda name: show(f"designing {name}"))
    if json:
        print_json(_document(described, need, ranked, refused))
    else:
        _print(described, need, ranked, refused)


def _print(machine: Machine, need: Need, ranked: list[Recommendation], refused: list[Refusal]) -> None:
    from swayless.cli.console import per_cent, print_line, print_table

    within = "" if need.longest_overtravel_m is None else f" within {need.longest_overtravel_m:g} m"
    title = f"{machine.name}: what holds {_range(machine)} at {per_cent(need.tolerance)}{within}"
    print_table(title, COLUMNS, [_row(place, item) for place, item in enumerate(ranked, start=1)])
    print_line(NOTE)
    print_line("")
    for place, item in enumerate(ranked, start=1):
        print_line(f"{place} {item.candidate.name}: {item.reason}")
    for refusal in refused:
        print_line(f"- {refusal.name}: not possible: {refusal.reason}")


def _range(machine: Machine) -> str:
    """Write the range of a machine, as its file gives it."""
    plant = machine.plant
    if plant.rope_length_m is not None:
        return "{:.4g} to {:.4g} m of rope".format(*plant.rope_length_m)
    return "{:.4g} to {:.4g} Hz".format(*plant.frequency_hz)


def _row(place: int, item: Recommendation) -> list[str]:
    from swayless.cli.console import rounded_down

    candidate = item.candidate
    bound_s = candidate.lower_bound_s
    return [
        f"{place}",
        candidate.name,
        f"{math.floor(1000 * candidate.share + ROUNDING) / 10:g} %",
        f"{100 * candidate.worst_residual_ratio:.3g} %",
        f"{candidate.duration_s:.4g}",
        f"{candidate.overtravel_s:.3g}",
        f"{candidate.overtravel_m:.3g}",
        f"{candidate.peak_factor:.3g}",
        "-" if bound_s is None else rounded_down(bound_s, 4),
    ]


def _document(
    machine: Machine, need: Need, ranked: list[Recommendation], refused: list[Refusal]
) -> dict[str, Any]:
    return {
        "name": machine.name,
        "rope_length_m": machine.plant.rope_length_m,
        "frequency_hz": machine.plant.frequency_hz,
        "damping_ratio": need.damping_ratio,
        "tolerance": need.tolerance,
        "longest_overtravel_m": need.longest_overtravel_m,
        "candidates": [_candidate(item, need) for item in ranked],
        "not_possible": [{"name": refusal.name, "reason": refusal.reason} for refusal in refused],
    }


def _candidate(item: Recommendation, need: Need) -> dict[str, Any]:
    candidate = item.candidate
    return {
        "name": candidate.name,
        "shortfall_ratio": item.shortfall_ratio,
        "reason": item.reason,
        "share_of_ropes": need.share_of_ropes(candidate.held) if need.on_rope else None,
        "share_of_frequencies": need.share_of_frequencies(candidate.held),
        "held_hz": [[band.low_hz, band.high_hz] for band in candidate.held],
        "worst_residual_ratio": candidate.worst_residual_ratio,
        "jog_residual_ratio": candidate.jog_residual_ratio,
        "duration_s": candidate.duration_s,
        "lower_bound_s": candidate.lower_bound_s,
        "overtravel_s": candidate.overtravel_s,
        "overtravel_m": candidate.overtravel_m,
        "peak_factor": candidate.peak_factor,
        "rows": [
            {
                "family": row.family,
                "frequency_hz": [row.guarantee.band.low_hz, row.guarantee.band.high_hz],
                "times_s": row.times_s.tolist(),
                "amplitudes": row.amplitudes.tolist(),
            }
            for row in candidate.rows
        ],
    }
