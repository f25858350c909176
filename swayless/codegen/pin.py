"""One pin of a generated block: its names, its unit, and which field of the reference it is.

Not for: which pins there are (`interface`).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Pin:
    """One input or output.

    Parameters
    ----------
    field : str
        Field of `ShaperInput` or `ShaperOutput` that it is.
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

    field: str
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


def pin(field: str, kind: str, doc: str, *, st_initial: str = "") -> Pin:
    """Make a pin without unit that is called after its field.

    Examples
    --------
    >>> pin("slow_forward", "bool", "switch").st_name
    'SlowForward'
    """
    return Pin(field, field, st_name(field), kind, doc, st_initial=st_initial)


def length_pin(field: str, doc: str, *, is_integer: bool, st_initial: str = "") -> Pin:
    """Make a pin of a length: in C its name ends in the unit, m or, in int32, mm.

    Examples
    --------
    >>> length_pin("distance_forward", "way left", is_integer=True).c_name
    'distance_forward_mm'
    """
    c_name = f"{field}_mm" if is_integer else f"{field}_m"
    return Pin(field, c_name, st_name(field), "real", doc, "m", "mm", st_initial)


def st_name(field: str) -> str:
    """Write a name as Structured Text does.

    Examples
    --------
    >>> st_name("cross_travel")
    'CrossTravel'
    """
    return "".join(word.capitalize() for word in field.split("_"))
