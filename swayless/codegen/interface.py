"""The pins of the command shaper block, for C and Structured Text alike. Not for: what they do inside."""

from __future__ import annotations

from swayless.codegen.operator_pins import diagnostic_pins, feedback_pins, operator_pins, tuning_pins
from swayless.codegen.pin import Pin, pin
from swayless.controller.number import NumberType
from swayless.controller.rope import RopeSettings
from swayless.controller.settings import ShaperSettings


def input_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the inputs of the block, in the order of the generated structure.

    Parameters
    ----------
    settings : ShaperSettings
        For units and the number of rows.
    """
    units = settings.limits.units
    by_rope = settings.bank.by_rope is not None
    rows = len(settings.bank.rows)
    choice = "1 the row of the rope" if by_rope else "1 the row" if rows == 1 else f"1 to {rows} rows"
    pins: tuple[Pin, ...] = (
        pin(
            "enable",
            "bool",
            "false: row 0 is wanted, ramped and unshaped",
            st_initial="TRUE",
        ),
        pin(
            "emergency_stop",
            "bool",
            "reference 0 at once; latched until the command is 0",
        ),
        pin(
            "quick_stop",
            "bool",
            "unshaped stop on its own ramp; latched until at rest and the command is 0",
        ),
        Pin(
            "command",
            "command",
            "Command",
            "real",
            "wanted speed; clamped to the maximum, and not finite counts as 0",
            units,
            f"counts ({units})" if units != "counts" else "counts",
        ),
        pin(
            "selector",
            "row",
            f"0 unshaped, {choice}; anything else keeps the last valid one",
        ),
    )
    if settings.rope is not None:
        pins += _measured_pins(settings.rope, settings.number)
    return pins + operator_pins(settings) + feedback_pins(settings) + tuning_pins(settings)


def _measured_pins(rope: RopeSettings, number: NumberType) -> tuple[Pin, ...]:
    """List what a measured rope, or the position of an arm, adds to the inputs."""
    measured, whole = rope.measured, number.is_integer
    return (
        Pin(
            "rope_length",
            measured.c_value(is_integer=whole),
            measured.st_name,
            "real",
            f"{rope.shortest:.6g} to {rope.longest:.6g}: clamped; the last one holds if it cannot be true",
            measured.value_unit(is_integer=False),
            measured.value_unit(is_integer=True),
        ),
        Pin(
            "hoist_speed",
            measured.c_speed(is_integer=whole),
            measured.st_speed,
            "real",
            measured.said("rate of change of the length, positive when the load sinks; clamped"),
            measured.speed_unit(is_integer=False),
            measured.speed_unit(is_integer=True),
        ),
        Pin(
            "rope_length_valid",
            measured.c_valid,
            measured.st_valid,
            "bool",
            measured.said("false: the rope length is not to be believed"),
            st_initial="TRUE",
        ),
    )


def output_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the outputs of the block, in the order of the generated structure.

    Parameters
    ----------
    settings : ShaperSettings
        For units.
    """
    units = settings.limits.units
    bound = "residual vibration that the row guarantees; all of it when unshaped"
    if settings.diagnostics.rope_bounds is not None:
        bound = "residual vibration that the row leaves at most on this rope; all of it when unshaped"
    pins: tuple[Pin, ...] = (
        Pin("reference", "reference", "Reference", "real", "speed for the drive", units, "counts"),
        Pin(
            "stop_distance",
            "stop_distance",
            "StopDistance",
            "real",
            "signed way still to go if the command is 0 from the next tick on",
            "m",
            "mm",
        ),
        Pin(
            "stop_time_s",
            "stop_time_s",
            "StopTime",
            "real",
            "time until the reference is 0 then",
            "s",
            "s, rounded up",
        ),
        Pin("stop_time_ticks", "stop_time_ticks", "StopTimeTicks", "word", "the same time", "ticks", "ticks"),
        Pin(
            "residual_bound",
            "residual_bound",
            "ResidualBound",
            "real",
            bound,
            "ratio",
            "millionths",
        ),
        pin("row", "row", "row in use"),
        pin("settled", "bool", "nothing is pending: a row may change"),
        pin("active", "bool", "the command is being shaped"),
        pin("error", "bool", "an input cannot be right; the status says which"),
        pin("status", "word", "one bit for each reason, see above"),
    )
    return pins + diagnostic_pins(settings)
