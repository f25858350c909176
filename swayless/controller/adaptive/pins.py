"""The pins of the adaptive shaper: what it reads and writes each tick. Not for: what it does with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class AdaptiveInput:
    """Inputs of one tick.

    Parameters
    ----------
    command : float or numpy.float32
        What the reference shall be: a speed or a position, in the unit of the settings' `max_command`.
    vibration : float or numpy.float32
        Measured vibration of the load: position, speed or acceleration, in the unit of the settings'
        `vibration_scale`. A constant offset is not learned from.
    enable : bool
        False: nothing is learned, and the command passes unshaped as soon as it has rested.
    """

    command: Any
    vibration: Any
    enable: bool = True


@dataclass(frozen=True)
class AdaptiveOutput:
    """Outputs of one tick.

    Parameters
    ----------
    reference : float or numpy.float32
        For the drive, in the unit of the command.
    coefficient : tuple of three float or numpy.float32
        Amplitudes learned, after 0, 1 and 2 delays: they sum to exactly 1. At first 1/3 each.
    adapting, converged, frozen : bool
        See the bits of the same names.
    status : int
        Sum of the bits of `AdaptiveStatus`.
    """

    reference: Any
    coefficient: tuple[Any, Any, Any]
    adapting: bool
    converged: bool
    frozen: bool
    status: int
