"""What generated code calls the counts of its clock: ticks, or quanta of phase. Not for: how it counts."""

from __future__ import annotations

from dataclasses import dataclass

from swayless.controller.settings import ShaperSettings


@dataclass(frozen=True)
class ClockNames:
    """Names of what both clocks have, in C.

    Parameters
    ----------
    unit : str
        What lags are counted in.
    c_still : str
        Member of the state that counts for how long nothing has changed.
    c_last : str
        Constant that it grows up to: the longest lag of any row.
    c_lags, c_tails, c_moments : str
        Tables of the lag of each tap, of the last lag of each row, and of each row's moment.
    lag : str
        What a lag is, for comments.
    """

    unit: str
    c_still: str
    c_last: str
    c_lags: str
    c_tails: str
    c_moments: str
    lag: str


TICK_NAMES = ClockNames(
    "ticks", "still_ticks", "LAST_TICKS", "DELAY_TICKS", "TAIL_TICKS", "MOMENT_TICKS", "delay"
)
PHASE_NAMES = ClockNames(
    "quanta", "still_quanta", "LAST_QUANTA", "LAG_QUANTA", "TAIL_QUANTA", "MOMENT_QUANTA", "lag"
)


def clock_names(settings: ShaperSettings) -> ClockNames:
    """Find the names for the clock of a block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    return TICK_NAMES if settings.clock is None else PHASE_NAMES
