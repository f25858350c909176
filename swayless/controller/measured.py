"""What a block measures: the rope of a crane, or where an arm stands; its pins and its words.

A spaced law follows either; the phase clock and rows chosen by length follow a rope. Not for: the readings of
a tick (`rope`), nor for the range that a design allows.
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.status import ROPE_BITS, Status, explain


@dataclass(frozen=True)
class Measured:
    """A measured quantity and its rate of change: names of their pins, units, and words for texts.

    Parameters
    ----------
    c_name, c_speed_name : str
        Pins in C, without their unit.
    st_name, st_speed : str
        Pins in Structured Text.
    unit : str
        ``"m"`` or ``"rad"``; in int32 thousandths of it.
    title, noun : str
        What the quantity is called in a sentence, at first and later on.
    speed_title : str
        What its rate of change is called.
    mover, growth : str
        What changes the quantity, and what happens when it grows.
    is_length : bool
        Whether values must be above 0.

    Examples
    --------
    >>> ROPE.c_value(is_integer=True), ROPE.c_speed(is_integer=True), ROPE.c_valid
    ('rope_length_mm', 'hoist_speed_mm_s', 'rope_length_valid')
    >>> ARM_ANGLE.c_value(is_integer=False), ARM_ANGLE.st_valid, ARM_ANGLE.speed_unit(is_integer=True)
    ('position_rad', 'PositionValid', 'mrad/s')
    """

    c_name: str
    c_speed_name: str
    st_name: str
    st_speed: str
    unit: str
    title: str
    noun: str
    speed_title: str
    mover: str
    growth: str
    is_length: bool

    def value_unit(self, *, is_integer: bool) -> str:
        """Give the unit of the quantity."""
        return f"m{self.unit}" if is_integer else self.unit

    def speed_unit(self, *, is_integer: bool) -> str:
        """Give the unit of its rate of change."""
        return f"{self.value_unit(is_integer=is_integer)}/s"

    def c_value(self, *, is_integer: bool) -> str:
        """Name the pin of the quantity in C."""
        return f"{self.c_name}_{self.value_unit(is_integer=is_integer)}"

    def c_speed(self, *, is_integer: bool) -> str:
        """Name the pin of its rate of change in C."""
        return f"{self.c_speed_name}_{self.value_unit(is_integer=is_integer)}_s"

    @property
    def c_valid(self) -> str:
        """Pin in C that says whether the quantity is to be believed."""
        return f"{self.c_name}_valid"

    @property
    def st_valid(self) -> str:
        """Pin in Structured Text that says whether the quantity is to be believed."""
        return f"{self.st_name}Valid"

    def explain(self, bit: Status) -> str:
        """Say what one status bit means in a block that measures this quantity, in one line.

        Parameters
        ----------
        bit : Status
            Any bit.

        Examples
        --------
        >>> ARM_POSITION.explain(Status.ROPE_FROZEN)
        'the axis moves and the position does not: one of them is wrong'
        """
        return self.said(explain(bit)) if bit & ROPE_BITS else explain(bit)

    def said(self, text: str) -> str:
        """Say of this quantity what a text says of the length of a rope and of its hoist.

        Examples
        --------
        >>> ARM_POSITION.said("positive when the load sinks; at rest every length is taken")
        'positive when it grows; at rest every position is taken'
        """
        for old, new in zip(ROPE.words, self.words, strict=True):
            text = text.replace(old, new)
        return text

    @property
    def words(self) -> tuple[str, ...]:
        """Words that differ between what may be measured; longer ones first."""
        return self.title, self.noun, self.speed_title, self.mover, self.growth


ROPE = Measured(
    c_name="rope_length",
    c_speed_name="hoist_speed",
    st_name="RopeLength",
    st_speed="HoistSpeed",
    unit="m",
    title="rope length",
    noun="length",
    speed_title="hoist speed",
    mover="hoist",
    growth="the load sinks",
    is_length=True,
)
"""The rope of a crane, from the suspension to the load's centre of gravity."""


def _arm(unit: str) -> Measured:
    return Measured(
        c_name="position",
        c_speed_name="position_speed",
        st_name="Position",
        st_speed="PositionSpeed",
        unit=unit,
        title="position",
        noun="position",
        speed_title="position speed",
        mover="axis",
        growth="it grows",
        is_length=False,
    )


ARM_POSITION = _arm("m")
"""Where an arm stands, in m: its reach, or a place along its way; 0 and negative values are allowed."""

ARM_ANGLE = _arm("rad")
"""The angle of an arm's joint, in rad; 0 and negative values are allowed."""
