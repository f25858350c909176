"""Blocks with a measured rope to compile: small, large, and with every optional part of the law."""

import dataclasses

import numpy as np

from swayless.controller import Bank, Row, ShaperSettings
from swayless.controller.phase_taps import phase_taps
from swayless.controller.taps import RopeRows
from swayless.design import design_shaper
from swayless.plant import Mode
from tests.unit.controller.blocks import EI, UM_ZV, ZVD, block, phase_block


def gantry(number):
    """One zvd row."""
    return phase_block(number, family="zvd", tick_s=0.02)


def everything(number):
    """Two damped rows, inching, minimum, resolution, three ramps, a fast hoist and a coarse tick."""
    settings = phase_block(
        number,
        family="ei",
        damping_ratio=0.04,
        rope_length_m=(4.0, 11.5),
        hoist_speed_m_s=1.0,
        tick_s=0.05,
        acceleration_m_s2=0.5,
        deceleration_m_s2=0.7,
        quick_stop_m_s2=1.6,
        minimum_speed_m_s=0.02,
        inching_speed_m_s=0.09,
        command_resolution_m_s=0.01,
    )
    return with_row(settings, "zv")


def with_row(settings, family):
    """The same block with one row more, on the same clock."""
    first = settings.bank.rows[0].taps
    shaper = design_shaper(family, Mode(1.0, first.guarantee.mode.damping_ratio))
    taps = phase_taps(
        2.0 * np.pi * shaper.times_s,
        shaper.amplitudes,
        tick_s=settings.tick_s,
        guarantee=dataclasses.replace(first.guarantee, tolerance=0.2),  # no matter of the law
        clock=settings.clock,
    )
    rows = (*settings.bank.rows, Row(family, family, taps))
    return ShaperSettings(Bank(rows), settings.limits, settings.rope)


def unramped(number):
    """A long row on a wide range of ropes, up to five cells a tick, and commands that step."""
    return phase_block(
        number,
        family="zvddd",
        rope_length_m=(1.0, 14.0),
        hoist_speed_m_s=0.6,
        tick_s=0.04,
        acceleration_m_s2=30.0,
    )


def measured_only(number):
    """The tick clock with a measured rope: readings are judged, no tap moves."""
    rope = phase_block(number, tick_s=0.05).rope
    return dataclasses.replace(block(ZVD, number=number), rope=rope)


def chosen_by_rope(number):
    """The tick clock with three rows, of which the measured rope chooses one, with hysteresis."""
    settings = block(ZVD, EI, UM_ZV, number=number)
    rope = phase_block(number, tick_s=0.05).rope
    scale, scalar = (1000, int) if settings.number.is_integer else (1, settings.number.scalar)
    lower, upper = ([scalar(m * scale) for m in ends] for ends in ((6.5, 4.0, 3.0), (9.0, 7.0, 4.5)))
    rows = RopeRows(tuple(lower), tuple(upper))
    return ShaperSettings(Bank(settings.bank.rows, rows), settings.limits, rope)


BLOCKS = {
    "gantry": gantry,
    "everything": everything,
    "unramped": unramped,
    "measured only": measured_only,
    "chosen by rope": chosen_by_rope,
}
