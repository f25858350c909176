"""How much a record shows: a swing at all, a bent drift, a second mode. Variances compared, with F tests.

Not for: the numbers of what is shown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from swayless.errors import PlantError
from swayless.plant.identification.fitting import Fit, best_fit, fit, with_drift, with_parameters
from swayless.plant.identification.noise import noise_near
from swayless.plant.identification.record import FloatArray
from swayless.plant.identification.samples import Samples
from swayless.plant.identification.start import starts
from swayless.plant.identification.sums import inner_products, sum_of_squares
from swayless.plant.identification.swing_model import DECAY, FREQUENCY, PER_MODE, SwingModel

CHANCE = 1e-4
"""Chance at which noise alone may look like a mode or a drift."""

CHANCE_OF_A_SWING = 0.01
"""Chance at which noise alone may look like the swing that somebody recorded."""

_STARTS = 4
_WORTH_A_FIT = 0.5
"""Starts with less than this part of the best one's energy cannot win."""

_WORTH_A_LOOK = 0.05
"""Chance of a peak of the residual in noise, above which no second mode is tried."""

_WORTH_A_TRY = 0.1
"""Chance of the noise near the mode, above which no second mode is tried beside it."""

_BESIDE_TURNS = 1.5
"""Modes that part by less over the record are beside each other."""

_ENVELOPE_TURNS = 4.0
"""Modes that part by more over the record make a swing rise and fall, which friction does not."""

_BENT_DRIFT = 3
_SWINGS_FOR_BENT_DRIFT = 3.0
_SMALLEST_REST = 1e-3
"""What is left of a swing, in rms, below which nobody asks for a second mode: no design holds so much."""

_TOLD_APART_TURNS, _TOLD_APART_STD = 0.1, 4.0


def single_mode(time_s: FloatArray, value: FloatArray) -> Fit:
    """Fit one mode with offset and drift.

    Parameters
    ----------
    time_s : ndarray, shape (n,)
        From 0 on.
    value : ndarray, shape (n,)

    Raises
    ------
    PlantError
        If the record shows no swing, or less than one.
    """
    model = SwingModel(Samples.of_record(time_s, value))
    drift, _ = np.linalg.qr(model.drift)
    level = value - drift @ inner_products(drift, value)
    if float(np.max(np.abs(level))) <= 1e-12 * float(np.max(np.abs(value)) or 1.0):
        raise PlantError("the record shows no swing: its values lie on a straight line")
    best = _best(model, level)
    if best is None:
        raise PlantError(
            "the record shows no swing: it lasts for less than one, or has too few samples of it"
        )
    if (
        chance_of(sum_of_squares(level) - best.squares, best, frequencies=_frequencies(best))
        > CHANCE_OF_A_SWING
    ):
        raise PlantError("the record shows no swing: nothing stands out of the noise")
    swings = best.mode(0)[FREQUENCY] * time_s[-1] / (2.0 * np.pi)
    return _with_bent_drift(best) if swings >= _SWINGS_FOR_BENT_DRIFT else best


def _best(model: SwingModel, level: FloatArray) -> Fit | None:
    found = starts(model.time_s, level, _STARTS)
    worth = [start for start in found if start.energy >= _WORTH_A_FIT * found[0].energy]
    return best_fit(model, (with_parameters(model, start[:2]) for start in worth))


def _frequencies(fit_: Fit) -> float:
    """Count the frequencies that a search looks at: the chance that one of them stands out grows with it."""
    model = fit_.model
    return max(1.0, model.samples.highest_rad_s * model.duration_s / (2.0 * np.pi))


def chance_of(gained: float, better: Fit, *, frequencies: float = 1.0, excess: float = 1.0) -> float:
    """Give the chance that noise alone lets a larger model explain so much more.

    Parameters
    ----------
    gained : float
        By how much its sum of squares is smaller.
    better : Fit
        The larger model.
    frequencies : float
        How many places were searched.
    excess : float
        Power of the noise where the larger model found something, relative to elsewhere.
    """
    from scipy.special import fdtrc

    if better.squares <= 0.0:
        return 0.0
    ratio = max(0.0, gained) / PER_MODE / (better.variance * excess)
    return min(1.0, frequencies * float(fdtrc(PER_MODE, better.freedom, ratio)))


