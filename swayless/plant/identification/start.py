"""Where to start a fit: matched filters for decaying waves, by one fast Fourier transform for each decay.

The likelihood of one decaying wave in white noise is, up to its overlap with its mirror image, the energy of
the record seen through that wave. So the peaks of that energy over frequency and decay are the starts.

Not for: the estimate itself.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from swayless.plant.identification.record import FloatArray

FEWEST_SWINGS = 1.0
"""Slower waves than one over the record cannot be told from offset and drift."""

_DECAYS = (0.0, *(4.0**power for power in range(6)))
"""Decay over the record, in the exponent: a wave between two of them keeps 8 / 9 of its energy at least."""

_LARGEST_DECAY_RATIO = 0.6
"""Of the frequency: a damping ratio of 0.5. What decays faster is no swing."""

_MOST_CELLS = 2**19
_EVEN = 0.02
_FINER = 2
_PEAKS_PER_DECAY = 4


class Start(NamedTuple):
    """Where to start: a frequency, a decay, and the energy that the wave explains."""

    frequency_rad_s: float
    decay_rad_s: float
    energy: float


class Grid(NamedTuple):
    """A record on even cells: the sum of the samples in each, and how many they are."""

    value: FloatArray
    samples: FloatArray
    cell_s: float
    highest_rad_s: float


def on_grid(time_s: FloatArray, value: FloatArray) -> Grid:
    """Put a record into even cells: its own where it is even with gaps, finer ones where it is not.

    Parameters
    ----------
    time_s : ndarray, shape (n,)
        From 0 on, rising.
    value : ndarray, shape (n,)
        Without offset and drift.
    """
    interval_s = float(np.median(np.diff(time_s)))
    steps = time_s / interval_s
    even = np.max(np.abs(steps - np.round(steps))) < _EVEN
    cell_s = max(interval_s / (1 if even else _FINER), time_s[-1] / _MOST_CELLS)
    cells = np.round(time_s / cell_s).astype(np.int64)
    sums, counts = (np.bincount(cells, weights=each).astype(np.float64) for each in (value, None))
    return Grid(sums, counts, cell_s, np.pi / interval_s)


def starts(time_s: FloatArray, value: FloatArray, count: int) -> list[Start]:
    """Find the waves that explain most of a record each, the best first.

    Parameters
    ----------
    time_s : ndarray, shape (n,)
        From 0 on, rising.
    value : ndarray, shape (n,)
        Without offset and drift.
    count : int
        How many at most; of a peak in frequency only the best decay counts.

    Examples
    --------
    >>> time_s = np.linspace(0.0, 50.0, 1001)
    >>> found = starts(time_s, np.exp(-0.02 * time_s) * np.cos(3.0 * time_s), 1)[0]
    >>> round(found.frequency_rad_s, 1), found.decay_rad_s
    (3.0, 0.02)
    """
    grid = on_grid(time_s, value)
    size = fast_length(2 * grid.value.size)
    frequency = 2.0 * np.pi / (size * grid.cell_s) * np.arange(size // 2 + 1)
    cells_s = grid.cell_s * np.arange(grid.value.size)
    lowest = 2.0 * np.pi * FEWEST_SWINGS / time_s[-1]
    found: list[Start] = []
    for times in _DECAYS:
        decay = times / float(time_s[-1])
        window = np.exp(-decay * cells_s)
        # White noise has the energy of one sample then, wherever samples are missing or share a cell.
        noise = float(np.einsum("i,i,i", grid.samples, window, window))
        energy = np.abs(np.fft.rfft(grid.value * window, size)) ** 2 / noise
        energy[(frequency < max(lowest, decay / _LARGEST_DECAY_RATIO)) | (frequency > grid.highest_rad_s)] = 0
        found += [Start(float(frequency[peak]), decay, float(energy[peak])) for peak in _peaks(energy)]
    return _apart(found, 2.0 * np.pi / time_s[-1])[:count]


def fast_length(least: int) -> int:
    """Give the length from `least` on that a fast Fourier transform likes."""
    from scipy.fft import next_fast_len

    return int(next_fast_len(least, real=True))


def _peaks(energy: FloatArray) -> list[int]:
    """Find the highest local maxima, borders included."""
    padded = np.concatenate([[0.0], energy, [0.0]])
    maxima = np.flatnonzero((energy > padded[:-2]) & (energy >= padded[2:]))
    return [int(peak) for peak in maxima[np.argsort(energy[maxima])[::-1][:_PEAKS_PER_DECAY]]]


def _apart(found: list[Start], resolution_rad_s: float) -> list[Start]:
    """Keep the best start of each frequency, with the other decays behind."""
    kept: list[Start] = []
    for start in sorted(found, key=lambda start: -start.energy):
        width = max(resolution_rad_s, start.decay_rad_s)
        if all(abs(start.frequency_rad_s - other.frequency_rad_s) > width for other in kept):
            kept.append(start)
    return kept
