"""Which parts of the law a Structured Text block has; declarations say which needs them. Not for: text."""

from __future__ import annotations

from typing import Literal, TypeAlias

from swayless.codegen.features import features_of
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacingLaw

BlockLaw: TypeAlias = Literal["fixed", "phase"] | SpacingLaw
"""What a tap waits for: ticks, a phase of the pendulum, or multiples of a spacing looked up each tick."""


def law_of(settings: ShaperSettings) -> BlockLaw:
    """Name the law of a block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    return features_of(settings).spacing_law or ("fixed" if settings.clock is None else "phase")


def parts_in_use(settings: ShaperSettings) -> frozenset[str]:
    """Name the parts of the law that a block uses, its law among them.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    features, law = features_of(settings), law_of(settings)
    parts = {
        "all": True,
        law: True,
        "ticks": law != "phase",
        "spacing": settings.is_spaced,
        "rope": features.has_rope,
        "rope rows": features.has_rope_rows,
        "minimum": features.has_minimum,
        "resolution": features.has_resolution,
        "inching": features.has_inching,
        "waiting": features.has_waiting_rows,
    }
    used = parts | _operator_parts(settings) | _diagnostic_parts(settings)
    return frozenset(name for name, is_used in used.items() if is_used)


def _operator_parts(settings: ShaperSettings) -> dict[str, bool]:
    """Tell which of the operator's functions there are, and what several of them share."""
    operator, waits = settings.operator, features_of(settings).has_waiting_rows
    steps, way = operator.steps is not None, operator.way is not None
    return {
        "steps": steps,
        "way": way,
        "ahead": steps or way,
        "plan": (steps or way) and waits,
        "way and steps": steps and way,
        "step rows wait": steps and waits,
        "way rows wait": way and waits,
        "switches": operator.has_switches,
        "stop switches": operator.has_stop_switches,
        "slow switches": operator.slow_command is not None,
        "anchor": not way or waits or settings.clock is not None,
        "pending": operator.has_stop_switches or way,
        "contactor": bool(operator.contactor_commands),
        "feedback": operator.has_drive_feedback,
        "halt": operator.has_drive_feedback or operator.has_stop_switches,
        "tuning": operator.is_tuned,
        "speed limit": operator.has_speed_limit,
        "offset": operator.rope_offset is not None,
        "lock": steps or operator.starts_from_zero,
        "locked at first": operator.starts_from_zero,
        "free at first": steps and not operator.starts_from_zero,
    }


def _diagnostic_parts(settings: ShaperSettings) -> dict[str, bool]:
    """Tell which diagnostics there are, and what they share with the law."""
    asked, is_phase = settings.diagnostics, settings.clock is not None
    sway_of_rope = asked.sway is not None and asked.sway.rope is not None
    is_summed = asked.facts is not None
    has_pieces = asked.rope_bounds is not None
    return {
        "sway": asked.sway is not None,
        "sway rows": asked.sway is not None and asked.sway.rope is None,
        "sway rope": sway_of_rope,
        "phase table": is_phase or sway_of_rope,
        "quanta of the sway": sway_of_rope and not is_phase,
        "bounds": has_pieces,
        "pieces": has_pieces or settings.is_spaced,
        "tracking": asked.tracking is not None,
        "facts": is_summed,
        "inner loop": is_phase or is_summed,
        "delays": not is_phase and (is_summed or not settings.is_spaced),
        "row ends": features_of(settings).has_rope_rows or (is_summed and settings.bank.by_rope is not None),
    }
