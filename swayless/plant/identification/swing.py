"""Frequency and damping of a measured free swing, with their uncertainty and what the record cannot show.

Maximum likelihood for decaying modes, offset and drift in noise; the swing of a load on a rope is slower
the farther it goes, and is corrected for that.

Not for: peak heights (`peaks`), stopwatches (`stopwatch`), or several ropes at once (`rope_offset`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swayless.errors import PlantError
from swayless.plant.identification.decision import DECISIVE, Hypothesis, decided, log_likelihood
from swayless.plant.identification.falling import FallingFit
from swayless.plant.identification.fitting import Fit, fit
from swayless.plant.identification.identified_mode import IdentifiedMode
from swayless.plant.identification.noise import Noise, noise_near
from swayless.plant.identification.order import are_told_apart, single_mode, turns_apart
from swayless.plant.identification.pendulum_swing import cut_off, first_angle_rad
from swayless.plant.identification.record import FloatArray, SwingRecord
from swayless.plant.identification.swing_model import DECAY, FREQUENCY, PER_MODE

MOST_MODES = 2

LARGEST_DAMPING = 0.5
"""What decays faster is no swing that a shaper could be designed for."""

_SAME_FREQUENCY_TURNS = 0.15
"""Modes that part by less over the record look like one whose decay is not exponential."""

_OTHER_MODEL = 0.75
"""Standard deviation for a model that may be the true one, in its distance: two of them cover it well."""

_GROWTH_STD, _LEAST_GROWTH = 4.0, 0.02
"""A swing that grows by so many standard deviations, and so much over the record, is not free."""

_NUMERICAL = 1e-10
"""What the search leaves of the phase over the whole record, in rad."""

_SECOND_MODE_FLOOR = 30.0
"""Square of a second mode's amplitude, over variance / (n / 2), at which the tests of `order` find it."""


@dataclass(frozen=True, eq=False)
class IdentifiedSwing:
    """What a record of a free swing tells.

    Parameters
    ----------
    record : SwingRecord
    fit : Fit
        The model with its parameters.
    modes : tuple of IdentifiedMode
        One or two, the one of the larger amplitude first.
    noise : Noise
        Near the first mode.
    is_exponential : bool
        False if the swing decays in another way: the damping ratio is then an average over the record.
    is_decided : bool
        False if it may be that of a load on a rope or a linear one, as far as the record shows; the
        uncertainty then covers both.
    may_be_two_modes : bool
        True if two modes explain as much as friction or air drag; the uncertainty then covers them.
    """

    record: SwingRecord
    fit: Fit
    modes: tuple[IdentifiedMode, ...]
    noise: Noise
    is_exponential: bool = True
    is_decided: bool = True
    may_be_two_modes: bool = False

    @property
    def swings(self) -> float:
        """How many swings of the first mode the record holds."""
        return self.record.duration_s / self.modes[0].mode.damped_period_s

    @property
    def slowed_ratio(self) -> float:
        """How much slower the first swing is for its size, relative to a small one; 0 for a linear mode."""
        return first_angle_rad(self.fit) ** 2 / 16.0

    @property
    def second_mode_floor(self) -> float:
        """Amplitude below which a second mode would not have been seen, in the unit of the record."""
        return self.noise.rms * float(np.sqrt(2.0 * _SECOND_MODE_FLOOR / self.record.time_s.size))

    @property
    def drift(self) -> float:
        """How far the middle of the swing moved over the record, in its unit."""
        return float(np.ptp(self.middle(self.record.time_s)))

    def middle(self, time_s: FloatArray) -> FloatArray:
        """Give the middle of the swing, offset and drift, at times of the record's clock."""
        model = self.fit.model.at(time_s - self.record.time_s[0])
        return np.asarray(model.drift @ self.fit.parameters[PER_MODE * model.modes :])


def identify_swing(
    record: SwingRecord, *, pendulum: bool | None = None, modes: int | None = None
) -> IdentifiedSwing:
    """Find the modes of a free swing.

    Parameters
    ----------
    record : SwingRecord
        At least one swing.
    pendulum : bool or None
        Whether it is a load on a rope, whose large swings are slower. None takes an angle for one, unless it
        turns faster than any rope or the record says that its frequency stays, and anything else for the
        likelier; what the record leaves open widens the uncertainty.
    modes : int or None
        1 or 2; None takes as many as the record shows.

    Raises
    ------
    PlantError
        If the record shows no swing, or two modes that it does not tell apart.

    References
    ----------
    S. Kay, *Fundamentals of Statistical Signal Processing: Estimation Theory* (1993), sections 7.8 (least
    squares as maximum likelihood) and 3.4 (Cramer-Rao).

    Examples
    --------
    >>> time_s = np.linspace(0.0, 60.0, 1201)
    >>> noise = np.random.default_rng(1).normal(size=time_s.size)
    >>> swing = 0.1 * np.exp(-0.01 * time_s) * np.cos(1.5 * time_s) + 0.005 * noise
    >>> mode = identify_swing(SwingRecord(time_s, swing)).modes[0]
    >>> abs(mode.frequency_hz - 1.5 / (2.0 * np.pi)) < 2.0 * mode.frequency_hz_std < 1e-4
    True
    """
    _check(record, pendulum, modes)
    time_s = record.time_s - record.time_s[0]
    taken, others = decided(single_mode(time_s, record.value), record, pendulum=pendulum, modes=modes)
    single, double = taken.single, taken.double
    if taken.falling is not None:
        found = _falling(record, taken, taken.falling)
    elif double is None or are_told_apart(double):
        found = _identified(record, taken.fit)
    elif modes is None and turns_apart(double) < _SAME_FREQUENCY_TURNS:
        found = _identified(record, single, mixture=_modes(double))
    else:
        raise PlantError(_not_told_apart(double, record))
    if not others:
        return found
    kinds = {each.fit.model.waveform is None for each in (taken, *others)}
    return _covering_all(found, [_modes(other.fit) for other in others], decided=len(kinds) == 1)


