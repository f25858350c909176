"""Run generated Structured Text over stimuli in the evaluator. Not for: judging what comes out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.controller.settings import ShaperSettings
from swayless.errors import VerificationError
from swayless.verify.records import output_dtype
from swayless.verify.structured_text import load


class EvaluatedProgram:
    """A block in Structured Text, parsed, checked and translated once.

    Parameters
    ----------
    text : str
        The generated file.
    outputs : dtype
        Layout of the records of its outputs.

    Raises
    ------
    ToolMissingError
        If the parser is not installed.
    VerificationError
        If the text is not portable Structured Text.
    """

    def __init__(self, text: str, outputs: np.dtype[np.void]) -> None:
        self._program = load(text)
        self._outputs = outputs

    def run(self, inputs: NDArray[np.void]) -> NDArray[np.void]:
        """Run the block from power-on over a stimulus; arrays as in `CompiledProgram.run`.

        Raises
        ------
        VerificationError
            If the block has other pins than the records have fields.
        """
        block = self._program.instantiate()
        outputs = np.zeros(inputs.size, dtype=of_dint(self._outputs))
        pins = _in_order(self._program.inputs, inputs.dtype)
        results = _in_order(self._program.outputs, outputs.dtype)
        columns = [inputs[name].tolist() for name in inputs.dtype.names or ()]
        for tick, values in enumerate(zip(*columns, strict=True)):
            found = block.step(dict(zip(pins, values, strict=True)))
            outputs[tick] = tuple(found[name] for name in results)
        return outputs.view(self._outputs)


def of_dint(record: np.dtype[np.void]) -> np.dtype[np.void]:
    """Give the same record with words as a DINT holds them: their bits with a sign.

    Parameters
    ----------
    record : dtype
        Layout of outputs.

    Examples
    --------
    >>> of_dint(np.dtype([("status", np.uint32)]))["status"]
    dtype('int32')
    """
    names = record.names or ()
    fields: Mapping[str, Any] = record.fields or {}
    kinds = [np.dtype(np.int32) if fields[name][0] == np.uint32 else fields[name][0] for name in names]
    places = [fields[name][1] for name in names]
    return np.dtype({"names": names, "formats": kinds, "offsets": places, "itemsize": record.itemsize})


class EvaluatedBlock(EvaluatedProgram):
    """A command shaper in Structured Text.

    Parameters
    ----------
    text : str
        The generated file.
    settings : ShaperSettings
        The block, for the fields of its records.
    """

    def __init__(self, text: str, settings: ShaperSettings) -> None:
        super().__init__(text, output_dtype(settings))


def _in_order(pins: Mapping[str, str], record: np.dtype[np.void]) -> list[str]:
    """Name the pins of a block in the order of the fields of a record, which is theirs."""
    fields = record.names or ()
    if len(pins) != len(fields):
        raise VerificationError(f"pins {', '.join(pins)}: expected {len(fields)}: {', '.join(fields)}")
    return list(pins)
