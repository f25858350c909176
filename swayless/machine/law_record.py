"""What each law needs of a design file: tables, a measured rope or position, and rows for its slowest mode.

Not for: the records themselves (`swayless.machine.design_document`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from swayless.machine.following_row import FAMILIES_OF_LAW, SPACED_LAWS

if TYPE_CHECKING:
    from swayless.machine.design_document import DesignFile

_CLOSE = 1e-9  # relative: more than 12 digits move a frequency


def law_disagreements(design: DesignFile) -> Iterator[tuple[str, str]]:
    """Give the key and the reason of everything that the law of a design needs, or has no use for.

    Parameters
    ----------
    design : DesignFile
        Whose records are right by themselves.
    """
    if design.law != "phase" and design.clock is not None:
        yield "clock", f'must be null: law = "{design.law}"'
    if design.law not in SPACED_LAWS and design.spacing is not None:
        yield "spacing", f'must not stand there: law = "{design.law}"'
    if design.law not in FAMILIES_OF_LAW:
        return
    for key, value in _needs(design).items():
        if value is None:
            yield key, f'is null, and law = "{design.law}" needs it'
    yield from _slowest(design)


def _needs(design: DesignFile) -> dict[str, object]:
    """Values that must not be null, by their keys."""
    plant, spaced = design.plant, design.law in SPACED_LAWS
    table: dict[str, object] = {"spacing": design.spacing} if spaced else {"clock": design.clock}
    table["tick_s"] = design.tick_s
    if spaced and plant.position is not None:
        return table | {"plant.position.speed_per_s": plant.position.speed_per_s}
    ropes = {"plant.rope_length_m": plant.rope_length_m, "plant.hoist_speed_m_s": plant.hoist_speed_m_s}
    return table | ropes


def _slowest(design: DesignFile) -> Iterator[tuple[str, str]]:
    """Require rows for the slowest mode of the machine; those that share a spacing also for its damping."""
    lowest_hz, damping_ratio = design.plant.frequency_hz[0], design.plant.damping_ratio
    for index, shaper in enumerate(design.shapers):
        key, mode = f"shapers[{index}].mode", shaper.mode
        if not math.isclose(mode.frequency_hz, lowest_hz, rel_tol=_CLOSE):
            yield f"{key}.frequency_hz", f"{mode.frequency_hz!r} is not plant.frequency_hz[0], {lowest_hz!r}"
        if design.law in SPACED_LAWS and mode.damping_ratio != damping_ratio:
            reason = f"{mode.damping_ratio!r} is not plant.damping_ratio, {damping_ratio!r}"
            yield f"{key}.damping_ratio", f"{reason}: rows share a spacing"
