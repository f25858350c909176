"""Learning coefficients from the vibration that is left, window by window. Not for: using them.

Samples are judged by windows: noise is told from vibration within each, and a window that holds little else
than noise teaches nothing, so that coefficients cannot drift. See decision 27.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.adaptive.information import (
    Coefficients,
    Information,
    absolute_sum,
    noise_power,
    on_lattice,
    squared_size,
)
from swayless.controller.adaptive.settings import AdaptiveSettings
from swayless.controller.number import NumberType

WHITE_AT_FIRST = 1e-7
"""P(0) = 1e7 I."""

PAST_WINDOWS = 63.0
"""What was learned before counts for no more than so many windows as strong as the present one."""

NOISE_FACTOR = 4.0
"""A window teaches if its power is more than so many times that of its noise: pure noise never reaches it."""

MISFIT_FACTOR, MISFIT_RATIO = 4.0, 1e-4
"""Coefficients do not fit if they leave so many times the noise, and 1 % of the amplitude."""

RECENT, SIGNIFICANCE = 7.0 / 8.0, 32.0
"""Weight of the past in the slower test of fit, and twice the square of its four standard deviations."""

CONVERGED_WITHIN = 0.01
"""A set that changes by no more in a window has converged."""


def dead_zone_sum(settings: AdaptiveSettings) -> float:
    """Sum of squares, over a window and the three samples of each tick, of vibration in the dead zone."""
    return 3.0 * settings.window_ticks * settings.dead_zone_ratio**2


def first_coefficients(number: NumberType) -> Coefficients:
    """1/3 each, on the lattice of the number type."""
    third = number.scalar(1) / 3.0
    return on_lattice((third, third, third))


class Learner:
    """The coefficients, and all that is known of the vibration.

    Parameters
    ----------
    settings : AdaptiveSettings
        Window, limits, dead zone and number type.
    """

    def __init__(self, settings: AdaptiveSettings) -> None:
        scalar = settings.number.scalar
        self._window_ticks = settings.window_ticks
        self._peak_factor = scalar(settings.peak_factor)
        self._dead_zone = scalar(dead_zone_sum(settings))
        self._nothing = Information(*(scalar(0) for _ in range(6)))
        self._at_first = self._nothing.with_white(scalar(WHITE_AT_FIRST))
        self._zero, self._one = scalar(0), scalar(1)
        self._window, self._past = self._nothing, self._at_first
        self._ticks = 0
        self._left: Any = self._zero
        self._noise: Any = self._zero
        self._samples: Any = self._zero
        self.coefficients: Coefficients = first_coefficients(settings.number)
        self.has_learned = self.is_converged = self.is_frozen = False
        self.learns_again = self.was_refused = False

    def pause(self) -> None:
        """Drop the samples of a window that will not be completed."""
        self._window, self._ticks = self._nothing, 0

    def learn(self, v0: Any, v1: Any, v2: Any, *, in_use: bool) -> None:
        """Take a sample of the free vibration and those of one and two delays ago.

        Parameters
        ----------
        v0, v1, v2 : float or numpy.float32
            Vibration, scaled to order 1.
        in_use : bool
            Whether the coefficients shape the command.
        """
        self._window = self._window.with_sample(v0, v1, v2)
        self._ticks += 1
        if self._ticks == self._window_ticks:
            self._judge(self._window, in_use)
            self.pause()

    def _judge(self, window: Information, in_use: bool) -> None:
        """Learn from a complete window, or find that there is nothing to learn from."""
        energy, noise = window.energy, noise_power(window)
        teaches = energy > self._dead_zone and energy > (3.0 * NOISE_FACTOR) * noise
        self.is_frozen = not teaches
        if teaches:
            weight = self._past_weight(window, energy, noise)
            self._past = window.with_white(-noise).after(weight, self._past)
            self._adopt(self._past.fit())
        elif in_use:
            self.is_converged = True

    def _past_weight(self, window: Information, energy: Any, noise: Any) -> Any:
        """How much the past still counts: less if the coefficients do not fit."""
        windows = self._windows_that_count(window, energy, noise) * energy
        past = self._past.energy
        return windows / past if past > windows else self._one

    def _windows_that_count(self, window: Information, energy: Any, noise: Any) -> Any:
        """How many windows like this one the past is worth: none, one or many."""
        self.learns_again = False
        if not self.has_learned:
            return PAST_WINDOWS
        left, size = window.left_by(self.coefficients), squared_size(self.coefficients)
        allowed = MISFIT_RATIO * energy
        if left > ((MISFIT_FACTOR * noise) * size) + allowed:
            self.learns_again = True
            self._forget_misfit()
            self._past = self._at_first
            return 1.0
        self.learns_again = self._misfits_slowly((left - allowed) / size, noise)
        return 1.0 if self.learns_again else PAST_WINDOWS

    def _misfits_slowly(self, left: Any, noise: Any) -> bool:
        """Whether recent windows together leave more than noise, by four standard deviations."""
        self._left = (RECENT * self._left) + left
        self._noise = (RECENT * self._noise) + noise
        self._samples = (RECENT * self._samples) + self._window_ticks
        excess = self._left - self._noise
        return bool(
            excess > 0.0 and (excess * excess) * self._samples > SIGNIFICANCE * (self._noise * self._noise)
        )

    def _forget_misfit(self) -> None:
        self._left = self._noise = self._samples = self._zero

    def _adopt(self, found: Coefficients | None) -> None:
        """Take new coefficients unless they ask too much of the drive."""
        self.was_refused = found is None or not absolute_sum(found) <= 2.0 * self._peak_factor
        if found is not None and not self.was_refused:
            found = on_lattice(found)
            self.was_refused = bool(absolute_sum(found) > self._peak_factor)
        if found is None or self.was_refused:
            self.is_converged = False
            return
        change = max(abs(new - old) for new, old in zip(found, self.coefficients, strict=True))
        self.is_converged = bool(self.has_learned and not self.learns_again and change <= CONVERGED_WITHIN)
        self.coefficients, self.has_learned = found, True
