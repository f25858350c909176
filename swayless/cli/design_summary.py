"""What a person wants to know of one shaper: its impulses, its taps, what both hold, and what is proved.

Not for: whole machines (`swayless.cli.summary`, `swayless.cli.bank_summary`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from swayless.cli.console import at_most, interval, per_cent, print_line, print_table, rounded_down

if TYPE_CHECKING:
    from swayless.machine import AnyTapsRecord, DesignFile, GuaranteeRecord, ShaperRecord

NEGATIVE_NOTE = (
    "a new command waits until the last one has come to rest, so a short jog is stretched: "
    "the command is held for at least {duration:.4g} s"
)
"""What negative amplitudes mean for the operator."""

RIVALS = {
    "positive": "shaper with positive amplitudes",
    "bounded": "shaper whose partial sums stay in 0 to 1",
    "unity-magnitude": "shaper whose partial sums stay in 0 to 1, such as all of unity magnitude,",
}
"""Shapers that the lower bound speaks of, by the rule for the amplitudes."""


def print_design(design: DesignFile, remarks: Sequence[str] = ()) -> None:
    """Print the tables of a design with one shaper.

    Parameters
    ----------
    design : DesignFile
        As `swayless design` makes it.
    remarks : sequence of str
        What else there is to say.
    """
    from swayless.machine import TapsRecord as RecordOfTaps

    shaper = design.shapers[0]
    impulses = zip(shaper.times_s, shaper.amplitudes, strict=True)
    columns, rows = ("time [s]", "amplitude"), [(f"{t:.9g}", f"{a:.9g}") for t, a in impulses]
    print_table(f"{shaper.family} {_made_for(design)}", columns, rows)
    if isinstance(shaper.taps, RecordOfTaps):
        taps = zip(shaper.taps.delays_ticks, shaper.taps.amplitudes, strict=True)
        columns, rows = ("delay [ticks]", "amplitude"), [(f"{d}", f"{a:.12g}") for d, a in taps]
        print_table(f"taps: the same on ticks of {design.tick_s:g} s, which is what runs", columns, rows)
    facts = [_facts(part, design) for part in (shaper, shaper.taps) if part is not None]
    names = dict.fromkeys(name for fact in facts for name in fact)
    lines = [[name, *(fact.get(name, "") for fact in facts)] for name in names]
    print_table("what it guarantees", ("", "impulses", "taps")[: len(facts) + 1], lines)
    for line in (*proofs(shaper), *remarks, *_notes(shaper)):
        print_line(line)


def bands(guarantee: GuaranteeRecord, digits: int = 6) -> str:
    """Print all ranges of frequency that are held, rounded inward.

    Parameters
    ----------
    guarantee : GuaranteeRecord
        What holds them.
    digits : int
        Digits printed.
    """
    held = (guarantee.frequency_hz, *guarantee.further_frequency_hz)
    return " and ".join(interval(*band, digits=digits) for band in held) + " Hz"


def damping_ratios(guarantee: GuaranteeRecord) -> str:
    """Print the damping ratio that is held, or the lowest and the highest.

    Parameters
    ----------
    guarantee : GuaranteeRecord
        What holds them.
    """
    return " to ".join(f"{ratio:g}" for ratio in dict.fromkeys(guarantee.damping_ratio))


def proofs(shaper: ShaperRecord) -> Iterator[str]:
    """Say what the lower bound proves, if there is one.

    Parameters
    ----------
    shaper : ShaperRecord
        Any row of a design.
    """
    bound_s = shaper.lower_bound_s
    if bound_s is None or shaper.amplitude_rule is None:
        return
    gap = f"the impulses are within {at_most(shaper.duration_s / bound_s - 1.0)} of that"
    if shaper.taps is not None and _holds_all(shaper.taps.guarantee, shaper.guarantee):
        gap += f", the taps within {at_most(shaper.taps.duration_s / bound_s - 1.0)}"
    yield (
        f"proved: no {RIVALS[shaper.amplitude_rule]} holds this in {rounded_down(bound_s)} s or less; {gap}"
    )


def _holds_all(taps: GuaranteeRecord, impulses: GuaranteeRecord) -> bool:
    """Whether taps hold what the impulses do, so that the bound is one for them too."""
    pairs = zip(_edges(taps), _edges(impulses), strict=True)
    inside = all(low <= inner_low and inner_high <= high for (low, high), (inner_low, inner_high) in pairs)
    return inside and taps.tolerance <= impulses.tolerance


def _edges(guarantee: GuaranteeRecord) -> list[tuple[float, float]]:
    return [guarantee.frequency_hz, *guarantee.further_frequency_hz]


def _made_for(design: DesignFile) -> str:
    """Say which mode the shaper is made for, or which range it holds."""
    shaper = design.shapers[0]
    if shaper.amplitude_rule is None:
        mode = shaper.mode
        rope = f" (rope {mode.rope_length_m:.6g} m)" if mode.rope_length_m is not None else ""
        return f"for {mode.frequency_hz:.6g} Hz{rope}, damping ratio {mode.damping_ratio:g}"
    held = shaper.guarantee
    reach = "reaches" if shaper.family == "fd" else "for"
    place = bands(held) if design.plant.rope_length_m is None else f"ropes of {_ropes(shaper, held)}"
    return f"{reach} {place}, damping ratio {damping_ratios(held)}, {shaper.amplitude_rule} amplitudes"


def _ropes(shaper: ShaperRecord, held: GuaranteeRecord) -> str:
    """Print ropes: those that a user asked for as they were given, others to what a tape measures."""
    return f"{interval(*held.rope_length_m, digits=4 if shaper.amplitude_rule is None else 6)} m"


def _facts(part: ShaperRecord | AnyTapsRecord, design: DesignFile) -> dict[str, str]:
    held = part.guarantee
    facts = {
        "duration": f"{part.duration_s:.6g} s",
        f"leaves at most {per_cent(held.tolerance)}": bands(held),
        "at damping ratios": damping_ratios(held),
        "on ropes of": _ropes(design.shapers[0], held),
        "overtravel": f"{part.overtravel_s:.4g} m per m/s",
        "peak factor": f"{sum(map(abs, part.amplitudes)):.4g}",
    }
    if design.plant.rope_length_m is None:
        del facts["on ropes of"]
    if held.damping_ratio[0] == held.damping_ratio[1]:
        del facts["at damping ratios"]
    return facts


def _notes(shaper: ShaperRecord) -> Iterator[str]:
    runs = shaper.taps or shaper
    if min(shaper.amplitudes) < 0.0:
        yield "note: negative amplitudes: " + NEGATIVE_NOTE.format(duration=runs.duration_s)
    if shaper.taps is None:
        yield "note: no taps: give --tick to solve it on a controller's ticks and to generate code"
