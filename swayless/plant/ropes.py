"""The mode of every rope of a crane, and the rope of every frequency, whatever drives the trolley.

Not for: what a mode is made of (`pendulum`, `servo_drive`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.errors import PlantError
from swayless.plant.mode import Mode
from swayless.plant.pendulum import pendulum_mode, pendulum_rope_length_m
from swayless.plant.servo_drive import ServoDrive, pole_figures, servo_drive_poles

FloatArray = NDArray[np.float64]

LEAST_LOOP_DAMPING = 0.2
"""A speed loop that vibrates must be damped at least so: what is left falls to a quarter each period."""

_LOOP_TO_SWING = 2.0  # least damping ratio of the loop's vibration over the swing's, to tell the two apart
_SAMPLES = 1025
_BEYOND = 4.0  # how far beyond the range of ropes frequencies may still be turned into ropes
_ROOT_RELATIVE = 1e-14


class Ropes(Protocol):
    """What a rope of any length swings as."""

    def mode(self, rope_length_m: float) -> Mode:
        """Give the mode of a rope, > 0 m."""

    def rope_length_m(self, frequency_hz: float) -> float:
        """Give the rope that has a frequency, > 0 Hz."""


@dataclass(frozen=True)
class FreeRopes:
    """Ropes below a trolley that follows its reference exactly: pendulums.

    Parameters
    ----------
    damping_ratio : float
        0 <= damping_ratio < 1, on every rope.

    Examples
    --------
    >>> round(FreeRopes(0.01).rope_length_m(0.25), 4)
    3.9745
    """

    damping_ratio: float = 0.0

    def mode(self, rope_length_m: float) -> Mode:
        """Give the mode of a rope, > 0 m."""
        return pendulum_mode(rope_length_m, self.damping_ratio)

    def rope_length_m(self, frequency_hz: float) -> float:
        """Give the rope that has a frequency, > 0 Hz."""
        return pendulum_rope_length_m(frequency_hz)


@dataclass(frozen=True)
class DrivenRopes:
    """Ropes below a trolley whose speed loop feels the load: frequency and damping are those of the whole.

    Parameters
    ----------
    drive : ServoDrive
        The trolley, its load and its speed loop.
    range_m : tuple of two floats
        Shortest and longest rope of the crane, > 0.
    damping_ratio : float
        Of the rope itself, below a trolley that stands: 0 <= damping_ratio < 1.

    Raises
    ------
    PlantError
        If the load does not swing as one clear vibration on every rope of the range, whose frequency falls as
        the rope gets longer.

    Examples
    --------
    >>> ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 6000.0, 0.1), (3.0, 6.0))
    >>> mode = ropes.mode(4.0)
    >>> round(mode.frequency_hz, 4), round(mode.damping_ratio, 4)
    (0.2498, 0.0588)
    >>> round(ropes.rope_length_m(mode.frequency_hz), 9)
    4.0
    """

    drive: ServoDrive
    range_m: tuple[float, float]
    damping_ratio: float = 0.0

    def __post_init__(self) -> None:
        lengths_m = np.geomspace(*self.range_m, _SAMPLES)
        frequency_hz, _ = self._clear_modes(lengths_m)
        if self.range_m[0] < self.range_m[1] and not (np.diff(frequency_hz) < 0.0).all():
            at_m = float(lengths_m[1:][np.diff(frequency_hz) >= 0.0][0])
            raise PlantError(
                f"the frequency of trolley, load and speed loop does not fall as the rope gets longer, at"
                f" {at_m:.4g} m: no frequency has one rope; a stiffer speed loop does"
            )

    def modes(self, rope_length_m: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Give frequency in Hz and damping ratio on many ropes; nan where no vibration is clearly the swing.

        Examples
        --------
        >>> ropes = DrivenRopes(ServoDrive.from_lag(2000.0, 6000.0, 0.1), (3.0, 6.0))
        >>> [values.round(4).tolist() for values in ropes.modes([3.0, 6.0])]
        [[0.2886, 0.2038], [0.0679, 0.048]]
        """
        modulus_rad_s, ratio = self._vibrations(rope_length_m)
        clear = ~_unclear(ratio)
        return (
            np.where(clear, modulus_rad_s[..., 0] / (2.0 * math.pi), np.nan),
            np.where(clear, ratio[..., 0], np.nan),
        )

    def mode(self, rope_length_m: float) -> Mode:
        """Give the mode of a rope, > 0 m.

        Raises
        ------
        PlantError
            If nothing vibrates on it.
        """
        frequency_hz, ratio = self._clear_modes(np.array([rope_length_m]))
        return Mode(float(frequency_hz[0]), float(ratio[0]))

    def rope_length_m(self, frequency_hz: float) -> float:
        """Give the rope that has a frequency.

        Solved for the true mode: no pendulum has both its frequency and its rope.

        Raises
        ------
        PlantError
            If it lies farther than four times beyond the ends of the range, or beyond ropes whose frequencies
            fall.
        """
        from scipy.optimize import brentq

        lengths_m, frequencies_hz = self._falling
        at = int(np.searchsorted(-frequencies_hz, -frequency_hz))
        if frequency_hz == frequencies_hz[0]:
            return float(lengths_m[0])
        if not 0 < at < lengths_m.size:
            low, high = frequencies_hz[-1], frequencies_hz[0]
            raise PlantError(
                f"frequency_hz = {frequency_hz!r}: trolley, load and speed loop have a rope for {low:.6g} to"
                f" {high:.6g} Hz"
            )
        return float(
            brentq(
                lambda length_m: float(self.modes(length_m)[0]) - frequency_hz,
                lengths_m[at - 1],
                lengths_m[at],
                xtol=_ROOT_RELATIVE * lengths_m[at],
                rtol=_ROOT_RELATIVE,
            )
        )

    def damping_near(self, frequency_hz: float) -> float:
        """Give the damping ratio at about a frequency, or at the end of the ropes that is nearest to it."""
        lengths_m, frequencies_hz = self._falling
        length_m = np.interp(-frequency_hz, -frequencies_hz, lengths_m)
        return float(self.modes(length_m)[1])

    def frequency_range_hz(self, ropes_m: tuple[float, float]) -> tuple[float, float]:
        """Give lowest and highest frequency over ropes of the range: those of its ends."""
        shortest_m, longest_m = ropes_m
        return self.mode(longest_m).frequency_hz, self.mode(shortest_m).frequency_hz

    def damping_range(self, ropes_m: tuple[float, float]) -> tuple[float, float]:
        """Give lowest and highest damping ratio over ropes, extremes between the ends included.

        Parameters
        ----------
        ropes_m : tuple of two floats
            Shortest and longest, > 0.
        """
        if ropes_m[0] == ropes_m[1]:
            own = self.mode(ropes_m[0]).damping_ratio
            return own, own
        lengths_m = np.geomspace(*ropes_m, _SAMPLES)
        ratio = self._clear_modes(lengths_m)[1]
        return self._extreme(lengths_m, ratio, -1.0), self._extreme(lengths_m, ratio, 1.0)

    @cached_property
    def _falling(self) -> tuple[FloatArray, FloatArray]:
        """Sample the range, and ropes beyond it as far as the frequency falls; give frequencies too."""
        shortest_m, longest_m = self.range_m
        lengths_m = np.geomspace(shortest_m / _BEYOND, longest_m * _BEYOND, _SAMPLES)
        frequency_hz, _ = self.modes(lengths_m)
        broken = np.flatnonzero(~(np.diff(frequency_hz) < 0.0))
        middle = int(np.searchsorted(lengths_m, math.sqrt(shortest_m * longest_m)))
        first = max((int(at) + 1 for at in broken if at < middle), default=0)
        last = min((int(at) for at in broken if at >= middle), default=_SAMPLES - 1)
        return lengths_m[first : last + 1], frequency_hz[first : last + 1]

    def _extreme(self, lengths_m: FloatArray, ratio: FloatArray, sign: float) -> float:
        """Find the largest of sign times the damping ratio over sampled ropes, refined between samples."""
        from scipy.optimize import minimize_scalar

        top = int((sign * ratio).argmax())
        if 0 < top < ratio.size - 1:
            found = minimize_scalar(
                lambda length_m: -sign * float(self.modes(length_m)[1]),
                bounds=(lengths_m[top - 1], lengths_m[top + 1]),
                method="bounded",
                options={"xatol": 1e-8 * lengths_m[top]},
            )
            return sign * max(sign * float(ratio[top]), -float(found.fun))
        return float(ratio[top])

    def _vibrations(self, rope_length_m: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Give angular frequency and damping ratio of both vibrations, the least damped first."""
        return pole_figures(servo_drive_poles(self.drive, rope_length_m, self.damping_ratio))

    def _clear_modes(self, lengths_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the modes of ropes, and refuse those on which none, or more than one, is the swing."""
        modulus_rad_s, ratio = self._vibrations(lengths_m)
        still = np.isnan(ratio[:, 0])
        if still.any():
            raise PlantError(
                f"the speed loop damps the load on {float(lengths_m[still][0]):.4g} m of rope so well that"
                " nothing vibrates; a mode needs a stiffer speed loop"
            )
        unclear = _unclear(ratio)
        if unclear.any():
            at = int(unclear.argmax())
            first_hz, second_hz = modulus_rad_s[at] / (2.0 * math.pi)
            raise PlantError(
                f"trolley, load and speed loop have two vibrations on {float(lengths_m[at]):.4g} m of rope:"
                f" {first_hz:.4g} Hz with damping ratio {ratio[at, 0]:.3g} and {second_hz:.4g} Hz with"
                f" {ratio[at, 1]:.3g}, which must be at least {LEAST_LOOP_DAMPING:g} and"
                f" {_LOOP_TO_SWING:g} times the first; a longer integral time does"
            )
        return modulus_rad_s[:, 0] / (2.0 * math.pi), ratio[:, 0]


def _unclear(ratio: FloatArray) -> NDArray[np.bool_]:
    """Tell where nothing vibrates, or a loop so little damped that it is no less a swing than the load."""
    swing, loop = ratio[..., 0], ratio[..., 1]
    return np.asarray(np.isnan(swing) | (loop < LEAST_LOOP_DAMPING) | (loop < _LOOP_TO_SWING * swing))
