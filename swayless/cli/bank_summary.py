"""What a person wants to know of a bank: the label of every knob position, what it holds, where to switch.

Not for: stop distances, which need the block (`swayless.cli.summary`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from swayless.cli.console import at_most, counted, interval, print_line, print_table, rounded_down
from swayless.cli.design_summary import NEGATIVE_NOTE

if TYPE_CHECKING:
    from swayless.machine import DesignFile, ShaperRecord
    from swayless.machine.bank_record import BankRecord


VISIBLE = 1e-4
"""Overlap from which it is worth telling, relative to where it is: rounding to ticks leaves less."""


def print_bank(design: DesignFile, bank: BankRecord) -> None:
    """Print the tables of a bank.

    Parameters
    ----------
    design : DesignFile
        The design of a machine.
    bank : BankRecord
        How its rows share the range.
    """
    columns = ("label", f"holds [{_unit(bank)}]", "leaves", "time [s]", "proven [s]", "overtravel [m]")
    rows = [
        [label, *_row(shaper, bank, design.drive.max_speed_m_s)]
        for label, shaper in zip(bank.labels, design.shapers, strict=True)
    ]
    number = counted(len(rows), "row")
    print_table(f"{design.name}: {number}, at most {at_most(bank.tolerance, 4)} is left", columns, rows)
    print_line("proven: in less no shaper with such amplitudes holds as much; overtravel: from full speed")
    for line in (*switching(bank), *_waiting(design)):
        print_line(line)
    if bank.selection == "knob":
        print_line(f"on the pendant: {'   '.join(bank.labels)}")


def switching(bank: BankRecord) -> Iterator[str]:
    """Say where the knob is to be turned, and what neighbours share there.

    Parameters
    ----------
    bank : BankRecord
        How rows share a range.
    """
    places = bank.switching_rope_length_m or bank.switching_frequency_hz
    overlaps = bank.overlap_m or bank.overlap_hz
    if not places or not overlaps:
        return
    unit = _unit(bank)
    turns = ", ".join(
        f"{row} to {row + 1} at {place:.5g} {unit}" for row, place in enumerate(places, start=1)
    )
    least = min(overlaps)
    seen = least >= VISIBLE * max(places)
    shared = f"both hold {rounded_down(least, 3)} {unit} there at least" if seen else "bands meet there"
    who = "turn the knob" if bank.selection == "knob" else "the measured rope changes the row"
    yield f"{who} from {turns}: {shared}"


def _row(shaper: ShaperRecord, bank: BankRecord, max_speed_m_s: float) -> list[str]:
    runs = shaper.taps or shaper
    held = runs.guarantee
    ends = held.frequency_hz if bank.switching_rope_length_m is None else held.rope_length_m
    proved_s = shaper.lower_bound_s if held.tolerance <= shaper.guarantee.tolerance else None
    bound = "-" if proved_s is None else rounded_down(proved_s, 5)  # taps that leave more prove nothing
    leaves = f"<= {at_most(held.worst_residual_ratio, 4)}"
    return [
        interval(*ends, digits=5),
        leaves,
        f"{runs.duration_s:.5g}",
        bound,
        f"{runs.overtravel_s * max_speed_m_s:.3f}",
    ]


def _waiting(design: DesignFile) -> Iterator[str]:
    """Say what negative amplitudes mean for the operator."""
    waiting = [shaper.taps or shaper for shaper in design.shapers if min(shaper.amplitudes) < 0.0]
    if waiting:
        longest_s = max(runs.duration_s for runs in waiting)
        yield "note: negative amplitudes: " + NEGATIVE_NOTE.format(duration=longest_s)


def _unit(bank: BankRecord) -> str:
    return "Hz" if bank.switching_rope_length_m is None else "m"
