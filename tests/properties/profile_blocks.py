"""Small motion profiles, made once, and ways to run them."""

from functools import cache

import numpy as np
from scipy.linalg import expm

from swayless.controller.profile import MotionProfile, ProfileInput
from swayless.design.optimal import Command, LinearPlant
from swayless.machine.profile_design import make_profile_design
from swayless.machine.profile_design_move import ProfileMove

OSCILLATOR = LinearPlant([[0.0, 1.0], [-16.0, -0.4]], [0.0, 16.0], [0.5, 0.0])
MASS = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
PLANTS = {"oscillator": OSCILLATOR, "mass": MASS}


def sampled_by_hand(plant, tick_s):
    """Exact for an input that stays between ticks, by the matrix exponential of state and input."""
    order = plant.b.size
    block = np.zeros((order + 1, order + 1))
    block[:-1, :-1], block[:-1, -1] = plant.a, plant.b
    exact = expm(block * tick_s)
    return exact[:-1, :-1], exact[:-1, -1]


def smallest_command(plant, tick_s, ticks, start, target):
    """The command from rest to rest whose sum of squares is least, straight from the definition."""
    a, b = sampled_by_hand(plant, tick_s)
    reach = np.array([np.linalg.matrix_power(a, ticks - 1 - tick) @ b for tick in range(ticks)]).T
    (from_state, from_input), (to_state, to_input) = plant.equilibrium(start), plant.equilibrium(target)
    inputs = from_input + np.linalg.lstsq(reach, to_state - from_state, rcond=None)[0]
    return Command(tick_s, inputs, to_input, initial_value=from_input)


@cache
def settings_of(kind, number):
    plant = PLANTS[kind]
    command = smallest_command(plant, 0.1, 12, 0.0, 1.0)
    most = 1.6 * np.abs([*command.values, command.final_value]).max()
    move = ProfileMove(plant, command, (-most, most), 0.0, 1.0, rate_limit_per_s=40.0 * most)
    return make_profile_design(kind, "test.toml", move, number).settings


def run(settings, history):
    """Run a history of (execute, abort, start, target); a start of None is where the block is."""
    profile, scalar, position = MotionProfile(settings), settings.number.scalar, settings.first_position
    trace = []
    for execute, abort, start, target in history:
        here = scalar(position if start is None else start)
        pins = ProfileInput(execute, abort, here, scalar(target))
        output = profile.step(pins)
        position = output.position
        trace.append((pins, output))
    return trace
