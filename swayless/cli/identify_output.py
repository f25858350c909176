"""What `swayless identify` gives: a table, a document for machines, a figure, a machine file.

Not for: finding it.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from swayless.cli.console import counted, print_line, print_table
from swayless.cli.identify_input import AllFound, Found
from swayless.cli.identify_remarks import of_record, remarks
from swayless.cli.options import OptionError
from swayless.machine.identified import IdentifiedPlant, write_identified
from swayless.plant import Band, pendulum_rope_length_m
from swayless.plant.identification import HELD_DEVIATIONS, IdentifiedMode, RopeOffset


def print_found(found: AllFound) -> None:
    """Print the modes, the band that a design has to hold, and what was not seen.

    Parameters
    ----------
    found : AllFound
    """
    columns = ["frequency [Hz]", "period [s]", "damping ratio", "to be held [Hz]"]
    with_rope = found.is_pendulum and all(len(each.modes) == 1 for each in found.records)
    columns += ["pendulum [m]"] if with_rope else []
    several = len(found.records) > 1
    rows = [
        [*([_rope(each)] if several else []), *_row(mode, with_rope=with_rope)]
        for each in found.records
        for mode in each.modes
    ]
    title = f"{len(found.records)} ropes" if several else _title(found.records[0])
    print_table(title, ["rope [m]", *columns] if several else columns, rows)
    print_line("+-: one standard deviation; to be held: two of them to either side")
    if found.offset is not None:
        print_line(_offset_text(found.offset))
    for remark in remarks(found):
        print_line(remark)


def _title(found: Found) -> str:
    if found.swing is None:
        return found.source
    record = found.swing.record
    samples = counted(record.time_s.size, "sample")
    return f"{found.source}: {found.swing.swings:.1f} swings, {samples} in {record.duration_s:.4g} s"


def _rope(found: Found) -> str:
    return "-" if found.rope_length_m is None else f"{found.rope_length_m:.5g}"


def _row(mode: IdentifiedMode, *, with_rope: bool) -> list[str]:
    band = mode.band()
    period_s = mode.mode.damped_period_s
    damping = (
        "-"
        if mode.damping_ratio is None or mode.damping_ratio_std is None
        else with_std(mode.damping_ratio, mode.damping_ratio_std)
    )
    row = [with_std(mode.frequency_hz, mode.frequency_hz_std)]
    row += [with_std(period_s, period_s * mode.frequency_hz_std / mode.frequency_hz), damping]
    decimals = _decimals(mode.frequency_hz_std)
    unit = 10.0**-decimals
    low_hz, high_hz = unit * math.floor(band.low_hz / unit), unit * math.ceil(band.high_hz / unit)
    row += [f"{low_hz:.{decimals}f} to {high_hz:.{decimals}f}"]
    if with_rope:
        length_m = pendulum_rope_length_m(mode.frequency_hz)
        row.append(with_std(length_m, 2.0 * length_m * mode.frequency_hz_std / mode.frequency_hz))
    return row


def with_std(value: float, std: float) -> str:
    """Print a value with its standard deviation, to two digits of that and twelve decimals at most.

    Examples
    --------
    >>> with_std(0.2501234, 0.000321), with_std(6.1, 0.0), with_std(0.004, 12.0)
    ('0.25012 +- 0.00032', '6.100000000000 +- 0.000000000000', '0 +- 12')
    """
    decimals = _decimals(std)
    return f"{value:.{decimals}f} +- {std:.{decimals}f}"


def _decimals(std: float) -> int:
    """Count the decimals that show two digits of a standard deviation."""
    return 12 if std < 1e-11 else max(0, 1 - int(f"{std:e}".partition("e")[2]))


def _offset_text(offset: RopeOffset) -> str:
    slope = "" if offset.slope is None else f"; slope {with_std(offset.slope, offset.slope_std or 0.0)}"
    return f"rope offset: {with_std(offset.offset_m, offset.offset_m_std)} m to add to what is shown{slope}"


def document(found: AllFound) -> dict[str, Any]:
    """Give all that was found, for machines; the first record's first mode stands at the top.

    Parameters
    ----------
    found : AllFound
    """
    offset = found.offset
    return {
        **_mode_document(found.records[0].modes[0]),
        "records": [_record_document(each) for each in found.records],
        "rope_offset": None
        if offset is None
        else {
            "offset_m": offset.offset_m,
            "offset_m_std": offset.offset_m_std,
            "slope": offset.slope,
            "slope_std": offset.slope_std,
            "consistent": offset.is_consistent,
        },
        "remarks": list(remarks(found)),
    }


def _mode_document(mode: IdentifiedMode) -> dict[str, Any]:
    band = mode.band()
    known = mode.damping_ratio is not None
    return {
        "frequency_hz": mode.frequency_hz,
        "frequency_hz_std": mode.frequency_hz_std,
        "damping_ratio": mode.damping_ratio,
        "damping_ratio_std": mode.damping_ratio_std,
        "period_s": mode.mode.damped_period_s,
        "held_hz": [band.low_hz, band.high_hz],
        "held_damping_ratio": list(mode.damping_range()) if known else None,
        "amplitude": mode.amplitude,
    }


def _record_document(found: Found) -> dict[str, Any]:
    swing = found.swing
    sampled = (
        {}
        if swing is None
        else {
            "samples": swing.record.time_s.size,
            "swings": swing.swings,
            "quantity": swing.record.quantity.value,
            "noise_rms": swing.noise.rms,
            "noise_is_coloured": swing.noise.is_coloured,
            "drift": swing.drift,
            "second_mode_floor": swing.second_mode_floor,
            "decay_is_exponential": swing.is_exponential,
            "may_be_two_modes": swing.may_be_two_modes,
            "slowed_ratio": swing.slowed_ratio,
        }
    )
    return {
        "source": found.source,
        "rope_length_m": found.rope_length_m,
        "modes": [_mode_document(mode) for mode in found.modes],
        **sampled,
        "remarks": list(of_record(found)),
    }


def draw(path: Path, found: AllFound) -> None:
    """Draw the one sampled swing that was found.

    Parameters
    ----------
    path : Path
        The figure.
    found : AllFound
        With one sampled swing.
    """
    from swayless.report.identification import identification_figure
    from swayless.report.save import check_place, save_figure

    check_place(path)
    (only,) = found.records
    assert only.swing is not None and only.read is not None  # noqa: S101, PT018 - checked with the options
    unit = only.read.head.unit or ""
    title = (
        f"{Path(only.source).name}: {with_std(only.modes[0].frequency_hz, only.modes[0].frequency_hz_std)} Hz"
    )
    figure = identification_figure(title, only.swing, unit=unit, unit_size=only.read.unit_size)
    save_figure(figure, path)


def write_into(path: Path, found: AllFound) -> str:
    """Write what was found into a machine file, and say what was written.

    Parameters
    ----------
    path : Path
        A machine file, or a name for a new one.
    found : AllFound
    """
    first = [each.modes[0] for each in found.records]
    bands = [_union([mode.band() for mode in first])]
    if len(found.records) == 1:
        bands += [mode.band() for mode in found.records[0].modes[1:]]
    dampings = [mode for mode in first if mode.damping_ratio is not None]
    ranges = [mode.damping_range(HELD_DEVIATIONS) for mode in dampings] or [(0.0, 0.0)]
    seen = [mode.damping_ratio or 0.0 for mode in dampings if not mode.damping_is_below_resolution]
    offset = found.offset
    if offset is not None and offset.scale_is_doubtful and path.exists():
        raise OptionError(
            [
                f"--into {path}: {offset.slope:.4f} m of pendulum for each metre shown, which no offset"
                " corrects: check the scale of the encoder first"
            ]
        )
    plant = IdentifiedPlant(
        kind="crane" if found.is_pendulum else "arm",
        bands=tuple(bands),
        damping_ratio=min(seen, default=None),
        damping_range=(min(low for low, _ in ranges), max(high for _, high in ranges)),
        rope_offset_m=_offset_range_m(found),
    )
    return write_identified(path, plant)


def _offset_range_m(found: AllFound) -> tuple[float, float] | None:
    """Give from and to what the pendulum is longer than the rope shown; None where none was shown."""
    if found.offset is not None:
        middle_m, reach_m = found.offset.offset_m, HELD_DEVIATIONS * found.offset.offset_m_std
        return middle_m - reach_m, middle_m + reach_m
    shown_m, band = found.records[0].rope_length_m, found.records[0].modes[0].band()
    if shown_m is None:
        return None
    return pendulum_rope_length_m(band.high_hz) - shown_m, pendulum_rope_length_m(band.low_hz) - shown_m


def _union(bands: list[Band]) -> Band:
    return Band(min(band.low_hz for band in bands), max(band.high_hz for band in bands))
