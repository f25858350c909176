"""A crane that hoists while it travels 12 m, and what a law leaves of its swing."""

import math

import numpy as np

from swayless.plant.simulation import HoistingCrane

TICK_S = 0.01
SPEED_M_S, HOIST_M_S = 0.6, 0.3
LONG_M, SHORT_M = 8.84, 3.74
LEAD_S, MOVE_S, TAIL_S = 5.0, 12.0 / SPEED_M_S, 14.0
"""Before the move, the move of 12 m, and two periods of the longest rope."""

TIME_S = TICK_S * np.arange(round((LEAD_S + MOVE_S + TAIL_S) / TICK_S))
COMMAND_M_S = np.where((TIME_S >= LEAD_S) & (TIME_S < LEAD_S + MOVE_S - TICK_S / 2), SPEED_M_S, 0.0)


def hoist(start_m, end_m, start_s):
    """Rope lengths at the beginning of each tick and the end, and hoist speeds."""
    speed = math.copysign(HOIST_M_S, end_m - start_m)
    first = round((LEAD_S + start_s) / TICK_S)
    speeds = np.zeros(TIME_S.size)
    speeds[first : first + round((end_m - start_m) / speed / TICK_S)] = speed
    return start_m + np.concatenate([[0.0], np.cumsum(speeds) * TICK_S]), speeds


def residuals(references_m_s, ropes_m):
    return HoistingCrane().simulate(references_m_s, ropes_m, tick_s=TICK_S).residual_ratio(SPEED_M_S)
