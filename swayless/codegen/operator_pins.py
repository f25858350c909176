"""The pins of functions that a block has only where its design asks for them. Not for: the others."""

from __future__ import annotations

from swayless.codegen.literals import st_literal
from swayless.codegen.pin import Pin, length_pin, pin
from swayless.controller.settings import ShaperSettings


def operator_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the inputs of steps, switches and distances.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    operator, pins = settings.operator, []
    if operator.steps is not None:
        held = "an edge is a step; it counts only after the input was seen false"
        pins += [
            pin("step_forward", "bool", held),
            pin("step_reverse", "bool", held),
            pin("step_size", "row", f"1 to 3: a step of {_sizes(settings)}; else none", st_initial="1"),
        ]
    if operator.has_stop_switches:
        made = "true: the stop switch at that end is made; motion towards it ends, the way back is open"
        pins += [pin("stop_forward", "bool", made), pin("stop_reverse", "bool", made)]
    if operator.slow_command is not None:
        units = "counts" if settings.number.is_integer else settings.limits.units
        most = f"{operator.slow_command:.6g} {units}"
        slow = f"true: the slow-down switch before that end is made; at most {most} towards it"
        pins += [pin("slow_forward", "bool", slow), pin("slow_reverse", "bool", slow)]
    if operator.way is not None:
        whole = settings.number.is_integer
        margin = f"{operator.way.margin:.6g} {'mm' if whole else 'm'}"
        left = f"way left to that end when the tick begins; it stops {margin} before"
        pins += [
            length_pin("distance_forward", left, is_integer=whole),
            length_pin("distance_reverse", left, is_integer=whole),
            pin("distance_valid", "bool", "false: the distances are not to be believed", st_initial="TRUE"),
        ]
    return tuple(pins)


def _sizes(settings: ShaperSettings) -> str:
    """Name the ways of the steps."""
    steps, units_per_m_s = settings.operator.steps, settings.limits.units_per_m_s
    assert steps is not None  # noqa: S101 - only a block with Step Mode asks
    first, second, third = (f"{float(size) * settings.tick_s / units_per_m_s:.4g}" for size in steps.sizes)
    return f"{first}, {second} or {third} m"


def feedback_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the inputs of what the drive says of itself.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    units = settings.limits.units
    counts = f"counts ({units})" if units != "counts" else "counts"
    has_feedback, pins = settings.operator.has_drive_feedback, []
    if has_feedback:
        pins.append(pin("drive_ready", "bool", "false: the drive does not follow; the reference is 0"))
    if has_feedback or settings.diagnostics.tracking is not None:
        pins.append(
            Pin("actual_speed", "actual_speed", "ActualSpeed", "real", "speed of the drive", units, counts)
        )
    return tuple(pins)


def tuning_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the inputs of what may be set on site.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    operator, limits, pins = settings.operator, settings.limits, []
    if operator.has_speed_limit:
        units = limits.units
        counts = f"counts ({units})" if units != "counts" else "counts"
        full = "" if settings.number.is_integer else st_literal(limits.max_command, settings.number)
        doc = f"largest command from now on, 0 to {limits.max_command:.9g}: clamped"
        pins.append(Pin("speed_limit", "speed_limit", "SpeedLimit", "real", doc, units, counts, full))
    if operator.rope_offset is not None:
        low, high = operator.rope_offset
        doc = f"added to the measured rope length, {low:.6g} to {high:.6g}: clamped"
        pins.append(length_pin("rope_offset", doc, is_integer=settings.number.is_integer))
    return tuple(pins)


def diagnostic_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the outputs of diagnostics.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    diagnostics, pins = settings.diagnostics, []
    if diagnostics.sway is not None:
        doc = "where the linear model has the load, ahead of the trolley; not measured"
        pins.append(length_pin("predicted_sway", doc, is_integer=settings.number.is_integer))
    if diagnostics.facts is not None:
        doc = "CRC-32 of the design file: which design the block runs"
        pins.append(pin("design_id", "word", doc))
    return tuple(pins)
