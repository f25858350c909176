"""What the residual of a fit says of the noise, and so of the uncertainty of what was fitted.

White noise gives every frequency the same power, and the covariance is its variance times the inverse of
Fisher's information. Drift and wind give more power where the swing is; the variance that counts is then
the one there (Whittle's approximation), told by the residual near the mode's frequency.

Not for: fitting.

References
----------
P. Whittle, "Estimation and information in stationary time series", *Arkiv foer Matematik* 2 (1953), 423-434.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from swayless.plant.identification.fitting import Fit
from swayless.plant.identification.start import fast_length, on_grid
from swayless.plant.identification.sums import sum_of_squares
from swayless.plant.identification.swing_model import DECAY, FREQUENCY, PER_MODE

_COLOUR_SIGNIFICANCE = 0.01
_FEWEST_BINS = 4
_NEARBY = 0.25
_TWO_STD = 0.9772498680518208
"""Part of a normal distribution below two standard deviations."""

_PARTS, _FEWEST_PER_PART = 8, 10
_LOUD, _LOUD_CHANCE = 4.0, 1e-4
_AUDIBLE = 1e-6
"""Part of the amplitude below which nobody cares what is left."""

_ROUNDING = 1e-15
"""Of the largest value: what arithmetic in double leaves of a record without noise."""


@dataclass(frozen=True)
class Noise:
    """Noise of a record near one mode.

    Parameters
    ----------
    rms : float
        Of the whole residual, in the unit of the record.
    local_rms : float
        Of white noise with the power that the noise has near the mode; `rms` unless there is more.
    freedom : float
        Degrees of freedom from which `local_rms` is known.
    chance : float
        Chance of so much noise near the mode, were it white.
    """

    rms: float
    local_rms: float
    freedom: float
    chance: float = 1.0

    @property
    def is_coloured(self) -> bool:
        """Whether there is more noise near the mode than elsewhere."""
        return self.local_rms > self.rms

    @property
    def scale(self) -> float:
        """Factor from standard deviations for noise of 1 to those stated."""
        return self.local_rms * student_ratio(self.freedom)


def student_ratio(freedom: float) -> float:
    """Give the factor by which a standard deviation grows that was itself told from the data.

    Twice the standard deviation stated then covers 95.45 %, as twice a known one does.

    Parameters
    ----------
    freedom : float
        Degrees of freedom, > 0.

    Examples
    --------
    >>> round(student_ratio(2.0), 3), round(student_ratio(1000.0), 3)
    (2.263, 1.001)
    """
    from scipy.special import stdtrit

    return float(stdtrit(freedom, _TWO_STD)) / 2.0


def noise_near(fit: Fit, index: int) -> Noise:
    """Tell the noise of a fit near one of its modes.

    Parameters
    ----------
    fit : Fit
        With at least one degree of freedom.
    index : int
        Number of the mode, from 0.
    """
    floor = _ROUNDING * float(np.max(np.abs(fit.parameters)))
    rms = max(float(np.sqrt(fit.variance)), floor)
    power, count = _power_nearby(fit, index)
    freedom = 2 * count - PER_MODE
    if freedom < 2 or fit.freedom - freedom < 2 or rms == floor:
        return Noise(rms, rms, fit.freedom)
    local_rms = float(np.sqrt(2.0 * power / (freedom * fit.residual.size)))
    from scipy.special import fdtrc

    # Both variances come from the same residual; what is not near the mode is the other one.
    elsewhere = max(fit.squares - freedom * local_rms**2, floor**2) / (fit.freedom - freedom)
    chance = float(fdtrc(freedom, fit.freedom - freedom, local_rms**2 / elsewhere))
    if chance > _COLOUR_SIGNIFICANCE or local_rms <= rms:
        return Noise(rms, rms, fit.freedom, chance)
    return Noise(rms, local_rms, freedom, chance)


class LoudPart(NamedTuple):
    """Part of a record in which the fit leaves more than elsewhere: from when to when, and how much more."""

    start_s: float
    end_s: float
    ratio: float


def loud_part(fit: Fit) -> LoudPart | None:
    """Find the eighth of a record that the model fits worst, if it does so beyond chance.

    A crane that still moves, a knock or a gust: in such a part the swing is not free.

    Parameters
    ----------
    fit : Fit
        Times count from the first sample.

    Examples
    --------
    >>> from swayless.plant.identification.order import single_mode
    >>> time_s = np.linspace(0.0, 40.0, 801)
    >>> knock = np.where(time_s < 5.0, 0.1 * time_s, 0.0)
    >>> loud_part(single_mode(time_s, np.cos(2.0 * time_s) + knock)).end_s
    5.0
    """
    from scipy.special import fdtrc

    parts = np.array_split(fit.residual, _PARTS)
    if fit.residual.size < _PARTS * _FEWEST_PER_PART or fit.variance < (_AUDIBLE * fit.amplitude(0)) ** 2:
        return None
    power = np.array([sum_of_squares(part) / part.size for part in parts])
    worst = int(np.argmax(power))
    ratio = float(power[worst] / max(np.delete(power, worst).mean(), _AUDIBLE**2 * power[worst]))
    count = parts[worst].size
    if ratio < _LOUD or _PARTS * float(fdtrc(count, fit.residual.size - count, ratio)) > _LOUD_CHANCE:
        return None
    first = sum(part.size for part in parts[:worst])
    time_s = fit.model.time_s
    return LoudPart(float(time_s[first]), float(time_s[first + count - 1]), float(np.sqrt(ratio)))


def _power_nearby(fit: Fit, index: int) -> tuple[float, int]:
    """Sum the periodogram of the residual around a mode; give how many frequencies that were."""
    grid = on_grid(fit.model.time_s, fit.residual)
    size = fast_length(grid.value.size)
    power = np.abs(np.fft.rfft(grid.value, size)) ** 2
    bin_rad_s = 2.0 * np.pi / (size * grid.cell_s)
    last = min(power.size - 1, int(grid.highest_rad_s / bin_rad_s))
    mode = fit.mode(index)
    centre = mode[FREQUENCY] / bin_rad_s
    half = max(_FEWEST_BINS, _NEARBY * centre, 2.0 * abs(mode[DECAY]) / bin_rad_s)
    low, high = max(1, int(np.ceil(centre - half))), min(last, int(centre + half))
    return float(power[low : high + 1].sum()), high - low + 1
