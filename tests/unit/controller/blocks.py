"""Small command shapers to test with, built from plain numbers."""

import copy
from dataclasses import replace
from fractions import Fraction

import numpy as np

from swayless.controller import (
    Bank,
    CommandShaper,
    Row,
    ShaperInput,
    ShaperSettings,
    SpeedLimits,
    Taps,
    command_limits,
    number_type,
)
from swayless.controller.number import amplitudes_on_lattice
from swayless.controller.phase_clock import phase_clock
from swayless.controller.phase_taps import phase_taps
from swayless.controller.rope import rope_settings
from swayless.design import design_shaper
from swayless.design.shaper import Guarantee
from swayless.plant import Band, Mode

TICK_S = 0.05
MAX_SPEED_M_S = 0.5
COUNTS_PER_M_S = 20_000.0
GUARANTEE = Guarantee(0.05, Mode(0.5), Band(0.49, 0.51), 0.05)
"""What taps promise is no matter of the law: any guarantee will do."""

ZVD = ((0, 0.25), (4, 0.5), (8, 0.25))
EI = ((0, 0.2625), (3, 0.475), (6, 0.2625))
UM_ZV = ((0, 1.0), (2, -1.0), (4, 1.0))
UM_SPLIT = ((0, 1.0), (3, -0.3), (4, -0.7), (7, 1.0))


def taps(impulses, number="double", tick_s=TICK_S):
    """Taps from (delay, amplitude) pairs, on the lattice of the number type."""
    kind = number_type(number)
    delays, amplitudes = zip(*impulses, strict=True)
    numerators = amplitudes_on_lattice(amplitudes, kind.amplitude_bits)
    return Taps(np.array(delays), np.array(numerators) / 2.0**kind.amplitude_bits, tick_s, GUARANTEE, kind)


def block(*rows, number="double", **limits):
    """Settings of a shaper with these rows; limits as in SpeedLimits, ramps of 10 ticks unless given."""
    limits.setdefault("max_speed_m_s", MAX_SPEED_M_S)
    limits.setdefault("acceleration_m_s2", MAX_SPEED_M_S / (10 * TICK_S))
    limits.setdefault("deceleration_m_s2", limits["acceleration_m_s2"])
    limits.setdefault("quick_stop_m_s2", limits["acceleration_m_s2"])
    if number == "int32":
        limits.setdefault("units_per_m_s", COUNTS_PER_M_S)
    bank = Bank(tuple(Row(f"row {i}", "test", taps(row, number)) for i, row in enumerate(rows, start=1)))
    speeds = SpeedLimits(**limits)
    return ShaperSettings(bank, command_limits(speeds, tick_s=TICK_S, number=number_type(number)))


def phase_block(
    number="double",
    *,
    family="zvd",
    damping_ratio=0.0,
    rope_length_m=(3.0, 9.0),
    hoist_speed_m_s=0.4,
    tick_s=0.01,
    **limits,
):
    """Settings of a phase clock with one row of a family; limits as in SpeedLimits."""
    kind = number_type(number)
    limits.setdefault("max_speed_m_s", 0.8)
    limits.setdefault("acceleration_m_s2", 0.4)
    limits.setdefault("deceleration_m_s2", limits["acceleration_m_s2"])
    limits.setdefault("quick_stop_m_s2", 2.0 * limits["acceleration_m_s2"])
    if number == "int32":
        limits.setdefault("units_per_m_s", COUNTS_PER_M_S)
    shaper = design_shaper(family, Mode(1.0, damping_ratio))
    phases_rad = 2.0 * np.pi * shaper.times_s
    rope = rope_settings(rope_length_m, hoist_speed_m_s, tick_s=tick_s, number=kind)
    clock = phase_clock(rope, tick_s=tick_s, most_phase_rad=float(phases_rad[-1]), number=kind)
    guarantee = replace(shaper.guarantee, tolerance=0.051)  # the split between ticks needs some
    made = phase_taps(phases_rad, shaper.amplitudes, tick_s=tick_s, guarantee=guarantee, clock=clock)
    speeds = command_limits(SpeedLimits(**limits), tick_s=tick_s, number=kind, on_grid=True)
    return ShaperSettings(Bank((Row("row 1", family, made),)), speeds, rope)


def command_of(settings, ratio):
    """A command from a ratio of the maximum, in the number type."""
    value = ratio * float(settings.limits.max_command)
    return settings.number.scalar(round(value) if settings.number.is_integer else value)


def run(shaper, inputs):
    """Outputs of all ticks."""
    return [shaper.step(each) for each in inputs]


def press(settings, ratio, ticks, **fields):
    """The same input for some ticks."""
    return [ShaperInput(command_of(settings, ratio), **fields)] * ticks


def fork(shaper):
    """An independent copy of a shaper; what never changes is shared."""
    settings = shaper._settings
    constants = (settings, settings.limits, settings.number, settings.row_tables, settings.operator)
    constants += (settings.clock, settings.diagnostics, shaper._units, shaper._foretelling)
    return copy.deepcopy(shaper, {id(value): value for value in constants})


def convolved(command, row_table, number):
    """The plain convolution of a command with a row's taps: exact in int32, in float64 else."""
    if number.is_integer:
        amplitudes = [Fraction(a, 1 << 30) for a in row_table.amplitudes]
    else:
        amplitudes = [float(a) for a in row_table.amplitudes]
        command = [float(x) for x in command]
    return [
        sum(a * command[k - d] for d, a in zip(row_table.lags, amplitudes, strict=True) if d <= k)
        for k in range(len(command))
    ]


def ramped_commands(settings, inputs):
    """The command after checks and ramp: what row 0 puts out."""
    return [out.reference for out in run(CommandShaper(settings), [i._replace(selector=0) for i in inputs])]
