"""What a figure is given: designs with their labels, and the command they answer.

Not for: how it is drawn, nor for reading design files.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from swayless.design.shaper import Guarantee, Impulses
from swayless.errors import DesignError, PlantError


@dataclass(frozen=True)
class PlottedShaper:
    """One design in a figure.

    Parameters
    ----------
    label : str
        Its name in legends, not empty.
    impulses : Impulses
        Times and amplitudes: of the shaper, or of the taps that run.
    guarantee : Guarantee
        What these impulses hold.
    tick_s : float or None
        Tick of the controller in seconds, > 0; None for a design in continuous time.

    Raises
    ------
    DesignError
        If the label is empty or the tick is out of range.
    """

    label: str
    impulses: Impulses
    guarantee: Guarantee
    tick_s: float | None = None

    def __post_init__(self) -> None:
        if not self.label.strip():
            raise DesignError(f"label = {self.label!r}: must not be empty, the legend has nothing else")
        if self.tick_s is not None and not (math.isfinite(self.tick_s) and self.tick_s > 0.0):
            raise DesignError(f"{self.label}: tick_s = {self.tick_s!r}: must be finite and > 0, or None")

    @property
    def duration_s(self) -> float:
        """Time of the last impulse, in seconds."""
        return float(self.impulses.times_s[-1])


@dataclass(frozen=True)
class PlottedCommand:
    """A press of a direction button: up to speed, held, and down again.

    Parameters
    ----------
    speed_m_s : float
        Speed asked for, in m/s, > 0 and finite.
    hold_s : float
        How long it is asked for, in seconds, > 0; infinite for a step.
    acceleration_m_s2, deceleration_m_s2 : float
        Ramps before the shaper, in m/s2, > 0; infinite for a jump.

    Raises
    ------
    PlantError
        If a value is out of range.

    Examples
    --------
    >>> PlottedCommand(0.5, hold_s=3.0).title
    'press of 3 s at 0.5 m/s'
    """

    speed_m_s: float = 1.0
    hold_s: float = math.inf
    acceleration_m_s2: float = math.inf
    deceleration_m_s2: float = math.inf

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not value > 0.0:
                raise PlantError(f"{name} = {value!r}: must be > 0")
        if math.isinf(self.speed_m_s):
            raise PlantError(f"speed_m_s = {self.speed_m_s!r}: must be finite")

    @property
    def title(self) -> str:
        """The command in words."""
        if math.isinf(self.hold_s):
            return f"step to {self.speed_m_s:g} m/s"
        return f"press of {self.hold_s:g} s at {self.speed_m_s:g} m/s"
