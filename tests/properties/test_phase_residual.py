"""What the phase clock leaves on a nonlinear crane that hoists while it travels."""

import math

import numpy as np
import pytest

from swayless.controller import CommandShaper, ShaperInput
from swayless.controller.rope import MM_PER_M
from swayless.plant import STANDARD_GRAVITY_M_S2
from swayless.plant.simulation import HoistingCrane
from tests.properties.crane_moves import (
    COMMAND_M_S,
    LEAD_S,
    LONG_M,
    MOVE_S,
    SHORT_M,
    SPEED_M_S,
    TICK_S,
    TIME_S,
    hoist,
    residuals,
)
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import phase_block, run

STEADY_S = (-4.0, -1.0)
"""Hoists of 17 s that start before the move and stop in the cruise, where nothing swings."""

WITHIN_S = (0.7, 1.5, 3.0, 8.0)
"""In the acceleration, after it, while the taps still come, and in the cruise, to stop after the move."""

HOISTS = [(LONG_M, SHORT_M, start) for start in STEADY_S + WITHIN_S]
HOISTS += [(SHORT_M, LONG_M, start) for start in STEADY_S + WITHIN_S]


def references(settings, commands_m_s, lengths_m, speeds_m_s):
    """References in m/s of a phase clock that is given this rope."""
    per_unit, scalar = settings.limits.units_per_m_s, settings.number.scalar
    if settings.number.is_integer:
        scales = (per_unit, MM_PER_M, MM_PER_M)
        rows = [
            np.rint(scale * values).astype(int).tolist()
            for scale, values in zip(scales, (commands_m_s, lengths_m, speeds_m_s), strict=True)
        ]
    else:
        rows = [[scalar(v) for v in values.tolist()] for values in (commands_m_s, lengths_m, speeds_m_s)]
    inputs = [
        ShaperInput(command, rope_length=length, hoist_speed=speed)
        for command, length, speed in zip(*rows, strict=True)
    ]
    return np.array([float(out.reference) for out in run(CommandShaper(settings), inputs)]) / per_unit


def moved(number):
    """Residuals of all hoists, and the way that each move went."""
    settings = phase_block(number)
    hoists = [hoist(*each) for each in HOISTS]
    moves = np.array([references(settings, COMMAND_M_S, rope[:-1], speed) for rope, speed in hoists])
    return residuals(moves, np.array([rope for rope, _ in hoists])), moves.sum(axis=1) * TICK_S


@pytest.mark.parametrize("number", NUMBERS)
def test_a_hoist_that_runs_or_stands_through_the_transients_leaves_0_1_percent_and_any_other_1_percent(
    number,
):
    left, ways_m = moved(number)
    steady = np.array([start in STEADY_S for _, _, start in HOISTS])
    print(f"{number}: " + ", ".join(f"{100 * value:.3f} %" for value in left))
    assert left[steady].max() <= 0.001
    assert left[~steady].max() <= 0.01
    # zvd delays by half a period: a move that stops on a shorter rope is shorter, by the difference at most,
    # and what answers a hoist moves the trolley by a centimetre or two.
    difference_m = SPEED_M_S * TICK_S * float(spacing_ticks(LONG_M) - spacing_ticks(SHORT_M))
    shorter_m = SPEED_M_S * MOVE_S - ways_m
    hoisted = np.array([start_m > end_m for start_m, end_m, _ in HOISTS])
    assert np.all(shorter_m * np.where(hoisted, 1.0, -1.0) >= 0.3)
    assert np.abs(shorter_m).max() <= difference_m + 0.02


def spacing_ticks(length_m):
    """Half a period, in ticks."""
    return np.rint(math.pi * np.sqrt(np.asarray(length_m) / STANDARD_GRAVITY_M_S2) / TICK_S).astype(int)


def zvd(commands_m_s, spacing):
    """Taps of zvd that look back by whole ticks, as many as the spacing of each tick says."""
    ticks = np.arange(commands_m_s.size)
    before = [np.maximum(ticks - k * spacing, 0) for k in range(3)]
    return 0.25 * commands_m_s[before[0]] + 0.5 * commands_m_s[before[1]] + 0.25 * commands_m_s[before[2]]


@pytest.mark.parametrize(("start_m", "end_m"), [(LONG_M, SHORT_M), (SHORT_M, LONG_M)])
def test_fixed_taps_and_delays_looked_up_from_the_length_of_the_tick_leave_percents(start_m, end_m):
    rope, _ = hoist(start_m, end_m, STEADY_S[1])
    ramp = np.minimum(np.cumsum(COMMAND_M_S > 0) * 0.4 * TICK_S, SPEED_M_S)
    down = np.maximum(SPEED_M_S - np.cumsum(TIME_S >= LEAD_S + MOVE_S) * 0.4 * TICK_S, 0.0)
    command = np.minimum(ramp, down)
    fixed = zvd(command, spacing_ticks(0.5 * (start_m + end_m)))
    looked_up = zvd(command, spacing_ticks(rope[:-1]))
    left = residuals(np.array([fixed, looked_up]), rope)
    print(f"fixed {100 * left[0]:.2f} %, looked up {100 * left[1]:.2f} %")
    assert left[0] > 0.05
    assert left[1] > 0.01


@pytest.mark.parametrize("family", ["zvd", "ei"])
@pytest.mark.parametrize("length_m", [3.74, 8.0])
def test_on_a_rope_that_stands_the_crane_does_what_the_linear_model_foretells_up_to_5_degrees(
    family, length_m
):
    # The block believes in 6 m, so that there is something to foretell; the speed is that of 5 degrees.
    settings = phase_block(family=family, acceleration_m_s2=100.0)
    speed = math.radians(5.0) * math.sqrt(STANDARD_GRAVITY_M_S2 * length_m)
    for believed_m in (length_m, 6.0):
        step = np.full(round(8.0 / TICK_S), min(speed, 0.8))
        reference = references(settings, step, np.full(step.size, believed_m), np.zeros(step.size))
        crane = HoistingCrane().simulate(reference, length_m, tick_s=TICK_S)
        phase = math.sqrt(STANDARD_GRAVITY_M_S2 / length_m) * TICK_S * np.arange(step.size)
        linear = abs(np.diff(reference, prepend=0.0) @ np.exp(1j * phase)) / step[0]
        left = float(crane.residual_ratio(float(step[0])))
        print(
            f"{family} {length_m} m, believed {believed_m} m: {100 * left:.2f} %, linear {100 * linear:.2f} %"
        )
        assert abs(left - linear) <= 0.005
        if family == "zvd" and believed_m == length_m:
            assert left <= 0.001
