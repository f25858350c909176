"""What the head of a generated file says of the law: the clock, the rope, and what each row guarantees."""

from __future__ import annotations

from swayless.controller.rope import MM_PER_M, RopeSettings
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacedTaps, SpacingLaw
from swayless.controller.spacing import Spacing
from swayless.controller.taps import Row
from swayless.design.robustness import overtravel_s

PHASE_LAW = (
    "Delays are phases of the pendulum: a tap releases its part of a change of the command when the load",
    "has swung on by the phase designed, however the rope was hoisted meanwhile. Give the rope length and",
    "its rate of change, positive when the load sinks, on every tick. A hoist that starts or stops under a",
    "swinging load kicks it: the reference answers with a step, and may pass the present command by that,",
    "but never the maximum. The stop distance is exact on a rope that is held still from now on; the stop",
    "time does not know the answers to come, which end by one run more and go as far back as forth.",
)

SPACING_LAWS: dict[SpacingLaw, tuple[str, ...]] = {
    "original": (
        "Taps are one spacing apart, half a period cut to whole ticks, looked up by the rope length on every",
        "tick. Each command is scattered by the spacing of its tick and released in full, but a spacing that",
        "changes leaves gaps and surplus that shake the load: a law to compare with, after Magee and Book.",
    ),
    "modified": (
        "Taps are one spacing apart, half a period cut to whole ticks, looked up by the rope length on every",
        "tick. A tap goes over to a new spacing when the commands that it would read by the old and by the",
        "new one both want it: no tick has a gap or a surplus, after Magee and Book. Some commands are read",
        "twice or never: a move during which the spacing changes is longer or shorter than commanded.",
    ),
}
"""What happens when the spacing of the taps changes."""

SPACED_STOP = "The stop distance is exact once the rope length has been still for the longest delay."

ROPE_READINGS = (
    "A rope length that is not valid, not finite or farther from the last one than the hoist could have",
    "moved is not taken: the last one holds, shaping goes on and a status bit says so. At rest every length",
    "is taken.",
)


def law_lines(settings: ShaperSettings) -> list[str]:
    """Name the law, the units and the longest settling.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    limits, ticks = settings.limits, settings.longest_delay_ticks
    law, still = "fixed (tick clock)", ""
    if settings.clock is not None:
        law, still = "phase (hoisting while travelling)", " on the longest rope"
    law_of_spacing = spacing_law(settings)
    if law_of_spacing is not None:
        law, still = f"{law_of_spacing} (command shaping by a spacing)", " at the widest spacing"
    return [
        f"Tick {settings.tick_s:.9g} s, numbers in {settings.number.name}, law {law}.",
        f"Commands in {limits.units}, at most {limits.max_command:.9g}. "
        f"Settled after {ticks} ticks without change{still}.",
    ]


def rope_lines(settings: ShaperSettings) -> list[str]:
    """Say what the block makes of a measured rope; nothing where there is none.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    rope = settings.rope
    if rope is None:
        return []
    law: tuple[str, ...] = () if settings.clock is None else PHASE_LAW
    law_of_spacing = spacing_law(settings)
    if law_of_spacing is not None:
        law = (*SPACING_LAWS[law_of_spacing], SPACED_STOP)
    lines = map(rope.measured.said, (*law, *ROPE_READINGS))
    return ["", *lines, _range_line(rope, MM_PER_M if settings.number.is_integer else 1)]


def spacing_law(settings: ShaperSettings) -> SpacingLaw | None:
    """Name the law of taps that follow a spacing; None where they do not.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    taps = settings.bank.rows[0].taps
    return taps.law if isinstance(taps, SpacedTaps) else None


def _range_line(rope: RopeSettings, per_m: int) -> str:
    shortest, longest, speed = (float(v) / per_m for v in (rope.shortest, rope.longest, rope.hoist_speed))
    if rope.measured.is_length:
        return f"Rope {shortest:.6g} to {longest:.6g} m, hoisted with at most {speed:.6g} m/s."
    unit = rope.measured.unit
    return f"Position {shortest:.6g} to {longest:.6g} {unit}, moved with at most {speed:.6g} {unit}/s."


def phase_row_lines(row: Row) -> list[str]:
    """Say what a row guarantees whose delays are phases.

    Parameters
    ----------
    row : Row
        A row of the phase clock.
    """
    taps, guarantee = row.taps, row.taps.guarantee
    return [
        f"{row.name}: {row.family} over the phase, damping ratio {guarantee.mode.damping_ratio:.6g}, "
        f"duration {taps.duration_s:.6g} s on the longest rope",
        f"at most {100 * guarantee.tolerance:.6g} % on every rope of the range that is held still",
        f"overtravel {overtravel_s(taps):.6g} m per m/s on the longest rope",
    ]


def spaced_row_lines(row: Row, spacing: Spacing, title: str) -> list[str]:
    """Say what a row guarantees whose delays are multiples of a spacing.

    Parameters
    ----------
    row : Row
        A row of the original or the modified law.
    spacing : Spacing
        Its spacing.
    title : str
        What is measured.
    """
    taps, guarantee = row.taps, row.taps.guarantee
    return [
        f"{row.name}: {row.family} at multiples of {spacing.least} to {spacing.most} ticks, damping ratio "
        f"{guarantee.mode.damping_ratio:.6g}, duration {taps.duration_s:.6g} s at the widest spacing",
        f"at most {100 * guarantee.tolerance:.6g} % at every {title} of the range that is held still",
        f"overtravel {overtravel_s(taps):.6g} m per m/s at the widest spacing",
    ]
