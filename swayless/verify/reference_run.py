"""Run the Python reference of a command shaper over a stimulus. Not for: generated code."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swayless.controller.command_shaper import CommandShaper, ShaperInput
from swayless.controller.settings import ShaperSettings
from swayless.verify.records import output_dtype


def run_reference(settings: ShaperSettings, inputs: NDArray[np.void]) -> NDArray[np.void]:
    """Run the reference, tick by tick.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    inputs : structured ndarray, shape (ticks,)
        Stimulus.

    Returns
    -------
    structured ndarray, shape (ticks,)
        Fields as in `output_dtype`.
    """
    shaper = CommandShaper(settings)
    scalar = settings.number.scalar
    names = output_dtype(settings).names or ()
    outputs = np.empty(inputs.size, dtype=output_dtype(settings))
    reals = {name for name in inputs.dtype.names or () if inputs.dtype[name].kind in "fi"}
    columns = {
        name: map(scalar, inputs[name].tolist()) if name in reals else inputs[name].tolist()
        for name in inputs.dtype.names or ()
    }
    for tick, values in enumerate(zip(*columns.values(), strict=True)):
        out = shaper.step(ShaperInput(**dict(zip(columns, values, strict=True))))
        outputs[tick] = tuple(getattr(out, name) for name in names)
    return outputs
