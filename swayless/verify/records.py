"""The records of a run: inputs and outputs of a block, one record per tick. Not for: what is in them."""

from __future__ import annotations

from typing import Any

import numpy as np

from swayless.controller.number import NumberType
from swayless.controller.settings import ShaperSettings

COMMAND_TYPES: dict[str, Any] = {"double": np.float64, "float": np.float32, "int32": np.int32}
"""Array type of a command in each number type."""


def input_dtype(settings: ShaperSettings) -> np.dtype[np.void]:
    """Record type of the inputs of a block, laid out as the C structure is."""
    real = COMMAND_TYPES[settings.number.name]
    fields = [
        ("enable", np.bool_),
        ("emergency_stop", np.bool_),
        ("quick_stop", np.bool_),
        ("command", real),
        ("selector", np.uint8),
    ]
    if settings.rope is not None:
        fields += [("rope_length", real), ("hoist_speed", real), ("rope_length_valid", np.bool_)]
    return np.dtype(fields, align=True)


def output_dtype(number: NumberType) -> np.dtype[np.void]:
    """Record type of the outputs, laid out as the C structure is."""
    real = COMMAND_TYPES[number.name]
    return np.dtype(
        [
            ("reference", real),
            ("stop_distance", real),
            ("stop_time_s", real),
            ("stop_time_ticks", np.uint32),
            ("residual_bound", real),
            ("row", np.uint8),
            ("settled", np.bool_),
            ("active", np.bool_),
            ("error", np.bool_),
            ("status", np.uint32),
        ],
        align=True,
    )
