"""What a person wants to know of one shaper: its impulses, its taps, and what both hold.

Not for: whole machines (`swayless.cli.summary`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from swayless.cli.console import interval, per_cent, print_line, print_table

if TYPE_CHECKING:
    from swayless.machine import DesignFile, ShaperRecord, TapsRecord

NEGATIVE_NOTE = (
    "a new command waits until the last one has come to rest, so a short jog is stretched: "
    "the command is held for at least {duration:.4g} s"
)
"""What negative amplitudes mean for the operator."""


def print_design(design: DesignFile) -> None:
    """Print the tables of a design with one shaper.

    Parameters
    ----------
    design : DesignFile
        As `swayless design` makes it.
    """
    shaper = design.shapers[0]
    impulses = zip(shaper.times_s, shaper.amplitudes, strict=True)
    columns, rows = ("time [s]", "amplitude"), [(f"{t:.9g}", f"{a:.9g}") for t, a in impulses]
    print_table(f"{shaper.family} for {_mode(design)}", columns, rows)
    if shaper.taps is not None:
        taps = zip(shaper.taps.delays_ticks, shaper.taps.amplitudes, strict=True)
        columns, rows = ("delay [ticks]", "amplitude"), [(f"{d}", f"{a:.12g}") for d, a in taps]
        print_table(f"taps: the same on ticks of {design.tick_s:g} s, which is what runs", columns, rows)
    on_rope = design.plant.kind == "crane"
    facts = [_facts(part, on_rope=on_rope) for part in (shaper, shaper.taps) if part is not None]
    lines = [[name, *(fact[name] for fact in facts)] for name in facts[0]]
    print_table("what it guarantees", ("", "impulses", "taps")[: len(facts) + 1], lines)
    for note in _notes(shaper):
        print_line(f"note: {note}")


def _mode(design: DesignFile) -> str:
    mode = design.shapers[0].mode
    rope = f" (rope {mode.rope_length_m:.6g} m)" if mode.rope_length_m is not None else ""
    return f"{mode.frequency_hz:.6g} Hz{rope}, damping ratio {mode.damping_ratio:g}"


def _facts(part: ShaperRecord | TapsRecord, *, on_rope: bool) -> dict[str, str]:
    held = part.guarantee
    facts = {
        "duration": f"{part.duration_s:.6g} s",
        f"leaves at most {per_cent(held.tolerance)}": f"{interval(*held.frequency_hz, digits=6)} Hz",
        "on ropes of": f"{interval(*held.rope_length_m)} m",
        "overtravel": f"{part.overtravel_s:.4g} m per m/s",
        "peak factor": f"{sum(map(abs, part.amplitudes)):.4g}",
    }
    if not on_rope:
        del facts["on ropes of"]
    return facts


def _notes(shaper: ShaperRecord) -> Iterator[str]:
    runs = shaper.taps or shaper
    if min(shaper.amplitudes) < 0.0:
        yield "negative amplitudes: " + NEGATIVE_NOTE.format(duration=runs.duration_s)
    if shaper.taps is None:
        yield "no taps: give --tick to solve it on a controller's ticks and to generate code"