def _check(record: SwingRecord, pendulum: bool | None, modes: int | None) -> None:
    """Refuse what cannot be asked of a record."""
    if pendulum and record.quantity == "value":
        raise PlantError("a load on a rope is corrected for large swings: say what unit the record is in")
    if modes not in {None, *range(1, MOST_MODES + 1)}:
        raise PlantError(f"modes = {modes!r}: must be 1 or 2")
    if modes == MOST_MODES and record.time_s.size <= PER_MODE * MOST_MODES + 4:
        raise PlantError(f"{record.time_s.size} samples are too few for two modes")


def _not_told_apart(double: Fit, record: SwingRecord) -> str:
    low, high = sorted(float(double.mode(index)[FREQUENCY]) / (2.0 * np.pi) for index in range(2))
    return (
        f"the record shows more than one mode, near {low:.5g} and {high:.5g} Hz, and does not tell"
        f" them apart in {record.duration_s:.4g} s: record for longer, or fit one mode (--modes 1)"
    )


def _falling(record: SwingRecord, taken: Hypothesis, falling: FallingFit) -> IdentifiedSwing:
    """Give a swing that friction or drag ends; two modes that explain it nearly as well are covered."""
    found = replace(_identified(record, falling), is_exponential=False)
    frequency_rad_s = float(falling.mode(0)[FREQUENCY])
    average, spread = (each / frequency_rad_s for each in falling.average_decay())
    single, mode = _modes(taken.single)[0], replace(found.modes[0], damping_ratio=average)
    # Two standard deviations of the damping reach as far as it strays; averaging leaves its square.
    mode = replace(mode, damping_ratio_std=float(np.hypot(0.5 * spread, single.damping_ratio_std or 0.0)))
    mode = _with_spread(mode, average**2 * mode.frequency_hz, 0.0)
    if taken.double is None or log_likelihood(taken.double) < log_likelihood(falling) - DECISIVE:
        return replace(found, modes=(mode,))
    covering = _widened(mode, _modes(taken.double))
    return replace(found, modes=(covering,), may_be_two_modes=True)


def _identified(
    record: SwingRecord, found: Fit, *, mixture: tuple[IdentifiedMode, ...] = ()
) -> IdentifiedSwing:
    """Give what a fit says; a mixture of modes that fits better, at one frequency, widens the uncertainty."""
    modes = _modes(found)
    if mixture:
        modes = (_widened(modes[0], mixture),)
    swinging = [index for index, mode in enumerate(modes) if _swings(mode, record)]
    if not swinging:
        raise PlantError(_no_swing(modes[0], record))
    swinging.sort(key=lambda index: -found.amplitude(index))
    by_amplitude = tuple(modes[index] for index in swinging)
    _refuse_growth(found, swinging)
    bounded = _bounded(found)
    return IdentifiedSwing(record, bounded, by_amplitude, noise_near(bounded, swinging[0]), not mixture)


def _refuse_growth(found: Fit, indices: list[int]) -> None:
    """Refuse a swing that grows beyond what noise may feign: it is not free."""
    end_s, covariance = found.model.duration_s, found.covariance()
    for index in indices:
        frequency_rad_s, decay_rad_s = found.mode(index)[[FREQUENCY, DECAY]]
        variance = covariance[PER_MODE * index + DECAY, PER_MODE * index + DECAY]
        std_rad_s = noise_near(found, index).scale * float(np.sqrt(variance))
        if -decay_rad_s > max(_GROWTH_STD * std_rad_s, _LEAST_GROWTH / end_s):
            raise PlantError(
                f"the swing of {frequency_rad_s / (2.0 * np.pi):.5g} Hz grows by"
                f" {100.0 * np.expm1(-decay_rad_s * end_s):.3g} % in {end_s:.4g} s, which no free swing does:"
                " is it driven, or a part of the beat of two modes?"
            )


