"""What the head of a generated file says: where it comes from and what it guarantees. Not for: code."""

from __future__ import annotations

import re
from dataclasses import dataclass

from swayless.codegen.law_text import law_lines, phase_row_lines, rope_lines, spaced_row_lines
from swayless.controller.measured import ROPE
from swayless.controller.phase_taps import PhaseTaps
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.controller.taps import Row
from swayless.design.robustness import overtravel_s, peak_factor, rope_length_interval_m
from swayless.errors import CodegenError

NOT_IN_COMMENTS = "*{}$\\"
"""Characters with which a text could end a comment, begin one, or be a pragma or an escape in some target."""


_WHO_CHOOSES = {True: "Rows of the selector", False: "Rows, of which the measured rope chooses one"}


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
        Whether frequencies also are rope lengths: those of a single pendulum.
    is_arm : bool
        Whether it is an arm, and nothing hangs.
    """

    name: str
    generator: str
    source: str | None
    design_sha256: str
    hangs_on_rope: bool
    is_arm: bool = False

    def __post_init__(self) -> None:
        if not re.fullmatch("[0-9a-f]{64}", self.design_sha256):
            raise CodegenError(f"design_sha256 = {self.design_sha256!r}: must be 64 hexadecimal digits")


def comment_text(text: str) -> str:
    """Return a text of the user's as it may stand in a generated comment.

    Parameters
    ----------
    text : str
        Name of a row, unit or file.

    Raises
    ------
    CodegenError
        If it is not printable ASCII or holds a character that could end the comment.

    Examples
    --------
    >>> comment_text("24 ft, no wind")
    '24 ft, no wind'
    """
    if not (text.isascii() and text.isprintable()) or any(mark in text for mark in NOT_IN_COMMENTS):
        raise CodegenError(
            f"{text!r} cannot stand in a comment: use printable ASCII without {' '.join(NOT_IN_COMMENTS)}"
        )
    return text


def check_comments(settings: ShaperSettings, provenance: Provenance) -> None:
    """Refuse texts of the user's that cannot stand in a comment; see `comment_text`.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with units and rows.
    provenance : Provenance
        Where it comes from.
    """
    for text in (provenance.generator, provenance.source or "", settings.limits.units):
        comment_text(text)
    for row in settings.bank.rows:
        comment_text(row.name)
        comment_text(row.family)


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
    lines = [
        f"{provenance.name}: command shaper. The load does not swing when the drive follows the reference.",
        "",
        f"Made by {provenance.generator} from {provenance.source or 'a design file'}.",
        f"Design SHA-256 {provenance.design_sha256}.",
        "This file is yours: use, change and ship it as you like.",
        "",
        *law_lines(settings),
        f"{_WHO_CHOOSES[settings.bank.by_rope is None]}, and the residual vibration that each guarantees "
        "on these very taps:",
        "  0 unshaped (ramped only)",
    ]
    measured = ROPE if settings.rope is None else settings.rope.measured
    for position, row in enumerate(settings.bank.rows, start=1):
        lines += [
            f"  {position} {line}" if i == 0 else f"    {line}"
            for i, line in enumerate(_row_lines(row, provenance, measured.title))
        ]
    lines += [*rope_lines(settings), "", *facts, ""]
    lines += [
        "NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.",
        "Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.",
        f"{_disturbances(provenance)} are beyond what a command can prevent.",
    ]
    return lines


def _disturbances(provenance: Provenance) -> str:
    """Name what shakes a load, on a rope or not, however it is commanded."""
    on_rope = "off-centre pick-up and a slack rope"
    return f"Wind, {'pushes and a load that slips' if provenance.is_arm else on_rope}"


def _row_lines(row: Row, provenance: Provenance, title: str) -> list[str]:
    taps, guarantee = row.taps, row.taps.guarantee
    if isinstance(taps, PhaseTaps):
        return phase_row_lines(row)
    if isinstance(taps, SpacedTaps):
        return spaced_row_lines(row, taps.spacing, title)
    bands = " and ".join(f"from {band.low_hz:.6g} to {band.high_hz:.6g}" for band in guarantee.bands)
    lowest, highest = guarantee.damping_ratios
    damping = f"{lowest:.6g}" if lowest == highest else f"{lowest:.6g} to {highest:.6g}"
    lines = [
        f"{row.name}: {row.family} for {guarantee.mode.frequency_hz:.6g} Hz, damping ratio {damping}, "
        f"duration {taps.duration_s:.6g} s",
        f"at most {100 * guarantee.tolerance:.6g} % {bands} Hz",
    ]
    if provenance.hangs_on_rope:
        low_m, high_m = rope_length_interval_m(guarantee.band)
        lines[-1] += f" (rope {low_m:.6g} to {high_m:.6g} m)"
    lines.append(f"overtravel {overtravel_s(taps):.6g} m per m/s, peak factor {peak_factor(taps):.6g}")
    if taps.has_negative:
        lines.append(
            "negative amplitudes: a new command waits until the block has settled, short jogs are stretched"
        )
    return lines
