"""Constants of the answer to hoisting in double and float. Not for: int32 (`c_phase_int32`)."""

from __future__ import annotations

from swayless.codegen.c_types import CConstant, CTable, CTypes, c_table
from swayless.controller import hoist
from swayless.controller.hoist_answers import answers, leaning_from
from swayless.controller.settings import ShaperSettings

ANSWER_DOC = "steps of the taps, by row, that answer a wanted step of 1: in sum 0, and without way"
LEAN_DOC = "steps of the taps, by row, that excite nothing: with them an answer goes only up or only down"


def float_constants(settings: ShaperSettings, types: CTypes) -> list[CConstant]:
    """List the scalar constants, each with its origin.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    assert settings.clock is not None  # noqa: S101 - only a phase clock has these constants
    scalar, clock, largest = types.number.scalar, settings.clock, settings.limits.max_command
    constants = [
        ("QUANTUM_RAD", clock.quantum_rad, "rad: phase of a quantum"),
        ("KICK_PER_QUANTUM", hoist.kick_per_quantum(settings), "QUANTUM_RAD / (9.80665 m/s2 tick)"),
        ("PER_MOST", 1.0 / clock.most_quanta, "1 / quanta of a tick on the shortest rope"),
        ("PER_FEWEST", 1.0 / clock.fewest_quanta, "1 / quanta of a tick on the longest rope"),
        ("LOSS", 2.0 * hoist.loss_ratio(settings), "twice the damping ratio of the swing"),
        ("LONGEST_STRETCH", hoist.LONGEST_STRETCH, "most change of sqrt(rope length) foreseen"),
        ("LEAST_MISMATCH", hoist.LEAST_MISMATCH, "least relative error of a part that is corrected"),
        ("LEAST_ANSWER", largest * scalar(hoist.LEAST_ANSWER), "smaller kicks are collected"),
        ("LEAST_LACK", largest * scalar(hoist.LEAST_LACK), "smaller corrections are left out"),
        ("LEANING_FROM", leaning_from(settings), "from here on answers lean away from the maximum"),
    ]
    return [CConstant(types.real, name, types.literal(value), doc) for name, value, doc in constants]


def float_tables(settings: ShaperSettings, types: CTypes) -> list[CTable]:
    """List what hoisting does to each tap, and the series of its weight.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    stretches = [[types.literal(value) for value in row] for row in hoist.stretches(settings)]
    series = [types.literal(value) for value in hoist.SERIES]
    steps = [[types.literal(value) for value in each.even] for each in answers(settings)]
    leans = [[types.literal(value) for value in each.lean] for each in answers(settings)]
    doc = "relative change of sqrt(rope length) until each tap, by row, per m/s and quantum of the tick"
    return [
        c_table(types.real, "STRETCH", stretches, doc),
        c_table(types.real, "SERIES", [series], "(1 + z)^(-1/2) = 1 + z (s0 + z (s1 + z (s2 + z s3)))"),
        c_table(types.real, "ANSWER", steps, ANSWER_DOC),
        c_table(types.real, "LEAN", leans, LEAN_DOC),
    ]
