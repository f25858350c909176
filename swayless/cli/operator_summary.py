"""What a build says of steps, ends and contactors: ways in m, asked of the block's own reference.

Not for: the rows (`swayless.cli.summary`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from swayless.cli.ways import MM_PER_M, end_ways, step_ways_m, ways

if TYPE_CHECKING:
    from swayless.controller import ShaperSettings

_WAY_DIGITS = 9
"""Significant digits of a way in a document and of a step: more than a count for a tick is of any of them."""


def operator_remarks(settings: ShaperSettings) -> Iterator[str]:
    """Say what steps, switches, distances and contactors come to.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    found = operator_document(settings)
    if "steps_m" in found:
        exact = _listed([f"{way_m!r}" for way_m in found["steps_m"]])
        yield f"steps: {exact} m, at most {found['step_speed_m_s']:.6g} m/s"
    if "slow_switch_m" in found:
        yield (
            f"slow-down switch: {found['slow_switch_m']:.3f} m before the stop switch or the end, to be at "
            f"{found['slow_speed_m_s']:.6g} m/s there"
        )
    if "stop_switch_m" in found:
        yield f"stop switch: {found['stop_switch_m']:.3f} m before the end, for the quick stop"
    if "limit_margin_m" in found:
        yield (
            f"distances: stops {found['limit_margin_m']:.6g} m before an end, and slows down from "
            f"{found['slows_from_m']:.3f} m before it at full speed"
        )
    if "contactor_speeds_m_s" in found:
        speeds = _listed([f"{speed_m_s:.6g}" for speed_m_s in [0.0, *found["contactor_speeds_m_s"]]])
        yield (
            f"contactors: {speeds} m/s and nothing between; a new command waits until the last one has "
            f"settled, up to {found['contactor_wait_s']:.4g} s"
        )


def operator_document(settings: ShaperSettings) -> dict[str, Any]:
    """Give the same for machines; keys of functions that the block has not are left out.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    operator, document = settings.operator, dict[str, Any]()
    if operator.steps is not None:
        document["steps_m"] = [_rounded(way_m) for way_m in step_ways_m(settings)]
        document["step_speed_m_s"] = _speed_m_s(settings, operator.steps.command)
    if operator.has_switches:
        ends = end_ways(settings)
        if ends.to_slow_m is not None:
            document["slow_switch_m"] = _rounded(ends.to_slow_m)
            document["slow_speed_m_s"] = _speed_m_s(settings, operator.slow_command)
        if operator.has_stop_switches:
            document["stop_switch_m"] = _rounded(ends.stop_m)
    if operator.way is not None:
        document |= _distances(settings, operator.way.margin)
    if operator.contactor_commands:
        speeds = [_speed_m_s(settings, command) for command in operator.contactor_commands]
        document["contactor_speeds_m_s"] = speeds
        document["contactor_wait_s"] = _rounded(settings.longest_delay_ticks * settings.tick_s)
    return document


def _listed(words: Sequence[str]) -> str:
    return f"{', '.join(words[:-1])} and {words[-1]}"


def _distances(settings: ShaperSettings, margin: Any) -> dict[str, float]:
    """Give where the crane stops before an end, and from where it slows down at full speed."""
    margin_m = float(margin) / (MM_PER_M if settings.number.is_integer else 1.0)
    farthest_m = max(ways(settings, row).released_m for row in range(1, len(settings.bank.rows) + 1))
    return {"limit_margin_m": margin_m, "slows_from_m": _rounded(margin_m + farthest_m)}


def _speed_m_s(settings: ShaperSettings, command: Any) -> float:
    return _rounded(float(command) / settings.limits.units_per_m_s)


def _rounded(value: float) -> float:
    return float(f"{value:.{_WAY_DIGITS}g}")
