"""Values that a caller gives to a block's inputs. Not for: values in the source, which are `literals`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from swayless.verify.structured_text.arithmetic import INTEGER_RANGES
from swayless.verify.structured_text.faults import InputError
from swayless.verify.structured_text.literals import Scalar


def accepted(types: Mapping[str, str], name: str, value: object) -> Scalar:
    """Return a value for an input as the evaluator computes with it.

    Parameters
    ----------
    types : mapping of str to str
        Name and type of every input.
    name : str
        The input, spelled as declared.
    value : bool, int or float
        numpy scalars are taken too.

    Raises
    ------
    InputError
        If there is no such input, or the value is of another type, out of range, or no REAL.

    Examples
    --------
    >>> accepted({"Command": "LREAL"}, "Command", 0.5)
    0.5
    >>> accepted({"Command": "REAL"}, "Command", 0.1)
    Traceback (most recent call last):
    swayless.verify.structured_text.faults.InputError: Command = 0.1 is no REAL, try 0.10000000149011612
    """
    type_name = types.get(name)
    match type_name, value:
        case None, _:
            raise InputError(f"{name} is not an input: the inputs are {', '.join(types) or 'none'}")
        case "BOOL", bool() | np.bool_():
            return bool(value)
        case "INT" | "DINT", int() | np.integer() if not isinstance(value, bool):
            return _integer(name, type_name, int(value))
        case "REAL" | "LREAL", float() | np.floating():
            return _float(name, type_name, value)
    raise InputError(f"{name} = {value!r} is of type {type(value).__name__}: it takes {type_name}")


def _integer(name: str, type_name: str, value: int) -> int:
    low, high = INTEGER_RANGES[type_name]
    if not low <= value <= high:
        raise InputError(f"{name} = {value} is outside {type_name}, {low} to {high}")
    return value


def _float(name: str, type_name: str, value: float | np.floating[Any]) -> float | np.float32:
    with np.errstate(over="ignore", under="ignore"):
        rounded = np.float32(value) if type_name == "REAL" else float(value)
    # A double comes first in the comparison: beside a single, numpy would round the other side too.
    if float(rounded) != value and not np.isnan(rounded):
        raise InputError(f"{name} = {value!r} is no {type_name}, try {float(rounded)!r}")
    return rounded
