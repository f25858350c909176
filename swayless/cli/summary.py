"""The closing table of a build: what each row guarantees, and how far the crane goes after the button.

Not for: proving any of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile, TapsRecord
    from swayless.verify import Verdict

METRES_OF_MM = 1e-3
"""Stop distances of int32 blocks are in mm."""


def stop_distances_m(settings: ShaperSettings, row: int) -> tuple[float, float]:
    """Stop distances from full speed in a row: released, and quick-stopped; emergency stops take the drive's own.

    Parameters
    ----------
    settings : ShaperSettings
        The block; its own reference is asked.
    row : int
        Position of the selector.

    Returns
    -------
    released_m, quick_m : float
        Way from the tick after the release, or from the tick of the quick stop on, in m.
    """
    from swayless.controller import CommandShaper, ShaperInput

    shaper = CommandShaper(settings)
    limits = settings.limits
    full = ShaperInput(command=limits.max_command, selector=row)
    ramp_ticks = int(limits.max_command / limits.acceleration_step) + 2
    for _ in range(ramp_ticks + 2 * settings.longest_delay_ticks + 2):
        released = shaper.step(full)
    quick = shaper.step(full._replace(quick_stop=True))
    scale = METRES_OF_MM if settings.number.is_integer else 1.0
    first_m = float(quick.reference) / limits.units_per_m_s * settings.tick_s
    return float(released.stop_distance) * scale, float(quick.stop_distance) * scale + first_m


def stop_rows(design: DesignFile, settings: ShaperSettings) -> tuple[Sequence[str], list[Sequence[str]]]:
    """Columns and lines of the closing table.

    Parameters
    ----------
    design : DesignFile
        The design, with taps.
    settings : ShaperSettings
        The block.
    """
    on_rope = design.plant.kind == "crane"
    held = "holds at rope [m]" if on_rope else "holds at [Hz]"
    columns = ("knob", "row", "family", "residual", held, "duration [s]", "stop, released [m]", "stop, quick [m]")
    released_m, quick_m = stop_distances_m(settings, 0)
    lines: list[Sequence[str]] = [("0", "unshaped", "-", "-", "-", "0", f"{released_m:.3f}", f"{quick_m:.3f}")]
    for position, shaper in enumerate(design.shapers, start=1):
        taps = _taps(design, position)
        low, high = taps.guarantee.rope_length_m if on_rope else taps.guarantee.frequency_hz
        released_m, quick_m = stop_distances_m(settings, position)
        lines.append(
            (
                f"{position}",
                shaper.name,
                shaper.family,
                f"<= {100 * taps.guarantee.tolerance:g} %",
                f"{low:.4g} to {high:.4g}",
                f"{taps.duration_s:.3g}",
                f"{released_m:.3f}",
                f"{quick_m:.3f}",
            )
        )
    return columns, lines


def gap_lines(design: DesignFile) -> list[str]:
    """Say which part of the machine's range no row holds at its tolerance."""
    plant = design.plant
    if plant.frequency_hz[0] >= plant.frequency_hz[1]:
        return []
    gaps = _gaps(design)
    unit = "m of rope" if plant.kind == "crane" else "Hz"
    if not gaps:
        return ["covered: every point of the range is held by at least one row"]
    return [f"not covered at the tolerance: {low:.4g} to {high:.4g} {unit}" for low, high in gaps]


def _gaps(design: DesignFile) -> list[tuple[float, float]]:
    from swayless.plant import pendulum_rope_length_m
    from swayless.report.ranges import uncovered

    plant = design.plant
    guarantees = [_taps(design, position).guarantee for position in range(1, len(design.shapers) + 1)]
    if plant.kind != "crane":
        return uncovered([g.frequency_hz for g in guarantees], plant.frequency_hz)
    low_hz, high_hz = plant.frequency_hz
    whole = plant.rope_length_m or (pendulum_rope_length_m(high_hz), pendulum_rope_length_m(low_hz))
    return uncovered([g.rope_length_m for g in guarantees], whole)


def _taps(design: DesignFile, position: int) -> TapsRecord:
    taps = design.shapers[position - 1].taps
    assert taps is not None  # noqa: S101 - a machine always has a tick
    return taps


def summary_document(
    design: DesignFile, settings: ShaperSettings, directory: Path, verdicts: Sequence[Verdict]
) -> dict[str, Any]:
    """Give the closing table for machines.

    Parameters
    ----------
    design : DesignFile
        The design, with taps.
    settings : ShaperSettings
        The block.
    directory : Path
        Where the files are.
    verdicts : sequence of Verdict
        What verification found; empty if it was not run.
    """
    rows = []
    for position, shaper in enumerate(design.shapers, start=1):
        taps = _taps(design, position)
        released_m, quick_m = stop_distances_m(settings, position)
        rows.append(
            {
                "knob": position,
                "name": shaper.name,
                "family": shaper.family,
                "tolerance": taps.guarantee.tolerance,
                "frequency_hz": list(taps.guarantee.frequency_hz),
                "rope_length_m": list(taps.guarantee.rope_length_m),
                "duration_s": taps.duration_s,
                "stop_distance_released_m": released_m,
                "stop_distance_quick_m": quick_m,
            }
        )
    return {
        "name": design.name,
        "directory": str(directory),
        "rows": rows,
        "not_covered": [list(gap) for gap in _gaps(design)] if design.plant.frequency_hz[0] < design.plant.frequency_hz[1] else [],
        "verified": "not run" if not verdicts else all(v.comparison.is_equal for v in verdicts),
        "runs": [{"code": v.code, "stimulus": v.stimulus, "ticks": v.ticks, "equal": v.comparison.is_equal} for v in verdicts],
    }
