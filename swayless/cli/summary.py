"""The closing table of a build: what each row guarantees, and how far the crane goes after the button.

Not for: proving any of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from swayless.cli.bank_summary import switching
from swayless.cli.console import interval, per_cent, print_line, print_table
from swayless.cli.design_summary import bands, damping_ratios, proofs
from swayless.cli.operator_summary import operator_document, operator_remarks
from swayless.cli.ways import ways

if TYPE_CHECKING:
    from swayless.controller import ShaperSettings
    from swayless.machine import AnyTapsRecord, DesignFile, ShaperRecord

WAY_DIGITS = 9
"""Decimals of a way in m in a document: a nanometre."""

STOPS_NOTE = "stop: way from full speed to rest once the button is released; quick: by a quick stop"


def print_summary(design: DesignFile, settings: ShaperSettings) -> None:
    """Print the closing table and what there is to know beside it.

    Parameters
    ----------
    design : DesignFile
        The design of a machine, with taps.
    settings : ShaperSettings
        Its block.
    """
    place = "rope [m]" if _on_rope(design) else "range [Hz]"
    columns = ["knob", "row", "family", "leaves", place, "time [s]", "stop [m]", "quick [m]"]
    unshaped = ways(settings, 0)
    rows = [["0", "unshaped", "-", "-", "-", "0", f"{unshaped.released_m:.3f}", f"{unshaped.quick_m:.3f}"]]
    for knob, shaper in enumerate(design.shapers, start=1):
        taps, way = _taps(shaper), ways(settings, knob)
        row = [f"{knob}", shaper.name, shaper.family, f"<= {per_cent(taps.guarantee.tolerance)}"]
        row += [interval(*_held(design, taps)), f"{taps.duration_s:.4g}"]
        rows.append([*row, f"{way.released_m:.3f}", f"{way.quick_m:.3f}"])
    knob_turns = design.bank is None or design.bank.selection == "knob"
    who = "each position of the knob guarantees" if knob_turns else "each row guarantees; the rope chooses"
    print_table(f"{design.name}: what {who}", columns, rows)
    print_line(STOPS_NOTE)
    for line in (*_robust_remarks(design), *_remarks(design, settings), *operator_remarks(settings)):
        print_line(line)


def _robust_remarks(design: DesignFile) -> Iterator[str]:
    """Say what rows hold beside what stands in the table, what is proved of them, and where to switch."""
    for knob, shaper in enumerate(design.shapers, start=1):
        held = _taps(shaper).guarantee
        if held.further_frequency_hz:
            yield f"row {knob}, all modes: {bands(held, digits=4)}"
        if held.damping_ratio[0] < held.damping_ratio[1]:
            yield f"row {knob} holds at damping ratios of {damping_ratios(held)}"
        for line in proofs(shaper):
            yield f"row {knob}, {line}"
    if design.bank is not None:
        yield from switching(design.bank)
        if design.bank.selection == "knob":
            yield f"on the pendant: {'   '.join(design.bank.labels)}"


def _remarks(design: DesignFile, settings: ShaperSettings) -> Iterator[str]:
    waiting = [knob for knob, table in enumerate(settings.row_tables) if table.waits]
    if waiting:
        names = ", ".join(design.shapers[knob - 1].name for knob in waiting)
        # The same for all of them: a command is held until the slowest row would have settled.
        jog_m = ways(settings, waiting[0]).jog_m
        yield (
            f"negative amplitudes in {names}: a new command waits until the last one has come to rest, and "
            f"the shortest jog at full speed goes {jog_m:.3f} m"
        )
    if design.plant.frequency_hz[0] < design.plant.frequency_hz[1]:
        gaps = [f"{low:.4g} to {high:.4g}" for low, high in _gaps(design)]
        unit = "m of rope" if _on_rope(design) else "Hz"
        yield (
            f"held by no row: {', '.join(gaps)} {unit}"
            if gaps
            else "every point of the range is held by at least one row"
        )


def _on_rope(design: DesignFile) -> bool:
    return design.plant.kind in {"crane", "double_pendulum"}


def _held(design: DesignFile, taps: AnyTapsRecord) -> tuple[float, float]:
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


def _taps(shaper: ShaperRecord) -> AnyTapsRecord:
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
    from swayless.machine.record import document_of

    shaped = [
        {"knob": knob, "name": shaper.name, **_row_document(design, shaper), **_ways_document(settings, knob)}
        for knob, shaper in enumerate(design.shapers, start=1)
    ]
    nothing = dict.fromkeys(_row_document(design, design.shapers[0]))
    unshaped = {"knob": 0, "name": "unshaped"} | nothing | {"duration_s": 0.0} | _ways_document(settings, 0)
    ranged = design.plant.frequency_hz[0] < design.plant.frequency_hz[1]
    not_held = {
        "not_held_rope_length_m" if _on_rope(design) else "not_held_hz": _gaps(design) if ranged else []
    }
    bank = {"bank": None if design.bank is None else document_of(design.bank)}
    rows = {"rows": [unshaped, *shaped], "operator": operator_document(settings)}
    return {"name": design.name, "number": settings.number.name, **rows, **not_held, **bank}


def _row_document(design: DesignFile, shaper: ShaperRecord) -> dict[str, Any]:
    """Give what the taps of a row hold, and what is proved."""
    taps, bound_s = _taps(shaper), shaper.lower_bound_s
    held = taps.guarantee
    return {
        "family": shaper.family,
        "amplitude_rule": shaper.amplitude_rule,
        "tolerance": held.tolerance,
        "worst_residual_ratio": held.worst_residual_ratio,
        "frequency_hz": list(held.frequency_hz),
        "further_frequency_hz": [list(band) for band in held.further_frequency_hz],
        "damping_ratio": list(held.damping_ratio),
        "rope_length_m": list(held.rope_length_m) if _on_rope(design) else None,
        "duration_s": taps.duration_s,
        "lower_bound_s": bound_s,
        "gap_ratio": None if bound_s is None else shaper.duration_s / bound_s - 1.0,
    }


def _ways_document(settings: ShaperSettings, row: int) -> dict[str, float]:
    way = ways(settings, row)
    return {
        "stop_distance_released_m": round(way.released_m, WAY_DIGITS),
        "stop_distance_quick_m": round(way.quick_m, WAY_DIGITS),
        "shortest_jog_m": round(way.jog_m, WAY_DIGITS),
    }
