"""What the head of a generated file says: where it comes from and what it guarantees. Not for: code."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.settings import ShaperSettings
from swayless.controller.taps import Row
from swayless.design.robustness import overtravel_s, peak_factor, rope_length_interval_m


@dataclass(frozen=True)
class Provenance:
    """Where a design comes from; passed in, so that the same design file gives the same bytes for ever.

    Parameters
    ----------
    name : str
        Machine name; prefixes every symbol.
    generator : str
        Name and version of what made the design.
    source : str or None
        Base name of the machine file.
    design_sha256 : str
        SHA-256 of the canonical design, 64 hexadecimal digits.
    hangs_on_rope : bool
        Whether frequencies also are rope lengths.
    """

    name: str
    generator: str
    source: str | None
    design_sha256: str
    hangs_on_rope: bool


def header_lines(settings: ShaperSettings, provenance: Provenance, facts: list[str]) -> list[str]:
    """Lines of the comment at the head of a file, without comment marks.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    provenance : Provenance
        Where it comes from.
    facts : list of str
        What only this target knows: how to call it, memory, compiler flags.
    """
    limits = settings.limits
    lines = [
        f"{provenance.name}: command shaper. The load does not swing when the drive follows the reference.",
        "",
        f"Made by {provenance.generator} from {provenance.source or 'a design file'}.",
        f"Design SHA-256 {provenance.design_sha256}.",
        "This file is yours: use, change and ship it as you like.",
        "",
        f"Tick {settings.tick_s:.9g} s, numbers in {settings.number.name}, law fixed (tick clock).",
        f"Commands in {limits.units}, at most {limits.max_command:.9g}. "
        f"Settled after {settings.longest_delay_ticks} ticks without change.",
        "Rows of the selector, and the residual vibration that each guarantees on these very taps:",
        "  0 unshaped (ramped only)",
    ]
    for position, row in enumerate(settings.bank.rows, start=1):
        lines += [
            f"  {position} {line}" if i == 0 else f"    {line}"
            for i, line in enumerate(_row_lines(row, provenance))
        ]
    lines += ["", *facts, ""]
    lines += [
        "NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.",
        "Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.",
        "Wind, off-centre pick-up and a slack rope are beyond what a command can prevent.",
    ]
    return lines


def _row_lines(row: Row, provenance: Provenance) -> list[str]:
    taps, guarantee = row.taps, row.taps.guarantee
    mode, band = guarantee.mode, guarantee.band
    lines = [
        f"{row.name}: {row.family} for {mode.frequency_hz:.6g} Hz, damping ratio {mode.damping_ratio:.6g}, "
        f"duration {taps.duration_s:.6g} s",
        f"at most {100 * guarantee.tolerance:.6g} % from {band.low_hz:.6g} to {band.high_hz:.6g} Hz",
    ]
    if provenance.hangs_on_rope:
        low_m, high_m = rope_length_interval_m(band)
        lines[-1] += f" (rope {low_m:.6g} to {high_m:.6g} m)"
    lines.append(f"overtravel {overtravel_s(taps):.6g} m per m/s, peak factor {peak_factor(taps):.6g}")
    if taps.has_negative:
        lines.append(
            "negative amplitudes: a new command waits until the block has settled, short jogs are stretched"
        )
    return lines
