"""The pins of the command shaper block, for C and Structured Text alike. Not for: what they do inside."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.number import NumberType
from swayless.controller.rope import RopeSettings
from swayless.controller.settings import ShaperSettings


@dataclass(frozen=True)
class Pin:
    """One input or output.

    Parameters
    ----------
    c_name, st_name : str
        Name in each language; Structured Text drops the unit suffix.
    kind : str
        ``"bool"``, ``"real"``, ``"row"`` or ``"word"``.
    doc : str
        Meaning, range and what happens on bad input.
    unit : str
        Unit in float types.
    integer_unit : str
        Unit in int32.
    st_initial : str
        Initial value of a Structured Text input that is not wired.
    """

    c_name: str
    st_name: str
    kind: str
    doc: str
    unit: str = ""
    integer_unit: str = ""
    st_initial: str = ""

    def text(self, *, is_integer: bool) -> str:
        """Comment with the unit in front."""
        unit = self.integer_unit if is_integer else self.unit
        return f"[{unit}] {self.doc}" if unit else self.doc


def input_pins(settings: ShaperSettings) -> tuple[Pin, ...]:
    """List the inputs of the block, in the order of the generated structure.

    Parameters
    ----------
    settings : ShaperSettings
        For units and the number of rows.
    """
    units = settings.limits.units
    by_rope = settings.bank.by_rope is not None
    choice = "1 the row of the rope" if by_rope else f"1 to {len(settings.bank.rows)} rows"
    pins = (
        Pin("enable", "Enable", "bool", "false: row 0 is wanted, ramped and unshaped", st_initial="TRUE"),
        Pin(
            "emergency_stop",
            "EmergencyStop",
            "bool",
            "reference 0 at once; latched until the command is 0",
        ),
        Pin(
            "quick_stop",
            "QuickStop",
            "bool",
            "unshaped stop on its own ramp; latched until at rest and the command is 0",
        ),
        Pin(
            "command",
            "Command",
            "real",
            "wanted speed; clamped to the maximum, and not finite counts as 0",
            units,
            f"counts ({units})" if units != "counts" else "counts",
        ),
        Pin(
            "selector",
            "Selector",
            "row",
            f"0 unshaped, {choice}; anything else keeps the last valid one",
        ),
    )
    return pins if settings.rope is None else (*pins, *_measured_pins(settings.rope, settings.number))


def _measured_pins(rope: RopeSettings, number: NumberType) -> tuple[Pin, ...]:
    """List what a measured rope, or the position of an arm, adds to the inputs."""
    measured, whole = rope.measured, number.is_integer
    return (
        Pin(
            measured.c_value(is_integer=whole),
            measured.st_name,
            "real",
            f"{rope.shortest:.6g} to {rope.longest:.6g}: clamped; the last one holds if it cannot be true",
            measured.value_unit(is_integer=False),
            measured.value_unit(is_integer=True),
        ),
        Pin(
            measured.c_speed(is_integer=whole),
            measured.st_speed,
            "real",
            measured.said("rate of change of the length, positive when the load sinks; clamped"),
            measured.speed_unit(is_integer=False),
            measured.speed_unit(is_integer=True),
        ),
        Pin(
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
    return (
        Pin("reference", "Reference", "real", "speed for the drive", units, "counts"),
        Pin(
            "stop_distance",
            "StopDistance",
            "real",
            "signed way still to go if the command is 0 from the next tick on",
            "m",
            "mm",
        ),
        Pin("stop_time_s", "StopTime", "real", "time until the reference is 0 then", "s", "s, rounded up"),
        Pin("stop_time_ticks", "StopTimeTicks", "word", "the same time", "ticks", "ticks"),
        Pin(
            "residual_bound",
            "ResidualBound",
            "real",
            "residual vibration that the row guarantees; all of it when unshaped",
            "ratio",
            "millionths",
        ),
        Pin("row", "Row", "row", "row in use"),
        Pin("settled", "Settled", "bool", "nothing is pending: a row may change"),
        Pin("active", "Active", "bool", "the command is being shaped"),
        Pin("error", "Error", "bool", "an input cannot be right; the status says which"),
        Pin("status", "Status", "word", "one bit for each reason, see above"),
    )
