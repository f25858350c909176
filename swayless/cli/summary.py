"""The closing table of a build: what each row guarantees, and how far the crane goes after the button.

Not for: proving any of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from swayless.cli.console import interval, per_cent, print_line, print_table

if TYPE_CHECKING:
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile, ShaperRecord, TapsRecord

MM_PER_M = 1000.0
"""Stop distances of int32 blocks are in mm."""

STOPS_NOTE = "stop: way from full speed to rest once the button is released; quick: by a quick stop"


class Stops(NamedTuple):
    """Ways from full speed to rest, in m, counted from the tick in which a button is released or pressed."""

    released_m: float
    quick_m: float


def stops(settings: ShaperSettings, row: int) -> Stops:
    """Ask the block's own reference for its stop distances.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    row : int
        Position of the selector.
    """
    from swayless.controller import CommandShaper, ShaperInput

    shaper = CommandShaper(settings)
    limits = settings.limits
    full = ShaperInput(command=limits.max_command, selector=row)
    ramp_ticks = int(limits.max_command / limits.acceleration_step) + 2
    for _ in range(ramp_ticks + 2 * settings.longest_delay_ticks + 2):
        steady = shaper.step(full)
    quick = shaper.step(full._replace(quick_stop=True))
    per_m = MM_PER_M if settings.number.is_integer else 1.0
    # The distance counts from the next tick on; the tick of the quick stop itself is part of the way.
    first_m = float(quick.reference) / limits.units_per_m_s * settings.tick_s
    return Stops(float(steady.stop_distance) / per_m, float(quick.stop_distance) / per_m + first_m)


def print_summary(design: DesignFile, settings: ShaperSettings) -> None:
    """Print the closing table and what there is to know beside it.

    Parameters
    ----------
    design : DesignFile
        The design of a machine, with taps.
    settings : ShaperSettings
        Its block.
    """
    held = "rope [m]" if _on_rope(design) else "range [Hz]"
    columns = ("knob", "row", "family", "leaves", held, "time [s]", "stop [m]", "quick [m]")
    unshaped = stops(settings, 0)
    rows = [["0", "unshaped", "-", "-", "-", "0", f"{unshaped.released_m:.3f}", f"{unshaped.quick_m:.3f}"]]
    for knob, shaper in enumerate(design.shapers, start=1):
        taps, way = _taps(shaper), stops(settings, knob)
        row = [f"{knob}", shaper.name, shaper.family, f"<= {per_cent(taps.guarantee.tolerance)}"]
        row += [interval(*_held(design, taps)), f"{taps.duration_s:.4g}"]
        rows.append([*row, f"{way.released_m:.3f}", f"{way.quick_m:.3f}"])
    print_table(f"{design.name}: what each position of the knob guarantees", columns, rows)
    print_line(STOPS_NOTE)
    for line in _remarks(design):
        print_line(line)


def _remarks(design: DesignFile) -> Iterator[str]:
    waiting = [shaper.name for shaper in design.shapers if min(shaper.amplitudes) < 0.0]
    if waiting:
        names = ", ".join(waiting)
        yield f"negative amplitudes in {names}: a new command waits until the last one has come to rest"
    if design.plant.frequency_hz[0] < design.plant.frequency_hz[1]:
        gaps = [f"{low:.4g} to {high:.4g}" for low, high in _gaps(design)]
        unit = "m of rope" if _on_rope(design) else "Hz"
        yield (
            f"held by no row: {', '.join(gaps)} {unit}"
            if gaps
            else "every point of the range is held by at least one row"
        )


def _on_rope(design: DesignFile) -> bool:
    return design.plant.kind == "crane"


def _held(design: DesignFile, taps: TapsRecord) -> tuple[float, float]:
    return taps.guarantee.rope_length_m if _on_rope(design) else taps.guarantee.frequency_hz


def _gaps(design: DesignFile) -> list[tuple[float, float]]:
    """Parts of the machine's range that no row holds at its tolerance, in m of rope or in Hz."""
    from swayless.plant import pendulum_rope_length_m
    from swayless.report.ranges import uncovered

    plant = design.plant
    whole = plant.frequency_hz
    if _on_rope(design):
        low_hz, high_hz = plant.frequency_hz
        whole = plant.rope_length_m or (pendulum_rope_length_m(high_hz), pendulum_rope_length_m(low_hz))
    return uncovered([_held(design, _taps(shaper)) for shaper in design.shapers], whole)


def _taps(shaper: ShaperRecord) -> TapsRecord:
    assert shaper.taps is not None  # noqa: S101 - a machine always has a tick
    return shaper.taps


def summary_document(design: DesignFile, settings: ShaperSettings) -> dict[str, Any]:
    """Give the closing table for machines.

    Parameters
    ----------
    design : DesignFile
        The design of a machine, with taps.
    settings : ShaperSettings
        Its block.
    """
    nothing = dict.fromkeys(("family", "tolerance", "frequency_hz", "rope_length_m"))
    rows = [{"knob": 0, "name": "unshaped", **nothing, "duration_s": 0.0, **_stops_document(settings, 0)}]
    for knob, shaper in enumerate(design.shapers, start=1):
        taps = _taps(shaper)
        rows.append(
            {
                "knob": knob,
                "name": shaper.name,
                "family": shaper.family,
                "tolerance": taps.guarantee.tolerance,
                "frequency_hz": list(taps.guarantee.frequency_hz),
                "rope_length_m": list(taps.guarantee.rope_length_m) if _on_rope(design) else None,
                "duration_s": taps.duration_s,
                **_stops_document(settings, knob),
            }
        )
    ranged = design.plant.frequency_hz[0] < design.plant.frequency_hz[1]
    not_held = {
        "not_held_rope_length_m" if _on_rope(design) else "not_held_hz": _gaps(design) if ranged else []
    }
    return {"name": design.name, "number": settings.number.name, "rows": rows, **not_held}


def _stops_document(settings: ShaperSettings, row: int) -> dict[str, float]:
    way = stops(settings, row)
    return {"stop_distance_released_m": way.released_m, "stop_distance_quick_m": way.quick_m}
