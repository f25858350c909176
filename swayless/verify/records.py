"""The records of a run: inputs and outputs of a block, one record per tick. Not for: what is in them."""

from __future__ import annotations

from typing import Any

import numpy as np

from swayless.codegen.interface import input_pins, output_pins
from swayless.codegen.pin import Pin
from swayless.controller.number import NumberType
from swayless.controller.settings import ShaperSettings

COMMAND_TYPES: dict[str, Any] = {"double": np.float64, "float": np.float32, "int32": np.int32}
"""Array type of a command in each number type."""


def input_dtype(settings: ShaperSettings) -> np.dtype[np.void]:
    """Record type of the inputs of a block, laid out as the C structure is, by the reference's names."""
    return record_of(input_pins(settings), settings.number)


def output_dtype(settings: ShaperSettings) -> np.dtype[np.void]:
    """Record type of the outputs, laid out as the C structure is; fields are those of the reference."""
    return record_of(output_pins(settings), settings.number)


def record_of(pins: tuple[Pin, ...], number: NumberType) -> np.dtype[np.void]:
    """Record type of some pins of any block, laid out as the C structure is.

    Parameters
    ----------
    pins : tuple of Pin
        Inputs or outputs.
    number : NumberType
        Of the block.
    """
    kinds = {
        "bool": np.bool_,
        "real": COMMAND_TYPES[number.name],
        "row": np.uint8,
        "word": np.uint32,
    }
    return np.dtype([(pin.field, kinds[pin.kind]) for pin in pins], align=True)
