"""Every constant of an adaptive shaper. Not for: what it learns."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.adaptive.delays import check_delay
from swayless.controller.number import NUMBER_TYPES, NumberType
from swayless.errors import ControllerError
from swayless.plant.mode import Mode

LARGEST_PEAK_FACTOR = 8.0
"""Beyond it the lattice of exact sums would be too coarse; no drive has that to spare."""

SHORTEST_WINDOW_TICKS, DELAYS_PER_WINDOW = 64, 8
"""Noise is told from vibration over so many samples, and over so much of a period: see decision 27."""

LONGEST_TICKS = 1_000_000
"""Bound of every time in ticks: counters and sums stay far from the end of their types."""


@dataclass(frozen=True)
class AdaptiveSettings:
    """How an adaptive shaper runs.

    Parameters
    ----------
    delay_ticks : int
        Delay from one impulse to the next, 1 to 125,000. Between a quarter and three quarters of a period of
        the vibration all amplitudes come out positive; half a period is best.
    tick_s : float
        Length of a tick, > 0.
    max_command : float
        Commands are clamped to it, > 0, in any unit.
    vibration_scale : float
        Measured vibration that counts as 1, about the amplitude that an unshaped move leaves, > 0.
    cycle_ticks : int
        The command passes unshaped for so long after it has first moved: the first cycle, 1 or more.
    max_reference : float or None
        What the drive can follow, `max_command` to 8 times that. Amplitudes that could ask for more are
        refused. None: `max_command`, which refuses negative amplitudes.
    lag_ticks : int
        Ticks that the drive needs to come to rest after its reference, 0 or more: not learned from.
    dead_zone_ratio : float
        Vibration of at most this rms, relative to `vibration_scale`, is never learned from; 0 to 1. Below
        1e-6 it counts as 1e-6.
    mode : Mode or None
        The vibration, where it is known: a delay with which it cannot be learned, or would ask for more than
        `max_reference`, is then refused.
    number : NumberType
        ``double`` or ``float``.

    Raises
    ------
    ControllerError
        If a value is out of range, the delay does not fit the mode, or the number type is int32.

    Examples
    --------
    The test bed of Rhim and Book: 25 ms at 1 kHz, transfer after the first cycle of 4 s.

    >>> settings = AdaptiveSettings(25, 0.001, max_command=1.0, vibration_scale=2.0, cycle_ticks=4000)
    >>> settings.ring_length, settings.quiet_ticks, settings.window_ticks
    (51, 101, 200)
    >>> AdaptiveSettings(31, 0.001, 1.0, 2.0, 4000, mode=Mode(16.0))
    Traceback (most recent call last):
        ...
    swayless.errors.ControllerError: delay = 0.031 s: |cos(w Td)| = 0.99968 of the vibration of 16 Hz: must \
be at most 0.95; with max_reference = 1 times max_command delays such as 0.016 to 0.028 s can be learned
    """

    delay_ticks: int
    tick_s: float
    max_command: float
    vibration_scale: float
    cycle_ticks: int
    max_reference: float | None = None
    lag_ticks: int = 0
    dead_zone_ratio: float = 0.001
    mode: Mode | None = None
    number: NumberType = NUMBER_TYPES["double"]

    def __post_init__(self) -> None:
        if self.number.is_integer:
            raise ControllerError(
                "number = 'int32': must be double or float; sums of squares of a measurement "
                "span more than 64 bits of fixed point"
            )
        for name, lowest in (("delay_ticks", 1), ("cycle_ticks", 1), ("lag_ticks", 0)):
            self._check_ticks(name, lowest)
        for name in ("tick_s", "max_command", "vibration_scale"):
            self._check_positive(name)
        if not 1.0 <= self.peak_factor <= LARGEST_PEAK_FACTOR:
            raise ControllerError(
                f"max_reference = {self.max_reference!r}: must be from max_command = "
                f"{self.max_command!r} to {LARGEST_PEAK_FACTOR:g} times that"
            )
        if not 0.0 <= self.dead_zone_ratio <= 1.0:
            raise ControllerError(f"dead_zone_ratio = {self.dead_zone_ratio!r}: must be from 0 to 1")
        if self.mode is not None:
            check_delay(self.delay_ticks, self.tick_s, self.mode, self.peak_factor)

    def _check_ticks(self, name: str, lowest: int) -> None:
        highest = LONGEST_TICKS // (DELAYS_PER_WINDOW if name == "delay_ticks" else 1)
        if not lowest <= getattr(self, name) <= highest:
            raise ControllerError(f"{name} = {getattr(self, name)!r}: must be from {lowest} to {highest}")

    def _check_positive(self, name: str) -> None:
        value = getattr(self, name)
        if not 1e-6 <= value <= 1e6:
            raise ControllerError(f"{name} = {value!r}: must be from 1e-6 to 1e6")

    @property
    def peak_factor(self) -> float:
        """Largest sum of absolute amplitudes that is accepted."""
        return 1.0 if self.max_reference is None else self.max_reference / self.max_command

    @property
    def ring_length(self) -> int:
        """Cells of each ring: the present sample and those of two delays."""
        return 2 * self.delay_ticks + 1

    @property
    def settled_ticks(self) -> int:
        """The command has been at rest for so long: the reference is the command."""
        return 2 * self.delay_ticks

    @property
    def quiet_ticks(self) -> int:
        """The command has been at rest for so long: all samples of two delays are free vibration.

        Two delays until the reference rests, one tick until that is measured, and two delays of samples.
        """
        return 4 * self.delay_ticks + 1 + self.lag_ticks

    @property
    def window_ticks(self) -> int:
        """Samples that are judged together."""
        return max(SHORTEST_WINDOW_TICKS, DELAYS_PER_WINDOW * self.delay_ticks)
