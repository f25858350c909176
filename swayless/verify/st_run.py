"""Run generated Structured Text over stimuli in the evaluator. Not for: judging what comes out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swayless.controller.number import NumberType
from swayless.verify.records import output_dtype
from swayless.verify.structured_text import load

PINS = {
    "enable": "Enable",
    "emergency_stop": "EmergencyStop",
    "quick_stop": "QuickStop",
    "command": "Command",
    "selector": "Selector",
    "rope_length": "RopeLength",
    "hoist_speed": "HoistSpeed",
    "rope_length_valid": "RopeLengthValid",
    "reference": "Reference",
    "stop_distance": "StopDistance",
    "stop_time_s": "StopTime",
    "stop_time_ticks": "StopTimeTicks",
    "residual_bound": "ResidualBound",
    "row": "Row",
    "settled": "Settled",
    "active": "Active",
    "error": "Error",
    "status": "Status",
}
"""Pins of the block by the name of the field in a record."""


class EvaluatedBlock:
    """A command shaper in Structured Text, parsed, checked and translated once.

    Parameters
    ----------
    text : str
        The generated file.
    number : NumberType
        ``double`` for LREAL, ``float`` for REAL.

    Raises
    ------
    ToolMissingError
        If the parser is not installed.
    VerificationError
        If the text is not portable Structured Text.
    """

    def __init__(self, text: str, number: NumberType) -> None:
        self._program = load(text)
        self._number = number

    def run(self, inputs: NDArray[np.void]) -> NDArray[np.void]:
        """Run the block from power-on over a stimulus; arrays as in `CompiledBlock.run`."""
        block = self._program.instantiate()
        outputs = np.zeros(inputs.size, dtype=output_dtype(self._number))
        names = inputs.dtype.names or ()
        pins = [PINS[name] for name in names]
        results = [PINS[name] for name in outputs.dtype.names or ()]
        columns = [inputs[name].tolist() for name in names]
        for tick, values in enumerate(zip(*columns, strict=True)):
            found = block.step(dict(zip(pins, values, strict=True)))
            outputs[tick] = tuple(found[name] for name in results)
        return outputs
