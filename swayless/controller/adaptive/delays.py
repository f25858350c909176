"""Which delays between three impulses suit a vibration that is known. Not for: unknown ones."""

from __future__ import annotations

import math

from swayless.design.families.closed_form import delay_filter
from swayless.errors import ControllerError
from swayless.plant.mode import Mode

LARGEST_COSINE = 0.95
"""Beyond this |cos(w Td)| the three samples that the shaper learns from hardly differ, or only in sign."""

_ROUNDING = 1e-9
_HALVINGS = 60


def check_delay(delay_ticks: int, tick_s: float, mode: Mode, peak_factor: float) -> None:
    """Refuse a delay with which a vibration cannot be learned.

    Parameters
    ----------
    delay_ticks : int
        From one impulse to the next, 1 or more.
    tick_s : float
        Length of a tick, > 0.
    mode : Mode
        The vibration.
    peak_factor : float
        Largest sum of absolute amplitudes that the drive can follow, 1 or more.

    Raises
    ------
    ControllerError
        If the absolute cosine of the phase that passes in a delay is above 0.95, or the amplitudes ask for
        more than the drive can follow.

    References
    ----------
    S. Rhim, W. J. Book, Adaptive command shaping using adaptive filter approach in time domain, eq 4.

    Examples
    --------
    >>> check_delay(25, 0.001, Mode(16.0), 1.0)
    >>> check_delay(10, 0.001, Mode(16.0), 1.0)
    Traceback (most recent call last):
        ...
    swayless.errors.ControllerError: delay = 0.01 s: has amplitudes of 1.0772, -1.1544 and 1.0772 for the \
vibration of 16 Hz, which take max_reference = 3.3087 times max_command; with max_reference = 1 times \
max_command delays such as 0.016 to 0.028 s can be learned
    """
    what, delay_s = f"the vibration of {mode.frequency_hz:.6g} Hz", delay_ticks * tick_s
    instead = f"with max_reference = {peak_factor:.5g} times max_command {_others(tick_s, mode, peak_factor)}"
    cosine = abs(math.cos(2.0 * math.pi * delay_s / mode.damped_period_s))
    if cosine > LARGEST_COSINE:
        raise ControllerError(
            f"delay = {delay_s:.6g} s: |cos(w Td)| = {cosine:.5g} of {what}: must be at most "
            f"{LARGEST_COSINE}; {instead}"
        )
    first, middle, last = delay_filter(mode, delay_s=delay_s)[1]
    asked = abs(first) + abs(middle) + abs(last)
    if asked > peak_factor * (1.0 + _ROUNDING):
        raise ControllerError(
            f"delay = {delay_s:.6g} s: has amplitudes of {first:.5g}, {middle:.5g} and {last:.5g} "
            f"for {what}, which take max_reference = {asked:.5g} times max_command; {instead}"
        )


def _others(tick_s: float, mode: Mode, peak_factor: float) -> str:
    """Name delays of whole ticks that can be learned, or say that there are none."""
    low_s, high_s = learnable_delays(mode, peak_factor)
    low, high = math.ceil(low_s / tick_s - _ROUNDING), math.floor(high_s / tick_s + _ROUNDING)
    if low > high:
        return (
            f"delays from {low_s:.5g} to {high_s:.5g} s can be learned, which no whole number of ticks of "
            f"{tick_s:.6g} s is"
        )
    return f"delays such as {low * tick_s:.6g} to {high * tick_s:.6g} s can be learned"


def learnable_delays(mode: Mode, peak_factor: float) -> tuple[float, float]:
    """Give the shortest and longest delay within half a period that can be learned, in s.

    The absolute amplitudes of eq 4 sum to (1 + x) / (1 - x) up to a quarter of a period, with
    x = cos(w Td) / cosh(d w Td) falling, and to 1 from there to three quarters.

    Parameters
    ----------
    mode : Mode
        The vibration.
    peak_factor : float
        Largest sum of absolute amplitudes, 1 or more.

    Examples
    --------
    At most 8 times the command is allowed, which is more than 0.216 of half a period:

    >>> [round(delay_s / 0.5, 3) for delay_s in learnable_delays(Mode(1.0), 8.0)]
    [0.216, 0.899]
    """
    half_s = 0.5 * mode.damped_period_s
    extreme_s = half_s * math.acos(LARGEST_COSINE) / math.pi
    decay = mode.damping_ratio / math.sqrt(1.0 - mode.damping_ratio**2)
    low, high = 0.0, 0.5 * math.pi
    for _ in range(_HALVINGS):
        phase = 0.5 * (low + high)
        is_short = math.cos(phase) / math.cosh(decay * phase) > (peak_factor - 1.0) / (peak_factor + 1.0)
        low, high = (phase, high) if is_short else (low, phase)
    return max(extreme_s, half_s * high / math.pi), half_s - extreme_s
