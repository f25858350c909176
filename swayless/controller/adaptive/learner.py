"""Learning coefficients from the vibration that is left, window by window. Not for: using them.

Samples are judged by windows: noise is told from vibration within each, and a window that holds little else
than noise teaches nothing, so that coefficients cannot drift. See decision 27.
"""

from __future__ import annotations

from typing import Any

from swayless.controller.adaptive.information import (
    Coefficients,
    Information,
    Window,
    noise_power,
    sample,
    squared_size,
)
from swayless.controller.adaptive.lattice import Lattice
from swayless.controller.adaptive.settings import AdaptiveSettings

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

ROUGHNESS = 1e-11
"""Power, by energy, of the rounding in a window that was summed up around coefficients that do not fit."""

LEAST_DEAD_ZONE = 1e-6
"""Below it the cubes of a window's energy leave the range of float, and noise is no longer told."""

CONVERGED_WITHIN = 0.01
"""A set that changes by no more in a window has converged."""


def dead_zone_sum(settings: AdaptiveSettings) -> float:
    """Sum of squares, over a window and the three samples of each tick, of vibration in the dead zone."""
    return 3.0 * settings.window_ticks * max(settings.dead_zone_ratio, LEAST_DEAD_ZONE) ** 2


def first_coefficients(settings: AdaptiveSettings) -> Coefficients:
    """1/3 each, on the lattice of the number type."""
    third = settings.number.scalar(1) / 3.0
    return Lattice(settings).rounded(third, third)


class Learner:
    """The coefficients, and all that is known of the vibration.

    Parameters
    ----------
    settings : AdaptiveSettings
        Window, limits, dead zone and number type.
    """

    def __init__(self, settings: AdaptiveSettings) -> None:
        scalar = settings.number.scalar
        self._window_ticks, self._window_samples = settings.window_ticks, scalar(settings.window_ticks)
        self._lattice = Lattice(settings)
        self._dead_zone = scalar(dead_zone_sum(settings))
        self._white_at_first = scalar(WHITE_AT_FIRST)
        self._zero, self._one = scalar(0), scalar(1)
        self.coefficients: Coefficients = first_coefficients(settings)
        self._nothing = Information(*(scalar(0) for _ in range(6)))
        self._drop()
        self._past = self._at_first()
        self._left: Any = self._zero
        self._noise: Any = self._zero
        self._samples: Any = self._zero
        self.has_learned = self.is_converged = self.is_frozen = False
        self.learns_again = self.was_refused = False
        self._follows_a_move = self._is_rough = self._is_trusted = False

    def begin_rest(self) -> None:
        """Take a change of the command: what follows tells what this move leaves.

        A window may go on from rest to rest, as long as it holds beginnings of rests and nothing else. A set
        that has converged by now is not given up on the word of the coming rest alone: somebody may knock.
        """
        if not self._follows_a_move:
            self._drop()
        self._follows_a_move, self._is_trusted = True, self.is_converged

    def interrupt(self) -> None:
        """Take that samples are missing, or that what shapes the moves is another: the window is dropped."""
        self._drop()
        self._follows_a_move = False

    def _drop(self) -> None:
        self._window, self._ticks = Window(self._nothing, self._zero, self._zero, self._zero), 0

    def learn(self, v0: Any, v1: Any, v2: Any, *, in_use: bool) -> None:
        """Take a sample of the free vibration and those of one and two delays ago.

        Parameters
        ----------
        v0, v1, v2 : float or numpy.float32
            Vibration, scaled to order 1.
        in_use : bool
            Whether the coefficients shape the command.
        """
        self._window = self._window.with_sample(*sample(self.coefficients, v0, v1, v2))
        self._ticks += 1
        if self._ticks == self._window_ticks:
            self._judge(self._window.around_means(self._window_samples), in_use)
            self.interrupt()

    def _judge(self, window: Information, in_use: bool) -> None:
        """Learn from a complete window, or find that there is nothing to learn from."""
        plain = self._plain(window)
        energy, noise = plain.energy, noise_power(window, plain)
        teaches = energy > self._dead_zone and energy > (3.0 * NOISE_FACTOR) * noise
        self.is_frozen = not teaches
        if teaches:
            misfits = self._misfits(window.ee, energy, noise)
            self.learns_again = misfits or self._misfits_slowly(window.ee, energy, noise)
            if self.learns_again and self._is_trusted:
                self.is_converged = False  # one rest's word: the next one decides
            else:
                self._teach(window, energy, noise, misfits=misfits)
        elif in_use and self._follows_a_move:
            self.is_converged, self.learns_again, self.was_refused = True, False, False

    def _teach(self, window: Information, energy: Any, noise: Any, *, misfits: bool) -> None:
        """Add a window, its noise taken out, to the past, and take new coefficients from both."""
        weight = self._past_weight(energy, noise, misfits=misfits)
        self._past = window.with_white(self.coefficients, -noise).after(weight, self._past)
        self._adopt()

    def _plain(self, sums: Information) -> Information:
        """Give the sums of products of v1 itself in the place of what the coefficients leave."""
        c0, _, c2 = self.coefficients
        return sums.moved(-c0, -c2)

    def _at_first(self) -> Information:
        """P(0)."""
        return self._nothing.with_white(self.coefficients, self._white_at_first)

    def _past_weight(self, energy: Any, noise: Any, *, misfits: bool) -> Any:
        """How much the past still counts: less if the coefficients do not fit, nothing if they misfit."""
        was_rough, self._is_rough = self._is_rough, misfits or not self.has_learned
        if misfits:
            self._forget_misfit()
            self._past = self._at_first()
        windows = energy if self.learns_again else PAST_WINDOWS * energy
        if was_rough:
            windows = min(windows, noise / ROUGHNESS)
        past = self._plain(self._past).energy
        return windows / past if past > windows else self._one

    def _misfits(self, left: Any, energy: Any, noise: Any) -> bool:
        """Whether coefficients that were learned leave far more of a window than its noise."""
        allowed = MISFIT_RATIO * energy
        most = ((MISFIT_FACTOR * noise) * squared_size(self.coefficients)) + allowed
        return bool(self.has_learned and left > most)

    def _misfits_slowly(self, left: Any, energy: Any, noise: Any) -> bool:
        """Whether recent windows together leave more than noise, by four standard deviations."""
        if not self.has_learned:
            return False
        left = (left - (MISFIT_RATIO * energy)) / squared_size(self.coefficients)
        self._left = (RECENT * self._left) + left
        self._noise = (RECENT * self._noise) + noise
        self._samples = (RECENT * self._samples) + self._window_ticks
        excess = self._left - self._noise
        return bool(
            excess > 0.0 and (excess * excess) * self._samples > SIGNIFICANCE * (self._noise * self._noise)
        )

    def _forget_misfit(self) -> None:
        self._left = self._noise = self._samples = self._zero

    def _adopt(self) -> None:
        """Take new coefficients unless they ask too much of the drive."""
        c0, c1, c2 = self.coefficients
        correction = self._past.correction()
        found = None if correction is None else self._lattice.rounded(c0 + correction[0], c2 + correction[1])
        self.was_refused = found is None or not self._lattice.allows(found)
        if found is None or self.was_refused:
            self.is_converged = False
            return
        d0, d1, d2 = found[0] - c0, found[1] - c1, found[2] - c2
        change = max(abs(d0), abs(d1), abs(d2))
        self.is_converged = bool(self.has_learned and not self.learns_again and change <= CONVERGED_WITHIN)
        self._past = self._past.moved(d0, d2)
        self.coefficients, self.has_learned = found, True