def _with_bent_drift(straight: Fit) -> Fit:
    """Let the drift bend, if the record says that it does."""
    model, start = with_drift(straight, _BENT_DRIFT)
    basis, _ = np.linalg.qr(model.drift)
    explained = inner_products(basis, straight.residual)
    enough = model.time_s.size > model.parameter_count + 2
    if not enough or chance_of(sum_of_squares(explained), straight) > _WORTH_A_LOOK:
        return straight
    bent = fit(model, start)
    return bent if chance_of(straight.squares - bent.squares, bent) < CHANCE else straight


def second_mode(single: Fit, *, certain: bool = False) -> Fit | None:
    """Fit one mode more, if the record shows it.

    Parameters
    ----------
    single : Fit
        One mode.
    certain : bool
        Whether there is one, whatever the record says.

    Returns
    -------
    Fit or None
        Two modes, the first as before; None if noise alone may look like that.
    """
    model = replace(single.model, modes=2)
    if model.time_s.size <= model.parameter_count + 2 or not (certain or _leaves_a_rest(single)):
        return None
    best = _best_second(model, single, _where_something_is_left(single, certain=certain))
    seen = best or single
    modes = range(seen.model.modes)
    if certain or any(noise_near(seen, index).chance < _WORTH_A_TRY for index in modes):
        beside = _best_second(model, single, _beside(single))
        best = beside if best is None or (beside and beside.squares < best.squares) else best
    if best is None or certain:
        return best
    noise = noise_near(best, 1)
    excess = (noise.local_rms / noise.rms) ** 2
    # A mode beside the first was not searched for all over the spectrum.
    looks = 1.0 if turns_apart(best) < _BESIDE_TURNS else _frequencies(best)
    chance = chance_of(single.squares - best.squares, best, frequencies=looks, excess=excess)
    return best if chance < CHANCE else None


def _best_second(model: SwingModel, single: Fit, seconds: Sequence[tuple[float, float]]) -> Fit | None:
    """Fit a second mode from some frequencies and decays."""
    first, drift = single.mode(0), single.parameters[PER_MODE:]
    return best_fit(model, (np.concatenate([first, [*second, 0.0, 0.0], drift]) for second in seconds))


def _where_something_is_left(single: Fit, *, certain: bool) -> list[tuple[float, float]]:
    """Find the peaks of the residual that are no chance."""
    # The energy of a wave in white noise is exponentially distributed; 3: decays that are independent.
    looks = 3.0 * _frequencies(single)
    found = starts(single.model.time_s, single.residual, 2)
    return [
        (start.frequency_rad_s, start.decay_rad_s)
        for start in found
        if start.energy >= _WORTH_A_FIT * found[0].energy
        and (certain or looks * np.exp(-start.energy / single.variance) < _WORTH_A_LOOK)
    ]


def _beside(single: Fit) -> list[tuple[float, float]]:
    """Look half a turn over the record to either side of a mode, where peaks are none of their own."""
    frequency, decay = (float(single.mode(0)[which]) for which in (FREQUENCY, DECAY))
    apart = np.pi / single.model.duration_s
    return [(frequency - apart, decay), (frequency + apart, decay)]


def _leaves_a_rest(single: Fit) -> bool:
    """Whether a mode leaves enough of the record to matter."""
    drift = single.model.drift @ single.parameters[PER_MODE:]
    swing = single.model.samples.value - single.residual - drift
    return single.squares > _SMALLEST_REST**2 * sum_of_squares(swing)


def turns_apart(two: Fit) -> float:
    """Count the turns that two modes go apart over the record: beats, or parts of one."""
    difference = two.mode(1)[FREQUENCY] - two.mode(0)[FREQUENCY]
    return float(abs(difference) * two.model.duration_s / (2.0 * np.pi))


def may_be_an_envelope(two: Fit) -> bool:
    """Whether two modes are so close that one of them may only change the envelope of the other."""
    return turns_apart(two) < _ENVELOPE_TURNS


def are_told_apart(two: Fit) -> bool:
    """Whether the frequencies of two modes differ by more than the record leaves open."""
    frequencies = [FREQUENCY, PER_MODE + FREQUENCY]
    covariance = two.covariance()[np.ix_(frequencies, frequencies)]
    spread = float(np.sqrt(max(0.0, np.array([1.0, -1.0]) @ covariance @ np.array([1.0, -1.0]))))
    difference = abs(float(two.mode(1)[FREQUENCY] - two.mode(0)[FREQUENCY]))
    noise = max(noise_near(two, index).scale for index in range(2))
    return difference > _TOLD_APART_STD * noise * spread and turns_apart(two) > _TOLD_APART_TURNS