def _covering_all(
    found: IdentifiedSwing, others: list[tuple[IdentifiedMode, ...]], *, decided: bool
) -> IdentifiedSwing:
    """Widen the uncertainty of each mode until it covers what other models say as well."""
    return replace(found, modes=tuple(_covering(mode, others) for mode in found.modes), is_decided=decided)


def _covering(mode: IdentifiedMode, others: list[tuple[IdentifiedMode, ...]]) -> IdentifiedMode:
    """Cover the nearest mode of each of the other models."""
    near = [min(modes, key=lambda each: abs(each.frequency_hz - mode.frequency_hz)) for modes in others]
    return _widened(mode, tuple(near), deviations=0.0)


def _no_swing(mode: IdentifiedMode, record: SwingRecord) -> str:
    if (mode.damping_ratio or 0.0) > LARGEST_DAMPING:
        return (
            f"the record dies away within a swing, damping ratio {mode.damping_ratio:.2g}: must be at most"
            f" {LARGEST_DAMPING:g} for a free swing"
        )
    return (
        f"the record holds {mode.frequency_hz * record.duration_s:.2f} swings in {record.duration_s:.4g} s:"
        " at least one is needed, and three or more to be exact"
    )


def _swings(mode: IdentifiedMode, record: SwingRecord) -> bool:
    """Whether a mode is a swing: what is slower than the record or dies at once is drift."""
    return mode.frequency_hz * record.duration_s >= 1.0 and (mode.damping_ratio or 0.0) <= LARGEST_DAMPING


def _widened(
    mode: IdentifiedMode, mixture: tuple[IdentifiedMode, ...], *, deviations: float = 1.0
) -> IdentifiedMode:
    """Add to the uncertainty of one mode how far those lie, or may, that may stand in its place."""
    away_hz = max(
        abs(each.frequency_hz - mode.frequency_hz) + deviations * each.frequency_hz_std for each in mixture
    )
    ratio = max(abs((each.damping_ratio or 0.0) - (mode.damping_ratio or 0.0)) for each in mixture)
    return _with_spread(mode, _OTHER_MODEL * away_hz, _OTHER_MODEL * ratio)


def _with_spread(mode: IdentifiedMode, frequency_hz: float, damping_ratio: float) -> IdentifiedMode:
    """Add to the standard deviations of a mode, as independent errors add up."""
    return replace(
        mode,
        frequency_hz_std=float(np.hypot(mode.frequency_hz_std, frequency_hz)),
        damping_ratio_std=float(np.hypot(mode.damping_ratio_std or 0.0, damping_ratio)),
    )


def _bounded(found: Fit) -> Fit:
    """Hold damping at 0 where it came out below."""
    decays = [PER_MODE * index + DECAY for index in range(found.model.modes)]
    growing = tuple(index for index in decays if found.parameters[index] < 0.0)
    if not growing:
        return found
    bounded = found.parameters.copy()
    bounded[list(growing)] = 0.0
    return fit(found.model, bounded, held=growing)


def _modes(found: Fit) -> tuple[IdentifiedMode, ...]:
    """Turn a fit into modes; what is uncertain is so as if damping could be below 0."""
    covariance, bounded = found.covariance(), _bounded(found)
    return tuple(
        _mode(bounded, index, noise_near(bounded, index).scale ** 2 * covariance)
        for index in range(found.model.modes)
    )


def _mode(found: Fit, index: int, covariance: FloatArray) -> IdentifiedMode:
    """Turn a damped frequency and a decay, in rad/s, into the undamped frequency and the damping ratio."""
    damped, decay = (float(found.mode(index)[which]) for which in (FREQUENCY, DECAY))
    undamped = float(np.hypot(damped, decay))
    cosine, sine = damped / undamped, decay / undamped
    turn = np.array([[cosine, sine], [-cosine * sine / undamped, cosine**2 / undamped]])
    columns = [PER_MODE * index + which for which in (FREQUENCY, DECAY)]
    numerical = (_NUMERICAL / found.model.duration_s) ** 2 * np.eye(2)
    spread = turn @ (covariance[np.ix_(columns, columns)] + numerical) @ turn.T
    cut_frequency, cut_ratio = cut_off(found, decay / undamped) if index == 0 else (0.0, 0.0)
    return IdentifiedMode(
        frequency_hz=undamped / (2.0 * np.pi),
        damping_ratio=max(0.0, decay / undamped),
        frequency_hz_std=float(np.hypot(np.sqrt(spread[0, 0]), undamped * cut_frequency)) / (2.0 * np.pi),
        damping_ratio_std=float(np.hypot(np.sqrt(spread[1, 1]), cut_ratio)),
        amplitude=found.amplitude(index),
    )


def fitted_values(found: IdentifiedSwing, time_s: FloatArray) -> FloatArray:
    """Give the fitted swing at other times within the record, in its unit.

    Parameters
    ----------
    found : IdentifiedSwing
    time_s : ndarray
        On the clock of the record.
    """
    return found.fit.values(time_s - found.record.time_s[0])
